"""One result: at any number of threads, by every instruction set, resumed, and of a command.

--tries says how many pairs of threads and instruction set each mission is flown with (all without
it). An instruction set that the processor lacks is its next lower one, and counts all the same. The
hash of another build of the same commit, clang's say, is printed, too: --gnbv, and -s to see it.
"""
import csv
import itertools
import shutil

import pytest
from program import Gnbv, difference, files_of, hash_of, summary

VIEWS = 12
PAIRS = [(1, 'avx512'), (3, 'baseline'), (2, 'avx2'),
         *itertools.product((1, 2, 3, 8), ('baseline', 'avx2', 'avx512'))]
ROUTE = ('planner.routes.views=[{position_m: [0, 5, 2]}, {position_m: [3.2, 0, 2], yaw_deg: 180}, '
         '{position_m: [0, 0, 1]}, {position_m: [0, 3.2, 2.5], yaw_deg: -90}, '
         '{position_m: [-3.2, 0, 2]}]')
GIMBAL = 'cameras.0.pitch_deg={min: 0, max: 60, step: 30}'
NO_FLY = 'no_fly=[{min: [2.6, -0.8, 0], max: [4.5, 0.8, 3]}]'
SCREEN = 'obstacles=[{box_m: {min: [-0.5, -1.6, 0], max: [0.5, -1.5, 1.6]}}]'
# a pillar that goes to and fro along x where the mission begins, and is waited for
MOVER = ['start={position_m: [0, -3.2, 1.2], jitter_m: [0, 0, 0]}',
         'planner.profiling.method=none',
         'obstacles=[{box_m: {min: [-3.8, -2.6, 0], max: [-3.4, -2.2, 3]}, motion: {waypoints: '
         '[{offset_m: [7.2, 0, 0]}], speed_m_s: 0.7, known: true}}]']
# from few positions little is seen: a short search
FEW_PLACES = ['cameras.0.width_px=64', 'cameras.0.height_px=48', 'cameras.0.fov_x_deg=90',
              'cameras.0.range_max_m=2', 'planner.validity.collision_radius_m=1']
BURSTS = ['planner.fvs.mode=burst', 'planner.fvs.entropy_threshold_nat=1']
MISSIONS = {
    'proposed': [],
    'bircher_volume': ['planner.utility.name=bircher_volume'],
    'kriegel by A*': ['planner.utility.name=kriegel', 'planner.validity.path=astar'],
    'bursts': BURSTS,
    'bursts of two clusters': [*BURSTS, 'planner.fvs.clusters=2', 'planner.fvs.retries=2',
                               'planner.fvs.views_per_layer=8', 'planner.validity.path=astar'],
    'coarse and random': ['planner.utility.name=random', 'planner.map.resolution_m=0.3'],
    'tour': ['planner.utility.name=tour'],
    'tour of a gimbal': ['planner.utility.name=tour', 'cameras.0.drop_probability=0.3', GIMBAL,
                         'wind.mean_m_s=[2, 1, 0]', NO_FLY, SCREEN],
    'take-off': ['planner.utility.name=tour', 'planner.preset=takeoff'],
    'known mover': ['planner.utility.name=tour', *MOVER],
    'oracle of views': ['planner.utility.name=oracle_views', *FEW_PLACES],
    'oracle of metres': ['planner.utility.name=oracle_metres', *FEW_PLACES],
    'oracle of seconds': ['planner.utility.name=oracle_seconds', 'planner.oracle.coverage=0.9',
                          *FEW_PLACES],
    'route': ['planner.utility.name=route', ROUTE],
    'gimbal': [GIMBAL],
    'no-fly box and screen': [NO_FLY, SCREEN],
    'stereo noise': ['planner.utility.name=isler', 'cameras.0.noise.model=stereo'],
    'noise and GNSS': ['cameras.0.noise.model=nguyen', 'lidars.0.range_sigma_m=0.02',
                       'lidars.0.rolling=true', 'vehicle.estimate.model=gnss'],
    'no satellites': ['vehicle.estimate.model=gnss', 'planner.profiling.method=none',
                      'vehicle.estimate.outages=[{start_s: 2, duration_s: 10}]',
                      'vehicle.estimate.outage_drift_m_per_sqrt_s=0.05',
                      'planner.validity.allow_unknown=true'],
    'gusts, lost frames': ['wind.mean_m_s=[3, 2, 0]', 'wind.gust_w20_m_s=5',
                           'cameras.0.drop_probability=0.3', 'cameras.0.rate_hz=1',
                           'vehicle.power.return_home=true'],
    'frames in flight': ['cameras.0.rate_hz=5'],
    'max_distance': ['planner.termination.max_distance_m=4'],
    'max_flight_time': ['planner.termination.max_flight_time_s=100'],
    'low_gain': ['planner.termination={min_new_voxels_per_m: 10, new_voxels_window: 2}'],
    'no_new_points': ['planner.map.resolution_m=0.5', 'planner.cloud.leaf_m=0.5',
                      'planner.cloud.profile_leaf_m=0.5',
                      'planner.termination.max_views_without_new_points=2'],
    'coverage_reached': ['benchmark.stop_at_coverage=0.6'],
    'lab_model': ['lab_model'],
}
ENDS = ('max_distance', 'max_flight_time', 'low_gain', 'no_new_points', 'coverage_reached')


def words_of(mission, views):
    sets = MISSIONS[mission]
    scenario, sets = (sets[0], sets[1:]) if sets == ['lab_model'] else ('smoke', sets)
    return ['run', scenario, '--quiet', *itertools.chain(*(('--set', s) for s in sets)), '--set',
            f'planner.termination.max_iterations={views}']


@pytest.mark.parametrize('mission', MISSIONS)
def test_a_mission_has_one_hash_and_goes_on_to_it(gnbv, tmp_path, request, views, mission):
    words, hashes = words_of(mission, views), {}
    for threads, simd in PAIRS[:request.config.option.tries]:
        run = tmp_path / f'{threads}-{simd}'
        Gnbv(gnbv.path, tmp_path, GNBV_SIMD=simd)(
            *words, '--candidates', '--threads', threads, '--out', run).check({0})
        hashes.setdefault(hash_of(run), []).append((threads, simd))
    print(mission, *hashes)
    assert len(hashes) == 1, hashes
    ended = summary(run)['termination']
    assert mission not in ENDS or ended == mission
    # as if it had been killed after half of its views, or after the first one of a burst
    rows = (run / 'iterations.csv').read_text().splitlines(keepends=True)
    assert len(rows) >= 4, f'{ended} after {len(rows) - 1} views'
    bursts = [i for i, row in enumerate(csv.DictReader(rows)) if row.get('plan_view') == '2']
    assert bursts or not mission.startswith('bursts')
    for left in {len(rows) // 2, *bursts}:
        cut = shutil.copytree(run, tmp_path / f'cut{left}', ignore=lambda *_: set(files_of(run)) - {
            'scenario.yaml', 'inputs.json'})
        for name in ('candidates.jsonl', 'beliefs.jsonl'):
            shutil.copy(run / name, cut / f'{name}.part')
        (cut / 'iterations.csv.part').write_text(''.join(rows[:1 + left]))
        gnbv(*words, '--candidates', '--out', cut, '--resume').check({0})
        assert not difference(cut, run), f'after {left} views'


COMMANDS = {
    'run': 'run smoke --frames --candidates --quiet --out out',
    'score': 'score run --update --json',
    'ceiling': 'ceiling run --json',
    'surface': 'surface run --quiet -o out',
    **{form: f'export run --format {form} -o out'
       for form in ('colmap', 'nerfstudio', 'plain', 'tum')},
    'report': 'report run --quiet -o page.html',
}


@pytest.mark.parametrize('command', COMMANDS)
def test_a_command_leaves_the_same_files(gnbv, whole, tmp_path, command):
    left = []
    for threads in (1, 3):
        place = tmp_path / str(threads)
        shutil.copytree(whole('run', 'smoke', '--frames', '--quiet', '--out').path, place / 'run')
        here = Gnbv(gnbv.path, place)
        end = here(*COMMANDS[command].split(), '--threads', threads).check({0})
        left.append((place, {k: v for k, v in end.json.items() if k != 'wall_s'}
                     if '--json' in COMMANDS[command] else None))
    assert left[0][1] == left[1][1]
    assert not difference(left[0][0], left[1][0])
