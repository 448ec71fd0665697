"""A run directory, read when asked."""

from __future__ import annotations

import json
import os
from functools import cached_property
from pathlib import Path
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from gnbv import _core
from gnbv._errors import BadInput
from gnbv._frames import Frames
from gnbv._program import call

Array = npt.NDArray[Any]
_TEXT = {"sampler", "via"}
_COUNTS = {"iteration", "candidates", "valid", "cloud_points", "view", "plan_view"}
MAP_DTYPE = np.dtype(
    [("x_m", "f8"), ("y_m", "f8"), ("z_m", "f8"), ("size_m", "f8"), ("log_odds", "f4")]
)


class Run:
    """What a mission left behind. Arrays are read once, when they are first asked for.

    Attributes:
        folder: the run directory.
    """

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = Path(folder)

    def __reduce__(self) -> tuple[Any, ...]:  # another process reads what it is asked for
        return Run, (self.folder,)

    def __repr__(self) -> str:
        s = self.summary
        return (
            f"<gnbv.Run {s['scenario']} {s['utility']} seed {s['seed']}: {s['termination']} after "
            f"{s['iterations']} views, {100 * self.final_coverage:.1f} % at 0.05 m, {self.folder}>"
        )

    @cached_property
    def summary(self) -> dict[str, Any]:
        """summary.json, as it is."""
        file = self.folder / "summary.json"
        try:
            read: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
        except OSError as error:
            raise BadInput(
                f"{file}: {error.strerror}: no run, or one that is not finished"
            ) from error
        except json.JSONDecodeError as error:
            raise BadInput(f"{file}:{error.lineno}: {error.msg}") from error
        except UnicodeDecodeError as error:
            raise BadInput(f"{file}: {error}") from error
        if not isinstance(read, dict) or "coverage" not in read:
            raise BadInput(f"{file}: is no summary of a run")
        return read

    @cached_property
    def iterations(self) -> Array:
        """iterations.csv: a row a view; metres, radians, nat, seconds, by its column names."""
        return _csv(self.folder / "iterations.csv")

    @cached_property
    def coverage(self) -> Array:
        """coverage.csv: after the profile (row 0) and after each view; shares from 0 to 1.

        Runs that old versions scored lack the columns accurate_0.05 and so on.
        """
        return _csv(self.folder / "coverage.csv")

    @cached_property
    def cloud(self) -> npt.NDArray[np.float32]:
        """The model: points x 3, metres, world ENU."""
        return _core.read_cloud(os.fspath(self.folder / "cloud.ply"))

    @cached_property
    def frames(self) -> Frames:
        """What the cameras saw at each view, of a run that keeps it (frames=True): a sequence of
        gnbv.Frame. Raises BadInput for one that does not."""
        return Frames(_core.read_frames(os.fspath(self.folder)))

    @cached_property
    def map(self) -> Array:
        """The occupancy map's leaves: centre and size (m), log-odds (natural logarithm)."""
        leaves = _core.read_map(os.fspath(self.folder / "map.ot"))
        out = np.empty(len(leaves), MAP_DTYPE)
        for column, name in enumerate(MAP_DTYPE.names or ()):
            out[name] = leaves[:, column]
        return out

    @cached_property
    def trajectory(self) -> npt.NDArray[np.float64]:
        """The true path at 10 Hz: time (s), x, y, z (m), qx, qy, qz, qw; body in world."""
        file = self.folder / "trajectory.tum"
        lines = _lines(file)
        try:
            return np.loadtxt(lines, ndmin=2, usecols=range(8))
        except ValueError as error:
            raise BadInput(f"{file}: {error}") from error

    @property
    def final_coverage(self) -> float:
        """Share of the voxels of 0.05 m that the score counts which the cloud covers."""
        return float(self.summary["coverage"]["final"]["0.05"])

    @property
    def accurate_coverage(self) -> float | None:
        """The same, of voxels with a point within 0.01 m of the surface; None of old versions."""
        found = self.summary["coverage"].get("accurate")
        return None if found is None else float(found["0.05"])

    @property
    def termination(self) -> str:
        return str(self.summary["termination"])

    @property
    def sha256(self) -> str:
        """Of all that was measured, decided and believed; the same seed and build repeat it."""
        return str(self.summary["result_sha256"])

    @property
    def utility_source(self) -> str | None:
        """The text of a utility of your own, as it was run."""
        file = self.folder / "utility.py"
        return "".join(_lines(file)) if file.exists() else None

    def render(self, *what: str, out: str | os.PathLike[str] | None = None) -> list[Path]:
        """Draws pictures ("path" by default; `gnbv render --help`), and returns their files."""
        target = Path(out) if out is not None else self.folder
        said = call(
            "render", str(self.folder), "--what", ",".join(what or ("path",)), "-o", str(target)
        )
        return [Path(line) for line in said.split("\n") if line]

    def report(self, out: str | os.PathLike[str] | None = None) -> Path:
        """Writes the interactive page of this run, and returns its file."""
        file = Path(out) if out is not None else self.folder / "report.html"
        call("report", str(self.folder), "-o", str(file))
        return file

    def export(self, form: str, out: str | os.PathLike[str] | None = None) -> Path:
        """Writes the run for other tools: colmap, nerfstudio, tum, plain, rerun or mcap."""
        said = call(
            "export", str(self.folder), "--format", form, *(["-o", str(out)] if out else [])
        )
        return Path(said.rstrip("\n").split("\n")[-1])


def load(folder: Union[str, os.PathLike[str]]) -> Run:
    """The run in a folder. Raises BadInput when it holds none that is finished."""
    run = Run(folder)
    run.summary  # noqa: B018  (says now what is wrong)
    return run


def _lines(file: Path) -> list[str]:
    """With their ends. Raises BadInput for a file that is no text."""
    try:
        return file.read_text(encoding="utf-8").splitlines(keepends=True)
    except (OSError, UnicodeDecodeError) as error:
        raise BadInput(f"{file}: cannot be read: {error}") from error


def _csv(file: Path) -> Array:
    def kind(name: str, cells: list[str]) -> str:
        if name in _TEXT:
            return f"U{max(map(len, cells), default=0) or 1}"
        return "i8" if name in _COUNTS else "f8"

    names, *rows = [line.rstrip("\n").split(",") for line in _lines(file) or [""]]
    if not all(names):
        raise BadInput(f"{file}:1: has no names of columns")
    columns = [[row[i] for row in rows if i < len(row)] for i in range(len(names))]
    read = np.empty(len(rows), [(n, kind(n, c)) for n, c in zip(names, columns, strict=True)])
    for i, row in enumerate(rows):
        try:
            read[i] = tuple(row)
        except ValueError as error:
            raise BadInput(f"{file}:{i + 2}: {error}") from error
    return read
