"""A planner in a Python file: it flies, its record repeats the run, it is a row like any other."""
import shutil
import sys

import pytest
from program import hash_of, summary

FEW = '--quiet --set planner.termination.max_iterations=5'
PLAN = '''def plan(belief, history):
    views = belief.valid(belief.sample())
    return View(*views[len(history) * 7 % len(views)])
'''
OTHER = '''def other(views):
    return views["path_m"]
'''


@pytest.fixture
def python(tmp_path):
    pytest.importorskip('numpy')
    (tmp_path / 'plan.py').write_text(PLAN)
    (tmp_path / 'other.py').write_text(OTHER)
    return {'GNBV_PYTHON': sys.executable}


def test_a_planner_flies_and_its_record_repeats_the_run(run, tmp_path, python):
    run(f'run smoke {FEW} --utility plan.py --out planned', **python)
    assert summary(tmp_path / 'planned')['utility'] == 'plan'
    (tmp_path / 'plan.py').rename(tmp_path / 'moved.py')
    run('run planned/scenario.yaml --quiet --threads 1 --out again', **python)
    assert hash_of(tmp_path / 'again') == hash_of(tmp_path / 'planned')
    run('render planned --quiet --what voxels -o pictures')  # which nobody is asked for


def test_a_killed_one_is_resumed(run, tmp_path, python):
    run(f'run smoke {FEW} --utility plan.py --out planned', **python)
    shutil.copytree(tmp_path / 'planned', tmp_path / 'cut')
    (tmp_path / 'cut/summary.json').unlink()
    rows = (tmp_path / 'cut/iterations.csv').read_text().splitlines(True)
    (tmp_path / 'cut/iterations.csv').unlink()
    (tmp_path / 'cut/iterations.csv.part').write_text(''.join(rows[:4]))
    run(f'run smoke {FEW} --utility plan.py --out cut --resume', **python)
    assert hash_of(tmp_path / 'cut') == hash_of(tmp_path / 'planned')


def test_it_is_compared_with_others(run, tmp_path, python):
    said = run(f'compare smoke {FEW} --utilities proposed,other.py,walk=plan.py --seeds 2 '
               '--no-ceiling --out cells --format csv', **python).out
    for method in ('proposed', 'other', 'walk'):
        assert said.count(f'smoke,coverage at 0.05 m (%),{method},2,') == 1, said


def test_what_does_not_go_together_is_refused(run, tmp_path, python):
    (tmp_path / 'views.csv').write_text('x,y,z,yaw_deg\n3.2,0,2,180\n')
    run('run smoke --utility plan.py --views views.csv --out none',
        '--views views.csv: goes with --utility route', code=2, **python)
    (tmp_path / 'two.py').write_text(PLAN + OTHER)
    run('run smoke --utility two.py --out none',
        'two.py: defines several functions (plan, other): name one', code=2, **python)
    assert not (tmp_path / 'none').exists()
