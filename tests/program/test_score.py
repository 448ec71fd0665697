"""Scores, gates and sizes of run directories and clouds, and what the cache keeps."""
import json
import re
import struct

import pytest
from program import changed, hash_of, json_of, summary

SMOKE = 'run', 'smoke', '--quiet', '--out'
SCORED = ('precision_recall', 'accuracy_m', 'completeness_m', 'chamfer_m', 'density',
          'budget', 'mean_coverage', 'ceiling_at_0.05', 'effort_to_reach')


@pytest.fixture
def flown(whole):
    """A mission that no test changes."""
    return whole(*SMOKE).path


@pytest.fixture
def copy(copy_of):
    return copy_of(*SMOKE)


@pytest.fixture(scope='session')
def cache(tmp_path_factory):
    return {'GNBV_CACHE': str(tmp_path_factory.mktemp('cache'))}


@pytest.fixture
def score(run, cache):
    """score(words, *says, code=0) -> the end of `gnbv score WORDS`, with the cache of all tests."""
    return lambda words, *says, code=0: run(f'score {words}', *says, code=code, **cache)


def points_of(path):
    data = path.read_bytes()
    at = data.index(b'end_header\n') + 11
    return [list(p) for p in struct.iter_unpack('<3f', data[at:])]


def write_points(path, points):
    path.write_bytes(b'ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\n'
                     b'property float y\nproperty float z\nend_header\n' % len(points)
                     + b''.join(struct.pack('<3f', *p) for p in points))


def test_updates_a_run_to_the_very_bytes_that_it_wrote_itself(score, flown, copy):
    def damage(old):  # of schema 1, and with figures that are wrong
        old.update(schema=1, auc={'views': 0.5})  # which later ones do not have
        old['coverage']['final']['0.05'] = 0.123
        for key in SCORED:
            del old[key]

    def falsify(now):
        now['coverage'] = 1
        now.update(dict.fromkeys(SCORED, 1))

    changed(copy / 'summary.json', damage)
    (copy / 'coverage.csv').unlink()
    score('run')
    assert not (copy / 'coverage.csv').exists(), 'it only looked'
    for threads in (1, 2):  # the second time by the cache
        score(f'run --update --threads {threads}')
        for name in ('summary.json', 'coverage.csv'):
            assert (copy / name).read_bytes() == (flown / name).read_bytes()
        changed(copy / 'summary.json', falsify)
        (copy / 'coverage.csv').write_text('')


def test_a_ceiling_of_nothing_is_refused_as_a_mission_is(run):
    nowhere = 'smoke --quiet --set score.region_m.min=[3,3,3] --set score.region_m.max=[4,4,4]'
    for command in ('ceiling', 'run'):
        run(f'{command} {nowhere}', 'smoke: nothing to measure', code=2)


def test_the_ceiling_gives_a_run_its_efforts(run, copy, tmp_path):
    def update(more, **environment):
        run(f'score run --update {more}', **environment)
        return summary(copy)

    own = {'GNBV_CACHE': str(tmp_path / 'own')}
    assert summary(copy)['effort_to_reach'] is None
    assert update('', **own)['ceiling_at_0.05'] is None
    found = update('--ceiling', **own)
    assert update('', **own) == found, 'by the cache'
    assert found['ceiling_at_0.05'] > 0.5
    efforts, final = found['effort_to_reach'], found['coverage']['final']['0.05']
    assert {share: effort is None for share, effort in efforts.items()} == {
        share: float(share) * found['ceiling_at_0.05'] > final
        for share in ('0.80', '0.90', '0.95', '0.98', '0.99')}
    at_80 = efforts['0.80']
    rows = [line.split(',') for line in (copy / 'coverage.csv').read_text().splitlines()[1:]]
    row = next(row for row in rows if row[0] == str(at_80['views']))
    assert float(row[3]) >= 0.8 * found['ceiling_at_0.05'] and float(row[1]) == at_80['metres']
    before = found['distance_m']['profile'] + found['distance_m']['transfer']
    assert at_80['metres_with_profile'] == pytest.approx(before + at_80['metres'])
    assert at_80['seconds_with_profile'] == pytest.approx(found['profile_end_s'] + at_80['seconds'])
    assert 0 < at_80['wh_with_profile'] < found['energy_wh']
    assert at_80['on_one_battery'] is True
    # a run of an older version knows no energy, which is not none
    views = copy / 'iterations.csv'
    views.write_text(re.sub(r',[^,\n]*$', '', views.read_text(), flags=re.M))
    changed(copy / 'summary.json', lambda old: old.pop('views_sha256'))
    old = update('--ceiling', **own)['effort_to_reach']['0.80']
    assert old == at_80 | {'wh_with_profile': None, 'on_one_battery': None}
    assert update('')['effort_to_reach'] is None, 'nobody knows it any more'


def test_of_the_runs_cloud_is_the_runs(run, score, flown, copy):
    run('asset smoke -o mesh.ply')
    cloud = score('run/cloud.ply --scenario smoke --json').json
    ours = summary(flown)
    assert cloud['coverage']['final'] == ours['coverage']['final']
    assert not {'budget', 'mean_coverage', 'ceiling_at_0.05', 'effort_to_reach'} & set(cloud)
    by_mesh = score('run/cloud.ply --mesh mesh.ply --json').json
    assert by_mesh['coverage'] == cloud['coverage'] and by_mesh['chamfer_m'] == cloud['chamfer_m']
    # points below the floor are not asked for, and surface below is not either
    points = points_of(copy / 'cloud.ply')
    for i in range(50):
        points.insert(7 * i, [0.1 * i, 0.0, -0.01])
    write_points(copy / 'ground.ply', points)
    ground = score('run/ground.ply --scenario smoke --json').json
    assert (ground['points_below_floor'], ground['points']) == (50, len(points) - 50)
    assert ground['coverage'] == cloud['coverage']
    score('run/ground.ply --scenario smoke', '50 points below z = 0.3 m left out')
    for key in ('precision_recall', 'chamfer_m', 'density'):
        assert cloud[key] == ours[key] == ground[key]
    high = score('run/cloud.ply --scenario smoke --floor-z 1 --json').json
    assert high['floor_z_m'] == 1.0 and high['coverage'] != cloud['coverage']


def test_of_area_samples_is_named_and_changes_coverage_alone(run, score, flown, copy, tmp_path,
                                                                request):
    sets = '--set score.reference=area_samples --set score.area_samples=3000'
    run(f'run smoke --quiet {sets} --out sampled', '3,000 points drawn by area')
    ours, theirs = summary(tmp_path / 'sampled'), summary(flown)
    assert ours['result_sha256'] == theirs['result_sha256']
    assert ours['coverage']['reference'] == 'area_samples'
    assert ours['coverage']['area_samples'] == 3000
    assert theirs['coverage']['reference'] == 'outside'
    assert ours['coverage']['final']['0.05'] < theirs['coverage']['final']['0.05']
    for same in ('final_raw_reference', 'profile_raw_reference'):
        assert ours['coverage'][same] == theirs['coverage'][same]
    for same in ('precision_recall', 'chamfer_m', 'density'):
        assert ours[same] == theirs[same]
    # any run's cloud can be scored so, and the score of the run is the same again
    cloud = score(f'run/cloud.ply --scenario smoke {sets} --json').json
    assert cloud['coverage']['final'] == ours['coverage']['final']
    assert score('sampled --json').json['coverage'] == ours['coverage']
    score('sampled', 'area samples ', 'profile, area samples', 'one of 3,000 points')
    run(f'check sampled --against {request.config.rootpath}/bench/baselines/smoke.json',
        "reference: outside -> area_samples 3000", code=2)


def test_lines_fit_the_terminal(run, cache, copy):
    said = run('score run', 'points against smoke', 'Points in a voxel of 0.2 m', COLUMNS='80',
               **cache).out
    assert all(len(line) <= 80 for line in said.splitlines())


def test_the_curve_goes_from_the_profile_to_the_end_and_never_falls(flown):
    found = summary(flown)
    rows = [line.split(',')[1:] for line in (flown / 'coverage.csv').read_text().splitlines()[1:]]
    rows = [[float(cell) for cell in row] for row in rows]
    assert len(rows) == found['iterations'] + 1
    for at, share in ((0, 'profile'), (-1, 'final')):
        assert rows[at][2:5] == list(found['coverage'][share].values())
    assert rows[-1][5:8] == list(found['coverage']['accurate'].values())
    assert all(accurate <= covered for row in rows for accurate, covered in zip(row[5:8], row[2:5]))
    assert rows[-1][0] == found['distance_m']['straight']
    for before, now in zip(rows, rows[1:]):
        assert now[1] > before[1] and all(b <= a for a, b in zip(now, before))


def without_last_row(text):
    return text[:text.rindex('\n', 0, -1) + 1]


def put(old, new):
    return lambda text: re.sub(old, new, text, count=1)


@pytest.mark.parametrize('command, name, change, says', [
    ('score run', 'iterations.csv', without_last_row, '11 views, 12 in summary.json'),
    ('score run', 'summary.json', put('"iterations": 12', '"iterations": "12"'),
     '/iterations: "12" is no count'),
    *(('score run --update', 'summary.json', put(r'"schema": \d+', f'"schema": {schema}'),
       f'/schema: {schema}') for schema in ('99', '-1', '"2"', '1.5')),
    ('score run --update', 'summary.json', put('"coverage"', '"covered"'),
     'is not the summary of a run'),
    ('plot run', 'summary.json', put('"flown": [^,]*', '"flown": "far"'),
     '/distance_m/flown: "far" is no number'),
    ('plot run', 'summary.json', put('"seed": ', '"sheed": '), '/seed: is missing'),
    ('plot run', 'summary.json', lambda text: '{', 'is no JSON'),
    ('plot run', 'coverage.csv', without_last_row, '12 rows for the profile and 12 views'),
    ('plot run', 'coverage.csv', lambda text: text + '13,1,2,nan,4,5\n', "13,1,2,nan,4,5'"),
    ('plot run', 'coverage.csv', lambda text: 'view\n', 'is not the header')])
def test_a_file_that_does_not_fit_others_is_named(run, cache, copy, command, name, change, says):
    text = (copy / name).read_text()
    (copy / name).write_text(change(text))
    assert f'run/{name}:' in run(command, says, code=2, **cache).err


@pytest.mark.parametrize('z_m', [float('inf'), float('nan'), 60000.0])
def test_a_point_that_is_nowhere_is_named(score, copy, z_m):
    points = points_of(copy / 'cloud.ply')
    points[5][2] = z_m
    write_points(copy / 'cloud.ply', points)
    score('run', 'run/cloud.ply: point 5 ', code=2)


@pytest.mark.parametrize('words, says', [
    ('empty.ply --scenario smoke', ['empty.ply', 'no points']),
    ('mm.ply --scenario smoke', ['mm.ply', 'looks like millimetres', 'scale the cloud by 0.001']),
    ('moved.ply --scenario smoke', ['moved.ply', 'no point within 1 m', 'the cloud spans']),
    ('prose.ply --scenario smoke', ['prose.ply', 'no PLY']),
    ('mm.ply', ['--mesh', '--scenario']),
    ('absent.ply --scenario smoke', ['absent.ply']),
    ('.', ['no summary.json']),
    ('mm.ply --scenario smoke --update', ['--update', 'mm.ply']),
    ('run --scenario smoke', ['scenario.yaml']),
    ('run', ['profile.ply', 'cloud.ply'])])
def test_what_cannot_be_scored_is_refused_in_one_line(score, copy, tmp_path, words, says):
    points = points_of(copy / 'cloud.ply')
    write_points(tmp_path / 'empty.ply', [])
    write_points(tmp_path / 'mm.ply', [[1000 * x for x in p] for p in points])
    write_points(tmp_path / 'moved.ply', [[p[0] + 20, *p[1:]] for p in points])
    write_points(copy / 'profile.ply', [[p[0] + 20, *p[1:]] for p in points])
    (tmp_path / 'prose.ply').write_text('Lorem ipsum\n')
    assert score(words, *says, code=2).err.count('\n') == 1


# ---- gates ----
@pytest.fixture
def finer(score, copy):
    """The mission, scored at a size more."""
    score('run --resolution 0.05,0.2 --update', '0.05 m    0.20 m\n')
    return copy


def test_sizes_of_the_scenario_are_those_of_the_score_and_change_no_mission(run, score, flown,
                                                                            finer, tmp_path):
    run('run smoke --quiet --set score.sizes_m=[0.05,0.2] --out own', 'Coverage 0.50 m  Coverage 0.20 m')
    curve = (tmp_path / 'own/coverage.csv').read_text()
    assert curve == (finer / 'coverage.csv').read_text()
    assert curve.startswith('view,metres,seconds,coverage_0.05,coverage_0.10,coverage_0.50,'
                            'coverage_0.20,accurate_0.05,accurate_0.10,accurate_0.50,'
                            'accurate_0.20,energy_wh,one_battery\n')
    own = summary(tmp_path / 'own')
    assert own['coverage'] == summary(finer)['coverage'] and hash_of(flown) == own['result_sha256']
    at = own['coverage']['final']
    assert at['0.20'] > at['0.05'] == summary(flown)['coverage']['final']['0.05']
    cloud = score('own/cloud.ply --scenario smoke --resolution 0.2 --json').json
    assert cloud['coverage']['final'] == at


def test_sizes_are_gated_and_drawn(run, flown, finer, tmp_path):
    run('check run --against gate.json --update')
    covered = json_of(tmp_path / 'gate.json')['metrics']['coverage_0.20']['value']
    assert covered == summary(finer)['coverage']['final']['0.20']
    run('check run --against gate.json')
    changed(tmp_path / 'gate.json',
            lambda gate: gate['metrics']['coverage_0.20'].update(value=1.5))
    run('check run --against gate.json', 'coverage_0.20', code=1)
    for update in ('', '--update'):
        run(f'check {flown} --against gate.json {update}',
            'metrics.coverage_0.20: the run was not scored at that size', code=2)
    run('plot run --plots coverage --voxel 0.2 --format json -o plots')
    run(f'plot {flown} --plots coverage --voxel 0.2 --format json -o none',
        'not scored at 0.20 m: left out', code=2)


def test_sizes_have_their_rows_in_a_comparison(run):
    rows = run('compare smoke --utilities proposed,isler --seeds 1 --quiet --no-ceiling --format '
               'json --set score.sizes_m=[0.2] --set planner.termination.max_iterations=2 --out '
               'bench').json['rows']
    assert sum(row['metric'] == 'coverage at 0.20 m (%)' for row in rows) == 2


@pytest.mark.parametrize('words, says', [
    ('score run --resolution 0', '--resolution 0'),
    ('score run --resolution 0.05,0.05', 'is there twice'),
    ('score run --box 0,0,0,1,1', 'x0,y0,z0,x1,y1,z1'),
    ('score run --box 0,0,0,1,1,0', 'x0,y0,z0,x1,y1,z1'),
    ('score run --box 9,9,9,10,10,10', 'nothing to measure'),
    ('score run --box 0,0,0,1,1,1 --update', '--box'),
    ('run smoke --out no --set score.sizes_m=[]', '1 to 16 numbers'),
    ('run smoke --out no --set score.sizes_m=0.05', '1 to 16 numbers'),
    ('run smoke --out no --set score.sizes_m=[0.05,0.05]',
     "score.sizes_m.1: value '0.05': is there twice"),
    ('run smoke --out no --set score.sizes_m=[0.001]', 'out of range'),
    ('run smoke --bounds auto --mesh field.obj --out no --set planner.map.resolution_m=0.5 '
     '--set score.sizes_m=[0.01]', '0.011 m fits'),
    ('score run/cloud.ply --mesh field.obj --resolution 0.01', '0.011 m fits')])
def test_sizes_that_are_none_are_refused(run, copy, tmp_path, words, says):
    (tmp_path / 'field.obj').write_text(  # 2,600 m2, too much for the memory
        'v -25 -26 1\nv 25 -26 1\nv 25 26 1\nv -25 26 1\nf 1 2 3 4\n')
    run(words, says, code=2)
    assert not (tmp_path / 'no').exists()


def test_the_score_of_a_box_is_of_what_lies_in_it(score, copy, tmp_path):
    def of(words):
        found = score(f'--scenario smoke --resolution 0.05,0.2 --json {words}').json
        found.pop('wall_s', None)
        return found

    assert of('run/cloud.ply --box=-9,-9,-9,9,9,9') == of('run/cloud.ply')
    # what is far from the box does not matter
    near = [p for p in points_of(copy / 'cloud.ply') if p[0] < 0.3]
    (tmp_path / 'near.xyz').write_text(''.join('%.9g %.9g %.9g\n' % tuple(p) for p in near))
    whole, part = (of(f'{cloud} --box=-9,-9,-9,0,9,9') for cloud in ('run/cloud.ply', 'near.xyz'))
    assert part['points'] < whole['points']
    for found in (whole, part):
        for key in ('points', 'completeness_m', 'chamfer_m', 'points_below_floor'):
            del found[key]
    assert whole == part and whole['coverage'] != of('run/cloud.ply')['coverage']


# ---- the cache ----
def test_the_cache_is_told_and_pruned(run, flown, tmp_path):
    own = {'GNBV_CACHE': str(tmp_path / 'own')}

    def results(more=''):
        return run(f'cache --json {more}', **own).json['all']['results']

    assert results() == 0
    run(f'score {flown}', GNBV_CACHE_LIMIT='0', **own)
    assert results() == 0
    run(f'score {flown}', **own)
    kept = results()
    assert kept >= 1
    assert results('--prune') == kept == results('--prune --limit 100MB')  # less than 2 GiB
    assert results('--prune --limit 0') == 0
    for wrong in ('cache --limit 5', 'cache --prune --limit -1', 'cache --prune --limit nan'):
        run(wrong, '--limit', code=2)
    run(f'score {flown}', code=2, GNBV_CACHE_LIMIT='2GiB', **own)
