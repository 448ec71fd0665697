"""gnbv.table and gnbv.compare: many missions, and what their statistics say."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from gnbv._errors import BadInput
from gnbv._mission import settings
from gnbv._program import call
from gnbv._utility import Utilities, as_arguments

PathLike = Union[str, "os.PathLike[str]"]


@dataclass(frozen=True)
class Table:
    """One table as data.

    Attributes:
        title: what it is about.
        rows: structured array, a row a line of the table; numbers that are missing are NaN.
            KEY_ci95 is the half width of the 95 % interval of KEY.
        notes: what has to be known to read it.
    """

    title: str
    rows: npt.NDArray[Any]
    notes: list[str]

    def __str__(self) -> str:
        names = self.rows.dtype.names or ()
        cells = [[_text(row[name]) for name in names] for row in self.rows]
        widths = [max(len(text) for text in column) for column in zip(names, *cells, strict=True)]
        lines = [
            "  ".join(text.ljust(width) for text, width in zip(line, widths, strict=True)).rstrip()
            for line in [list(names), *cells]
        ]
        return "\n".join([self.title, *lines, *self.notes])


def table(
    scenario: PathLike, *, seeds: int = 1, oracle: bool = True, **options: Any
) -> list[Table]:
    """Every row of the paper's table of this scenario, flown over seeds, beside its figures.

    Args:
        oracle: also planners that know the structure.
        options: seed, set, mesh, jobs, threads, out, utilities (rows of your own beside), as
            for compare().
    """
    extra = [] if oracle else ["--no-oracle"]
    return _tables(["table", os.fspath(scenario)], seeds=seeds, extra=extra, **options)


def compare(
    *scenarios: PathLike,
    utilities: Utilities = (),
    presets: Iterable[str] = (),
    variants: Mapping[str, Mapping[str, Any]] | None = None,
    seeds: int = 8,
    ceiling: bool = True,
    **options: Any,
) -> list[Table]:
    """Is A better than B here? Missions over seeds, paired differences, tests.

    Args:
        scenarios: built-in names or YAML files.
        utilities: names, '[NAME=]FILE.py:FUNCTION' or functions of your own, utilities and
            planners, perhaps by names of your choice (a dict); the first is the baseline.
        presets: of the planner, as methods.
        variants: methods by name, each with the values it sets.
        ceiling: also shares of the most that any planner could cover from allowed positions (a
            minute where it is not known).
        options: seed (the first), set, mesh, jobs (missions at a time), threads, out (folder of
            the missions: what it holds is not flown again).

    Raises BadInput, Failed (a mission failed; the message says which) or KeyboardInterrupt.
    """
    extra = [] if ceiling else ["--no-ceiling"]
    if names := _listed("presets", presets):
        extra += ["--presets", _joined("presets", names)]
    for name, values in (variants or {}).items():
        extra += ["--variant", f"{name}:{','.join(settings(values))}"]
    command = ["compare", *(os.fspath(scenario) for scenario in scenarios)]
    return _tables(command, seeds=seeds, extra=extra, utilities=utilities, **options)


def _tables(
    command: list[str],
    *,
    seeds: int,
    extra: list[str],
    utilities: Utilities = (),
    seed: int | None = None,
    set: Mapping[str, Any] | None = None,
    mesh: PathLike | None = None,
    jobs: int = 1,
    threads: int = 0,
    out: PathLike | None = None,
) -> list[Table]:
    arguments = [*command, "--seeds", str(seeds), "--jobs", str(jobs), "--threads", str(threads)]
    arguments += ["--quiet", "--format", "json", *extra]
    arguments += ["--seed", str(seed)] if seed is not None else []
    arguments += ["--mesh", os.fspath(mesh)] if mesh is not None else []
    arguments += ["--out", os.fspath(out)] if out is not None else []
    for setting in settings(set):
        arguments += ["--set", setting]
    if not isinstance(utilities, Mapping):
        utilities = _listed("utilities", utilities)
    with as_arguments(utilities) as names:
        arguments += ["--utilities", _joined("utilities", names)] if names else []
        said = call(*arguments)
    return [_table(read) for read in _documents(said)]


def _listed(what: str, names: Any) -> list[Any]:
    if isinstance(names, (str, os.PathLike)) or not isinstance(names, Iterable):
        raise BadInput(f"{what}: value {names!r}: expected a list of them, perhaps of one")
    return list(names)


def _joined(what: str, names: list[str]) -> str:
    """As the program takes a list."""
    for name in names:
        if "," in name:
            raise BadInput(f"{what}: value {name!r}: expected one without commas, in its path, too")
    return ",".join(names)


def _documents(text: str) -> list[dict[str, Any]]:
    """JSON objects (or lists of them), one behind the other."""
    decoder, at, found = json.JSONDecoder(), 0, []
    while (at := len(text) - len(text[at:].lstrip())) < len(text):
        read, at = decoder.raw_decode(text, at)
        found += read if isinstance(read, list) else [read]
    return found


def _table(read: dict[str, Any]) -> Table:
    keys = [column["key"] for column in read["columns"]]
    columns = {key: [row.get(key) for row in read["rows"]] for key in keys}
    dtype = []
    for key, values in columns.items():
        is_text = any(isinstance(value, str) for value in values)
        width = max((len(str(value)) for value in values), default=1) or 1
        dtype.append((key, f"U{width}" if is_text else "f8"))
    rows = np.empty(len(read["rows"]), dtype=dtype)
    for (key, kind), values in zip(dtype, columns.values(), strict=True):
        missing: Any = "" if kind.startswith("U") else np.nan
        rows[key] = [missing if value is None else value for value in values]
    return Table(read["title"], rows, list(read.get("notes", [])))


def _text(value: Any) -> str:
    return str(value) if isinstance(value, str) else f"{float(value):.6g}"
