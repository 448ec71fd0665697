# Run by gnbv as `python3 -c`: scores candidate views by the user's function. Speaks on what was
# stdin and stdout; what the function prints goes to stderr. tools/mission/user_utility.cpp is the
# other side.
import ctypes
import json
import os
import signal
import struct
import sys
import traceback

signal.signal(signal.SIGINT, signal.SIG_IGN)  # the mission ends in order, and this with it
PR_SET_PDEATHSIG = 1  # as the program set it, for the child of a wrapper that GNBV_PYTHON names
ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
hear = os.fdopen(os.dup(0), "rb")
tell = os.fdopen(os.dup(1), "wb")
os.dup2(2, 1)
FILE = "<utility>"


def answer(line):
    tell.write(json.dumps(line).encode() + b"\n")
    tell.flush()


def text_of(error):
    """The traceback from the user's own code on."""
    frames = traceback.extract_tb(error.__traceback__)
    own = next((i for i, frame in enumerate(frames) if frame.filename == FILE), len(frames))
    lines = traceback.format_list(frames[own:])
    return "".join(lines + traceback.format_exception_only(type(error), error)).rstrip("\n")


def lone_fault(function, stats):
    """The first row that fails alone, -1 if none does."""
    for row in range(len(stats)):
        try:
            function(stats[row : row + 1])
        except Exception:
            return row
    return -1


def scores_of(function, stats):
    """(scores, row at fault or -1, what is wrong)"""
    try:
        scores = numpy.asarray(function(stats), dtype=numpy.float64)
    except Exception as error:
        return None, lone_fault(function, stats), text_of(error)
    if scores.shape != stats.shape:
        return None, -1, f"returned shape {scores.shape}, expected {stats.shape}: a score a row"
    wrong = numpy.flatnonzero(~numpy.isfinite(scores))
    if len(wrong):
        return None, int(wrong[0]), f"returned {scores[wrong[0]]}"
    return numpy.ascontiguousarray(scores), -1, ""


def load(hello):
    source = hello["source"]
    import linecache

    linecache.cache[FILE] = (len(source), None, source.splitlines(True), FILE)
    space = {"__name__": "gnbv_utility", "np": numpy, "numpy": numpy}
    exec(compile(source, FILE, "exec"), space)
    return space[hello["function"]]


def main():
    hello = json.loads(hear.readline())
    dtype = numpy.dtype(hello["dtype"])
    try:
        function = load(hello)
    except BaseException as error:
        return answer({"error": text_of(error)})
    answer({"python": sys.version.split()[0], "numpy": numpy.__version__})
    while len(head := hear.read(8)) == 8:
        (rows,) = struct.unpack("<q", head)
        stats = numpy.frombuffer(hear.read(rows * dtype.itemsize), dtype=dtype)
        scores, row, wrong = scores_of(function, stats)
        if scores is not None:
            tell.write(struct.pack("<q", rows) + scores.tobytes())
        else:
            text = wrong.encode()
            tell.write(struct.pack("<qqq", -1, row, len(text)) + text)
        tell.flush()


try:
    import numpy
except ImportError as error:
    answer({"error": f"{sys.executable}: {error} (Debian package python3-numpy)"})
else:
    main()
