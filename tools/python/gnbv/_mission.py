"""gnbv.run."""

from __future__ import annotations

import json
import operator
import os
import sys
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from typing import Any, Union

from gnbv import _core
from gnbv._errors import BadInput, Failed, Interrupted, UtilityFailed
from gnbv._picture import Live, live_picture
from gnbv._planner import AskedPlanner, Planner
from gnbv._run import Run
from gnbv._utility import Utility, as_arguments, recorded_planner

PathLike = Union[str, "os.PathLike[str]"]
Progress = Callable[[float, str], None]
MOST_THREADS = 1024


def run(
    scenario: PathLike,
    *,
    utility: Utility | None = None,
    planner: Planner | str | os.PathLike[str] | None = None,
    seed: int | None = None,
    preset: str | None = None,
    mesh: PathLike | None = None,
    bounds: str = "scenario",
    set: Mapping[str, Any] | None = None,
    out: PathLike | None = None,
    threads: int = 0,
    resume: bool = False,
    frames: bool = False,
    candidates: bool = False,
    ceiling: bool = False,
    progress: bool | Progress = True,
    live: bool | Live = False,
) -> Run:
    """Flies one mission, scores it, and returns its run directory.

    Args:
        scenario: a built-in name ("aircraft", "smoke", ...) or a YAML file.
        utility: what ranks the candidates: a name, '[NAME=]FILE.py:FUNCTION', or a function of
            your own from the candidates' ViewStats (a structured array) to a finite score each.
        planner: a function plan(belief, history) -> View of your own, instead of a utility; None
            ends the mission. One of this process records its views, so that the run repeats
            without it; '[NAME=]FILE.py:FUNCTION' is run from its text, as a utility is. Resumed,
            it is asked again from the first view on, and has to answer as it did.
        seed, preset, mesh, bounds, out, threads, resume, frames, candidates, ceiling: as the
            options of `gnbv run`.
        set: values of the scenario by key: {"planner.cloud.leaf_m": 0.02}.
        progress: False: none; True: by tqdm where it is installed and stderr is a terminal; or a
            function of the share done (0 to 1) and a note.
        live: True: in Jupyter a picture of the map from above and the way, drawn anew after each
            view, elsewhere nothing; or a function of that picture, (H, W, 3) bytes.

    Raises:
        BadInput: with file, line, key and value of what is wrong; nothing was written.
        UtilityFailed: of a utility, or a planner in a file: with iteration, candidate and
            traceback; the run directory is complete.
        Interrupted: Ctrl-C; the mission ended after the view at hand, and so did all that flew in
            other threads.
        KeyboardInterrupt: Ctrl-C when the last view was taken; the run directory is complete. And
            a second Ctrl-C, in a function of your own, too; one in a file is killed.
        Failed: the vehicle hit something or was carried away; the run directory shows where.
        Whatever the planner raised, after the mission has ended in order.
    """
    is_named = utility is not None or "planner.utility.name" in (set or {})
    if planner is not None and is_named:
        raise BadInput("planner: a planner chooses without a utility; give one of the two")
    if bounds not in ("scenario", "auto"):
        raise BadInput(f"bounds: value {bounds!r}: expected 'scenario' or 'auto'")
    threads = whole("threads", threads, 0, MOST_THREADS)
    os.environ.setdefault("GNBV_PYTHON", sys.executable)
    with ExitStack() as stack:
        is_here = callable(planner)
        in_text = [each for each in (utility, planner) if each is not None and not is_here]
        arguments = stack.enter_context(as_arguments(in_text))
        chosen = "route" if is_here else arguments[0] if arguments else ""
        overrides = settings(set)
        given = {
            "scenario": text_of("scenario", scenario),
            "mesh": text_of("mesh", mesh or ""),
            "utility": chosen,
            "preset": text_of("preset", preset or ""),
            "seed": "" if seed is None else str(seed),
            "overrides": overrides + ([recorded_planner(planner)] if callable(planner) else []),
            "bounds_auto": bounds == "auto",
            "out": text_of("out", out or ""),
            "threads": threads,
            "resume": resume,
            "candidates": candidates,
            "frames": frames,
            "ceiling": ceiling,
        }
        for name in ("resume", "candidates", "frames", "ceiling"):
            if given[name] not in (True, False):
                raise BadInput(f"{name}: value {given[name]!r}: expected True or False")
            given[name] = bool(given[name])
        shown = stack.enter_context(_Shown(progress, os.fspath(scenario)))
        asked = AskedPlanner(planner) if callable(planner) else None
        show = shown.show if shown else None
        folder, termination, failure = _core.run(given, asked, show, live_picture(live))
    return _checked(folder, termination, failure)


def _checked(folder: str, termination: str, failure: str) -> Run:
    if termination == "interrupted":
        raise Interrupted(folder)
    if termination == "utility_failed":
        raise UtilityFailed(failure, folder)
    if termination in ("collision", "off_course"):
        raise Failed(f"the mission ended as {termination}; {folder} shows where")
    return Run(folder)


def whole(name: str, value: Any, low: int, high: int) -> int:
    """An argument that is a whole number in those bounds. Raises BadInput for another."""
    try:
        number = operator.index(value)
    except TypeError:
        number = low - 1
    if not low <= number <= high:
        raise BadInput(f"{name}: value {value!r}: expected a whole number from {low} to {high}")
    return number


def text_of(name: str, value: Any) -> str:
    """A name or a path as the program takes it. Raises BadInput for what is none."""
    try:
        text = os.fsdecode(value)
        if b"\0" not in text.encode():
            return text
    except (TypeError, UnicodeError):
        pass
    raise BadInput(f"{name}: value {value!r}: expected text or a path, in UTF-8")


def settings(values: Mapping[str, Any] | None) -> list[str]:
    """KEY=YAML of each, JSON being a part of YAML; a str is taken for YAML already."""

    def plain(value: Any) -> Any:
        return value.tolist() if hasattr(value, "tolist") else os.fsdecode(value)

    texts = []
    for key, value in (values or {}).items():
        try:
            text = (
                value
                if isinstance(value, str)
                else json.dumps(value, default=plain, ensure_ascii=False)
            )
        except (TypeError, ValueError) as error:
            raise BadInput(f"set: {key}: value {value!r:.100}: {error}") from error
        texts.append(text_of("set", f"{key}={text}"))
    return texts


class _Shown:
    """Progress by tqdm, by a function, or not at all. False when there is nobody to show it to."""

    def __init__(self, progress: bool | Progress, label: str) -> None:
        self._function: Progress | None = progress if callable(progress) else None
        self._bar: Any = None
        if progress is True and sys.stderr is not None and sys.stderr.isatty():
            try:
                from tqdm import tqdm  # type: ignore[import-untyped,unused-ignore]
            except ImportError:
                return
            self._bar = tqdm(total=100, desc=label, unit="%", leave=False)

    def __enter__(self) -> _Shown:
        return self

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.refresh()  # the last state, too, however soon it came
            self._bar.close()

    def __bool__(self) -> bool:
        return self._bar is not None or self._function is not None

    def show(self, share: float, note: str) -> None:
        if self._function is not None:
            self._function(share, note)
        if self._bar is not None:
            self._bar.set_postfix_str(note, refresh=False)
            self._bar.update(round(100 * share, 1) - self._bar.n)
