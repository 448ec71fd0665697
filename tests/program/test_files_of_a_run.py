"""What is made of a run: pictures, surfaces and exports; of damaged, bare and old ones, too."""
import json
import os
import re
import shutil

import pytest
from program import REPOSITORY, files_of, json_of, summary

FRAMES = ('run', 'smoke', '--quiet', '--frames', '--out')
SMALL = '--width 320 --height 240'


@pytest.fixture
def copy(copy_of):
    return copy_of(*FRAMES)


def test_names_of_files_need_not_be_utf_8(gnbv, tmp_path):
    name = os.fsdecode(b'caf\xe9')
    gnbv('asset', 'smoke', '-o', f'{name}.obj', '--json').check({0})
    gnbv('run', 'smoke', '--quiet', '--mesh', f'{name}.obj', '--frames', '--out', name).check({0})
    for line in ('check NAME --against b.json --update', 'check NAME --against b.json',
                 'score NAME --json', 'ceiling NAME --json --quiet',
                 'surface NAME/cloud.ply --json -o cloud', 'export NAME --format colmap'):
        gnbv(*line.replace('NAME', name).split()).check({0})
    (tmp_path / f'{name}.yaml').write_text(
        'scenarios: {name: smoke, scenario: smoke, mesh: ' + f'{name}.obj}}\n'
        'set: {planner.termination.max_iterations: 1}\n', errors='surrogateescape')
    for _ in range(2):  # the folder is still its own
        gnbv('sweep', f'{name}.yaml', '--quiet', '--out', 'cells').check({0})


# ---- pictures ----
def test_runs_of_one_name_get_a_picture_each(run, copy, tmp_path):
    shutil.copytree(copy, tmp_path / 'y/run')
    run(f'render run y/run/ --what path -o pics --sheet sheet.png {SMALL}')
    assert {'pics/run-path.png', 'pics/run-2-path.png', 'sheet.png'} <= set(files_of(tmp_path))


def test_runs_that_can_be_drawn_are_and_the_others_are_named(run, copy, tmp_path):
    shutil.copytree(copy, tmp_path / 'less')
    (tmp_path / 'less/cloud.ply').unlink()
    run(f'render run less --what cloud -o pics --sheet sheet.png {SMALL}', 'gnbv: cloud of less: ')
    assert {'pics/run-cloud.png', 'sheet.png'} <= set(files_of(tmp_path))
    assert not (tmp_path / 'pics/less-cloud.png').exists()
    said = run(f'render run less --what cloud -o pics --quiet {SMALL}')
    assert said.out == 'pics/run-cloud.png\n'
    run('render less --what cloud', code=2)


@pytest.mark.parametrize('views', [True, False])
def test_an_incomplete_run_is_drawn_as_far_as_it_goes(run, copy, views):
    for name in ('trajectory.tum', 'cloud.ply', 'profile.ply', 'summary.json',
                 *([] if views else ['iterations.csv'])):
        (copy / name).unlink()
    run(f'render run --what all {SMALL}', 'gnbv: cloud of ')
    assert (copy / 'path.png').exists()
    assert (copy / 'profile.png').exists()  # flown again: it needs the scenario only
    assert not (copy / 'cloud.png').exists()


@pytest.mark.parametrize('words, says', [
    ('run --azimuth-deg nan', "'nan' must be a finite number"),
    ('run --elevation-deg nan', "'nan' must be from -89 to 90"),
    ('run --iteration -1', '--iteration: Value -1 not in range'),
    ('run --film-s 1e9', '--film-s: Value 1e9 not in range'),
    ('run --camera two.json', 'two.json: position_m: [0,1] is not three numbers'),
    ('run --camera typo.json', 'typo.json: position: no such key'),
    ('run -o picture.jpg', '--out picture.jpg: pictures are .png'),
    ('run -o film.mp4', '--out film.mp4: the name of a path ends in .png'),
    ('run -o run/cloud.ply/deeper', 'run/cloud.ply'),
    ('run --over-surface', 'no run/surface/surface.obj: `gnbv surface run` makes'),
    ('run --sheet sheet.jpg', '--sheet sheet.jpg: a sheet is a .png'),
    ("''", 'RUN: is empty'),
    # options that would be ignored
    ('run --camera camera.json --azimuth-deg 10', '--azimuth-deg'),
    ('run --camera camera.json --elevation-deg 10', '--elevation-deg'),
    ('run --what snapshots,movie --sheet sheet.png', '--sheet'),
    ('run --what cloud --over-surface', '--over-surface'),
    ('run --width 8192 --height 8192', '--width and --height')])
def test_what_makes_no_picture_is_refused(run, copy, tmp_path, words, says):
    for name, text in {'two.json': '{"position_m": [0, 1], "target_m": [0, 0, 1]}',
                       'typo.json': '{"position": [0, 1, 2]}',
                       'camera.json': '{"position_m": [0, -9, 3], "target_m": [0, 0, 3]}'}.items():
        (tmp_path / name).write_text(text)
    assert len(run(f'render {words}', says, code=2).err) < 400
    assert not (copy / 'path.png').exists()


# ---- surfaces ----
def test_a_textured_surface_is_the_true_one(run, copy, tmp_path):
    made = run('surface run --threads 1', 'Precision').out
    for name in ('surface.glb', 'surface.obj', 'surface.mtl', 'surface.png', 'surface.ply',
                 'preview.png', 'score.json'):
        assert (copy / 'surface' / name).exists() and f'run/surface/{name}\n' in made
    score = json_of(copy / 'surface/score.json')
    assert score['at'][1]['f'] > 0.95
    assert run('surface run --threads 2 --json -o other').json == score


def test_without_frames_there_is_no_texture(run, copy):
    shutil.rmtree(copy / 'frames')
    run('surface run', '--frames --out NEW')
    assert not (copy / 'surface/surface.png').exists()
    run('surface run --depth 13', "--depth: '13'", code=2)
    (copy / 'cloud.ply').unlink()
    shutil.rmtree(copy / 'surface')
    run('surface run', 'cloud.ply: is missing', code=2)
    assert not (copy / 'surface').exists()


def test_the_mesh_of_a_cloud_is_flown_by_the_command_that_surface_says(run, copy):
    said = run('surface run/cloud.ply -o mesh --threads 2').out
    run(re.search(r'^fly it: gnbv (run .*)$', said, re.M)[1] + ' --quiet --out flown'
        ' --set planner.termination.max_iterations=1 --set planner.profiling.method=none')


def test_a_damaged_picture_costs_the_texture_and_no_more(run, copy):
    pictures = sorted((copy / 'frames').glob('*.png'))
    for picture in pictures:
        picture.write_text('no picture')
    run('surface run --depth 6', '.png', '--frames --out NEW')
    assert (copy / 'surface/surface.glb').exists()
    assert not (copy / 'surface/surface.png').exists()
    pictures[0].unlink()
    run('surface run --depth 6 --no-texture', f'no image `{pictures[0].name}')


def test_without_the_true_structure_there_is_a_surface_but_no_score(run, copy, tmp_path):
    (tmp_path / 'damaged.obj').write_text('f 1 2 3\n')
    scenario = (copy / 'scenario.yaml').read_text()
    (copy / 'scenario.yaml').write_text(
        scenario.replace('path: ""', f'path: {tmp_path}/damaged.obj', 1))
    (copy / 'surface').mkdir()
    (copy / 'surface/score.json').write_text('of an earlier call')
    run('surface run --depth 6', 'there is no score')
    assert (copy / 'surface/surface.glb').exists()
    assert not (copy / 'surface/score.json').exists()
    run('surface run --depth 6 --json', code=2)


def test_a_folder_that_cannot_be_made_costs_no_work(run, copy, tmp_path):
    (tmp_path / 'file').write_text('in the way')
    end = run('surface run -o file/folder', 'file/folder: cannot make the folder', code=2)
    assert 'Poisson' not in end.err


# ---- exports ----
def test_an_export_writes_over_nothing_but_an_export(run, copy, tmp_path):
    (tmp_path / 'thesis').mkdir()
    (tmp_path / 'thesis/thesis.txt').write_text('words')
    run('export run --format tum -o thesis', 'no earlier export', code=2)
    assert run('export run --format tum').out == 'run/export/tum\n'
    stray = copy / 'export/tum/rgbd/stray.db'
    stray.write_text('features')
    run('export run --format tum', 'rgbd/stray.db', code=2)
    stray.unlink()
    run('export run --format tum')
    assert [p.name for p in (copy / 'export').iterdir()] == ['tum']
    # one that was killed comes back, with what was in it
    (copy / 'export/tum').rename(copy / 'export/.tum.gnbv-old')
    (copy / 'export/.tum.gnbv-part').mkdir()
    (copy / 'export/.tum.gnbv-part/half').write_text('')
    (copy / 'export/.tum.gnbv-old/stray').write_text('')
    run('export run --format tum', 'stray', code=2)
    (copy / 'export/tum/stray').unlink()
    (copy / 'export/.tum.gnbv-old').mkdir()
    run('export run --format tum')
    assert [p.name for p in (copy / 'export').iterdir()] == ['tum']
    (tmp_path / 'elsewhere').mkdir()
    (tmp_path / 'linked').symlink_to('elsewhere')
    run('export run --format tum -o linked')
    assert (tmp_path / 'linked').is_symlink() and (tmp_path / 'elsewhere/gnbv-export.json').exists()


@pytest.mark.parametrize('form', ['tum', 'colmap'])
def test_a_camera_that_cannot_name_files_is_refused(run, copy, form):
    for name in ('cameras.json', 'poses.csv'):
        path = copy / 'frames' / name
        path.write_text(re.sub('([",])rgbd([",])', r'\1a/b\2', path.read_text()))
    run(f'export run --format {form}', "camera 'a/b' cannot name files", code=2)
    assert not (copy / 'export' / form).exists()


def test_an_export_takes_as_many_points_as_it_may(run, copy, tmp_path):
    count = int(re.search(rb'element vertex (\d+)', (copy / 'cloud.ply').read_bytes())[1])

    def points(more):
        run(f'export run --format colmap -o out {more}')
        return (tmp_path / 'out/sparse/0/points3D.txt').read_text().count('\n')

    every = points('')
    assert points(f'--points {count}') == every
    assert points(f'--points {count - 1}') < 0.6 * every
    run('export run --format tum --points 9', code=2)  # which has none


def test_without_frames_the_path_is_still_there(run, copy):
    shutil.rmtree(copy / 'frames')
    for form in ('colmap', 'nerfstudio'):
        run(f'export run --format {form}', '--frames', code=2)
        assert not (copy / 'export' / form).exists()

    def rows(path):
        return [[float(cell) for cell in line.split()] for line in path.read_text().splitlines()
                if not line.startswith('#')]

    run('export run --format tum')
    for ours, own in zip(rows(copy / 'export/tum/trajectory.txt'), rows(copy / 'trajectory.tum'),
                         strict=True):
        assert ours == pytest.approx(own, abs=1e-6)
    for name in ('profile.ply', 'map.ot'):
        (copy / name).unlink()
    run('export run --format plain', 'profile.ply: is missing', 'map.ot: is missing', '--frames')
    assert ',planned,' in (copy / 'export/plain/views.csv').read_text()
    (copy / 'trajectory.tum').unlink()
    run('export run --format tum', '--resume', code=2)


@pytest.mark.parametrize('command', ['report', 'render', 'plot', 'surface',
                                     'export --format plain'])
def test_half_an_iterations_file_is_refused(run, copy, command):
    """Figures of a whole run beside half of its views would lie."""
    text = (copy / 'iterations.csv').read_text()
    (copy / 'iterations.csv').write_text(text[:len(text) // 2])
    run(f'{command} run', 'iterations.csv: holds', 'and the run of summary.json has', code=2)


# ---- what version 0.1 wrote ----
@pytest.fixture
def old(tmp_path):
    """What it wrote, never written anew: a run that was interrupted after five of ten views, runs of a
    tour and from take-off, scenario files; of its last state and small.yaml a baseline, rows of
    `compare --missions`, and answers to `--views -`."""
    return shutil.copytree(REPOSITORY / 'tests/program/fixtures/version_0_1', tmp_path,
                           dirs_exist_ok=True)


@pytest.mark.parametrize('name', ['interrupted', 'tour', 'takeoff'])
def test_old_runs_are_scored_as_they_scored_themselves(run, old, name):
    now, then = run(f'score --json {name}').json['coverage'], summary(old / name)['coverage']
    for of, sizes in then.items():
        if not isinstance(sizes, dict):
            continue  # says what the shares are of
        for size, share in sizes.items():
            # rays that graze an edge may differ from machine to machine: one voxel of 300 or so
            assert now[of][size] == pytest.approx(share, abs=0.004)


def test_old_runs_have_a_report(gnbv, old):
    end = gnbv('report', '--quiet', 'interrupted', 'tour', 'takeoff', '-o', 'page.html')
    if 'npm' in end.err:
        pytest.skip(end.err)
    assert end.check({0}) and (old / 'page.html').stat().st_size > 100_000


def test_an_old_interrupted_run_goes_on_to_its_end(run, old):
    path = old / 'interrupted/iterations.csv'
    rows = path.read_text().splitlines()[2:]
    assert summary(old / 'interrupted')['iterations'] == 5
    run('run interrupted/scenario.yaml --resume --candidates --quiet --out interrupted')
    now = summary(old / 'interrupted')
    assert (now['termination'], now['iterations']) == ('max_iterations', 10)
    # the views that were recorded are still the first
    for row in rows:
        assert '\n' + row.split(',agvs,')[0] in path.read_text()


def test_an_old_mission_from_take_off_goes_on_as_it_went(run, old):
    path = old / 'takeoff/iterations.csv'
    rows = path.read_text().splitlines(keepends=True)
    path.write_text(''.join(rows[:5]))  # as a kill after four views leaves it
    (old / 'takeoff/summary.json').unlink()
    run('run takeoff/scenario.yaml --resume --quiet --out takeoff')
    assert path.read_text().startswith(''.join(rows[:2]).rsplit(',', 12)[0])
    assert summary(old / 'takeoff')['iterations'] == 8
    run('render takeoff --what all --width 320 --height 240 --quiet')
    run('export takeoff --format plain')


def test_old_rows_and_old_baselines_judge(run, old):
    # both seeds flew one mission, which counts once
    run('compare --from rows.csv --no-ceiling --quiet --format csv',
        'small,coverage at 0.05 m (%),proposed,1,1,17.211', 'bircher,1,1,18.2385')
    # the configuration that 0.1 noted is what its scenario means today
    run('run small.yaml --quiet --out now')
    run('check now --against baseline.json')


def test_programs_that_give_views_to_0_1_are_answered_alike(gnbv, old):
    """New fields may come; none goes, or changes its kind."""
    def kinds(value):
        if isinstance(value, dict):
            return {key: kinds(inner) for key, inner in value.items()}
        return [kinds(value[0])] if isinstance(value, list) and value else type(value)

    def held(old_kind, new_kind):
        if isinstance(old_kind, dict):
            return all(key in new_kind and held(old_kind[key], new_kind[key]) for key in old_kind)
        if isinstance(old_kind, list):
            return held(old_kind[0], new_kind[0])
        return old_kind == new_kind

    (old / 'views.csv').write_text(
        'x,y,z,yaw_deg\n3.2,0,2,180\n0,3.2,2.5,-90\n9,9,9,0\nnonsense\n')
    with (old / 'views.csv').open() as file:
        words = 'run small.yaml --utility route --views - --coverage --quiet --out piped'
        end = gnbv(*words.split(), stdin=file).check({0})
    then = (old / 'answers.jsonl').read_text().splitlines()
    for before, now in zip(then, end.out.splitlines(), strict=True):
        before, now = json.loads(before), json.loads(now)
        assert before['event'] == now['event']
        assert held(kinds(before), kinds(now)), (before, now)


def test_old_scenarios_mean_what_they_meant(run, old):
    run('run old_scenario.yaml --quiet --out old')
    run('run settings.yaml --quiet --out flown')
    resolved = (old / 'flown/scenario.yaml').read_text()
    for value in ('5.015625', '31.25', '0.21875', '0.203125', '1.015625', '0.078125', '0.328125',
                  '33', '0.46875', '0.0390625'):
        assert f': {value}\n' in resolved
