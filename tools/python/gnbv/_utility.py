"""Utilities and planners of your own: functions that are recorded and run by their source text."""

from __future__ import annotations

import inspect
import json
import os
import re
import tempfile
import textwrap
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Union

from gnbv import _core
from gnbv._errors import BadInput

UserFunction = Callable[..., Any]
Utility = Union[str, "os.PathLike[str]", UserFunction]
Utilities = Union[Iterable[Utility], Mapping[str, Utility]]


def utilities() -> list[str]:
    """The names of the built-in utilities, those of the paper first."""
    return list(_core.utilities())


def source_of(function: UserFunction) -> str:
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
        raise BadInput(
            f"utility {label}: expected a function made by `def`, and no text left of that"
        )
    return text[start.start() :]


def _file_of(function: UserFunction) -> str:
    """The name of the file that it is from."""
    code = getattr(function, "__code__", None)
    name = Path(code.co_filename).name if code else ""
    return name if name.endswith(".py") else ""


@contextmanager
def as_arguments(given: Utilities) -> Iterator[list[str]]:
    """Each as `--utilities` takes it; functions are put into files for the time being."""
    is_named = isinstance(given, Mapping)
    pairs = list(given.items()) if isinstance(given, Mapping) else [("", each) for each in given]
    with tempfile.TemporaryDirectory(prefix="gnbv-utility-") as folder:
        arguments: list[str] = []
        for i, (name, utility) in enumerate(pairs):
            if is_named and not re.fullmatch(r"[^=/.,\s]+", name):
                raise BadInput(f"utility {name!r}: a name is one word without = / . and commas")
            if callable(utility):
                source = source_of(utility)
                file = Path(folder, str(i), _file_of(utility) or f"{utility.__name__}.py")
                file.parent.mkdir()
                file.write_text(source, encoding="utf-8")
                text = f"{file}:{utility.__name__}"
            else:
                text = os.fspath(utility)
            arguments.append(f"{name}={text}" if is_named else text)
        yield arguments


def recorded_planner(planner: UserFunction) -> str:
    """The setting by which runs of a planner in this process are known as its own."""
    function = getattr(planner, "__name__", type(planner).__name__).strip("<>")
    try:
        source = textwrap.dedent(inspect.getsource(planner))
        around = inspect.getclosurevars(planner).nonlocals
    except (OSError, TypeError, ValueError):
        source, around = "", {}
    for name, value in around.items():
        if isinstance(value, (bool, int, float, str)):
            source += f"# {name} = {value!r}\n"
    own = {"kind": "planner", "function": function, "file": _file_of(planner), "source": source}
    return "planner.utility.python=" + json.dumps(own, ensure_ascii=False)
