"""A utility in a Python file: it flies, its record repeats the run, its failure ends the run."""
import hashlib
import sys
from pathlib import Path

import pytest
from program import Gnbv, hash_of, summary, until

FEW = '--quiet --set planner.termination.max_iterations=5'
MINE = '''def other(views):
    return views["path_m"]

def mine(views):  # "quotes", a back\\slash, Umläute
    return views["unknown_voxels"] / (1.0 + views["path_m"])
'''
LATE = '''calls = []
def late(views):
    calls.append(1)
    return views["path_m"] * (1 if len(calls) < 3 else float("nan"))
'''
ENDLESS = '''def endless(views):
    import os
    with open("pid.part", "w") as file:
        file.write(str(os.getpid()))
    os.rename("pid.part", "pid")
    while True:
        pass
'''


@pytest.fixture
def python():
    pytest.importorskip('numpy')
    return {'GNBV_PYTHON': sys.executable}


def test_a_utility_flies_and_its_record_repeats_the_run(run, tmp_path, python):
    (tmp_path / 'mine.py').write_text(MINE)
    run(f'run smoke {FEW} --utility mine.py:mine --out first', **python)
    flown = summary(tmp_path / 'first')
    assert flown['utility'] == 'mine'
    assert (tmp_path / 'first/utility.py').read_text() == MINE
    assert flown['utility_source_sha256'] == hashlib.sha256(MINE.encode()).hexdigest()
    (tmp_path / 'mine.py').unlink()
    run('run first/scenario.yaml --quiet --threads 1 --out again', **python)
    assert hash_of(tmp_path / 'again') == flown['result_sha256']


def test_a_utility_that_fails_ends_the_run_in_order(run, tmp_path, python):
    (tmp_path / 'late.py').write_text(LATE)
    run(f'run smoke {FEW} --utility late.py:late --out late',
        'utility late: iteration 3, candidate', code=1, **python)
    assert summary(tmp_path / 'late')['termination'] == 'utility_failed'
    assert (tmp_path / 'late/iterations.csv').read_text().count('\n') == 4
    run('run smoke --utility late.py:none --out none', "defines no function 'none'", code=2,
        **python)
    run('run smoke --utility late.py --out none', 'GNBV_PYTHON names another', code=2,
        GNBV_PYTHON='/nowhere')
    assert not (tmp_path / 'none').exists(), 'nothing is written before the utility is known to run'


def test_an_endless_utility_ends_with_the_program_that_asks_it(gnbv, tmp_path, python):
    def state():
        """Who has ended may stay as a zombie until the first process waits for it."""
        try:
            return Path(f'/proc/{asked}/stat').read_text().rsplit(') ')[-1][0]
        except OSError:
            return 'X'

    (tmp_path / 'endless.py').write_text(ENDLESS)
    process = Gnbv(gnbv.path, tmp_path, **python).start(
        'run', 'smoke', *FEW.split(), '--utility', 'endless.py', '--out', 'endless')
    until(60, 'the function is asked', (tmp_path / 'pid').exists)
    asked = int((tmp_path / 'pid').read_text())
    process.kill()
    process.wait()
    until(10, 'its Python ends', lambda: state() in 'ZX')
