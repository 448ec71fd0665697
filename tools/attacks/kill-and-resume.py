#!/usr/bin/env python3
"""Kills commands at random moments and starts them again: the same files, none half-written.

A run is killed, perhaps killed while it is resumed, and resumed to its end; or asked to stop by
SIGINT, SIGTERM or SIGHUP. A sweep, a table and the paper are started again. Reports, surfaces and
exports are made again.
"""
import random
import re
import shutil
import signal
import tempfile
import time
from pathlib import Path

from run_attack import (Gnbv, Table, arguments, complaint, difference, files_of, half_written,
                        names_of, stopped)

SMOKE = ['smoke', '--set', 'planner.termination.max_iterations=30', '--frames', '--candidates',
         '--quiet']
SWEEP = """scenarios: smoke
utilities: [proposed, bircher]
seeds: 2
"""


def needs(table, kind, done):
    """Counts a failure of a command that has to work."""
    wrong = complaint(done)
    if wrong is None and done.returncode != 0:
        wrong = f'exit code {done.returncode}: {done.stderr.decode(errors="replace")[-300:]}'
    if wrong:
        table.count(kind, wrong)
    return wrong is None


def runs(table, gnbv, folder, options, dice):
    whole = folder / 'whole'
    begin = time.monotonic()
    if not needs(table, 'run', gnbv('run', *SMOKE, '--out', whole)):
        return
    takes_s = time.monotonic() - begin
    for end in ('SIGKILL', 'SIGINT', 'SIGTERM', 'SIGHUP'):
        for attempt in range(options.tries):
            run = folder / f'{end}-{attempt}'
            command = ['run', *SMOKE, '--out', run, '--resume']
            kills = 1 + dice.randrange(2)
            for _ in range(kills):
                code = stopped(gnbv.start(*command), dice.uniform(0.0, takes_s),
                               signal.Signals[end])
                # one that ended in order is whole, and shorter
                is_killed = end == 'SIGKILL' and run.exists()
                wrong = half_written(run, whole) if is_killed else None
                if wrong is None and end != 'SIGKILL' and code not in (0, 1, -signal.Signals[end]):
                    wrong = f'exit code {code}'
                if wrong:
                    break
            kind = f'run, {end} and --resume'
            if wrong is None and needs(table, kind, gnbv(*command)):
                table.count(kind, difference(run, whole))
            elif wrong:
                table.count(kind, f'{wrong}, after {kills} kills')
            shutil.rmtree(run, ignore_errors=True)


def sweeps(table, gnbv, folder, options, dice):
    (folder / 'sweep.yaml').write_text(SWEEP)
    command = ['sweep', 'sweep.yaml', '--quiet', '--out']
    whole = folder / 'whole-sweep'
    begin = time.monotonic()
    if not needs(table, 'sweep', gnbv(*command, whole)):
        return
    takes_s = time.monotonic() - begin
    for attempt in range(options.tries):
        out = folder / f'sweep-{attempt}'
        stopped(gnbv.start(*command, out), dice.uniform(0.0, takes_s), signal.SIGKILL)
        if needs(table, 'sweep, SIGKILL and again', gnbv(*command, out)):
            table.count('sweep, SIGKILL and again',
                        cells_differ(out / 'cells', whole / 'cells'))
        shutil.rmtree(out, ignore_errors=True)


def cells_differ(cells, whole):
    """The first difference of missions that are flown by name, and what is left of killed ones."""
    for cell in sorted(p for p in whole.iterdir() if p.is_dir()):
        wrong = difference(cells / cell.name, cell)
        if wrong:
            return f'{cell.name}: {wrong}'
    left = [p.name for p in cells.iterdir() if p.name.endswith('.part')]
    return f'left {left}' if left else None


def without_clock(printed):
    return re.sub(rb'[0-9.]+ s of wall time', b'', printed)


def tables(table, gnbv, folder, options, dice):
    """What is printed, and the missions that it is printed of."""
    command = ['table', 'lab_model', '--set', 'planner.termination.max_iterations=3', '--no-oracle',
               '--quiet', '--format', 'csv', '--out']
    kind = 'table, SIGKILL and again'
    begin = time.monotonic()
    whole = gnbv(*command, folder / 'whole-table')
    if not needs(table, kind, whole):
        return
    takes_s = time.monotonic() - begin
    for attempt in range(options.tries):
        out = folder / f'table-{attempt}'
        for _ in range(1 + dice.randrange(2)):
            stopped(gnbv.start(*command, out), dice.uniform(0.0, takes_s), signal.SIGKILL)
        again = gnbv(*command, out)
        if needs(table, kind, again):
            wrong = cells_differ(out / 'cells', folder / 'whole-table' / 'cells')
            if wrong is None and without_clock(again.stdout) != without_clock(whole.stdout):
                wrong = 'another table'
            table.count(kind, wrong)
        shutil.rmtree(out, ignore_errors=True)


def papers(table, gnbv, folder, options, dice):
    """The page with its tables and pictures, and its missions."""
    place = folder / 'paper'
    command = ['paper', '--scenarios', 'lab_model', '--seeds', '1', '--quiet', '--set',
               'planner.termination.max_iterations=3', '-o', place / 'page', '--cells',
               place / 'cells']
    kind = 'paper, SIGKILL and again'
    begin = time.monotonic()
    if not needs(table, kind, gnbv(*command)):
        return
    takes_s = time.monotonic() - begin
    place.rename(folder / 'whole-paper')
    for attempt in range(options.paper_tries):
        stopped(gnbv.start(*command), dice.uniform(0.0, takes_s), signal.SIGKILL)
        if needs(table, kind, gnbv(*command)):
            wrong = cells_differ(*(p / 'cells' / 'cells' for p in (place, folder / 'whole-paper')))
            ours, theirs = (set(map(str, files_of(p / 'page'))) for p in
                            (place, folder / 'whole-paper'))
            if wrong is None and ours != theirs:
                wrong = f'files {sorted(ours ^ theirs)}'
            table.count(kind, wrong)
        shutil.rmtree(place, ignore_errors=True)


def made_of_a_run(table, gnbv, folder, options, dice):
    run = folder / 'whole'
    if not run.exists():
        gnbv('run', *SMOKE, '--out', run)
    for kind, words, out in (('report', ['report', run, '-o'], 'page.html'),
                             ('surface', ['surface', run, '-o'], 'surface'),
                             ('export', ['export', run, '--format', 'tum', '-o'], 'tum')):
        whole = folder / f'whole-{kind}' / out
        whole.parent.mkdir()
        begin = time.monotonic()
        if not needs(table, kind, gnbv(*words, whole)):
            continue
        takes_s = time.monotonic() - begin
        for attempt in range(options.tries):
            place = folder / f'{kind}-{attempt}'
            place.mkdir()
            stopped(gnbv.start(*words, place / out), dice.uniform(0.0, takes_s), signal.SIGKILL)
            wrong = half_written(place, whole.parent)
            if wrong is None and needs(table, f'{kind}, SIGKILL and again',
                                       gnbv(*words, place / out)):
                left = [p.name for p in place.rglob('*')
                        if p.is_file() and '.part' not in p.name and not p.stat().st_size]
                table.count(f'{kind}, SIGKILL and again', f'empty: {left}' if left else None)
            elif wrong:
                table.count(f'{kind}, SIGKILL and again', wrong)
            shutil.rmtree(place, ignore_errors=True)


ATTACKS = {'runs': runs, 'sweeps': sweeps, 'tables': tables, 'papers': papers,
           'made': made_of_a_run}


def main():
    def extra(parser):
        parser.add_argument('--only', type=names_of(ATTACKS), default=','.join(ATTACKS),
                            help='only these (default: %(default)s)')
        parser.add_argument('--paper-tries', type=int, help='of the paper (default: a fifth)')

    options = arguments(__doc__, tries=50, extra=extra)
    options.paper_tries = options.paper_tries or max(1, options.tries // 5)
    table, dice = Table(), random.Random(options.seed)
    with tempfile.TemporaryDirectory(prefix='gnbv_attack_') as name:
        folder = Path(name)
        gnbv = Gnbv(options.gnbv, folder)
        for name in options.only:
            ATTACKS[name](table, gnbv, folder, options, dice)
    return table.end()


if __name__ == '__main__':
    raise SystemExit(main())
