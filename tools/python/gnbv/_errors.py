"""What can go wrong, as exceptions. The program's exit codes: BadInput is 2, Failed 1."""

from __future__ import annotations

import re
from typing import Any, NamedTuple

_PLACE = re.compile(
    r"(?:gnbv: )?(?P<file>.+?)(?::(?P<line>\d+))?: (?:(?P<key>[\w.]+): )?"
    r"(?:value '(?P<value>.*?)': )?(?P<what>.+)"
)


class Fault(NamedTuple):
    """One thing that is wrong with the input; what does not apply is "" or, for the line, 0."""

    file: str  # a path, or an option as it was given ("--set a.b=c")
    line: int  # from 1
    key: str  # of the scenario: "planner.utility.alpha"
    value: str
    what: str


class BadInput(ValueError):
    """Something unusable was given. `file`, `line`, `key` and `value` are those of faults[0].

    Attributes:
        faults: all that is wrong, in the order of the input; never empty.
    """

    def __init__(
        self, message: str, faults: list[tuple[str, int, str, str, str]] | None = None
    ) -> None:
        super().__init__(message)
        self.faults = [Fault(*f) for f in faults] if faults else faults_in(message)
        self.file, self.line, self.key, self.value, self.what = self.faults[0]


class BrokenInvariant(RuntimeError):
    """gnbv itself is wrong, or a number became NaN; the message has the command that repeats it."""


class Failed(RuntimeError):
    """What was asked for failed; the message says why."""


class UtilityFailed(Failed):
    """A utility or planner of your own raised, or returned what are no scores or no view.

    Attributes:
        folder: the run directory, complete up to there.
        iteration: the view that was being decided.
        candidate: its index among those sampled, or None: all of them together, or a planner.
        traceback: as Python prints it.
    """

    def __init__(self, message: str, folder: str) -> None:
        super().__init__(message)
        self.folder = folder
        found = re.search(r"iteration (\d+)(?:, candidate (\d+))?[^:]*: (.*)", message, re.DOTALL)
        self.iteration = int(found[1]) if found else -1
        self.candidate = int(found[2]) if found and found[2] else None
        self.traceback = found[3] if found else message

    def __reduce__(self) -> tuple[Any, ...]:  # from another process
        return UtilityFailed, (str(self), self.folder)


class Interrupted(KeyboardInterrupt):
    """Ctrl-C: the mission ended after the view at hand; run(resume=True, out=folder) goes on."""

    def __init__(self, folder: str) -> None:
        super().__init__(f"interrupted; gnbv.run(..., out={folder!r}, resume=True) continues it")
        self.folder = folder

    def __reduce__(self) -> tuple[Any, ...]:
        return Interrupted, (self.folder,)


def faults_in(message: str) -> list[Fault]:
    """The faults of a message of the program, one a line: FILE[:LINE]: [KEY: ][value 'V': ]WHAT."""
    faults = []
    for line in message.splitlines() or [""]:
        found = _PLACE.fullmatch(line)
        if not found:
            faults.append(Fault("", 0, "", "", line))
            continue
        parts = found.groupdict(default="")
        at = int(parts["line"] or 0)
        faults.append(Fault(parts["file"], at, parts["key"], parts["value"], parts["what"]))
    return faults
