"""Tables and comparisons: missions flown, read back and judged."""
import json

import pytest
from program import REPOSITORY, summary

FEW = '--quiet --set planner.termination.max_iterations=4'
# what it sees in a moment
SMALL = '--set cameras.0.width_px=64 --set cameras.0.height_px=48'


def rows(table, metric):
    return [row for row in table['rows'] if row['metric'] == metric]


def runs(folder):
    return [path.parent for path in sorted(folder.glob('cells/*/summary.json'))]


def test_compare_flies_what_is_missing_or_failed_and_judges_the_runs_of_its_folder(run, tmp_path):
    compare = f'compare smoke --utilities proposed,bircher --seeds 2 {FEW} --out . --format'
    table = run(f'{compare} json').json
    proposed, bircher = rows(table, 'coverage at 0.05 m (%)')
    # the oracle: the summaries of the four runs
    flown = [summary(path) for path in runs(tmp_path)]
    covered = {(s['utility'], s['seed']): 100 * s['coverage']['final']['0.05'] for s in flown}
    p1, p2, b1, b2 = (covered[utility, seed] for utility in ('proposed', 'bircher')
                      for seed in (1, 2))
    assert proposed['mean'] == pytest.approx((p1 + p2) / 2, abs=1e-9)
    assert bircher['difference'] == pytest.approx((b1 - p1 + b2 - p2) / 2, abs=1e-9)
    # what SciPy is asked with: here no p of two differences can be below 0.5
    both_ways = (b1 > p1) != (b2 > p2)
    assert bircher['p_n'] == 2 and bircher['p_w_plus'] in ({1, 2} if both_ways else {0, 3})
    assert bircher['verdict'] == 'too few seeds'
    assert 'smoke: the start is what varies' in str(table['notes'])
    assert 'gain formulas of those papers' in str(table['notes'])
    assert rows(table, 'mean coverage over metres (%)') and rows(table, 'share of ceiling at 0.05 m (%)')
    # four views are too few for any share of the ceiling
    assert not rows(table, 'metres to 80 % of ceiling')
    assert 'smoke: no run got to 80 % of ceiling' in str(table['notes'])
    # a run that is there is not flown again: a doctored one is believed
    for path in runs(tmp_path):
        doctored = summary(path)
        doctored['distance_m']['straight'] = 123.0
        (path / 'summary.json').write_text(json.dumps(doctored))
    run(f'{compare} csv', 'smoke,distance (m),bircher,2,2,123,0,,,0,0,,,,,-')
    failed = runs(tmp_path)[0]
    failed.rename(tmp_path / 'gone')  # as a mission leaves it that was killed for its memory
    failed.with_name(f'{failed.name}.failed.json').write_text('{"failure": "killed by signal 9"}')
    run(f'{compare} csv')
    assert failed in runs(tmp_path)


def test_compare_takes_a_sweep_and_says_what_it_lacks(run, tmp_path):
    (tmp_path / 'grid.yaml').write_text(
        'scenarios: [smoke]\nutilities: [proposed, isler]\nseeds: 2\n'
        'set: {planner.termination.max_iterations: 2}\n')
    for index in (0, 2):
        run(f'sweep grid.yaml --quiet --index {index} --out sweep')
    run('compare --quiet --from sweep --baseline isler', 'proposed against isler',
        'one seed: no test', 'smoke, isler: without a result: not flown (seed 2)', code=1)
    run('sweep grid.yaml --quiet --out sweep')
    run('compare --quiet --from sweep')


def test_a_file_of_rows_without_a_mission_is_none(run, tmp_path):
    for _ in range(2):  # the next call would refuse it
        run(f'compare smoke --utilities proposed,isler --seeds 1 --no-ceiling {FEW} --out . '
            '--missions m.csv --set planner.validity.z_min_m=0 --set start.position_m=[0,0,0.5] '
            '--set start.jitter_m=[0,0,0]', 'start.position', code=1)
        assert not (tmp_path / 'm.csv').exists()


@pytest.mark.parametrize('option', ['--mesh m.obj', '--seed 2', '--set planner.cloud.leaf_m=0.1',
                                    '--bounds auto', '--seeds 3', '--jobs 2', '--out o'])
def test_compare_of_a_sweep_takes_nothing_that_would_fly_other_missions(run, option):
    run(f'compare --from sweep {option}', 'excludes', option.split()[0], code=2)


def test_compare_divides_all_methods_by_the_ceiling_of_its_baseline(run):
    table = run('compare smoke --vary planner.cloud.leaf_m=0.05,0.2 --seeds 1 --format json '
                f'{FEW} --out .').json
    ceiling = run('ceiling smoke --quiet --json --set planner.cloud.leaf_m=0.05').json
    for covered, share in zip(rows(table, 'coverage at 0.05 m (%)'),
                              rows(table, 'share of ceiling at 0.05 m (%)')):
        assert share['mean'] == pytest.approx(
            covered['mean'] / ceiling['leaf_outside']['0.05'], abs=1e-9)
    assert 'one ceiling for all, that of planner.cloud.leaf_m=0.05' in str(table['notes'])


def test_compare_of_structures_has_a_block_over_all(run):
    table = run('compare smoke lab_model --utilities proposed,isler --seeds 2 --no-ceiling --plots '
                f'plots --format json {FEW} {SMALL} --out .').json
    covered = rows(table, 'coverage at 0.05 m (%)')
    assert [row['verdict'] for row in covered] == ['baseline', '-'] * 2 + ['baseline', 'too few structures']
    all_of_it = covered[5]
    assert all_of_it['scenario'] == 'all 2 structures' and all_of_it['n'] == all_of_it['p_n'] == 2
    assert all_of_it['mean'] == pytest.approx((covered[1]['mean'] + covered[3]['mean']) / 2)
    notes = str(table['notes'])
    assert 'smoke: the start is what varies' in notes
    assert 'lab_model: start and noise are what varies' in notes


def test_compare_loses_no_more_than_the_ceiling_of_a_mesh_that_is_gone(run, tmp_path):
    (tmp_path / 'box.obj').write_text('v 0 0 1\nv 1 0 1\nv 0 1 1\nv 0 0 2\n'
                                      'f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n')
    (tmp_path / 'grid.yaml').write_text(
        'scenarios: {name: box, scenario: smoke, mesh: box.obj}\nutilities: [proposed, isler]\n'
        'set: {planner.termination.max_iterations: 1}\n')
    run('sweep grid.yaml --quiet --out sweep')
    (tmp_path / 'box.obj').unlink()
    run('compare --quiet --from sweep', 'box: no share of ceiling: ', 'box.obj')


@pytest.mark.parametrize('words, says', [
    ('compare smoke --utilities proposed,best --presets relased --variant '
     'planner.utilty.name=isler', ["'best'", "'relased'", 'planner.utilty']),
    ('compare smoke --utilities a,b --baseline c',
     ["'c': no method of this comparison; it has: a, b"]),
    ('compare smoke --utilities proposed --variant score.reference=area_samples',
     ['score.reference', 'different voxels']),
    ('compare smoke --utilities proposed --variant score.region_m.max=[1,1,1]',
     ['score.region_m', 'different voxels']),
    ('compare smoke --utilities proposed --variant b:score.budget_m=40,score.budget_views=4',
     ['smoke: proposed and b', 'score.budget_']),
    ('compare smoke --utilities proposed,isler --missions none/m.csv', ['none/m.csv']),
    ('compare smoke --utilities proposed', []),
    ('compare smoke --utilities proposed,isler --seeds 0', []),
    ('compare --utilities proposed,isler', []),
    ('compare smoke smoke --utilities proposed,isler', [])])
def test_compare_names_all_faults_before_it_flies(run, tmp_path, words, says):
    run(f'{words} --out out', *says, code=2)
    run('compare --from out', code=2)
    assert not (tmp_path / 'out').exists()


def test_seeds_of_a_start_that_never_moves_are_one_observation(run, tmp_path):
    smoke = (REPOSITORY / 'scenarios/smoke.yaml').read_text()
    (tmp_path / 'still.yaml').write_text(smoke.replace(', jitter_m: [0.3, 0.2, 0.2]', ''))
    table = run('compare still.yaml --utilities proposed,isler --seeds 3 --no-ceiling --format json '
                f'{FEW} {SMALL} --out .').json
    assert {row['verdict'] for row in rows(table, 'coverage at 0.05 m (%)')} == {
        'baseline', 'one seed: no test'}
    assert 'nothing varies over the seeds' in str(table['notes'])


def test_table_has_the_papers_row_ours_the_oracles_and_the_ceiling(run):
    # the smallest scenario, under the name of one that the paper has figures of; few positions
    table = (f'table smoke --set name=lab_model --seeds 2 {FEW} {SMALL} --set cameras.0.fov_x_deg=90 '
             '--set cameras.0.range_max_m=2 --set planner.validity.collision_radius_m=1 '
             '--out . --format')
    found = run(f'{table} json').json['rows']
    assert [f'{row["utility"]}: {row["row"]}' for row in found] == [
        'Proposed: ours', 'Proposed: paper', 'Proposed: ours below', 'Tour: ours',
        'Oracle, few views: ours', 'Oracle, few metres: ours', 'Oracle, few seconds: ours',
        'Profile: ours',
        'Ceiling: physical', 'Ceiling: leaf filter']
    assert found[0]['runs'] == 2 and found[0]['iterations'] == 4
    assert found[0]['time_min'] and found[0]['share_of_ceiling']
    assert found[1]['entropy_reduction'] == 30140
    for key in ('metres_to_80_runs', 'seconds_to_99_runs', 'wh_with_profile_to_95_runs'):
        assert [found[i][key] is None for i in range(7)] == [
            False, True, True, False, False, False, False]
    # every other form has the same rows and the command that repeats it
    for form in ('terminal', 'markdown', 'csv', 'latex'):
        run(f'{table} {form}', 'gnbv table smoke', 'seeds 2', 'Oracle, few metres',
            'how many got there', 'on one battery',
            'our rows are of smoke, which is not known to be')


def test_table_flies_again_without_noise_what_lies_above_the_ceiling(run):
    # noise of some decimetres fills voxels that a point a leaf of 0.04 m cannot
    found = run('table smoke --set name=lab_model --no-oracle --quiet '
                '--set cameras.0.noise.model=stereo --set cameras.0.noise.disparity_noise_px=2 '
                '--set cameras.0.width_px=640 --set cameras.0.height_px=480 '
                '--set planner.cloud.leaf_m=0.04 --set planner.validity.collision_radius_m=1.3 '
                '--set planner.termination.max_iterations=30 --format json --out .').json['rows']
    assert [row['utility'] for row in found[:2]] == ['Proposed', 'Proposed, exact sensors']
    assert found[0]['share_of_ceiling'] > 1.0 > found[1]['share_of_ceiling']
    assert found[1]['metres_to_90_runs'] is not None
