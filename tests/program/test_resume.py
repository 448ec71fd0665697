"""A run goes on only from a record that is its own, in the world that it began in."""
import fcntl
import json
import re
import resource
import shutil
import subprocess

import pytest
from program import difference, end_of, files_of, hash_of, summary, until

FEW = ['--quiet', '--set', 'planner.termination.max_iterations=8']
SMOKE = ('run', 'smoke', *FEW, '--out')
RESUME = f'run smoke {" ".join(FEW)} --resume --out run'


@pytest.fixture
def killed(copy_of):
    """killed(change) leaves a run as one that was killed after its fifth view, with a record that
    an earlier version wrote, without checks, and that was changed by hand: rows of cells."""
    def made(change=lambda rows: None):
        run = copy_of(*SMOKE)
        rows = [line.split(',') for line in (run / 'iterations.csv').read_text().splitlines()]
        for path in files_of(run).values():
            if path.name not in ('scenario.yaml', 'inputs.json'):
                path.unlink()
        kept = [dict(zip(rows[0], row)) for row in rows[1:6]]
        change(kept)
        (run / 'iterations.csv.part').write_text('\n'.join(
            [','.join(rows[0]), *(','.join(row.values()) for row in kept)]) + '\n')
        return run

    return made


def test_a_record_without_checks_is_taken(run, killed, whole):
    left = killed()
    for name in ('.scenario.part-elsewhere-999999999.yaml', '.gnbv-lock',
                 '.cloud.part-elsewhere-999999999.ply',
                 'frames/.0001_rgbd.rgb.part-elsewhere-999999999.png'):  # of killed writers
        (left / name).parent.mkdir(exist_ok=True)
        (left / name).write_text('half')
    run(RESUME)
    assert not difference(left, whole(*SMOKE).path)


def add(name, size, view):
    def change(rows):
        rows[view][name] = repr(float(rows[view][name]) + size) if isinstance(size, float) else str(
            int(rows[view][name]) + size)
    return change


@pytest.mark.parametrize('change, says', [
    (add('entropy_nat', 1e-9, 3), 'view 3: entropy_nat is '),
    (add('cloud_points', 1, 4), 'view 4: cloud_points is '),
    (add('flown_m', 0.5, 2), 'view 2: flown_m is '),
    (add('x', 1e10, 3), 'iterations.csv.part:5: view 3 leads to 1'),
    (lambda rows: rows.extend(dict(rows[-1], iteration=str(i)) for i in range(5, 9)), 'view 5')])
def test_the_first_view_that_comes_out_differently_is_named(run, killed, change, says):
    left = killed(change)
    before = (left / 'iterations.csv.part').read_text()
    run(RESUME, says, code=2)
    assert (left / 'iterations.csv.part').read_text() == before, 'the record stays'
    assert not (left / 'summary.json').exists()


def test_every_edit_of_a_journal_is_noticed(run, gnbv, tmp_path):
    journal = tmp_path / 'run/iterations.csv.part'
    process = gnbv.start('run', 'smoke', '--quiet', '--out', 'run', '--set',
                         'planner.termination.max_iterations=80')
    until(60, 'six lines', lambda: journal.exists() and journal.read_text().count('\n') > 6)
    process.kill()
    process.wait()
    resume = 'run smoke --quiet --set planner.termination.max_iterations=80 --resume --out run'
    whole = journal.read_text()
    lines = whole.splitlines(keepends=True)
    # a sampler, which no flight depends on; then a row that is gone
    journal.write_text(''.join([*lines[:3], *(re.sub(',agvs,', ',fvs,', x) for x in lines[3:])]))
    run(resume, 'iterations.csv.part:', 'is not the row that was written', code=2)
    journal.write_text(''.join([*lines[:2], *lines[3:]]))
    run(resume, 'iterations.csv.part:3', code=2)
    journal.write_text(whole)
    run(resume)


def test_a_finished_run_stays_as_it_is(run, copy_of, whole):
    left = copy_of(*SMOKE)
    written = (left / 'summary.json').stat().st_mtime_ns
    run(RESUME, 'is finished already (max_iterations): nothing to resume')
    assert not difference(left, whole(*SMOKE).path)
    assert (left / 'summary.json').stat().st_mtime_ns == written
    (left / 'cloud.ply').unlink()  # what is missing is made again
    run(RESUME)
    assert not difference(left, whole(*SMOKE).path)


def test_what_a_finished_run_lacks_is_made_or_refused(run, copy_of, whole):
    left = copy_of(*SMOKE)
    run(f'{RESUME} --frames --candidates', 'candidates.jsonl: ', code=2)
    run(f'{RESUME} --frames')
    poses = left / 'frames/poses.csv'
    all_rows = poses.read_text()
    poses.write_text(''.join(all_rows.splitlines(True)[:-1]))  # as of a resume without --frames
    run(f'{RESUME} --frames')
    assert poses.read_text() == all_rows
    assert not summary(left)['ceiling_at_0.05']
    run(f'{RESUME} --frames --ceiling')
    assert summary(left)['ceiling_at_0.05']
    run(f'{RESUME} --frames --ceiling', 'nothing to resume')


def test_views_given_to_a_run_that_had_ended_are_flown(gnbv, run, tmp_path):
    rows = ['x,y,z,yaw_deg\n', '3.2,0,2,180\n', '0,3.2,2.5,-90\n']
    (tmp_path / 'all.csv').write_text(''.join(rows))
    run('run smoke --quiet --utility route --views all.csv --out whole')
    for text in (rows[:2], [rows[0], rows[2]]):
        process = gnbv.start(*'run smoke --quiet --utility route --views - --out run --resume'
                             .split(), stdin=subprocess.PIPE)
        process.stdin.write(''.join(text).encode())
        process.stdin.close()
        said = end_of(process).check({0}).out
    assert json.loads(said.splitlines()[-1])['event'] == 'end'
    assert hash_of(tmp_path / 'run') == hash_of(tmp_path / 'whole')


@pytest.mark.parametrize('words', ['score run', 'report run -o r.html', 'plot run -o plots',
                                   RESUME])
def test_an_edited_row_of_a_finished_run_is_noticed(run, copy_of, words):
    path = copy_of(*SMOKE) / 'iterations.csv'
    path.write_text(path.read_text().replace(',agvs,', ',fvs,', 1))
    run(words, 'iterations.csv: holds other rows', code=2)


def test_there_is_no_old_summary_beside_new_files(gnbv, copy_of):
    left = copy_of(*SMOKE)
    size = (left / 'trajectory.tum').stat().st_size  # the largest file
    (left / 'cloud.ply').unlink()
    gnbv(*RESUME.split(), restore_signals=False, preexec_fn=lambda: resource.setrlimit(
        resource.RLIMIT_FSIZE, (size - 1, size - 1))).check({1}, ['File too large'])
    assert not (left / 'summary.json').exists()


def test_one_folder_is_flown_into_by_one(run, killed):
    with (killed() / '.gnbv-lock').open('w') as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        run(RESUME, 'run: another gnbv flies into it now', code=2)


# ---- what a run began with, exchanged ----
@pytest.fixture
def mesh(whole, copy_of):
    """Of which a vertex was moved since there is a finished run on it."""
    path = whole('asset', 'smoke', '-o', name='mesh.obj').path
    copy_of(*SMOKE[:-1], '--mesh', path, '--out')
    path.write_text(re.sub('\nv .*', '\nv 0.1 0.2 0.9', path.read_text(), count=1))
    return path


@pytest.mark.parametrize('words, code', [
    (f'{RESUME} --mesh {{mesh}}', 2), ('render run -o out.png', 2), ('score run --update', 2),
    ('render run --what candidates --iteration 2 -o out.png', 2), ('ceiling run', 2),
    # said, and no more, by what does without it
    ('report run -o out.html', 0), ('surface run -o out', 0),
    ('export run --format tum -o out', 0)])
def test_every_command_says_that_the_mesh_was_exchanged(run, mesh, words, code):
    run(words.format(mesh=mesh), 'mesh.obj is not what the run began with', code=code)


def test_the_mesh_asked_for_by_name_is_another_question(run, mesh, tmp_path):
    run(f'ceiling run --mesh {mesh}')
    (tmp_path / 'run/summary.json').unlink()  # as of one that was killed while finishing
    run(f'{RESUME} --mesh {mesh}', 'is not what the run began with', code=2)


def test_a_mesh_is_known_by_what_it_holds_wherever_it_lies(run, tmp_path):
    run('asset smoke -o smoke.obj')
    run(f'run smoke {" ".join(FEW)} --out run --mesh smoke.obj')
    (tmp_path / 'smoke.obj').rename(tmp_path / 'moved.obj')
    run(f'{RESUME} --mesh moved.obj', 'nothing to resume')
    (tmp_path / 'run/summary.json').unlink()
    (tmp_path / 'other.obj').write_text(
        re.sub('\nv .*', '\nv 0.1 0.2 0.9', (tmp_path / 'moved.obj').read_text(), count=1))
    run(f'{RESUME} --mesh other.obj', 'other.obj is not what the run began with', code=2)
    assert 'smoke.obj' in (tmp_path / 'run/scenario.yaml').read_text()
    run(f'{RESUME} --mesh moved.obj')
    assert 'moved.obj' in (tmp_path / 'run/scenario.yaml').read_text()


def test_an_exchanged_profile_is_refused(run, whole, tmp_path):
    first, second = (whole('run', 'smoke', *FEW, '--seed', seed, '--out').path for seed in '12')
    shutil.copy(first / 'profile.map', tmp_path / 'p.map')
    saved = ('--set planner.profiling.method=saved --set planner.profiling.file=p.map '
             f'--out run {" ".join(FEW)}')
    run(f'run smoke {saved}')
    (tmp_path / 'run/summary.json').unlink()
    run(f'run smoke --resume {saved}')
    (tmp_path / 'run/summary.json').unlink()
    shutil.copy(second / 'profile.map', tmp_path / 'p.map')
    run(f'run smoke --resume {saved}', 'planner.profiling.file: ', code=2)
    run('render run --what candidates', 'planner.profiling.file: ', code=2)
