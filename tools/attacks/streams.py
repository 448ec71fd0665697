#!/usr/bin/env python3
"""Streams that are closed, full or read by nobody, and limits of memory, threads and files.

A mission flies to its end whoever listens; what cannot be printed to stdout is exit code 1.
"""
import json
import os
import subprocess
import tempfile
from pathlib import Path

from run_attack import Gnbv, Table, arguments, is_sanitized

SMOKE = 'run smoke --set planner.termination.max_iterations=3 --out "$OUT"'
# shell words after the program: expected exit codes
STREAMS = {
    f'{SMOKE} 2>/dev/full': {0},
    f'{SMOKE} 2>&-': {0},
    f'{SMOKE} 2>&- >/dev/null': {0},
    f'{SMOKE} <&-': {0},
    f'{SMOKE} <&- 2>&- >&-': {1},
    f'{SMOKE} >&-': {1},
    f'{SMOKE} >/dev/full': {1},
    f'{SMOKE} --json >/dev/full': {1},
    f'{{ {SMOKE} 2>&1 >/dev/null; }} | true': {0},
    'schema >/dev/full': {1},
    'schema >&-': {1},
    '--version >/dev/full': {1},
    '--help >/dev/full': {1},
    'asset --list >/dev/full': {1},
    'run nothing 2>/dev/full': {2},
    'run nothing 2>&-': {2},
    'fly-me 2>/dev/full': {2},
    'run /dev/zero': {2},
    'run /dev/urandom': {2},
    'lint /dev/zero': {1, 2},
    'score /dev/zero --scenario smoke': {2},
    'run smoke --mesh /dev/zero': {2},
}
LIMITS = {
    'ulimit -n 12': {0, 1},
    'ulimit -n 20': {0, 1},
    'ulimit -f 8': {1},
    'ulimit -f 64': {0, 1},
    'ulimit -v 100000': {1, 127},
    'ulimit -v 200000': {0, 1},
    'ulimit -v 300000': {0, 1},
    'ulimit -v 500000': {0, 1},
    'ulimit -u 1': {0, 1},
    'ulimit -s 512': {0, 1},
}
# of somebody who is not root, whom that limit does not bind; the shell itself needs one
PROCESSES = [f'ulimit -u {count}' for count in (2, 3, 4, 6)]
NOBODY = 'setpriv --reuid=65534 --regid=65534 --clear-groups '
BAD = ('internal error', 'terminate called', 'does not hold', 'json.exception')


def shell(gnbv, folder, line):
    environment = {**gnbv.environment, 'OUT': str(folder / 'run')}
    return subprocess.run(['bash', '-c', line], cwd=folder, env=environment, capture_output=True,
                          stdin=subprocess.DEVNULL, timeout=300)


def attack(gnbv, line, expected):
    with tempfile.TemporaryDirectory(prefix='gnbv_attack_') as name:
        folder = Path(name)
        try:
            done = shell(gnbv, folder, line)
        except subprocess.TimeoutExpired:
            return f'{line}: hangs'
        words = done.stderr.decode(errors='replace')
        if done.returncode not in expected or any(bad in words for bad in BAD):
            return f'{line}: exit code {done.returncode}: {words[-300:]}'
        summary = folder / 'run' / 'summary.json'
        if done.returncode == 0 and '$OUT' in line and 'ulimit' not in line:
            if not summary.exists():
                return f'{line}: the mission came to no end'
            if json.loads(summary.read_text())['termination'] != 'max_iterations':
                return f'{line}: the mission ended early'
        for file in folder.rglob('*'):
            if file.is_file() and b'view 1/3' in file.read_bytes():
                return f'{line}: messages in {file.name}'
    return None


def limits_of(program):
    """Those that the program can be asked to bear: sanitizers take addresses and stack."""
    dear = ('ulimit -v', 'ulimit -s')
    return {limit: expected for limit, expected in LIMITS.items()
            if not (is_sanitized(program) and limit.startswith(dear))}


def main():
    options = arguments(__doc__, tries=1)
    table = Table()
    gnbv = Gnbv(options.gnbv, Path('/'))
    program = f"'{options.gnbv}' "
    for _ in range(options.tries):
        for line, expected in STREAMS.items():
            line = line.replace('run smoke', program + 'run smoke', 1) if line.startswith('{') \
                else program + line
            table.count('streams and devices', attack(gnbv, line, expected))
        for limit, expected in limits_of(options.gnbv).items():
            table.count('limits', attack(gnbv, f'{limit}; {program}{SMOKE}', expected))
        for limit in PROCESSES if os.geteuid() == 0 else ():
            table.count('limits of processes', attack(
                gnbv, f'chmod 777 .; {limit}; exec {NOBODY}{program}{SMOKE}', {0, 1}))
    return table.end()


if __name__ == '__main__':
    raise SystemExit(main())
