#!/usr/bin/env python3
"""Damages every file of a run directory, then gives it to every command that reads one.

Each file is cut, emptied, garbled, removed, or exchanged for another run's. A command may succeed,
or refuse with words that name the file (of an exchanged one, any file of the run); what it has no
need of does not stop it. A run that is resumed comes to the same result or says why not. Nothing
crashes, hangs or shows control bytes.
"""
import concurrent.futures
import json
import random
import shutil
import tempfile
from pathlib import Path

from run_attack import Gnbv, Table, arguments, complaint, files_of, names_of

SMOKE = ['smoke', '--set', 'planner.termination.max_iterations=6', '--frames', '--candidates',
         '--quiet']
RECORD = ['scenario.yaml', 'iterations.csv', 'summary.json', 'coverage.csv', 'trajectory.tum']
CLOUDS = ['cloud.ply', 'profile.ply']
TO_PNG, TO_HTML = '.png', '.html'


def made(*words, to=''):
    """A command that reads the run and writes elsewhere."""
    return lambda run, out: [words[0], run, *words[1:], '-o', out.with_suffix(to) if to else out]


# name: (its words, what it needs; None for whatever the run holds)
COMMANDS = {
    'run --resume': (lambda run, out: ['run', *SMOKE, '--resume', '--out', run], None),
    'run scenario.yaml': (lambda run, out: ['run', run / 'scenario.yaml', '--quiet', '--out', out],
                          ['scenario.yaml']),
    'score': (lambda run, out: ['score', run],
              ['scenario.yaml', 'summary.json', 'iterations.csv', 'inputs.json', *CLOUDS]),
    'score --update': (lambda run, out: ['score', run, '--update'],
                       ['scenario.yaml', 'summary.json', 'iterations.csv', 'inputs.json', *CLOUDS]),
    'check': (lambda run, out: ['check', run, '--against', out.parent / 'baseline.json'],
              ['scenario.yaml', 'summary.json', 'coverage.csv', 'iterations.csv']),
    'ceiling': (lambda run, out: ['ceiling', run, '--quiet'], ['scenario.yaml', 'inputs.json']),
    'report': (made('report', to=TO_HTML),
               [*RECORD, 'plan.jsonl', 'candidates.jsonl', 'beliefs.jsonl']),
    'plot': (made('plot'), RECORD),
    'export tum': (made('export', '--format', 'tum'), [*RECORD, 'frames/']),
    'export colmap': (made('export', '--format', 'colmap'), [*RECORD, *CLOUDS, 'frames/']),
    'export nerfstudio': (made('export', '--format', 'nerfstudio'), [*RECORD, *CLOUDS, 'frames/']),
    'export plain': (made('export', '--format', 'plain'),
                     [*RECORD, *CLOUDS, 'map.ot', 'frames/']),
    'surface': (made('surface'), [*RECORD, *CLOUDS, 'frames/']),
    'render path': (made('render', to=TO_PNG), [*RECORD, 'inputs.json']),
    'render cloud': (made('render', '--what', 'cloud', to=TO_PNG),
                     [*RECORD, 'inputs.json', *CLOUDS]),
    'render candidates': (made('render', '--what', 'candidates', '--iteration', '3', to=TO_PNG),
                          [*RECORD, 'inputs.json', 'candidates.jsonl', 'profile.map']),
    'render snapshots': (made('render', '--what', 'snapshots'),
                         [*RECORD, 'inputs.json', *CLOUDS, 'frames/']),
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


DAMAGES = (cut, emptied, garbled, removed, exchanged)


def is_needed(file, needs):
    return needs is None or any(file.startswith(need) for need in needs)


def verdict(done, run, file, damage, command, sha):
    """What is wrong with how the command took it; None when nothing is."""
    wrong = complaint(done)
    words = done.stderr.decode(errors='replace')
    if wrong is None and done.returncode != 0:
        if not is_needed(file, COMMANDS[command][1]):
            return f'needs it for nothing: {words[-300:]}'
        names = [Path(file).name]
        if damage is exchanged or command == 'run --resume':
            names += [Path(name).name for name in files_of(run)] + ['iterations.csv']
        # a folder without scenario.yaml is none of a run; a run of two runs' files flies otherwise
        names += {removed: ['no run directory'],
                  exchanged: ['flown again it left']}.get(damage, [])
        if not any(name in words for name in names):
            wrong = f'does not name it: {words[-300:]}'
    if wrong is None and command == 'run --resume' and done.returncode == 0:
        now = json.loads((run / 'summary.json').read_text()).get('result_sha256')
        if now != sha:
            wrong = f'resumed to another result, {now}'
    return wrong


def attack(gnbv, folder, number, file, damage, command, sha, seed):
    """One damage, one command, in a folder of its own."""
    place = folder / str(number)
    run, out = place / 'run', place / 'out'
    shutil.copytree(folder / 'whole', run)
    shutil.copyfile(folder / 'baseline.json', place / 'baseline.json')
    damage(run / file, folder / 'other' / file, random.Random(seed * 1_000_003 + number))
    done = gnbv(*COMMANDS[command][0](run, out))
    wrong = verdict(done, run, file, damage, command, sha)
    shutil.rmtree(place)
    return command, wrong and f'{command}: {file} {damage.__name__}: {wrong}'


def main():
    def extra(parser):
        parser.add_argument('--commands', type=names_of(COMMANDS), default=','.join(COMMANDS),
                            help='which, with commas (default: all)')
        parser.add_argument('--files', default='', help='only those whose name holds this')
        parser.add_argument('--every', type=int, default=1,
                            help='only each N-th try: the short version (default: %(default)s)')
        parser.add_argument('--jobs', type=int, default=1, help='at a time (default: %(default)s)')

    options = arguments(__doc__, tries=1, extra=extra)
    table = Table()
    with tempfile.TemporaryDirectory(prefix='gnbv_attack_') as name:
        folder = Path(name)
        gnbv = Gnbv(options.gnbv, folder)
        whole = folder / 'whole'
        gnbv('run', *SMOKE, '--out', whole)
        gnbv('run', *SMOKE, '--seed', '2', '--out', folder / 'other')
        gnbv('check', whole, '--against', folder / 'baseline.json', '--update')
        sha = json.loads((whole / 'summary.json').read_text())['result_sha256']
        # of the frames those of one view stand for all
        names = [n for n in files_of(whole) if 'frames/000' not in n or '0003' in n]
        tries = [(file, damage, command) for file in names if options.files in file
                 for damage in DAMAGES for command in options.commands
                 for _ in range(options.tries)][::options.every]
        pool = concurrent.futures.ThreadPoolExecutor(options.jobs)
        try:
            for command, wrong in pool.map(
                    lambda numbered: attack(gnbv, folder, numbered[0], *numbered[1], sha,
                                            options.seed), enumerate(tries)):
                table.count(command, wrong)
        finally:
            pool.shutdown(cancel_futures=True)
    return table.end()


if __name__ == '__main__':
    raise SystemExit(main())
