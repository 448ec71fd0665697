"""Two runs into one folder at a time, new ones and resumed ones: one flies, the other is told.

Also by default names, of which each has its own.
"""
import time

from program import difference, end_of, stopped, summary

TRIES = 36
SMOKE = ['run', 'smoke', '--set', 'planner.termination.max_iterations=12', '--quiet']


def both(gnbv, dice, *words):
    """The ends of two that are started at nearly the same time."""
    processes = []
    for more in words:
        processes.append(gnbv.start(*SMOKE, *more))
        time.sleep(dice.choice([0.0, 0.0, 0.01, 0.05, 0.2]))
    return [end_of(process) for process in processes]


def test_of_two_seeds_one_flies(gnbv, tmp_path, dice, attempt):
    run = tmp_path / 'run'
    ends = both(gnbv, dice, *(['--seed', seed, '--out', run] for seed in (1, 2)))
    assert {end.code for end in ends} == {0, 2}, ends
    for end in ends:
        end.check(names=['another gnbv', 'holds a run'])
    assert f'\nseed: {summary(run)["seed"]}\n' in '\n' + (run / 'scenario.yaml').read_text()


def test_of_two_resumes_one_goes_on(gnbv, whole, tmp_path, dice, attempt):
    run = tmp_path / 'run'
    stopped(gnbv.start(*SMOKE, '--out', run), dice.uniform(0.05, 0.5), 'SIGKILL')
    ends = both(gnbv, dice, *[['--out', run, '--resume']] * 2)
    assert 0 in {end.code for end in ends} <= {0, 2}, ends
    assert not difference(run, whole(*SMOKE, '--out').path)


def test_by_default_each_has_a_name(gnbv, tmp_path, dice, attempt):
    ends = both(gnbv, dice, [], [])
    assert [end.code for end in ends] == [0, 0], ends
    assert len(list((tmp_path / 'runs').iterdir())) == 2
