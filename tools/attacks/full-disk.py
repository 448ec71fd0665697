#!/usr/bin/env python3
"""Runs commands on disks of every size: exit code 0 or 1, the cause named, and the run goes on.

Needs the right to mount a tmpfs in a namespace of its own (`unshare -rm`).
"""
import random
import shutil
import subprocess
import tempfile
from pathlib import Path

from run_attack import Gnbv, Table, arguments, complaint, difference, in_a_namespace

SMOKE = ['smoke', '--set', 'planner.termination.max_iterations=6', '--quiet']


def on_disk(size_kib, disk, act):
    disk.mkdir(exist_ok=True)
    subprocess.run(['mount', '-t', 'tmpfs', '-o', f'size={size_kib}k', 'tmpfs', disk], check=True)
    try:
        return act()
    finally:
        subprocess.run(['umount', disk], check=True)


def named(done):
    wrong = complaint(done)
    words = done.stderr.decode(errors='replace')
    if wrong is None and done.returncode == 2:
        wrong = f'exit code 2: {words[-300:]}'
    if wrong is None and done.returncode == 1 and 'No space left' not in words:
        wrong = f'no cause: {words[-300:]}'
    return wrong


def run_on(gnbv, more, size_kib, disk, folder, whole):
    """Fills up in flight, or while finishing; then goes on where there is room."""
    rescued = folder / 'rescued'
    shutil.rmtree(rescued, ignore_errors=True)

    def act():
        done = gnbv('run', *SMOKE, *more, '--out', disk / 'run')
        if (disk / 'run').exists():
            shutil.copytree(disk / 'run', rescued)
        return named(done)

    wrong = on_disk(size_kib, disk, act)
    if wrong:
        return f'{size_kib} KiB: {wrong}'
    done = gnbv('run', *SMOKE, *more, '--out', rescued, '--resume')
    if complaint(done) or done.returncode != 0:
        return f'{size_kib} KiB, resumed: {done.stderr.decode(errors="replace")[-300:]}'
    return difference(rescued, whole)


def make_on(gnbv, words, size_kib, disk):
    def act():
        done = gnbv(*words)
        empty = [p.name for p in disk.rglob('*') if p.is_file() and p.stat().st_size == 0]
        return named(done) or (f'exit code 0 and empty {empty}'
                               if done.returncode == 0 and empty else None)

    wrong = on_disk(size_kib, disk, act)
    return wrong and f'{size_kib} KiB: {wrong}'


def main():
    options = arguments(__doc__, tries=12)
    in_a_namespace('full-disk')
    table, dice = Table(), random.Random(options.seed)
    with tempfile.TemporaryDirectory(prefix='gnbv_attack_') as name:
        folder = Path(name)
        disk = folder / 'disk'
        gnbv = Gnbv(options.gnbv, folder)
        for kind, more in (('run', []), ('run --frames --candidates', ['--frames', '--candidates'])):
            whole = folder / kind.replace(' ', '')
            gnbv('run', *SMOKE, *more, '--out', whole)
            kib = sum(p.stat().st_size for p in whole.rglob('*')) // 1024
            for _ in range(options.tries):
                table.count(kind, run_on(gnbv, more, dice.randrange(4, kib), disk, folder, whole))
        run = folder / 'run--frames--candidates'
        for kind, words in (
                ('plot', ['plot', run, '--format', 'svg,png,pdf', '-o', disk / 'plots']),
                ('report', ['report', run, '-o', disk / 'page.html']),
                *((f'export {form}', ['export', run, '--format', form, '-o', disk / form])
                  for form in ('tum', 'plain', 'colmap', 'nerfstudio')),
                ('surface', ['surface', run, '-o', disk / 'surface']),
                ('render', ['render', run, '-o', disk / 'path.png']),
                ('asset', ['asset', 'smoke', '-o', disk / 'smoke.glb']),
                ('sweep', ['sweep', folder / 'sweep.yaml', '--quiet', '--out', disk / 'sweep'])):
            (folder / 'sweep.yaml').write_text('scenarios: smoke\nutilities: [proposed]\nseeds: 2\n')
            for _ in range(options.tries):
                table.count(kind, make_on(gnbv, words, dice.choice([4, 8, 16, 32, 64, 128]), disk))
    return table.end()


if __name__ == '__main__':
    raise SystemExit(main())
