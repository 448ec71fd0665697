"""What the attacks on run directories share: the program, its runs compared, the table."""
import argparse
import csv
import functools
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
TIMEOUT_S = 300


@functools.cache
def is_sanitized(program):
    """Whether a sanitizer goes with it, which takes terabytes of addresses."""
    code = pathlib.Path(program).read_bytes()
    return any(name in code for name in (b'__asan_init', b'__tsan_init'))


def arguments(doc, tries, extra=None):
    """The options that all have; `extra` adds more to the parser."""
    parser = argparse.ArgumentParser(description=doc)
    parser.add_argument('--gnbv', type=pathlib.Path,
                        default=REPOSITORY / 'build' / 'release' / 'gnbv', help='the program')
    parser.add_argument('--tries', type=int, default=tries, help='of each kind (default: %(default)s)')
    parser.add_argument('--seed', type=int, default=1, help='of the moments (default: %(default)s)')
    if extra:
        extra(parser)
    given = parser.parse_args()
    given.gnbv = given.gnbv.resolve()
    if not os.access(given.gnbv, os.X_OK):
        parser.error(f'{given.gnbv} is no program: tools/build makes it')
    return given


def names_of(known):
    """What reads an option that takes some of these, with commas between them."""
    def names(text):
        found = text.split(',')
        if unknown := sorted(set(found) - set(known)):
            raise argparse.ArgumentTypeError(f'{unknown[0]!r} is none of {", ".join(known)}')
        return found
    return names


def in_a_namespace(name):
    """Starts the attack anew where it may mount, with no mount seen from outside."""
    if os.environ.get('GNBV_ATTACK_INSIDE'):
        return
    if subprocess.run(['unshare', '-rm', 'true'], capture_output=True).returncode != 0:
        print(f'{name}: `unshare -rm` is not allowed here', file=sys.stderr)
        raise SystemExit(77)
    os.environ['GNBV_ATTACK_INSIDE'] = '1'
    os.execvp('unshare', ['unshare', '-rm', sys.executable, *sys.argv])


class Table:
    """Rows of tries and failures."""

    def __init__(self):
        self.rows = {}
        signal.signal(signal.SIGTERM, lambda *_: sys.exit(self.end()))  # what was tried counts

    def count(self, kind, failure=None):
        tries, failures = self.rows.get(kind, (0, 0))
        self.rows[kind] = (tries + 1, failures + (failure is not None))
        if failure is not None:
            print(f'{kind}: {failure}', file=sys.stderr, flush=True)

    def end(self):
        """Prints it; the exit code."""
        print(f"{'attack':44} {'tries':>7} {'failures':>9}")
        for kind, (tries, failures) in self.rows.items():
            print(f'{kind:44} {tries:7} {failures:9}')
        return 1 if any(failures for _, failures in self.rows.values()) else 0


class Gnbv:
    """The program, without a cache."""

    def __init__(self, path, folder):
        self.path = str(path)
        self.folder = folder
        self.environment = {**os.environ, 'GNBV_CACHE': ''}

    def __call__(self, *words, **more):
        """Runs it to its end. A program that hangs is a failure of its own: exit code None."""
        try:
            return subprocess.run([self.path, *map(str, words)], cwd=self.folder,
                                  env=self.environment, stdin=subprocess.DEVNULL,
                                  capture_output=True, timeout=TIMEOUT_S, **more)
        except subprocess.TimeoutExpired as hung:
            return subprocess.CompletedProcess(hung.cmd, None, b'', b'hangs')

    def start(self, *words, **more):
        more = {'stdout': subprocess.DEVNULL, 'stderr': subprocess.DEVNULL, **more}
        return subprocess.Popen([self.path, *map(str, words)], cwd=self.folder,
                                env=self.environment, stdin=subprocess.DEVNULL, **more)


def code_of(process):
    """Its exit code; None, and it is killed, when it hangs."""
    try:
        return process.wait(TIMEOUT_S)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
        return None


def end_of(process):
    """As Gnbv.__call__ returns it, of a process that was started with stderr in a pipe."""
    try:
        said = process.communicate(timeout=TIMEOUT_S)[1]
        return subprocess.CompletedProcess(process.args, process.returncode, b'', said)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        return subprocess.CompletedProcess(process.args, None, b'', b'hangs')


def stopped(process, after_s, signal):
    """Sends the signal after that time; the exit code."""
    try:
        process.wait(after_s)
    except subprocess.TimeoutExpired:
        process.send_signal(signal)
    return code_of(process)


def complaint(done):
    """What a user would not want to read; None when there is nothing."""
    words = done.stderr.decode(errors='replace')
    if done.returncode is None:
        return 'hangs'
    if done.returncode < 0:
        return f'signal {-done.returncode}: {words[-300:]}'
    if done.returncode not in (0, 1, 2):
        return f'exit code {done.returncode}: {words[-300:]}'
    for bad in ('internal error', 'json.exception', 'does not hold', 'terminate called'):
        if bad in words:
            return words[-500:]
    if any(ord(c) < 32 and c not in '\n\t' for c in words):
        return f'control bytes: {words[-300:]!r}'
    if done.returncode != 0 and not words.strip():
        return f'exit code {done.returncode} without a word'
    return None


def without_wall_times(path):
    """The file's content, but for what a clock measured."""
    if path.name == 'summary.json':
        summary = json.loads(path.read_text())
        summary.pop('wall_s', None)
        return summary
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
    for name, path in ours.items():
        if without_wall_times(path) != without_wall_times(theirs[name]):
            return f'{name} differs'
    return None


def half_written(run, whole, growing=('frames/poses.csv',)):
    """A file under its final name that is not as in the whole run; None when there is none. Files
    that grow view by view may have only begun."""
    theirs = files_of(whole)
    for name, path in files_of(run).items():
        if name not in theirs or name.endswith('.part'):
            continue
        content, full = without_wall_times(path), without_wall_times(theirs[name])
        begins = name in growing and full.startswith(content)
        if content != full and not begins:
            return f'{name} is half-written'
    return None
