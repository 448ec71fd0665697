#!/usr/bin/env python3
"""Many missions in one process and many after each other: memory, descriptors, files stay flat.

Those in one process are flown by the test program long_haul_test, --tries of them; ten times as
many are flown one after the other by the program itself, with a cache of a few megabytes.
"""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from run_attack import REPOSITORY, Gnbv, Table, arguments

SMOKE = ['smoke', '--quiet']
LIMIT_BYTES = 4_000_000  # of the cache: some references of the smoke structure
FLAT = 1.1  # the largest memory of the last ones, of that of the first ones


def bytes_in(folder):
    return sum(p.stat().st_size for p in folder.rglob('*') if p.is_file())


def one_after_the_other(gnbv, folder, count):
    """Peak memory of each in KiB; what is wrong."""
    temporary, cache, runs = folder / 'tmp', folder / 'cache', folder / 'runs'
    for place in (temporary, cache, runs):
        place.mkdir()
    gnbv.environment |= {'TMPDIR': str(temporary), 'GNBV_CACHE': str(cache),
                         'GNBV_CACHE_LIMIT': str(LIMIT_BYTES)}
    peaks_kib, wrong = [], []
    for i in range(count):
        run = runs / 'run'
        # another floor rule, so that each keeps a reference of its own
        process = gnbv.start('run', *SMOKE, '--seed', i + 1, '--out', run, '--set',
                             f'planner.floor_z_m={0.3 + 1e-4 * i}')
        _, status, usage = os.wait4(process.pid, 0)
        peaks_kib.append(usage.ru_maxrss)
        files = len(list(run.iterdir())) if run.exists() else 0
        subprocess.run(['rm', '-rf', run], check=True)
        fault = None
        if os.waitstatus_to_exitcode(status) != 0 or files == 0:
            fault = f'exit code {os.waitstatus_to_exitcode(status)}'
        elif any(temporary.iterdir()) or any(runs.iterdir()):
            fault = f'left {[*temporary.iterdir(), *runs.iterdir()]}'
        elif bytes_in(cache) > LIMIT_BYTES:
            fault = f'{bytes_in(cache)} bytes in the cache'
        wrong.append(fault and f'mission {i + 1}: {fault}')
    return peaks_kib, wrong


def grown(values):
    """Whether the last third is larger than the first third was."""
    third = max(1, len(values) // 3)
    first, last = max(values[:third]), max(values[-third:])
    return None if last <= FLAT * first else f'from {first} to {last} KiB'


def in_one_process(program, count):
    done = subprocess.run([program], capture_output=True, stdin=subprocess.DEVNULL,
                          env={**os.environ, 'GNBV_CACHE': '', 'GNBV_MISSIONS': str(count)})
    said = done.stdout.decode(errors='replace')
    print(*[line for line in said.splitlines() if line.startswith('missions')], sep='\n')
    return None if done.returncode == 0 else said[-2000:]


def main():
    options = arguments(__doc__, tries=50, extra=lambda parser: parser.add_argument(
        '--test', type=Path, help='long_haul_test',
        default=REPOSITORY / 'build/release/tests/end_to_end/long_haul_test'))
    table = Table()
    with tempfile.TemporaryDirectory(prefix='gnbv_attack_') as name:
        gnbv = Gnbv(options.gnbv, Path(name))
        peaks_kib, wrong = one_after_the_other(gnbv, Path(name), 10 * options.tries)
        for fault in wrong:
            table.count('missions after each other', fault)
        table.count('their peak memory', grown(peaks_kib))
        print(f'peak memory {min(peaks_kib)} to {max(peaks_kib)} KiB, '
              f'the last {peaks_kib[-1]}, cache {bytes_in(Path(name) / "cache")} bytes')
    if options.test.exists():
        missions = max(9, options.tries)  # fewer do not show what grows
        table.count(f'{missions} missions in one process', in_one_process(options.test, missions))
    else:
        print(f'long-haul: no {options.test}: no missions in one process are flown', file=sys.stderr)
    return table.end()


if __name__ == '__main__':
    raise SystemExit(main())
