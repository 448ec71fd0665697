"""Every file of a run directory, damaged, given to every command that reads one.

Each file is cut, emptied, garbled, removed, or exchanged for another run's. A command may succeed,
or refuse with words that name the file (of an exchanged one, any file of the run); what it has no
need of does not stop it. A run that is resumed comes to the same result or says why not. Nothing
crashes, hangs or shows control bytes.
"""
import shutil
from pathlib import Path

import pytest
from program import files_of, hash_of

TRIES = 1
SMOKE = ['smoke', '--set', 'planner.termination.max_iterations=6', '--frames', '--candidates',
         '--quiet']
RECORD = ['scenario.yaml', 'iterations.csv', 'summary.json', 'coverage.csv', 'trajectory.tum']
CLOUDS = ['cloud.ply', 'profile.ply']
SCORED = ['scenario.yaml', 'summary.json', 'iterations.csv', 'inputs.json', *CLOUDS]
PICTURED = [*RECORD, 'inputs.json']
RESUME = f'run {" ".join(SMOKE)} --resume --out run'
# its words, what it needs; None for whatever the run holds
COMMANDS = {
    RESUME: None,
    'run run/scenario.yaml --quiet --out out': ['scenario.yaml'],
    'score run': SCORED,
    'score run --update': SCORED,
    'check run --against baseline.json': ['scenario.yaml', 'summary.json', 'coverage.csv',
                                          'iterations.csv'],
    'ceiling run --quiet': ['scenario.yaml', 'inputs.json'],
    'report run -o out.html': [*RECORD, 'plan.jsonl', 'candidates.jsonl', 'beliefs.jsonl'],
    'plot run -o out': RECORD,
    'export run --format tum -o out': [*RECORD, 'frames/'],
    'export run --format colmap -o out': [*RECORD, *CLOUDS, 'frames/'],
    'export run --format nerfstudio -o out': [*RECORD, *CLOUDS, 'frames/'],
    'export run --format plain -o out': [*RECORD, *CLOUDS, 'map.ot', 'frames/'],
    'surface run -o out': [*RECORD, *CLOUDS, 'frames/'],
    'render run -o out.png': PICTURED,
    'render run --what cloud -o out.png': [*PICTURED, *CLOUDS],
    'render run --what candidates --iteration 3 -o out.png': [*PICTURED, 'candidates.jsonl',
                                                              'profile.map'],
    'render run --what snapshots -o out': [*PICTURED, *CLOUDS, 'frames/'],
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


@pytest.fixture
def damaged(whole, tmp_path):
    """damaged(file, damage, dice) -> a run of which that file is damaged."""
    run = tmp_path / 'run'

    def made(file, damage, dice):
        shutil.rmtree(tmp_path, ignore_errors=True)
        shutil.copytree(whole('run', *SMOKE, '--out').path, run)
        damage(run / file, whole('run', *SMOKE, '--seed', '2', '--out').path / file, dice)
        return run

    return made


def names_in(run, file, damage, command):
    """Words of which a refusal has to hold one."""
    names = [Path(file).name]
    if damage is exchanged or command == RESUME:
        names += [Path(name).name for name in files_of(run)] + ['iterations.csv']
    # a folder without scenario.yaml is none of a run; a run of two runs' files flies otherwise
    return names + {removed: ['no run directory'],
                    exchanged: ['flown again it left']}.get(damage, [])


def fault_of(end, run, file, damage, command):
    needs = COMMANDS[command]
    if end.code in (1, 2) and needs is not None and not file.startswith(tuple(needs)):
        return f'needs it for nothing: {end.err[-300:]}'
    return end.fault(names=names_in(run, file, damage, command))


@pytest.mark.parametrize('damage', [cut, emptied, garbled, removed, exchanged])
@pytest.mark.parametrize('command', COMMANDS)
def test_names_what_is_damaged(gnbv, whole, damaged, tmp_path, request, dice, command, damage,
                               attempt):
    undisturbed = whole('run', *SMOKE, '--out').path
    baseline = undisturbed.parent / 'baseline.json'
    if not baseline.exists():
        gnbv('check', undisturbed, '--against', baseline, '--update').check({0})
    faults = []
    # of the frames those of one view stand for all
    for file in (n for n in files_of(undisturbed) if 'frames/000' not in n or '0003' in n):
        if request.config.option.file in file:
            run = damaged(file, damage, dice)
            shutil.copyfile(baseline, tmp_path / 'baseline.json')
            end = gnbv(*command.split())
            fault = fault_of(end, run, file, damage, command)
            if fault is None and command == RESUME and end.code == 0 and \
                    hash_of(run) != hash_of(undisturbed):
                fault = 'resumed to another result'
            faults += [f'{file}: {fault}'] if fault else []
    assert not faults, '\n'.join(faults)
