"""`gnbv sweep`: what it flies, tabulates, refuses and leaves behind."""
import csv
import os
import subprocess

import pytest
from program import Gnbv, json_of

S_YAML = ('scenarios: smoke\nutilities: [proposed, bircher]\nseeds: 2\n'
          'set: {planner.termination.max_iterations: 1}\n')


@pytest.fixture
def sweep(run, tmp_path):
    """sweep(words, *says, code=0) -> the end of `gnbv sweep WORDS` beside s.yaml."""
    (tmp_path / 's.yaml').write_text(S_YAML)
    return lambda words, *says, code=0: run(f'sweep {words}', *says, code=code)


def statuses(sweep, words='s.yaml --out o'):
    return [cell['status'] for cell in sweep(f'{words} --status --json').json]


def test_flies_what_is_missing_and_tabulates_all(sweep, tmp_path):
    sweep('s.yaml --out o --index 1 --threads 1', 'smoke proposed seed 2: done: o/cells/')
    assert statuses(sweep) == ['missing', 'done', 'missing', 'missing']
    done = tmp_path / sweep('s.yaml --out o --status --json').json[1]['run'] / 'summary.json'
    written = done.stat().st_mtime_ns
    sweep('s.yaml --out o --jobs 2 --threads 1', 'results.csv')
    assert done.stat().st_mtime_ns == written
    # the table's rows are the cells in order, with the figures of their summaries
    manifest = json_of(tmp_path / 'o/sweep.json')
    assert manifest['text'] == S_YAML
    with (tmp_path / 'o/results.csv').open() as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0])[:7] == ['index', 'id', 'scenario', 'method', 'seed', 'status',
                                 'termination']
    for row, cell in zip(rows, manifest['cells'], strict=True):
        found = json_of(tmp_path / f'o/cells/{cell["id"]}/summary.json')
        assert (row['id'], row['method']) == (cell['id'], cell['method'])
        assert (found['utility'], found['seed']) == (cell['method'], cell['seed'])
        assert row['result_sha256'] == found['result_sha256']
        assert str(found['coverage']['final']['0.05']) in row.values()


def test_is_compared_and_drawn_whatever_its_rows_are_called(sweep, run, tmp_path):
    (tmp_path / 'named.yaml').write_text(
        'scenarios: {name: a/b, scenario: smoke}\nutilities: [proposed, bircher]\nseeds: 2\n'
        'set: {planner.termination.max_iterations: 1}\n')
    sweep('named.yaml --out o --jobs 2 --threads 1')
    run('compare --no-ceiling --from o --plots p', 'a/b')
    assert (tmp_path / 'p').exists()


def test_a_cell_that_failed_is_named(sweep, tmp_path):
    (tmp_path / 'f.yaml').write_text(
        'scenarios:\n  - smoke\n  - {name: inside, scenario: smoke, set: {'
        'planner.validity.z_min_m: 0, start: {position_m: [0, 0, 0.5], jitter_m: [0, 0, 0]}}}\n'
        'set: {planner.termination.max_iterations: 1}\n')
    sweep('f.yaml --out o --quiet --threads 1', '1 cells failed; --retry-failed',
          'inside default seed 1: exit code 2: gnbv: start.position', code=1)
    assert ',inside,default,1,failed,,' in (tmp_path / 'o/results.csv').read_text()
    sweep('f.yaml --out o --index 1', code=1)
    sweep('f.yaml --out o --index 0')
    record, = (tmp_path / 'o/cells').glob('*.failed.json')
    assert json_of(record)['exit_code'] == 2 and record.name.startswith(json_of(record)['id'])
    record.write_text('{"failure": "as before"}')
    sweep('f.yaml --out o --quiet', 'as before', code=1)
    sweep('f.yaml --out o --quiet --retry-failed', 'gnbv: start.position', code=1)


def test_the_status_of_a_folder_that_cannot_be_written_is_shown(sweep, tmp_path):
    (tmp_path / 'o/results.csv').mkdir(parents=True)
    sweep('s.yaml --out o --status', 'all', 'gnbv: o/results.csv: cannot write')


def test_lists_without_a_folder(sweep, tmp_path):
    assert sweep('s.yaml --list --json').json[3]['method'] == 'bircher'
    assert not (tmp_path / 'o').exists()


def test_an_index_means_the_cell_of_the_manifest(sweep, tmp_path):
    sweep('s.yaml --out o --slurm-dry-run')
    (tmp_path / 's.yaml').write_text(S_YAML + 'grid: {planner.cloud.leaf_m: [0.05, 0.06]}\n')
    sweep('s.yaml --out o --index 2', 's.yaml: cell 2 is not the one of o/sweep.json', code=2)
    assert not (tmp_path / 'o/cells').exists()


def test_a_folder_belongs_to_one_sweep_file_until_another_replaces_it(sweep, tmp_path):
    sweep('s.yaml --out o --slurm-dry-run')
    (tmp_path / 't.yaml').write_text(
        'scenarios: smoke\nset: {planner.termination.max_iterations: 1}\n')
    for how in ('', '--status', '--slurm-dry-run'):
        sweep(f't.yaml --out o --quiet {how}', f'o/sweep.json: is of {tmp_path}/s.yaml',
              f'not of {tmp_path}/t.yaml; --replace', code=2)
    assert len(json_of(tmp_path / 'o/sweep.json')['cells']) == 4
    sweep('t.yaml --out o --quiet --threads 1 --replace')
    assert len(json_of(tmp_path / 'o/sweep.json')['cells']) == 1
    sweep('./t.yaml --out o --status')


def test_the_batch_script_flies_each_cell_in_one_task(sweep, tmp_path):
    sweep("s.yaml --out 'o p' --slurm-dry-run --threads 3 --slurm-limit 2 --slurm-args "
          "'--time=01:00:00 --partition=cpu'")
    script = (tmp_path / 'o p/sweep.sbatch').read_text().splitlines()
    assert {'#SBATCH --array=0-3%2', '#SBATCH --cpus-per-task=3', '#SBATCH --requeue',
            '#SBATCH --time=01:00:00 --partition=cpu'} <= set(script)
    # the script itself, as Slurm would run its third task
    subprocess.run(['bash', tmp_path / 'o p/sweep.sbatch'], cwd='/', check=True,
                   capture_output=True,
                   env={**os.environ, 'SLURM_ARRAY_TASK_ID': '2', 'GNBV_CACHE': ''})
    assert statuses(sweep, "s.yaml --out 'o p'") == ['missing', 'missing', 'done', 'missing']


@pytest.mark.parametrize('words, says', [
    ('absent.yaml --out o', 'absent.yaml'),
    ('empty.yaml --out o', 'empty.yaml:1: is empty'),
    ('none.yaml --out o', "none.yaml:1: scenarios: value '[]'"),
    ('key.yaml --out o',
     "key.yaml:3: planner.utilty: is no known key (did you mean 'planner.utility'?)\n"
     "key.yaml:4: seeds: value '0': is out of range (allowed: from 1 to 1000000)"),
    ('s.yaml', '--out'),
    ('s.yaml --out o --status', 'o: no such folder'),
    ('s.yaml --out o --index 4', 'the cells 0 to 3'),
    ('s.yaml --out o --index two', 'K or K-L'),
    ('s.yaml --out o --index 2-1', 'K or K-L'),
    ('s.yaml --out o --index 1 --list', '--list'),
    ('s.yaml --out o --status --slurm', '--status'),
    ('s.yaml --out o --status --retry-failed', '--retry-failed'),
    ('s.yaml --out o --slurm-dry-run --jobs 2', '--jobs'),
    ('s.yaml --out o --slurm-limit 2', '--slurm-limit'),
    ('s.yaml --out s.yaml/o', 's.yaml/o'),
    ('s.yaml --out o --jobs 0', '--jobs')])
def test_bad_usage_is_named_and_leaves_nothing(sweep, tmp_path, words, says):
    for name, text in {
            'key.yaml': 'scenarios: smoke\nset:\n  planner.utilty.name: isler\nseeds: 0\n',
            'empty.yaml': '', 'none.yaml': 'scenarios: []\n'}.items():
        (tmp_path / name).write_text(text)
    sweep(words, says, code=2)
    assert not (tmp_path / 'o').exists()


# ---- what is final has reached the disk, by the calls that the program makes (sync_log.cpp) ----
@pytest.fixture
def calls_of(gnbv, tmp_path):
    log = os.environ.get('GNBV_SYNC_LOG')
    if log is None:
        pytest.skip('GNBV_SYNC_LOG names no module')

    def calls(*words):
        Gnbv(gnbv.path, tmp_path, LD_PRELOAD=log, SYNC_LOG=str(tmp_path / 'log'))(*words).check({0})
        return (tmp_path / 'log').read_text().splitlines()

    return calls


def test_a_run_is_on_the_disk_before_its_summary_says_so(calls_of, tmp_path):
    run = (tmp_path / 'run').resolve()
    calls = calls_of('run', 'smoke', '--quiet', '--frames', '--candidates', '--set',
                     'planner.termination.max_iterations=2', '--out', run)
    last = {call: at for at, call in enumerate(calls)}
    summary = last[f'rename {run / "summary.json"}']
    for path in (p for p in run.rglob('*') if p.is_file() and p.name != 'summary.json'):
        # under its own name, or as the temporary file just before it got that name
        renamed = last.get(f'rename {path}')
        before = calls[renamed - 1] if renamed else ''
        assert last.get(f'sync {path}', summary) < summary or (
            renamed < summary and before.startswith('sync ') and '.part' in before), path
    assert last[f'sync {run}'] > summary, 'the folder after the last name in it'
    assert last[f'remove {run / "iterations.csv.part"}'] < summary, \
        'a kill between them would leave it beside a finished run'


def test_a_cell_is_done_when_its_folder_knows_it(calls_of, tmp_path):
    (tmp_path / 's.yaml').write_text('scenarios: smoke\nutilities: [proposed]\nseeds: 1\n'
                                     'set: {planner.termination.max_iterations: 1}\n')
    cells = (tmp_path / 'out/cells').resolve()
    calls = calls_of('sweep', tmp_path / 's.yaml', '--quiet', '--out', tmp_path / 'out')
    published = next(at for at, call in enumerate(calls) if call.startswith(f'rename {cells}/') and
                     '/' not in call.removeprefix(f'rename {cells}/'))
    assert f'sync {cells}' in calls[published:]
