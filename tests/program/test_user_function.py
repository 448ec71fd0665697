"""A utility or a planner in a Python file: it flies, its record repeats the run, it is a row like
any other, and its failure ends the run in order."""
import hashlib
import shutil
import sys
from pathlib import Path

import pytest
from program import Gnbv, hash_of, summary, until

FEW = '--quiet --set planner.termination.max_iterations=5'
PLAN = '''from __future__ import annotations
import dataclasses


@dataclasses.dataclass
class Step:  # of which dataclasses asks where it is from
    rows: int = 7


def plan(belief, history):
    views = belief.valid(belief.sample())
    return View(*views[len(history) * Step().rows % len(views)])
'''
OTHER = '''def other(views):
    return views["path_m"]
'''
FILES = {
    'plan.py': PLAN,
    'mine.py': OTHER + '''
def mine(views):  # "quotes", a back\\slash, Umläute
    return views["unknown_voxels"] / (1.0 + views["path_m"])
''',
    'endless.py': '''def endless(views):
    import os
    with open("pid.part", "w") as file:
        file.write(str(os.getpid()))
    os.rename("pid.part", "pid")
    while True:
        pass
'''}


@pytest.fixture
def python(tmp_path):
    pytest.importorskip('numpy')
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    return {'GNBV_PYTHON': sys.executable}


@pytest.mark.parametrize('words, name, file', [('mine.py:mine', 'mine', 'mine.py'),
                                               ('plan.py', 'plan', 'plan.py')])
def test_it_flies_and_its_record_repeats_the_run(run, tmp_path, python, words, name, file):
    run(f'run smoke {FEW} --utility {words} --out first', **python)
    flown = summary(tmp_path / 'first')
    assert flown['utility'] == name
    assert (tmp_path / 'first/utility.py').read_text() == FILES[file]
    assert flown['utility_source_sha256'] == hashlib.sha256(FILES[file].encode()).hexdigest()
    (tmp_path / file).unlink()
    run('run first/scenario.yaml --quiet --threads 1 --out again', **python)
    assert hash_of(tmp_path / 'again') == flown['result_sha256']
    run('render first --quiet --what voxels -o pictures')  # which nobody is asked for


def test_a_planner_that_was_killed_is_resumed(run, tmp_path, python):
    run(f'run smoke {FEW} --utility plan.py --out planned', **python)
    shutil.copytree(tmp_path / 'planned', tmp_path / 'cut')
    (tmp_path / 'cut/summary.json').unlink()
    rows = (tmp_path / 'cut/iterations.csv').read_text().splitlines(True)
    (tmp_path / 'cut/iterations.csv').unlink()
    (tmp_path / 'cut/iterations.csv.part').write_text(''.join(rows[:4]))
    run(f'run smoke {FEW} --utility plan.py --out cut --resume', **python)
    assert hash_of(tmp_path / 'cut') == hash_of(tmp_path / 'planned')


@pytest.mark.parametrize('text, says', [
    ('calls = []\ndef f(views):\n    calls.append(1)\n'
     '    return views["path_m"] * (1 if len(calls) < 3 else float("nan"))\n',
     'utility f: iteration 3, candidate'),
    *((f'def f(views):\n    return {returned}\n', 'utility f: iteration 1, all 53 candidates '
       f'together: returned {told}') for returned, told in [
           ('1.0', 'shape ()'), ("views['path_m'][:-1]", 'shape (52,)'),
           ('[[1.0]]', 'shape (1, 1)'),
           ("'many'", "'many', expected a number a row"), ("views['rays'] * 1j", 'array([0.')]),
    ('def f(views):\n    import os\n    os._exit(7)\n',
     'iteration 1: its Python ended (exit code 7)'),
    ('def f(belief, history):\n    print("on stderr")\n'
     '    return belief.valid(belief.sample())[1 // (3 - len(history))]\n',
     'planner f: iteration 3: ')])
def test_one_that_fails_ends_the_run_in_order(run, tmp_path, python, text, says):
    (tmp_path / 'f.py').write_text(text)
    end = run(f'run smoke {FEW} --utility f.py --out f', says, code=1, **python)
    assert summary(tmp_path / 'f')['termination'] == 'utility_failed'
    views = 3 if 'iteration 3' in says else 1
    assert (tmp_path / 'f/iterations.csv').read_text().count('\n') == views + 1
    if 'planner' in says:
        assert 'File "f.py", line 3' in end.err and 'ZeroDivisionError' in end.err


@pytest.mark.parametrize('text, words, says', [
    ('x = 1\n', 'f.py', 'defines no function'),
    (OTHER, 'f.py:none', "defines no function 'none'"),
    (PLAN + OTHER, 'f.py', 'f.py: defines several functions (plan, other): name one'),
    ('def f(v:\n  return v\n', 'f.py', 'SyntaxError'),
    ('import nosuchmodule\ndef f(v): return v\n', 'f.py', 'nosuchmodule'),
    ('x = 1\n', 'plan.py --views views.csv', '--views views.csv: goes with --utility route')])
def test_one_that_cannot_be_used_is_refused_before_anything_is_written(run, tmp_path, python, text,
                                                                       words, says):
    (tmp_path / 'f.py').write_text(text)
    (tmp_path / 'views.csv').write_text('x,y,z,yaw_deg\n3.2,0,2,180\n')
    run(f'run smoke --utility {words} --out none', says, code=2, **python)
    run('run smoke --utility plan.py --out none', 'GNBV_PYTHON names another', code=2,
        GNBV_PYTHON='/nowhere')
    assert not (tmp_path / 'none').exists()


def test_an_endless_utility_ends_with_the_program_that_asks_it(gnbv, tmp_path, python):
    def state():
        """Who has ended may stay as a zombie until the first process waits for it."""
        try:
            return Path(f'/proc/{asked}/stat').read_text().rsplit(') ')[-1][0]
        except OSError:
            return 'X'

    process = Gnbv(gnbv.path, tmp_path, **python).start(
        'run', 'smoke', *FEW.split(), '--utility', 'endless.py', '--out', 'endless')
    until(60, 'the function is asked', (tmp_path / 'pid').exists)
    asked = int((tmp_path / 'pid').read_text())
    process.kill()
    process.wait()
    until(10, 'its Python ends', lambda: state() in 'ZX')
