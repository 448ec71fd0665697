"""Figures of runs as matplotlib axes, to be styled on; `gnbv plot` draws the same.

    ax = gnbv.plots.coverage(["runs/a", "runs/b"], effort="metres")
    ax.set_xlim(0, 400)
    ax.figure.savefig("coverage.pdf")

Every function takes run directories, folders of them, or `gnbv.Run`s, and `ax` (or, of several
panels, `axes`) to draw into. What it draws is computed by the program: figures() has it as data.
Needs matplotlib.
"""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

from gnbv._errors import BadInput
from gnbv._program import call
from gnbv._run import Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes

PathLike = Union[str, "os.PathLike[str]"]
Runs = Union[PathLike, Run, Iterable[Union[PathLike, Run]]]
Figure = dict[str, Any]
KINDS = ("density", "coverage", "terms", "reach", "flight", "tracking", "predictions")


def figures(
    runs: Runs,
    kinds: Sequence[str] = KINDS,
    *,
    size: float = 0.05,
    reach: int = 95,
    title: str = "",
    labels: Mapping[str, str] | None = None,
    colors: Mapping[str, str] | None = None,
    order: Sequence[str] = (),
) -> list[Figure]:
    """All figures of these runs as data (`gnbv schema figures` prints their JSON Schema).

    Args:
        kinds: of KINDS.
        size: edge of the voxels that are covered (m).
        reach: percent of the ceiling that the reach figures ask for.
        title: in the place of each figure's own.
        labels, colors: by group: its label in the legend, its utility, or its number from 1.
        order: groups; the others follow.
    """
    with tempfile.TemporaryDirectory() as folder:
        command = ["plot", *_folders(runs), "--format", "json", "-o", folder]
        command += ["--plots", ",".join(kinds), "--voxel", str(size), "--reach", str(reach)]
        command += ["--title", title] if title else []
        for option, named in (("--labels", labels), ("--colors", colors)):
            for group, value in (named or {}).items():
                command += [option, f"{group}={value}"]
        for group in order:
            command += ["--order", group]
        call(*command)
        return read(Path(folder) / "figures.json")


def read(file: PathLike) -> list[Figure]:
    """The figures of a figures.json of `gnbv plot --format json` or `gnbv compare --plots`."""
    found: list[Figure] = json.loads(Path(file).read_text(encoding="utf-8"))["figures"]
    return found


def draw(figure: Figure, axes: Sequence[Axes] | None = None) -> list[Axes]:
    """Draws a figure of figures() or read(), panel by panel, into axes of yours or its own."""
    try:
        import matplotlib.pyplot as plt
    except ModuleNotFoundError as error:
        raise ImportError("gnbv.plots needs matplotlib: pip install 'gnbv[plot]'") from error
    from gnbv.plots._draw import add_panels, draw_panel, legend_of, safe, style

    panels = figure["panels"]
    with plt.rc_context(style() if axes is None else {}):
        if axes is None:
            height_in = 0.7 + sum(panel["height_px"] + 60 for panel in panels) / 432
            canvas = plt.figure(figsize=(3.5, height_in), layout="constrained", dpi=150)
            drawn = add_panels(figure, canvas)
            canvas.suptitle(safe(figure["title"]))
        elif len(axes) != len(panels):
            raise BadInput(f"{figure['name']}: has {len(panels)} panels, not {len(axes)} axes")
        else:
            drawn = [draw_panel(ax, panel) for ax, panel in zip(axes, panels, strict=True)]
        for ax, panel in zip(drawn, panels, strict=True):
            handles, texts = legend_of(panel)
            if handles:
                ax.legend(handles, texts)
    return drawn


def coverage(
    runs: Runs, *, effort: str = "metres", end: bool = False, ax: Axes | None = None, **options: Any
) -> Axes:
    """Coverage over "views", "metres" or "seconds", of many runs; `end`: its last 15 %.

    From take-off: "metres_with_profile", "seconds_with_profile", "wh_with_profile"."""
    name = f"coverage-{effort}" + ("-end" if end else "")
    return _one(runs, "coverage", name, ax, options)


def reach(
    runs: Runs, percent: int = 95, *, effort: str = "metres", ax: Axes | None = None, **options: Any
) -> Axes:
    """The share of the runs that covered so much of the ceiling, over effort."""
    return _one(runs, "reach", f"reach-{effort}", ax, options | {"reach": percent})


def density(runs: Runs, *, axes: Sequence[Axes] | None = None, **options: Any) -> list[Axes]:
    """Density over the views, of several methods in one panel; of one run below its entropy."""
    return _all(runs, "density", axes, options)


def terms(run: Runs, *, axes: Sequence[Axes] | None = None, **options: Any) -> list[Axes]:
    """What made the chosen views of one run worth choosing."""
    return _all(run, "terms", axes, options)


def flight(run: Runs, *, axes: Sequence[Axes] | None = None, **options: Any) -> list[Axes]:
    """Position, attitude, speed and, of legs, the distance from them, of one run."""
    return _all(run, "flight", axes, options)


def tracking(run: Runs, *, axes: Sequence[Axes] | None = None, **options: Any) -> list[Axes]:
    """How well the vehicle kept to its legs, of one run."""
    return _all(run, "tracking", axes, options)


def predictions(run: Runs, *, axes: Sequence[Axes] | None = None, **options: Any) -> list[Axes]:
    """What the views of one tour promised beside what they brought."""
    return _all(run, "predictions", axes, options)


def forest(
    file: PathLike, scenario: str | None = None, *, axes: Sequence[Axes] | None = None
) -> list[Axes]:
    """Paired differences with intervals, of the figures.json that `gnbv compare --plots` wrote."""
    found = [each for each in read(file) if each["kind"] == "forest"]
    return draw(_named(found, f"forest-{scenario}" if scenario else None, os.fspath(file)), axes)


def _one(runs: Runs, kind: str, name: str, ax: Axes | None, options: dict[str, Any]) -> Axes:
    figure = _named(figures(runs, [kind], **options), name, ", ".join(_folders(runs)))
    return draw(figure, None if ax is None else [ax])[0]


def _all(runs: Runs, kind: str, axes: Sequence[Axes] | None, options: dict[str, Any]) -> list[Axes]:
    found = figures(runs, [kind], **options)
    overlaid = [each for each in found if each["name"] == kind]  # not of each run alone
    return draw(_named(overlaid or found, None, ", ".join(_folders(runs))), axes)


def _named(found: list[Figure], name: str | None, whose: str) -> Figure:
    for figure in found:
        if name is None or figure["name"] == name:
            return figure
    names = ", ".join(figure["name"] for figure in found) or "none"
    raise BadInput(f"{whose}: no figure {name or 'of that kind'}; there are: {names}")


def _folders(runs: Runs) -> list[str]:
    given = [runs] if isinstance(runs, (str, os.PathLike, Run)) else list(runs)
    return [os.fspath(run.folder if isinstance(run, Run) else run) for run in given]
