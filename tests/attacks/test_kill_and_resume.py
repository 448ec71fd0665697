"""Commands killed at random moments and started again: the same files, none half-written.

A run is killed, perhaps killed while it is resumed, and resumed to its end; or asked to stop by
SIGINT, SIGTERM or SIGHUP. A sweep, a table and the paper are started again. Reports, surfaces and
exports are made again.
"""
import re
import signal

import pytest
from program import difference, files_of, half_written, stopped

TRIES = 50
# with bursts in the midst of which it may die
SMOKE = ['smoke', '--set', 'planner.termination.max_iterations=30', '--set',
         'planner.fvs.entropy_threshold_nat=1', '--frames', '--candidates', '--quiet']
SWEEP = 'scenarios: smoke\nutilities: [proposed, bircher]\nseeds: 2\n'
SHORT = ['--quiet', '--set', 'planner.termination.max_iterations=3']
MANY = {
    'sweep': ['sweep', '{sweep}', '--quiet', '--out'],
    'table': ['table', 'lab_model', '--no-oracle', '--format', 'csv', *SHORT, '--out'],
    'paper': ['paper', '--scenarios', 'lab_model', '--seeds', '1', *SHORT, '-o', 'page', '--cells'],
}
MADE = {'report': ['report', '{run}', '-o'], 'surface': ['surface', '{run}', '-o'],
        'export': ['export', '{run}', '--format', 'tum', '-o']}


@pytest.mark.parametrize('name', ['SIGKILL', 'SIGINT', 'SIGTERM', 'SIGHUP'])
def test_a_run_goes_on_to_the_same_files(gnbv, whole, tmp_path, dice, name, attempt):
    flown, run = whole('run', *SMOKE, '--out'), tmp_path / 'run'
    command = ['run', *SMOKE, '--resume', '--out', run]
    for _ in range(dice.randint(1, 2)):
        end = stopped(gnbv.start(*command), dice.uniform(0.0, flown.takes_s), name)
        if name != 'SIGKILL':
            assert end.code in (0, 1, -signal.Signals[name]), end
        elif run.exists():  # one that ended in order is whole, and shorter
            assert not half_written(run, flown.path)
    gnbv(*command).check({0})
    assert not difference(run, flown.path)


def difference_of_missions(folder, whole):
    """The first difference between missions that are flown by name; what killed ones left."""
    theirs = {p.parent.relative_to(whole) for p in whole.rglob('summary.json')}
    assert theirs, f'no missions in {whole}'
    left = [str(p) for p in folder.rglob('*.part')]
    return f'left {left}' if left else next(
        (f'{name}: {wrong}' for name in sorted(theirs)
         if (wrong := difference(folder / name, whole / name))), None)


def without_clock(printed):
    return re.sub('[0-9.]+ s of wall time', '', printed)


@pytest.fixture(scope='session')
def sweep_yaml(tmp_path_factory):
    path = tmp_path_factory.mktemp('sweep') / 'sweep.yaml'
    path.write_text(SWEEP)
    return path


@pytest.mark.parametrize('kind', MANY)
def test_many_missions_are_those_of_one_call(gnbv, whole, sweep_yaml, tmp_path, dice, kind,
                                             attempt):
    words = [word.format(sweep=sweep_yaml) for word in MANY[kind]]
    undisturbed, out = whole(*words), tmp_path / 'out'
    for _ in range(dice.randint(1, 2)):
        stopped(gnbv.start(*words, out), dice.uniform(0.0, undisturbed.takes_s), 'SIGKILL')
    again = gnbv(*words, out).check({0})
    assert not difference_of_missions(out, undisturbed.path)
    if kind == 'table':
        assert without_clock(again.out) == without_clock(undisturbed.end.out)
    if kind == 'paper':  # with its tables and pictures
        assert set(files_of(tmp_path / 'page')) == set(files_of(undisturbed.path.parent / 'page'))


@pytest.mark.parametrize('kind', MADE)
def test_what_is_made_of_a_run_is_whole_or_not_there(gnbv, whole, tmp_path, dice, kind, attempt):
    words = [word.format(run=whole('run', *SMOKE, '--out').path) for word in MADE[kind]]
    name = 'out.html' if kind == 'report' else 'out'
    undisturbed, out = whole(*words, name=name), tmp_path / 'made' / name
    out.parent.mkdir()
    stopped(gnbv.start(*words, out), dice.uniform(0.0, undisturbed.takes_s), 'SIGKILL')
    assert not half_written(out.parent, undisturbed.path.parent)
    gnbv(*words, out).check({0})
    assert all(p.stat().st_size for p in files_of(out.parent).values() if '.part' not in p.name)
