# Run by gnbv as `python3 -c`: a function of the user's own scores candidate views, or plans the
# next one. Speaks on what was stdin and stdout, a line of JSON and the bytes that it announces at a
# time; what the function prints goes to stderr. tools/mission/user_child.cpp is the other side.
import ctypes
import importlib.util
import json
import linecache
import os
import signal
import sys
import threading
import traceback
import types

signal.signal(signal.SIGINT, signal.SIG_IGN)  # the mission ends in order, and this with it
PR_SET_PDEATHSIG = 1  # as the program set it, for the child of a wrapper that GNBV_PYTHON names
ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
hear = os.fdopen(os.dup(0), "rb")
os.dup2(os.open(os.devnull, os.O_RDONLY), 0)  # what the function reads is not ours
tell = os.fdopen(os.dup(1), "wb")
os.dup2(2, 1)


def send(fields, raw=b""):
    line = json.dumps({**fields, "bytes": len(raw)}, ensure_ascii=False)
    tell.write(line.encode(errors="replace") + b"\n" + raw)  # a message may be no UTF-8
    tell.flush()


def receive():
    """(fields, bytes); ends this process when the other one has ended."""
    line = hear.readline()
    if not line.endswith(b"\n"):
        sys.exit()
    fields = json.loads(line)
    return fields, hear.read(fields["bytes"])


def text_of(error, file):
    """The traceback from the user's own code on."""
    frames = traceback.extract_tb(error.__traceback__)
    own = next((i for i, frame in enumerate(frames) if frame.filename == file), len(frames))
    lines = traceback.format_list(frames[own:])
    return "".join(lines + traceback.format_exception_only(type(error), error)).rstrip("\n")


def load(hello, space):
    source, file = hello["source"], hello["file"]
    linecache.cache[file] = (len(source), None, source.splitlines(True), file)
    module = sys.modules["gnbv_user"] = types.ModuleType("gnbv_user")  # for pickle, dataclasses
    vars(module).update(space, np=numpy, numpy=numpy)
    exec(compile(source, file, "exec"), vars(module))
    return vars(module)[hello["function"]]


# ---- a utility


def lone_fault(function, stats):
    """The first row that fails alone, -1 if none does."""
    for row in range(len(stats)):
        try:
            function(stats[row : row + 1])
        except Exception:
            return row
    return -1


def scores_of(function, stats, file, numbers):
    """(scores, row at fault or -1, what is wrong)"""
    try:
        answer = function(stats)
    except Exception as error:
        return None, lone_fault(function, stats), text_of(error, file)
    scores = numbers(answer)
    if scores is None:
        return None, -1, f"returned {answer!r:.200}, expected a number a row"
    if scores.shape != stats.shape:
        return None, -1, f"returned shape {scores.shape}, expected {stats.shape}: a score a row"
    wrong = numpy.flatnonzero(~numpy.isfinite(scores))
    if len(wrong):
        return None, int(wrong[0]), f"returned {scores[wrong[0]]}"
    return numpy.ascontiguousarray(scores), -1, ""


def score(function, hello, module):
    dtype = numpy.dtype(hello["dtype"])
    while True:
        stats = numpy.frombuffer(receive()[1], dtype)
        scores, row, wrong = scores_of(function, stats, hello["file"], module.numbers)
        if scores is None:
            send({"error": wrong, "row": row})
        else:
            send({}, scores.tobytes())


# ---- a planner


class Told:
    """The belief during one call. The program is asked for what the planner asks for."""

    one_question = threading.Lock()

    def __init__(self, about, stats_dtype):
        self._about = about
        self._stats_dtype = stats_dtype
        self._known = {}

    def end(self):
        self._about = None

    def _tell(self, name):
        if self._about is None:
            raise ReferenceError(
                "belief: answers only during the call of the planner that it was handed to"
            )
        return self._about.get(name)

    def _ask(self, what, rows=(), **fields):
        with self.one_question:
            self._tell(what)
            send({"ask": what, **fields}, numpy.ascontiguousarray(rows, "<f8").tobytes())
            return receive()

    def _array(self, what, dtype, shape):
        self._tell(what)
        if what not in self._known:
            self._known[what] = numpy.frombuffer(self._ask(what)[1], dtype).reshape(shape)
        return self._known[what]

    log_odds = property(lambda self: self._array("log_odds", "<f4", self._tell("shape")))
    words = property(lambda self: self._array("words", "<u4", self._tell("shape")))
    cloud = property(lambda self: self._array("cloud", "<f4", (-1, 3)))
    resolution_m = property(lambda self: self._tell("resolution_m"))
    origin_m = property(lambda self: self._tell("origin_m"))
    density_max = property(lambda self: self._tell("density_max"))
    entropy_nat = property(lambda self: self._tell("entropy_nat"))
    current = property(lambda self: numpy.array([self._tell("current")]))
    navigation_m = property(lambda self: numpy.array(self._tell("navigation_m")))
    stats_dtype = property(lambda self: self._stats_dtype)

    @property
    def density(self):
        raw = self._ask("density")[1]
        half = len(raw) // 2
        return (numpy.frombuffer(raw[:half], "<i8").copy(), numpy.frombuffer(raw[half:], "<f8").copy())

    def sample(self, scale):
        return numpy.frombuffer(self._ask("sample", scale=scale)[1], "<f8").reshape(-1, 5).copy()

    def sample_frontiers(self):
        return numpy.frombuffer(self._ask("sample_frontiers")[1], "<f8").reshape(-1, 5).copy()

    def validate(self, rows):
        fields, raw = self._ask("validate", rows)
        return fields["reasons"], numpy.frombuffer(raw, "<f8").copy()

    def evaluate(self, rows):
        return self._ask("evaluate", rows)[1]

    def find_path(self, start, goal):
        fields, raw = self._ask("find_path", [*start, *goal])
        return numpy.frombuffer(raw, "<f8").reshape(-1, 3).copy() if fields["found"] else None


def planner_module(hello):
    """What the package calls gnbv._planner. Where gnbv is not installed, `import gnbv` finds it."""
    spec = importlib.util.find_spec("gnbv")
    is_installed = spec is not None and spec.origin is not None
    package = types.ModuleType("gnbv")
    sys.modules["gnbv"] = package
    for name, text in hello["modules"].items():
        module = types.ModuleType(f"gnbv.{name}")
        sys.modules[module.__name__] = module
        exec(compile(text, f"gnbv/{name}.py", "exec"), module.__dict__)
    for name in ("Belief", "History", "View"):
        setattr(package, name, getattr(module, name))
    if is_installed:
        for name in ["gnbv", *(f"gnbv.{name}" for name in hello["modules"])]:
            del sys.modules[name]
    return module


def plan(function, hello, module):
    asked = module.AskedPlanner(function)
    stats_dtype = numpy.dtype(hello["dtype"])
    while True:
        fields, _ = receive()
        if fields["event"] == "view":
            asked.on_view(fields)
        elif fields["event"] == "refused":
            asked.on_refused(fields["reason"])
        else:
            told = Told(fields, stats_dtype)
            try:
                rows = asked.plan(told)
                answer = ({"view": True}, b"" if rows is None else rows.tobytes())
            except Exception as error:
                answer = ({"error": text_of(error, hello["file"])},)
            told.end()
            send(*answer)


def main():
    hello, _ = receive()
    is_planner = hello["kind"] == "planner"
    module = planner_module(hello)
    try:
        function = load(hello, {"View": module.View} if is_planner else {})
    except BaseException as error:
        return send({"error": text_of(error, hello["file"])})
    send({"python": sys.version.split()[0], "numpy": numpy.__version__})
    if is_planner:
        plan(function, hello, module)
    score(function, hello, module)


try:
    import numpy
except ImportError as error:
    send({"error": f"{sys.executable}: {error} (Debian package python3-numpy)"})
else:
    main()
