"""Streams that are closed, full or read by nobody, and limits of memory, threads and files.

A mission flies to its end whoever listens; what cannot be printed to stdout is exit code 1.
"""
import os

import pytest
from program import Gnbv, files_of, is_sanitized, summary

FLY = 'gnbv run smoke --set planner.termination.max_iterations=3 --out run'
# shell words: expected exit codes, and what stderr says of a failure
STREAMS = {
    f'{FLY} 2>/dev/full': {0},
    f'{FLY} 2>&-': {0},
    f'{FLY} 2>&- >/dev/null': {0},
    f'{FLY} <&-': {0},
    f'{FLY} <&- 2>&- >&-': {1},
    f'{FLY} >&-': {1},
    f'{FLY} >/dev/full': {1},
    f'{FLY} --json >/dev/full': {1},
    f'set -o pipefail; {{ {FLY} 2>&1 >/dev/null; }} | true': {0},
    'gnbv run nothing 2>/dev/full': {2},
    'gnbv run nothing 2>&-': {2},
    'gnbv fly-me 2>/dev/full': {2},
    'gnbv run /dev/zero': {2},
    'gnbv run /dev/urandom': {2},
    'gnbv lint /dev/zero': {1, 2},
    'gnbv score /dev/zero --scenario smoke': {2},
    'gnbv run smoke --mesh /dev/zero': {2},
    **{f'gnbv {words} {to}': {1} for words in ('schema', '--version', '--help', 'asset --list')
       for to in ('>/dev/full', '>&-')},
}
# what the limit leaves undone is said in these words
LIMITS = {
    'ulimit -n 12': ({0, 1}, []),
    'ulimit -n 20': ({0, 1}, []),
    'ulimit -f 8': ({1}, ['cannot write: File too large']),
    'ulimit -f 64': ({0, 1}, ['cannot write: File too large']),
    'ulimit -v 100000': ({1, 127}, []),
    **{f'ulimit -v {kib}': ({0, 1}, ['gnbv: out of memory\n'])
       for kib in (200_000, 300_000, 450_000, 600_000, 750_000, 900_000)},
    'ulimit -u 1': ({0, 1}, []),
    'ulimit -s 512': ({0, 1}, []),
}
DEAR = ('ulimit -v', 'ulimit -s')  # sanitizers take addresses and stack
NOBODY = 'setpriv --reuid=65534 --regid=65534 --clear-groups'


@pytest.fixture
def shell(gnbv, tmp_path):
    """shell(words) -> their end; `gnbv` among them is the program."""
    (tmp_path / 'gnbv').symlink_to(gnbv.path)
    path = f'{tmp_path}:{os.environ["PATH"]}'
    return lambda words: Gnbv('bash', tmp_path, PATH=path)('-c', words)


@pytest.mark.parametrize('words', STREAMS)
def test_a_mission_flies_whoever_listens(shell, tmp_path, words):
    end = shell(words)
    if '2>' in words:
        assert end.code in STREAMS[words], end
    else:
        end.check(STREAMS[words], ['No space left on device'] if '/dev/full' in words else [])
    if words.startswith(('gnbv run smoke --set', 'set')) and end.code == 0:
        assert summary(tmp_path / 'run')['termination'] == 'max_iterations'
    for name, file in files_of(tmp_path).items():  # none got the number of a closed stream
        assert name == 'gnbv' or b'view 1/3' not in file.read_bytes(), name


@pytest.mark.parametrize('limit', LIMITS)
def test_a_limit_is_named(shell, gnbv, limit):
    if is_sanitized(gnbv.path) and limit.startswith(DEAR):
        pytest.skip('a sanitizer needs more')
    codes, names = LIMITS[limit]
    shell(f'{limit}; {FLY}').check(codes, names)


@pytest.mark.skipif(os.geteuid() != 0, reason='root is not bound by it, and sets it for others')
@pytest.mark.parametrize('processes', [2, 3, 4, 6])  # the shell itself needs one
def test_a_limit_of_processes_is_named(shell, processes):
    shell(f'chmod 777 .; ulimit -u {processes}; exec {NOBODY} {FLY}').check({0, 1})
