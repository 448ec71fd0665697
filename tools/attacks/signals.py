#!/usr/bin/env python3
"""Signals in flight: those that ask to stop end a mission in order, inherited SIG_IGN is respected.

SIGINT, SIGTERM and SIGHUP, one or several, at random moments: the run is whole and says that it was
interrupted, or it was over before. What was started with a signal ignored, as nohup and shells in
the background do, flies on. A table and a sweep that are stopped leave no mission behind.
"""
import json
import os
import random
import shutil
import signal
import tempfile
import time
from pathlib import Path

from run_attack import Gnbv, Table, arguments, code_of, stopped

ENDS = ('SIGINT', 'SIGTERM', 'SIGHUP')
FEW = ['--set', 'planner.termination.max_iterations=4', '--quiet']
SMOKE = ['smoke', '--set', 'planner.termination.max_iterations=30', '--quiet']


def termination(run):
    summary = run / 'summary.json'
    return json.loads(summary.read_text())['termination'] if summary.exists() else None


def in_order(gnbv, run, ends, moments_s):
    """One mission that is told to stop at those moments."""
    process = gnbv.start('run', *SMOKE, '--out', run)
    begin = time.monotonic()
    for end, moment_s in zip(ends, moments_s):
        time.sleep(max(0.0, begin + moment_s - time.monotonic()))
        if process.poll() is None:
            process.send_signal(signal.Signals[end])
    code = code_of(process)
    ended = termination(run)
    if code == 0 and ended == 'max_iterations':
        return None
    if code in (0, 1) and ended == 'interrupted':
        return None
    # before the mission began there is nothing to put in order; who is asked twice ends at once
    has_begun = (run / 'inputs.json').exists()
    if code is not None and -code in (signal.Signals[end] for end in ends) and (len(ends) > 1 or not has_begun):
        return None
    return f'{ends} at {moments_s}: exit code {code}, {ended}'


def ignored(gnbv, run, end, moment_s):
    process = gnbv.start('run', *SMOKE, '--out', run,
                         preexec_fn=lambda: signal.signal(signal.Signals[end], signal.SIG_IGN))
    code = stopped(process, moment_s, signal.Signals[end])
    if code != 0 or termination(run) != 'max_iterations':
        return f'{end} at {moment_s:.2f} s: exit code {code}, {termination(run)}'
    return None


def flying_in(folder):
    """Processes whose command line names the folder."""
    found = []
    for entry in Path('/proc').iterdir():
        if entry.name.isdigit() and entry.name != str(os.getpid()):
            try:
                words = (entry / 'cmdline').read_bytes()
            except OSError:
                continue
            if os.fsencode(folder) in words:
                found.append(int(entry.name))
    return found


def of_many(gnbv, folder, words, end, moment_s):
    out = folder / 'cells'
    process = gnbv.start(*words, '--out', out)
    code = stopped(process, moment_s, signal.Signals[end])
    limit = time.monotonic() + 60
    while flying_in(out) and time.monotonic() < limit:
        time.sleep(0.1)
    left = flying_in(out)
    shutil.rmtree(out, ignore_errors=True)
    if left:
        return f'{end} at {moment_s:.2f} s: {len(left)} missions fly on'
    if code not in (0, 1, -signal.Signals[end], 128 + signal.Signals[end]):
        return f'{end} at {moment_s:.2f} s: exit code {code}'
    return None


def main():
    options = arguments(__doc__, tries=20)
    table, dice = Table(), random.Random(options.seed)
    with tempfile.TemporaryDirectory(prefix='gnbv_attack_') as name:
        folder = Path(name)
        gnbv = Gnbv(options.gnbv, folder)
        begin = time.monotonic()
        gnbv('run', *SMOKE, '--out', folder / 'whole')
        takes_s = time.monotonic() - begin
        (folder / 'sweep.yaml').write_text(
            'scenarios: smoke\nutilities: [proposed, bircher]\nseeds: 2\n')
        many = {'table': ['table', 'lab_model', *FEW, '--no-oracle', '--jobs', '2'],
                'sweep': ['sweep', 'sweep.yaml', '--quiet', '--jobs', '2']}
        for attempt in range(options.tries):
            run = folder / 'run'
            for end in ENDS:
                table.count(f'run, {end}',
                            in_order(gnbv, run, [end], [dice.uniform(0.0, takes_s)]))
                shutil.rmtree(run, ignore_errors=True)
                table.count(f'run, {end} ignored when it began',
                            ignored(gnbv, run, end, dice.uniform(0.0, 0.8 * takes_s)))
                shutil.rmtree(run, ignore_errors=True)
            ends = [dice.choice(ENDS) for _ in range(3)]
            table.count('run, three signals', in_order(
                gnbv, run, ends, sorted(dice.uniform(0.0, takes_s) for _ in ends)))
            shutil.rmtree(run, ignore_errors=True)
            for kind, words in many.items():
                table.count(f'{kind}, stopped', of_many(
                    gnbv, folder, words, dice.choice(ENDS), dice.uniform(0.0, 2 * takes_s)))
    return table.end()


if __name__ == '__main__':
    raise SystemExit(main())
