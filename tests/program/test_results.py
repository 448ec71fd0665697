"""Missions as rows: tables are printed from them, what they hold is not flown again, and what they
say can be recomputed by others."""
import csv
import hashlib
import json
import os
import re
import shutil
import subprocess
import time

import pytest
from program import REPOSITORY, summary

# the lab with a small structure, seen in few pixels
SMALL = '--set structure.builtin=smoke --set cameras.0.width_px=64 --set cameras.0.height_px=48'
TINY = f'--quiet --no-oracle --set planner.termination.max_iterations=3 {SMALL}'
TABLE = f'table lab_model --seeds 2 {TINY} --missions rows.csv --commit abc'

# the least that a comparison of rows reads
COLUMNS = ['id', 'scenario', 'structure', 'structure_sha256', 'method', 'setting', 'commit',
           'program', 'termination', 'result_sha256', 'seed', 'within_coverage_0.05']


@pytest.fixture
def first(whole, tmp_path):
    """The end of TABLE, flown once; its rows and its runs are here."""
    made = whole(*f'{TABLE} --format json --out'.split())
    shutil.copytree(made.path.parent, tmp_path, dirs_exist_ok=True)
    return made.end


def rows_of(path):
    with path.open(newline='') as lines:
        return list(csv.DictReader(lines))


def row_of(mesh, scenario, structure, method, seed, value, **more):
    """What a comparison reads of a mission."""
    mission = f'{scenario}{structure}{mesh}{method}{seed}'
    return dict(zip(COLUMNS, (mission, scenario, structure, mesh, method, '', 'c', 'p',
                              'max_iterations', mission, seed, value))) | more


def write_rows(path, rows):
    with path.open('w', newline='') as lines:
        writer = csv.DictWriter(lines, rows[0].keys(), lineterminator='\n')
        writer.writeheader()
        writer.writerows(rows)


def flown(folder):
    return {path: path.stat().st_mtime_ns for path in folder.glob('*/cells/*/summary.json')}


def test_rows_say_what_their_runs_do_and_tables_need_no_more(run, first, tmp_path):
    rows = rows_of(tmp_path / 'rows.csv')
    runs = {s['result_sha256']: s for s in map(summary, (p.parent for p in flown(tmp_path)))}
    assert len(rows) == len(runs) == 4  # proposed and the tour
    for row in rows:
        its = runs[row['result_sha256']]
        assert row['commit'] == 'abc' and row['termination'] == its['termination']
        assert float(row['coverage_0.05']) == its['coverage']['final']['0.05']
        assert float(row['mean_coverage_metres']) == its['mean_coverage']['metres']
        assert float(row['budget_seconds']) == its['budget']['seconds'] == 480
        reached = float(row['coverage_0.05']) >= 0.9 * float(row['ceiling_0.05'])
        assert (float(row['metres_to_0.90']) < float('inf')) == reached
    table, printed = first.json, run('table --from rows.csv --format json').json
    assert printed['rows'] == table['rows']
    unknown = [note for note in table['notes'] if note not in printed['notes']]
    assert [note.startswith('gnbv table lab_model') for note in unknown] == [True]
    run(f'{TABLE} --out elsewhere --format json')
    assert not list(tmp_path.glob('elsewhere/cells/*')), 'it flew what the rows hold'
    run('table lab_model --from rows.csv', 'excludes', code=2)


def test_rows_of_another_program_hold_as_long_as_a_sample_does(run, first, tmp_path):
    rows = rows_of(tmp_path / 'rows.csv')
    for row in rows:
        row['program'] = 'another'
    write_rows(tmp_path / 'rows.csv', rows)
    run(f'{TABLE} --out again')
    assert len(flown(tmp_path)) == 4 + 2, 'of each method the first seed'
    assert [row['program'] for row in rows_of(tmp_path / 'rows.csv')] == ['another'] * 4
    for row in rows:
        if row['method'] == 'tour':
            row['result_sha256'] = 'false'
    write_rows(tmp_path / 'rows.csv', rows)
    run(f'{TABLE} --out third')
    now = {(row['method'], row['seed']): row for row in rows_of(tmp_path / 'rows.csv')}
    assert len(flown(tmp_path)) == 4 + 2 + 3, 'the sample, and the other tour'
    assert now['proposed', '2']['program'] == 'another' != now['tour', '2']['program']
    assert 'false' not in {row['result_sha256'] for row in now.values()}


def test_rows_come_with_their_missions_and_outlast_a_kill(gnbv, run, first, tmp_path):
    def timeless(file):  # by mission
        return {row['id']: {key: row[key] for key in row if key not in
                            ('time_min', 'within_time_min', 'wall_s')} for row in rows_of(file)}

    whole, come = timeless(tmp_path / 'rows.csv'), tmp_path / 'come.csv'
    words = f'{TABLE} --out come --jobs 1'.replace('rows.csv', come.name)
    with subprocess.Popen([gnbv.path, *words.split()], cwd=tmp_path) as table:
        while table.poll() is None and not come.exists():
            time.sleep(0.002)
        table.kill()
    kept = timeless(come)
    assert len(kept) == 1, 'the first one, before the others are flown'
    assert kept.items() <= whole.items(), 'ceiling and all'
    run(words)
    assert timeless(come) == whole


@pytest.mark.parametrize('change, says', [
    (lambda text: text.replace('result_sha256', 'hash', 1), "rows.csv:1: has no column 'result_"),
    (lambda text: text.replace('proposed', 'proposed,', 1), 'rows.csv:2: '),
    (lambda text: text + text.splitlines()[1] + '\n', 'a second row of lab_model, proposed'),
    (lambda text: text.replace(',inf', ',often', 1), "`often` is not a number"),
    (lambda text: text.splitlines()[0], 'holds no missions')])
def test_damaged_rows_are_refused_by_line(run, first, tmp_path, change, says):
    file = tmp_path / 'rows.csv'
    file.write_text(change(file.read_text()))
    run('table --from rows.csv', 'rows.csv', says, code=2)


def test_scipy_has_the_same_p_and_intervals_of_the_rows(run, tmp_path):
    stats = pytest.importorskip('scipy.stats')
    # rows need no missions: six structures, three seeds, a tie, a difference of nothing
    rows, by_structure = [], {}
    for s in range(8):
        for m, method in enumerate(('base', 'own')):
            values = [0.8 + 0.01 * s + 0.002 * seed + m * (0.004 * (s % 4) - 0.003)
                      for seed in range(3)]
            by_structure[method, s] = sum(values) / 3
            rows += [row_of('', f'scene {s}', f's{s}', method, seed, value)
                     for seed, value in enumerate(values)]
    write_rows(tmp_path / 'rows.csv', rows)
    table = run('compare --from rows.csv --baseline base --format json').json
    own = next(row for row in table['rows'] if row['method'] == 'own'
               and row['scenario'] == 'all 8 structures')
    differences = [100 * (by_structure['own', s] - by_structure['base', s]) for s in range(8)]
    test = stats.wilcoxon([round(d, 9) for d in differences], method=stats.PermutationMethod(10**6))
    assert own['p'] == pytest.approx(test.pvalue, abs=1e-9)
    low, high = stats.t.interval(0.95, 7, loc=sum(differences) / 8, scale=stats.sem(differences))
    assert own['difference'] == pytest.approx((low + high) / 2)
    assert own['difference_ci95'] == pytest.approx((high - low) / 2)


def test_rows_of_one_scenario_around_two_structures_are_of_two(run, tmp_path):
    for structure in ('aircraft', 'a340.obj'):
        write_rows(tmp_path / f'{structure}.csv',
                   [row_of('', 'aircraft', structure, method, seed, 0.9)
                    for method in ('base', 'own') for seed in (1, 2)])
    table = run('compare --from aircraft.csv a340.obj.csv --baseline base --format json').json
    assert {'aircraft', 'a340.obj'} <= {row['scenario'] for row in table['rows']}
    run('compare --from aircraft.csv aircraft.csv', 'two rows of aircraft, base, seed 1', code=2)


def test_files_of_one_name_are_as_many_structures_as_meshes(run, tmp_path):
    for mesh in 'ab':
        write_rows(tmp_path / f'{mesh}.csv', [row_of(mesh * 64, 'aircraft', 'part.obj', method, 1, 0.9)
                                              for method in ('base', 'own')])
    table = run('compare --from a.csv b.csv --baseline base --format json').json
    assert {row['scenario'] for row in table['rows']} == {
        'part.obj (aaaaaaaa)', 'part.obj (bbbbbbbb)', 'all 2 structures'}


@pytest.mark.parametrize('figure, values, says', [
    ('area_samples', (0, 155000), 'score.area_samples'),
    ('budget_metres', (600, 40), 'score.budget_m')])
def test_rows_of_unlike_measures_are_refused(run, tmp_path, figure, values, says):
    write_rows(tmp_path / 'rows.csv',
               [row_of('', 'aircraft', 'aircraft', method, 1, 0.9, **{figure: value})
                for method, value in zip(('base', 'own'), values)])
    run('compare --from rows.csv --baseline base', 'aircraft', 'base', 'own', says, code=2)


def test_a_table_of_two_structures_is_refused(run):
    missions = REPOSITORY / 'bench/results/missions'
    run(f'table --from {missions}/a340.csv {missions}/powerplant-dae.csv', 'aircraft', 'a340.obj',
        'power_plant', 'powerplant.dae', code=2)


def test_rows_are_hits_with_the_ceiling_in_use_alone(run, tmp_path):
    compare = ('compare smoke --utilities proposed,isler --seeds 1 --quiet --format json --out . '
               f'--missions rows.csv --set planner.termination.max_iterations=2 {SMALL}')
    run(f'{compare} --no-ceiling')
    for percent in (90, 80):
        table = run(f'{compare} --ceiling-at {percent}').json
        share = {row['metric'].split(' (')[0]: row['mean'] for row in table['rows']}
        assert share['share of ceiling at 0.05 m'] * percent / 100 == pytest.approx(
            share['coverage at 0.05 m'])
    # the lines of one method from elsewhere
    rows = rows_of(tmp_path / 'rows.csv')
    rows[0]['ceiling_0.05'] = 0.5
    write_rows(tmp_path / 'rows.csv', rows)
    run('compare --from rows.csv', 'smoke: not one ceiling: 50 % (proposed), 80 % (isler)')


def test_two_commands_lose_no_rows_of_one_file(gnbv, tmp_path):
    words = f'--quiet --seeds 3 --no-ceiling --missions rows.csv {SMALL} --set planner.termination.max_iterations='
    both = [subprocess.Popen([gnbv.path, *f'compare smoke --utilities {two} --out {out} {words}{n}'.split()],
                             cwd=tmp_path, stdout=subprocess.DEVNULL)
            for two, out, n in (('proposed,isler', 'a', 2), ('bircher,random', 'b', 3))]
    assert [one.wait() for one in both] == [0, 0]
    assert sorted(row['method'] for row in rows_of(tmp_path / 'rows.csv')) == sorted(
        3 * ['proposed', 'isler', 'bircher', 'random'])


def test_anybody_can_repeat_the_draw_of_what_is_held_out(run, tmp_path):
    for kind, draw in (('tower', 1), ('tower', 2), ('hull', 1)):
        drawn = run(f'asset random --kind {kind} --drawn-from 0123abcd --draw {draw} -o m.ply --json').json
        digest = hashlib.sha256(f'0123abcd {kind} {draw}'.encode()).hexdigest()
        assert drawn['seed'] == int(digest[:8], 16)
    run('asset random --drawn-from 0123abcd -o m.ply', '--kind', code=2)


def results(gnbv, *words, code=0, **environment):
    end = subprocess.run([REPOSITORY / 'tools/results', *map(str, words)], capture_output=True,
                         text=True, cwd=gnbv.folder,
                         env=os.environ | {'GNBV': str(gnbv.path)} | environment)
    assert end.returncode == code, end.stdout + end.stderr
    return end.stdout + end.stderr


@pytest.mark.skipif(not (REPOSITORY / '.git').exists(), reason='no clone')
def test_held_out_structures_are_drawn_from_all_digits_of_a_commit_and_say_it(gnbv, tmp_path):
    stub, rows = tmp_path / 'stub', tmp_path / 'to/missions/held-out.csv'
    stub.write_text(f'#!/bin/sh\necho "$@" | tee -a {tmp_path}/calls\n')  # gnbv itself flies for long
    stub.chmod(0o755)
    rows.parent.mkdir(parents=True)
    write_rows(rows, [{'commit': 'c'}])
    words = ['--only', 'held-out', '--out', 'out', '--to', 'to', '--held-out']
    results(gnbv, *words, 'HEAD', GNBV=str(stub))
    drawn_from = re.findall(r'--drawn-from (\S+) --draw', (tmp_path / 'calls').read_text())
    assert len(drawn_from) == 24 and re.fullmatch('[0-9a-f]{40}', drawn_from[0])
    assert {*drawn_from, *re.findall(r'--held-out (\S+) -->', (tmp_path / 'to/held-out.md').read_text())
            } == {drawn_from[0]}
    results(gnbv, *words, 'moon', code=2)


def test_one_command_flies_prints_and_says_what_is_stale(gnbv, tmp_path):
    there = ['--seeds', 1, '--set', 'planner.termination.max_iterations=2', *SMALL.split(),
             '--out', 'out', '--to', 'to', '--only', 'lab_model', '--only', 'a340']
    nothing = {'GNBV_SHARED_MESHES': str(tmp_path)}
    assert 'a340: left out: no ' in results(gnbv, *there, **nothing)
    table = tmp_path / 'to/lab_model.md'
    assert table.read_text().startswith('<!-- gnbv table --from missions/lab_model.csv; commit ')
    assert 'flown with gnbv table lab_model -->' in table.read_text()
    before = flown(tmp_path)
    assert before and table.name not in results(gnbv, *there, **nothing) and flown(tmp_path) == before
    results(gnbv, '--check', *there)
    table.write_text(table.read_text().replace('ours', 'theirs', 1))
    assert f'stale: {table}' in results(gnbv, '--check', *there, code=1)
    assert 'theirs' in table.read_text(), 'a check writes nothing'
    results(gnbv, '--print', *there)
    results(gnbv, '--check', *there)
    for bad in (['--only', 'moon'], ['--seeds', 'none'], ['--seeds', '0'], ['--sedes', '3']):
        results(gnbv, *bad, code=2)


def test_the_numbers_of_the_documents_are_those_of_the_rows(gnbv):
    results(gnbv, '--check')
    for name in ('README.md', 'bench/results/README.md'):  # intervals stand nowhere but in marks
        text = (REPOSITORY / name).read_text()
        assert '±' not in re.sub(r'<!--=.*?<!--/-->', '', text, flags=re.S)
