"""Writes a run for a viewer with a timeline; `python3 -c` of the program runs it. Its stdin: a line
of the modules beside it as {name: source}, and one of the scene (timeline.cpp). Its stdout: one
line of JSON, {"written": {...}} or {"error": one sentence}."""

import sys

sys.path = [p for p in sys.path if p]  # nothing of the folder that the user is in

import importlib  # noqa: E402
import json  # noqa: E402
import os  # noqa: E402
import types  # noqa: E402

tell = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)  # what a library prints is no answer

EXTRAS = {
    "rerun": "rerun-sdk",
    "mcap": "mcap mcap-protobuf-support foxglove-schemas-protobuf pillow",
}


def main() -> dict:
    sources = json.loads(sys.stdin.readline())
    scene = json.loads(sys.stdin.readline())
    kind = scene["format"]
    try:
        for name in ("recorded_run", f"to_{kind}"):
            module = sys.modules[name] = types.ModuleType(name)
            exec(compile(sources[name], f"{name}.py", "exec"), module.__dict__)
    except ImportError as error:
        return {
            "error": f"--format {kind}: Python's package {error.name} is not there; "
            f"{sys.executable} -m pip install numpy {EXTRAS[kind]} installs what it takes, and "
            "GNBV_PYTHON names another Python"
        }
    run = sys.modules["recorded_run"].RecordedRun(scene)
    return {"written": importlib.import_module(f"to_{kind}").write(run, scene["out"])}


try:
    answer = main()
except Exception as error:
    at = error.__traceback__
    while at is not None and at.tb_next is not None:
        at = at.tb_next
    where = f"{at.tb_frame.f_code.co_filename}:{at.tb_lineno}" if at is not None else "?"
    answer = {"error": f"{type(error).__name__}: {error} ({where})"}
print(json.dumps(answer), file=tell, flush=True)
