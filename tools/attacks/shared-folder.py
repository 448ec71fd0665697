#!/usr/bin/env python3
"""Two runs into one folder at a time, new ones and resumed ones: one flies, the other is told.

Also by default names, of which each has its own.
"""
import json
import random
import shutil
import signal
import tempfile
import time
from pathlib import Path

from run_attack import Gnbv, Table, arguments, difference, end_of, stopped
import subprocess

SMOKE = ['smoke', '--set', 'planner.termination.max_iterations=12', '--quiet']


def pair(gnbv, words, dice):
    """Both at nearly the same time: their exit codes and what they say."""
    both = []
    for more in words:
        both.append(gnbv.start('run', *SMOKE, *more, stderr=subprocess.PIPE,
                               stdout=subprocess.DEVNULL))
        time.sleep(dice.choice([0.0, 0.0, 0.01, 0.05, 0.2]))
    ends = [end_of(process) for process in both]
    return [end.returncode for end in ends], [end.stderr.decode(errors='replace') for end in ends]


def is_of_one(run):
    """Whether its summary and its scenario are of one seed."""
    seed = json.loads((run / 'summary.json').read_text())['seed']
    return f'\nseed: {seed}\n' in '\n' + (run / 'scenario.yaml').read_text()


def two_seeds(table, gnbv, folder, attempt, dice):
    run = folder / f'seeds-{attempt}'
    codes, said = pair(gnbv, [['--seed', '1', '--out', run], ['--seed', '2', '--out', run]], dice)
    if set(codes) != {0, 2}:
        return f'exit codes {codes}: {said}'
    loser = said[codes.index(2)]
    if 'another gnbv' not in loser and 'holds a run' not in loser:
        return loser
    return None if is_of_one(run) else 'summary.json and scenario.yaml of two seeds'


def two_resumes(table, gnbv, folder, attempt, dice):
    run = folder / f'resumed-{attempt}'
    stopped(gnbv.start('run', *SMOKE, '--out', run), dice.uniform(0.05, 0.5), signal.SIGKILL)
    codes, said = pair(gnbv, [['--out', run, '--resume']] * 2, dice)
    if 0 not in codes or any(code not in (0, 2) for code in codes):
        return f'exit codes {codes}: {said}'
    return difference(run, folder / 'whole')


def default_names(table, gnbv, folder, attempt, dice):
    place = folder / f'names-{attempt}'
    place.mkdir()
    here = Gnbv(gnbv.path, place)
    codes, said = pair(here, [[], []], dice)
    runs = sorted(p.name for p in (place / 'runs').iterdir())
    if codes != [0, 0] or len(runs) != 2:
        return f'exit codes {codes}, runs {runs}: {said}'
    return None


def main():
    options = arguments(__doc__, tries=36)
    table, dice = Table(), random.Random(options.seed)
    with tempfile.TemporaryDirectory(prefix='gnbv_attack_') as name:
        folder = Path(name)
        gnbv = Gnbv(options.gnbv, folder)
        gnbv('run', *SMOKE, '--out', folder / 'whole')
        for kind, attack in (('two seeds, one --out', two_seeds),
                             ('two --resume of one run', two_resumes),
                             ('two runs by default names', default_names)):
            for attempt in range(options.tries):
                table.count(kind, attack(table, gnbv, folder, attempt, dice))
            for left in folder.iterdir():
                if left.name != 'whole':
                    shutil.rmtree(left, ignore_errors=True)
    return table.end()


if __name__ == '__main__':
    raise SystemExit(main())
