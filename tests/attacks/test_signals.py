"""Signals in flight: those that ask to stop end a mission in order, inherited SIG_IGN is respected.

SIGINT, SIGTERM and SIGHUP, one or several, at random moments: the run is whole and says that it was
interrupted, or it was over before. What was started with a signal ignored, as nohup and shells in
the background do, flies on. A table and a sweep that are stopped leave no mission behind.
"""
import os
import signal
import time
from pathlib import Path

import pytest
from program import end_of, stopped, summary

TRIES = 20
NAMES = ['SIGINT', 'SIGTERM', 'SIGHUP']
SMOKE = ['run', 'smoke', '--set', 'planner.termination.max_iterations=30', '--quiet', '--out']
MANY = {'table': ['table', 'lab_model', '--set', 'planner.termination.max_iterations=4', '--quiet',
                  '--no-oracle', '--jobs', '2', '--out'],
        'sweep': ['sweep', 'sweep.yaml', '--quiet', '--jobs', '2', '--out']}


@pytest.mark.parametrize('names', [*([name] for name in NAMES), 3], ids=str)
def test_a_run_ends_in_order(gnbv, whole, tmp_path, dice, names, attempt):
    names = [dice.choice(NAMES) for _ in range(3)] if names == 3 else names
    moments_s = sorted(dice.uniform(0.0, whole(*SMOKE).takes_s) for _ in names)
    run, begin = tmp_path / 'run', time.monotonic()
    process = gnbv.start(*SMOKE, run)
    for name, moment_s in zip(names, moments_s):
        time.sleep(max(0.0, begin + moment_s - time.monotonic()))
        if process.poll() is None:
            process.send_signal(signal.Signals[name])
    end = end_of(process)
    ended = summary(run) and summary(run)['termination']
    # before the mission began there is nothing to put in order; who is asked twice ends at once
    at_once = end.code in (-signal.Signals[name] for name in names) and \
        (len(names) > 1 or not (run / 'inputs.json').exists())
    assert at_once or end.code in (0, 1) and ended == 'interrupted' or \
        end.code == 0 and ended == 'max_iterations', (names, moments_s, end, ended)


@pytest.mark.parametrize('name', NAMES)
def test_what_was_ignored_at_the_start_is_ignored(gnbv, whole, tmp_path, dice, name, attempt):
    moment_s = dice.uniform(0.0, 0.8 * whole(*SMOKE).takes_s)
    process = gnbv.start(*SMOKE, tmp_path / 'run', preexec_fn=lambda: signal.signal(
        signal.Signals[name], signal.SIG_IGN))
    assert stopped(process, moment_s, name).code == 0
    assert summary(tmp_path / 'run')['termination'] == 'max_iterations'


def flying_in(folder):
    """Processes whose command line names the folder."""
    found = []
    for entry in Path('/proc').glob('[0-9]*'):
        try:
            words = (entry / 'cmdline').read_bytes()
        except OSError:
            continue
        if os.fsencode(folder) in words and entry.name != str(os.getpid()):
            found.append(int(entry.name))
    return found


@pytest.mark.parametrize('kind', MANY)
def test_no_mission_of_many_flies_on(gnbv, whole, tmp_path, dice, kind, attempt):
    (tmp_path / 'sweep.yaml').write_text(
        'scenarios: smoke\nutilities: [proposed, bircher]\nseeds: 2\n')
    name, out = dice.choice(NAMES), tmp_path / 'cells'
    end = stopped(gnbv.start(*MANY[kind], out), dice.uniform(0.0, 2 * whole(*SMOKE).takes_s), name)
    limit = time.monotonic() + 60
    while flying_in(out) and time.monotonic() < limit:
        time.sleep(0.1)
    assert not flying_in(out)
    assert end.code in (0, 1, -signal.Signals[name], 128 + signal.Signals[name]), end
