"""Utilities of your own: functions that are recorded and run by their source text."""

from __future__ import annotations

import inspect
import os
import re
import tempfile
import textwrap
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Union

from gnbv import _core
from gnbv._errors import BadInput

UtilityFunction = Callable[[Any], Any]
Utility = Union[str, "os.PathLike[str]", UtilityFunction]


def utilities() -> list[str]:
    """The names of the built-in utilities, those of the paper first."""
    return list(_core.utilities())


def source_of(function: UtilityFunction) -> str:
    """The function's own text. It has to stand alone: `np` is NumPy, all else it imports itself.

    Raises BadInput for what has no such text: a lambda, a method, a function with free variables.
    """
    name = getattr(function, "__name__", "")
    label = getattr(function, "__qualname__", repr(function))
    if not inspect.isfunction(function) or not name.isidentifier():
        raise BadInput(f"utility {label}: expected a function with a name, made by `def`")
    if function.__code__.co_freevars:
        free = ", ".join(function.__code__.co_freevars)
        raise BadInput(
            f"utility {label}: uses {free} from around it, which its text does not record; "
            "make them defaults of its arguments, or give a file: 'FILE.py:FUNCTION'"
        )
    try:
        text = textwrap.dedent(inspect.getsource(function))
    except (OSError, TypeError) as error:
        raise BadInput(f"utility {label}: its source text cannot be had ({error})") from error
    start = re.search(r"^def ", text, re.MULTILINE)
    if start is None:
        raise BadInput(f"utility {label}: expected a function made by `def`")
    return text[start.start() :]


def _name_of(utility: Utility) -> str:
    if callable(utility):
        return str(utility.__name__)
    return os.fspath(utility)


@contextmanager
def as_arguments(given: Sequence[Utility]) -> Iterator[list[str]]:
    """Each utility as `--utility` takes it; functions are put into files for the time being."""
    names = [_name_of(utility) for utility in given]
    double = next((name for name in names if names.count(name) > 1), None)
    if double is not None:
        raise BadInput(f"utility {double}: named twice")
    with tempfile.TemporaryDirectory(prefix="gnbv-utility-") as folder:
        arguments = []
        for utility, name in zip(given, names, strict=True):
            if callable(utility):
                file = Path(folder) / f"{name}.py"
                file.write_text(source_of(utility), encoding="utf-8")
                name = f"{file}:{name}"
            arguments.append(name)
        yield arguments
