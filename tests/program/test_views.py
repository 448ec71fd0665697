"""`--views`: a user's views in a file, and another planner at the other end of a pipe."""
import json
import subprocess

import pytest
from program import Gnbv, end_of, hash_of, summary

VIEWS = 'x,y,z,yaw_deg\n3.2,0,2,180\n0,9,2,0\n\n# a remark\n0,3.2,2.5,-90\n-3.2,0,2,0\n'
RUN = 'run smoke --seed 2 --utility route --quiet --views'


@pytest.fixture
def pipe(gnbv, tmp_path):
    """pipe(text, line) -> the answers to the text on stdin."""
    (tmp_path / 'views.csv').write_text(VIEWS)

    def answers(text, line):
        (tmp_path / 'stdin').write_text(text)
        with (tmp_path / 'stdin').open() as file:
            end = Gnbv(gnbv.path, tmp_path)(*line.split(), stdin=file).check({0})
        return [json.loads(answer) for answer in end.out.splitlines()]

    return answers


def test_a_file_and_a_pipe_and_the_runs_own_scenario_fly_the_same(run, pipe, tmp_path):
    run(f'{RUN} views.csv --out file', '1 of 4 given views refused')
    assert summary(tmp_path / 'file')['termination'] == 'route_flown'
    pipe(VIEWS, f'{RUN} - --out pipe')
    for name in ('scenario.yaml', 'views.csv'):
        assert (tmp_path / 'pipe' / name).read_text() == (tmp_path / 'file' / name).read_text()
    run('run pipe/scenario.yaml --quiet --out again')
    # and the record of what became of the views is a list of views itself
    run(f'{RUN} pipe/views.csv --out record')
    assert len({hash_of(tmp_path / name) for name in ('file', 'pipe', 'again', 'record')}) == 1


def test_every_view_is_answered_with_one_line(pipe, tmp_path):
    answers = pipe(VIEWS + '1,2,three,4\n', f'{RUN} - --frames --coverage --out run')
    assert [a['event'] for a in answers] == ['start', 'flown', 'refused', 'flown', 'flown',
                                             'malformed', 'end']
    assert answers[2] == {'event': 'refused', 'view': 1, 'reason': 'out_of_bounds'}
    assert answers[5]['what'] == 'stdin:8: z `three` is not a number'
    points, flown_m = answers[0]['points'], 0.0
    for i in (1, 3, 4):
        a = answers[i]
        points += a['new_points']
        assert (a['view'], a['points']) == (i - 1, points) and a['flown_m'] > flown_m
        flown_m = a['flown_m']
        camera = a['cameras'][0]
        assert camera['name'] == 'rgbd'
        assert all((tmp_path / camera[kind]).exists() for kind in ('rgb', 'depth'))
    # where it was asked to be, as far as it flies
    assert answers[1]['position_m'][0] == pytest.approx(3.2, abs=0.15)
    assert abs(answers[1]['yaw_deg']) == pytest.approx(180.0, abs=4.0)
    flown = summary(tmp_path / 'run')
    final = flown['coverage']['final']['0.05']
    assert answers[0]['coverage']['0.05'] < answers[4]['coverage']['0.05'] == pytest.approx(final)
    assert (answers[6]['result_sha256'], answers[6]['run']) == (flown['result_sha256'], 'run')


def test_goes_on_where_it_was_interrupted(gnbv, pipe, tmp_path):
    pipe(VIEWS, f'{RUN} - --out whole')
    # stdin stays open: after the start and two answers only the signal ends the wait
    process = subprocess.Popen([gnbv.path, *RUN.split(), '-', '--out', 'cut'], cwd=tmp_path,
                               env=gnbv.environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True)
    process.stdin.write('x,y,z,yaw_deg\n3.2,0,2,180\n0,9,2,0\n')
    process.stdin.flush()
    for _ in range(3):
        process.stdout.readline()
    process.terminate()
    said = process.communicate(timeout=300)[1]
    assert process.returncode == 1 and 'interrupted after 2 views' in said
    assert 'gnbv run cut/scenario.yaml --views - --resume --out cut' in said
    answers = pipe('x,y,z,yaw_deg\n0,3.2,2.5,-90\n-3.2,0,2,0\n',
                   'run cut/scenario.yaml --quiet --views - --resume --out cut')
    assert len(answers) == 6, 'those of before come again'
    assert (answers[2]['event'], answers[-1]['termination']) == ('refused', 'route_flown')
    assert hash_of(tmp_path / 'cut') == hash_of(tmp_path / 'whole')


def test_flies_to_the_end_whoever_listens(gnbv, tmp_path):
    # whose answers are more than a buffer holds
    (tmp_path / 'many').write_text('x,y,z,yaw_deg\n' + '3.2,0,2,170\n3.2,0,2,190\n' * 15)
    end = end_of(Gnbv('sh', tmp_path).start(
        '-c', f"'{gnbv.path}' {RUN} - --set planner.termination.max_iterations=40 --out deaf "
        '<many | head -n 1'))
    assert '"event":"start"' in end.out
    assert summary(tmp_path / 'deaf')['termination'] == 'route_flown'


def test_names_no_camera_whose_frame_was_lost(pipe):
    answers = pipe(VIEWS, f'{RUN} - --frames --set cameras.0.drop_probability=1 --out blind')
    assert len(answers) == 6
    for answer in answers:
        if answer['event'] in ('start', 'flown'):
            assert answer['cameras'] == [] and answer['new_points'] == 0
            assert len(answer['position_m']) == 3


@pytest.mark.parametrize('words, says', [
    (f'{RUN} bad', 'bad:2: yaw_deg `up` is not a number'),
    (f'{RUN} gone', 'gone'),
    ('run smoke --utility route', 'planner.routes.views: holds no view'),
    ('run smoke --views -', '--views -: goes with --utility route, not proposed'),
    ('run smoke --views views.csv', 'goes with --utility route'),
    ('run smoke --coverage', '--coverage'),
    ('compare smoke --utilities bircher,isler --views views.csv',
     'goes with route among --utilities')])
def test_what_does_not_go_together_is_refused(run, tmp_path, words, says):
    (tmp_path / 'views.csv').write_text(VIEWS)
    (tmp_path / 'bad').write_text('x,y,z,yaw_deg\n1,2,3,up\n')
    run(f'{words} --out none', says, code=2)
    assert not (tmp_path / 'none').exists()


def test_is_compared_with_others(run, tmp_path):
    (tmp_path / 'views.csv').write_text(VIEWS)
    run('compare smoke --utilities route,nearest_frontier --seeds 2 --quiet --set '
        'planner.termination.max_iterations=4 --views views.csv --out bench --format csv', 'route')
