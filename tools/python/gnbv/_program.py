"""The program gnbv that came with the package."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from gnbv._errors import BadInput, Failed

PROGRAM = Path(__file__).parent / "gnbv-program"


def environment() -> dict[str, str]:
    """For the program: own utilities run in this Python; words are set in the package's font."""
    env = dict(os.environ)
    env.setdefault("GNBV_PYTHON", sys.executable)
    font = Path(__file__).parent / "DejaVuSans.ttf"
    if font.exists():
        env.setdefault("GNBV_FONT", str(font))
    return env


def call(*arguments: str) -> str:
    """Runs `gnbv ARGUMENTS` and returns its stdout; what it says on stderr comes on stderr.

    Raises BadInput for exit code 2, Failed for 1, KeyboardInterrupt on Ctrl-C.
    """
    command = [str(PROGRAM), *arguments]
    is_interrupted = False
    with subprocess.Popen(
        command,
        env=environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
        errors="surrogateescape",  # in the names of files
    ) as child:
        while True:
            try:
                out, errors = child.communicate()
                break
            except KeyboardInterrupt:  # it has heard it, too, and ends in order
                is_interrupted = True
    lines = [line for line in errors.strip().splitlines() if line]
    message = "\n".join(lines).removeprefix("gnbv: ") or f"gnbv {arguments[0]}: failed"
    if is_interrupted:
        raise KeyboardInterrupt(message)
    if child.returncode == 2:
        raise BadInput(message)
    if child.returncode != 0:
        raise Failed(message)
    if sys.stderr is not None:
        sys.stderr.write(errors)
    return out


def main() -> None:
    """The command `gnbv`."""
    os.execve(PROGRAM, ["gnbv", *sys.argv[1:]], environment())
