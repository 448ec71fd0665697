"""Runs a module of the program's; `python3 -c` does, so that no file of it has to be installed. Its
stdin: a line of {"modules": {name: source}, "entry", "what", "apt", "pip"}, and one that the entry's
main() is called with (python_script.cpp). Its stdout: one line, {"answer": ...} or {"error": one
sentence}, with "missing" where a package is not there, with "errno" and "file" of what the system
refused."""

import sys

sys.path = [p for p in sys.path if p]  # nothing of the folder that the user is in

import json  # noqa: E402
import os  # noqa: E402
import types  # noqa: E402

tell = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)  # what a library prints is no answer


def main() -> dict:
    script = json.loads(sys.stdin.readline())
    request = json.loads(sys.stdin.readline())
    try:
        for name, source in script["modules"].items():
            module = sys.modules[name] = types.ModuleType(name)
            exec(compile(source, f"{name}.py", "exec"), module.__dict__)
    except ImportError as error:
        pip = f"{sys.executable} -m pip install {script['pip']}"
        installs = f"apt-get install {script['apt']}, or {pip}," if script["apt"] else pip
        is_there = not isinstance(error, ModuleNotFoundError)  # of another version, perhaps
        why = str(error) if is_there else f"Python's package {error.name} is not there"
        return {
            "missing": error.name,
            "error": f"{script['what']}: {why}; {installs} "
            "installs what it takes, and GNBV_PYTHON names another Python",
        }
    return {"answer": sys.modules[script["entry"]].main(request)}


try:
    answer = main()
except OSError as error:
    answer = {"error": str(error), "errno": error.errno or 0, "file": str(error.filename or "")}
except Exception as error:
    at = error.__traceback__
    while at is not None and at.tb_next is not None:
        at = at.tb_next
    where = f"{at.tb_frame.f_code.co_filename}:{at.tb_lineno}" if at is not None else "?"
    answer = {"error": f"{type(error).__name__}: {error} ({where})"}
print(json.dumps(answer), file=tell, flush=True)
