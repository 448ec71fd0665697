"""The program, run as an attack needs it: what is wrong with how it ended, two runs compared."""
import csv
import dataclasses
import functools
import json
import os
import pathlib
import resource
import signal
import subprocess
import tempfile
import time

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
TIMEOUT_S = 300
MEMORY_BYTES = 12 << 30  # the map's budget is 6 GiB
BAD_WORDS = ('internal error', 'the program is wrong', 'broken invariant', 'does not hold',
             'terminate called', 'Sanitizer', 'json.exception', 'std::')


@functools.cache
def is_sanitized(program):
    """Whether a sanitizer goes with it, which takes terabytes of addresses."""
    code = pathlib.Path(program).read_bytes()
    return any(name in code for name in (b'__asan_init', b'__tsan_init'))


@dataclasses.dataclass
class End:
    """How a process ended: its exit code, None when it hung, and what it said."""
    code: int | None
    out: str
    err: str

    def fault(self, codes=(0, 1, 2), names=()):
        """What a user would not want to meet; None when there is nothing. A refusal has to hold
        one of the names, if there are any."""
        said = f'{self.out[-200:]}{self.err[-400:]}'
        if self.code is None:
            return f'hangs: {said}'
        if self.code not in codes:
            return f'exit code {self.code}: {said}'
        if bad := next((word for word in BAD_WORDS if word in self.out + self.err), None):
            return f'says {bad!r}: {said}'
        if any(ord(c) < 32 and c not in '\n\t' for c in self.err):
            return f'control bytes: {said!r}'
        if self.code != 0 and not self.err.strip():
            return f'exit code {self.code} without a word'
        if self.code != 0 and names and not any(name in self.err for name in names):
            return f'names none of {names}: {said}'
        return None

    @property
    def json(self):
        """What it printed on stdout."""
        return json.loads(self.out)

    def check(self, codes=(0, 1, 2), names=()):
        """It, or an AssertionError that says the fault."""
        if fault := self.fault(codes, names):
            raise AssertionError(fault)
        return self


class Gnbv:
    """The program in a folder, without a cache unless tests have one in common."""
    cache = ''

    def __init__(self, path, folder, before=(), **environment):
        self.path, self.folder, self.before = str(path), folder, list(before)
        self.environment = {**os.environ, 'GNBV_CACHE': self.cache, **environment}

    def start(self, *words, **more):
        files = tempfile.TemporaryFile(), tempfile.TemporaryFile()  # a pipe could outlive it
        process = subprocess.Popen([*self.before, self.path, *map(str, words)], cwd=self.folder,
                                   env=self.environment, stdout=files[0], stderr=files[1],
                                   **{'stdin': subprocess.DEVNULL, **more})
        process.files = files
        return process

    def __call__(self, *words, timeout_s=TIMEOUT_S, **more):
        return end_of(self.start(*words, **more), timeout_s)

    def limited(self, *words, timeout_s):
        """With the memory of an ordinary machine."""
        def limit():
            if not is_sanitized(self.path):
                resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        return self(*words, timeout_s=timeout_s, preexec_fn=limit)


def end_of(process, timeout_s=TIMEOUT_S):
    """Waits for its end; one that hangs is killed."""
    try:
        code = process.wait(timeout_s)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
        code = None
    said = []
    for file in process.files:
        file.seek(0)
        said.append(file.read().decode(errors='replace'))
    return End(code, *said)


def stopped(process, after_s, name):
    """Its end, when that signal is sent after that time."""
    try:
        process.wait(after_s)
    except subprocess.TimeoutExpired:
        process.send_signal(signal.Signals[name])
    return end_of(process)


def until(seconds, what, holds):
    """Waits for what `holds` tells."""
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end, f'not within {seconds} s: {what}'
        time.sleep(0.1)


def json_of(path):
    return json.loads(path.read_text())


def changed(path, change):
    """Writes the JSON anew as `change` leaves it."""
    content = json_of(path)
    change(content)
    path.write_text(json.dumps(content))


def summary(run):
    """What summary.json holds; None before there is one."""
    path = run / 'summary.json'
    return json_of(path) if path.exists() else None


def hash_of(run):
    return summary(run)['result_sha256']


def without_wall_times(path):
    """The file's content, but for what a clock measured."""
    if path.name == 'summary.json':
        return {k: v for k, v in json.loads(path.read_text()).items() if k != 'wall_s'}
    if path.name == 'iterations.csv':
        rows = csv.DictReader(path.read_text().splitlines())
        return [{k: v for k, v in row.items() if not k.startswith('wall_')} for row in rows]
    return path.read_bytes()


def files_of(run):
    return {str(p.relative_to(run)): p for p in sorted(run.rglob('*')) if p.is_file()}


def difference(run, whole):
    """The first file in which two run directories differ; None when they are the same."""
    ours, theirs = files_of(run), files_of(whole)
    if set(ours) != set(theirs):
        return f'files {sorted(set(ours) ^ set(theirs))}'
    return next((f'{name} differs' for name, path in ours.items()
                 if without_wall_times(path) != without_wall_times(theirs[name])), None)


def half_written(run, whole, growing=('frames/poses.csv',)):
    """A file under its final name that is not as in the whole run; None when there is none. Files
    that grow view by view may have only begun."""
    theirs = files_of(whole)
    for name, path in files_of(run).items():
        if name not in theirs or name.endswith('.part'):
            continue
        content, full = without_wall_times(path), without_wall_times(theirs[name])
        if content != full and not (name in growing and full.startswith(content)):
            return f'{name} is half-written'
    return None
