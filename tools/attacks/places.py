#!/usr/bin/env python3
"""Folders that vanish, move or cannot be written, and clocks that jump.

A mission whose folder goes away ends with its name, or finds what it needs. A run on a read-only
disk can be read by all commands that write elsewhere. Clocks that jump (where libfaketime is
installed) change no result. Needs the right to mount in a namespace of its own (`unshare -rm`).
"""
import json
import os
import random
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

from run_attack import Gnbv, Table, arguments, complaint, end_of, in_a_namespace

SMOKE = ['smoke', '--set', 'planner.termination.max_iterations=30', '--quiet']
FAKETIME = ['/usr/lib/x86_64-linux-gnu/faketime/libfaketimeMT.so.1',
            '/usr/lib/aarch64-linux-gnu/faketime/libfaketimeMT.so.1']


def hash_of(run):
    return json.loads((run / 'summary.json').read_text())['result_sha256']


def fly_while(gnbv, out, moment_s, act):
    """How the mission took it that `act` happened to its folder."""
    process = gnbv.start('run', *SMOKE, '--frames', '--out', out, stderr=subprocess.PIPE)
    time.sleep(moment_s)
    act()
    done = end_of(process)
    words = done.stderr.decode(errors='replace')
    wrong = complaint(done)
    if wrong is None and done.returncode != 0 and str(out.name) not in words:
        wrong = f'does not name it: {words[-300:]}'
    return wrong


def vanishing(gnbv, folder, how, moment_s):
    place = folder / 'vanishing'
    shutil.rmtree(place, ignore_errors=True)
    shutil.rmtree(folder / 'moved', ignore_errors=True)
    place.mkdir()

    def act():
        if how == 'the run removed':
            shutil.rmtree(place / 'run', ignore_errors=True)
        elif how == 'the folder above removed':
            shutil.rmtree(place, ignore_errors=True)
        elif (place / 'run').exists():
            (place / 'run').rename(folder / 'moved')

    wrong = fly_while(gnbv, place / 'run', moment_s, act)
    return wrong and f'{how} at {moment_s:.2f} s: {wrong}'


def mounted(disk, act):
    disk.mkdir(exist_ok=True)
    subprocess.run(['mount', '-t', 'tmpfs', '-o', 'size=200m', 'tmpfs', disk], check=True)
    try:
        return act()
    finally:
        subprocess.run(['umount', '-l', disk], check=True)


def read_only(disk):
    subprocess.run(['mount', '-o', 'remount,ro', disk], check=True, capture_output=True)


def on_read_only_disk(gnbv, folder, whole, words, expected):
    disk = folder / 'disk'

    def act():
        shutil.copytree(whole, disk / 'run')
        read_only(disk)
        out = folder / 'out'
        shutil.rmtree(out, ignore_errors=True)
        done = gnbv(*[word.format(run=disk / 'run', disk=disk, out=out) for word in words])
        wrong = complaint(done)
        if wrong is None and done.returncode not in expected:
            wrong = f'exit code {done.returncode}: {done.stderr.decode(errors="replace")[-300:]}'
        if wrong is None and done.returncode and b'Read-only file system' not in done.stderr:
            wrong = f'no cause: {done.stderr.decode(errors="replace")[-300:]}'
        return wrong and f'{" ".join(words)}: {wrong}'

    return mounted(disk, act)


READ_ONLY = (
    (['run', 'smoke', '--quiet', '--out', '{disk}/new'], {1, 2}),
    (['run', *SMOKE, '--resume', '--out', '{run}'], {0, 1, 2}),
    (['score', '{run}'], {0}),
    (['score', '{run}', '--update'], {1, 2}),
    (['render', '{run}', '-o', '{out}.png'], {0}),
    (['render', '{run}'], {1, 2}),
    (['plot', '{run}', '-o', '{out}'], {0}),
    (['plot', '{run}'], {1, 2}),
    (['report', '{run}', '-o', '{out}.html'], {0}),
    (['report', '{run}'], {1, 2}),
    (['surface', '{run}', '-o', '{out}'], {0}),
    (['surface', '{run}'], {1, 2}),
    (['export', '{run}', '--format', 'tum', '-o', '{out}'], {0}),
    (['export', '{run}', '--format', 'tum'], {1, 2}),
    (['table', 'lab_model', '--quiet', '--out', '{disk}/cells'], {1, 2}),
    (['asset', 'smoke', '-o', '{disk}/smoke.obj'], {1, 2}),
)


def with_clock(gnbv, folder, library, jumps, whole):
    """Flown while the time of day, and every other clock, jumps."""
    clock, run = folder / 'clock', folder / 'run'
    shutil.rmtree(run, ignore_errors=True)
    clock.write_text('+0\n')
    faked = Gnbv(gnbv.path, folder)
    faked.environment |= {'LD_PRELOAD': library, 'FAKETIME_TIMESTAMP_FILE': str(clock),
                          'FAKETIME_NO_CACHE': '1'}
    process = faked.start('run', *SMOKE, '--out', run, stderr=subprocess.PIPE)
    for jump in jumps:
        time.sleep(0.1)
        clock.write_text(jump + '\n')
    done = end_of(process)
    wrong = complaint(done)
    if wrong is None and done.returncode != 0:
        wrong = done.stderr.decode(errors='replace')[-300:]
    if wrong is None and hash_of(run) != hash_of(whole):
        wrong = 'another result'
    return wrong and f'{jumps}: {wrong}'


def main():
    options = arguments(__doc__, tries=10)
    in_a_namespace('places')
    table, dice = Table(), random.Random(options.seed)
    with tempfile.TemporaryDirectory(prefix='gnbv_attack_') as name:
        folder = Path(name)
        gnbv = Gnbv(options.gnbv, folder)
        whole = folder / 'whole'
        begin = time.monotonic()
        gnbv('run', *SMOKE, '--frames', '--out', whole)
        takes_s = time.monotonic() - begin
        for _ in range(options.tries):
            for how in ('the run removed', 'the folder above removed', 'the run moved'):
                table.count(how, vanishing(gnbv, folder, how, dice.uniform(0.0, takes_s)))
        for words, expected in READ_ONLY:
            table.count('commands on a read-only disk',
                        on_read_only_disk(gnbv, folder, whole, words, expected))
        library = next((path for path in FAKETIME if os.path.exists(path)), None)
        for _ in range(options.tries if library else 0):
            jumps = [dice.choice(['+10y', '-10y', '+1h', '-1h', '+0', '-3', '+3'])
                     for _ in range(6)]
            table.count('a clock that jumps', with_clock(gnbv, folder, library, jumps, whole))
    return table.end()


if __name__ == '__main__':
    raise SystemExit(main())
