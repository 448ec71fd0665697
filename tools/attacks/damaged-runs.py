#!/usr/bin/env python3
"""Damages every file of a run directory, then gives it to every command that reads one.

Each file is cut, emptied, garbled, removed, or exchanged for another run's. A command may succeed,
or refuse with words that name a file of the run; a run that is resumed comes to the same result or
says why not. Nothing crashes, hangs or shows control bytes.
"""
import json
import random
import shutil
import tempfile
from pathlib import Path

from run_attack import Gnbv, Table, arguments, complaint, files_of

SMOKE = ['smoke', '--set', 'planner.termination.max_iterations=6', '--frames', '--candidates',
         '--quiet']
COMMANDS = {
    'run --resume': lambda run, out: ['run', *SMOKE, '--resume', '--out', run],
    'run scenario.yaml': lambda run, out: ['run', run / 'scenario.yaml', '--quiet', '--out', out],
    'score': lambda run, out: ['score', run],
    'score --update': lambda run, out: ['score', run, '--update'],
    'check': lambda run, out: ['check', run, '--against', out.parent / 'baseline.json'],
    'report': lambda run, out: ['report', run, '-o', out.with_suffix('.html')],
    'plot': lambda run, out: ['plot', run, '-o', out],
    'export tum': lambda run, out: ['export', run, '--format', 'tum', '-o', out],
    'export colmap': lambda run, out: ['export', run, '--format', 'colmap', '-o', out],
    'export plain': lambda run, out: ['export', run, '--format', 'plain', '-o', out],
    'surface': lambda run, out: ['surface', run, '-o', out],
    'render': lambda run, out: ['render', run, '--what', 'path,cloud', '-o', out.with_suffix('.png')],
}


def cut(path, other, dice):
    path.write_bytes(path.read_bytes()[:dice.randrange(1, max(2, path.stat().st_size))])


def emptied(path, other, dice):
    path.write_bytes(b'')


def garbled(path, other, dice):
    content = bytearray(path.read_bytes())
    for _ in range(max(1, len(content) // 200)):
        content[dice.randrange(len(content))] = dice.randrange(256)
    path.write_bytes(content)


def removed(path, other, dice):
    path.unlink()


def exchanged(path, other, dice):
    shutil.copyfile(other, path)


def verdict(done, run, resumes, sha):
    """What is wrong with how the command took it; None when nothing is."""
    wrong = complaint(done)
    words = done.stderr.decode(errors='replace')
    if wrong is None and done.returncode != 0:
        names = {Path(name).name for name in files_of(run)} | {run.name}
        if not any(name in words for name in names | {'iterations.csv', 'summary.json'}):
            wrong = f'names no file: {words[-300:]}'
    if wrong is None and resumes and done.returncode == 0:
        now = json.loads((run / 'summary.json').read_text()).get('result_sha256')
        if now != sha:
            wrong = f'resumed to another result, {now}'
    return wrong


def main():
    def extra(parser):
        parser.add_argument('--commands', default=','.join(COMMANDS),
                            help='which, with commas (default: all)')
        parser.add_argument('--files', default='', help='only those whose name holds this')

    options = arguments(__doc__, tries=1, extra=extra)
    table, dice = Table(), random.Random(options.seed)
    with tempfile.TemporaryDirectory(prefix='gnbv_attack_') as name:
        folder = Path(name)
        gnbv = Gnbv(options.gnbv, folder)
        whole, other = folder / 'whole', folder / 'other'
        gnbv('run', *SMOKE, '--out', whole)
        gnbv('run', *SMOKE, '--seed', '2', '--out', other)
        gnbv('check', whole, '--against', folder / 'baseline.json', '--update')
        sha = json.loads((whole / 'summary.json').read_text())['result_sha256']
        names = [n for n in files_of(whole) if 'frames/000' not in n or '0003' in n]
        for file in names:
            if options.files not in file:
                continue
            for damage in (cut, emptied, garbled, removed, exchanged):
                for command in options.commands.split(','):
                    for _ in range(options.tries):
                        run, out = folder / 'run', folder / 'out'
                        for old in (run, out):
                            shutil.rmtree(old, ignore_errors=True)
                        shutil.copytree(whole, run)
                        damage(run / file, other / file, dice)
                        done = gnbv(*COMMANDS[command](run, out))
                        wrong = verdict(done, run, command == 'run --resume', sha)
                        table.count(command, wrong and f'{file} {damage.__name__}: {wrong}')
    return table.end()


if __name__ == '__main__':
    raise SystemExit(main())
