"""The program as its users meet it: exit codes, messages, and what it leaves behind."""
import os
import re

import pytest
from program import hash_of, json_of

COMMANDS = ('run table render asset lint schema score sweep ceiling export plot check compare '
            'report surface fly paper doctor').split()
ONE = '--quiet --set planner.termination.max_iterations=1'
NAN = 'v 0 0 1\nv nan 0 1\nv 0 1 1\nf 1 2 3\n'


@pytest.mark.parametrize('command', ['', *COMMANDS])
def test_help_fits_80_columns_and_has_examples(run, command):
    said = run(f'{command} --help', 'Usage').out
    assert all(len(line) <= 80 for line in said.splitlines())
    assert not command or f'\nExamples:\n  gnbv {command}' in said


def test_a_mistyped_word_is_understood(run):
    run('--version')
    assert 'subcommand' not in run('rendr', 'did you mean `gnbv render`?', code=2).err
    run('comp', 'did you mean `gnbv compare`?', code=2)
    run('run smoke --utilty bircher', 'did you mean --utility?', code=2)
    run('bench verfy x.zip', 'did you mean `gnbv bench verify`?', code=2)
    assert 'did you mean' not in run('fly-me-to-the-moon', 'is no command', code=2).err
    for bad in ('', 'run', 'run smoke --threads none'):
        run(bad, code=2)


@pytest.mark.parametrize('words, meant', [
    ('render run --what covrage', 'coverage'), ('render run --camera isoo', 'iso'),
    ('plot run --plots denstiy', 'density'), ('plot run --format sgv', 'svg'),
    ('export run --format colmp', 'colmap'), ('compare smoke --utilities proposd', 'proposed'),
    ('compare smoke --format markdwn', 'markdown'), ('run smoke --bounds atuo', 'auto'),
    ('paper -o run --scenarios lab_modle', 'lab_model')])
def test_a_name_of_every_closed_list_may_be_a_slip_of_one(run, copy_of, words, meant):
    copy_of('run', 'smoke', *ONE.split(), '--out')
    assert run(words, f"did you mean '{meant}'?", code=2).err.startswith('gnbv: --')


@pytest.mark.parametrize('words', [
    "run smoke --mesh ''", "run smoke --seed ''", "run smoke --utility ''",
    "run smoke --preset ''", "run smoke --out ''", "compare smoke --baseline ''", "score ''",
    "asset smoke -o ''", "sweep ''"])
def test_a_variable_that_is_not_set_is_no_option(run, words):
    run(words, ': is empty', code=2)


REFUSED = {
    'run aircaft --out out': ['aircaft', 'aircraft'],
    'run unknown.yaml --out out': ['unknown.yaml:2', 'planer', 'planner'],
    'run type.yaml --out out': ['type.yaml:3', 'seed', 'many'],
    'run range.yaml --out out': ['range.yaml:3', 'resolution_m', '-0.2'],
    'run broken.yaml --out out': ['broken.yaml'],
    'run control.yaml --out out': ['control.yaml'],
    'run absent.yaml --out out': ['absent.yaml'],
    'run smoke --set planner.utilty.name=isler --out out': ['--set', 'utilty', 'utility'],
    'run smoke --utility best --out out': ['--utility best: ', 'proposed'],
    'run smoke --mesh absent.obj --out out': ['absent.obj'],
    'run smoke --mesh . --out out': ['is a directory'],
    'ceiling aircaft': ['aircaft', 'aircraft'],
    'lint absent.obj': ['absent.obj', 'No such file'],
    'asset aircrft -o out': ['aircrft', "'aircraft'"],
    'asset random --kind crain -o out': ['--kind', "'crain'", "did you mean 'crane'?", 'hull'],
    'asset smoke --seed 2 -o out.obj': ['smoke', 'asset random'],
    **{f'asset random --seed {seed} -o out': ['--seed', seed]
       for seed in ('-1', '010', '0x10', '18446744073709551616')},
    'run smoke --threads 010 --out out': ['--threads', "'010' must be a whole number in decimal digits"],
    'run smoke --round-views --out out': ['--round-views', 'FILE.py:FUNCTION'],
    'table smoke --commit abc --out out': ['--commit', '--missions'],
    'asset smoke -o out': ['out', '.obj, .ply or .glb'],
    'asset smoke --list': ['--list'],
    'run smoke --mesh empty.obj --out out': ['empty.obj'],
    'run smoke --mesh nan.obj --out out': ['nan.obj'],
    'run smoke --mesh outside.obj --out out': ['outside.obj', 'workspace_m'],
    'run smoke --out file/out': ['file/out'],
    'run smoke --set planner.cloud.leaf_m=0.002 --out out': ['--set', 'leaf_m', '0.002'],
    "run smoke --set 'workspace_m={min: [2530, -4, 0], max: [2540, 4, 5]}' "
    "--set 'start.position_m=[2532, -2.8, 1.2]' --out out":
        ['--set', 'workspace_m', '2540', '1000 m'],
    'run smoke --set vehicle.airframe.mass_kg=5 --out out': ['--set', 'mass_kg', 'thrust_max'],
    'run smoke --seed -1 --out out': ["--seed -1: seed: value '-1'"],
    'run smoke --preset papr --out out': ['--preset papr: planner.preset'],
    'run smoke --resume': ['--resume', '--out'],
    'run smoke --out .': ['not empty'],
    'table smoke --out out': ['smoke', 'aircraft'],
    'render out': ['out'],
}


@pytest.mark.parametrize('words', REFUSED)
def test_bad_input_is_named_and_leaves_nothing(run, tmp_path, words):
    for name, text in {
            'unknown.yaml': 'name: x\nplaner: {}\n', 'type.yaml': 'name: x\n\nseed: many\n',
            'range.yaml': 'planner:\n  map:\n    resolution_m: -0.2\n',
            'broken.yaml': 'planner: {map: [\n', 'control.yaml': '"pl\\e[31maner": 3\n',
            'empty.obj': '', 'nan.obj': NAN, 'file': '',
            'outside.obj': 'v 0 0 1\nv 900 0 1\nv 0 1 1\nf 1 2 3\n'}.items():
        (tmp_path / name).write_text(text)
    end = run(words, *REFUSED[words], code=2)
    assert '\x1b' not in end.err
    assert not (tmp_path / 'out').exists()


def test_an_unknown_instruction_set_is_refused(run):
    run('schema', 'GNBV_SIMD=foo', code=2, GNBV_SIMD='foo')
    assert 'planner' in run('schema', GNBV_SIMD='avx2').json['properties']


def test_a_folder_is_refused_before_an_oracle_plans(run, tmp_path):
    """It plans for minutes in a large scene; what its plan needs would be in the cache."""
    (tmp_path / 'thesis.txt').write_text('')
    run('run smoke --set planner.utility.name=oracle_views --out .', 'not empty', code=2,
        GNBV_CACHE=str(tmp_path / 'cache'))
    assert not (tmp_path / 'cache').exists()


def test_a_current_folder_that_was_removed_is_named(gnbv, tmp_path):
    gone = tmp_path / 'gone'
    gnbv('run', 'smoke', preexec_fn=lambda: (gone.mkdir(), os.chdir(gone), gone.rmdir())).check(
        {2}, ['the current folder: '])


def test_a_run_repeats_from_its_own_folder(run, tmp_path):
    run('run smoke --seed 3 --out a', 'a')
    run('run a/scenario.yaml --threads 1 --out b')
    assert hash_of(tmp_path / 'a') == hash_of(tmp_path / 'b')
    run('render a')
    assert (tmp_path / 'a/path.png').exists()


def test_a_run_that_is_there_is_kept(run, tmp_path, copy_of):
    before = (copy_of('run', 'smoke', *ONE.split(), '--out') / 'summary.json').read_bytes()
    run(f'run smoke {ONE} --out run', '--resume', code=2)
    assert (tmp_path / 'run/summary.json').read_bytes() == before


def test_a_mission_that_ends_before_it_explored_says_why(run, tmp_path):
    # in a corner, looking away, and without frontier views
    away = ("run smoke --quiet --set 'start={position_m: [0, -3.9, 4.5], yaw_deg: -90, "
            "jitter_m: [0, 0, 0]}' --out ")
    run(f'{away}tour --utility tour --preset takeoff', 'no view pays', 'planner.tour.explore: true')
    few = run('run smoke --quiet --out few --utility tour --preset takeoff '
              '--set planner.tour.price=3 --set planner.tour.end_price=1')
    assert json_of(tmp_path / 'few/summary.json')['iterations'] == 1
    assert 'explored' not in few.err, 'it found a third of the structure'
    run(f'{away}out --set planner.fvs.enabled=false --set planner.agvs.scales=false '
        '--set planner.profiling.method=none',
        'ended after 1 view, before it explored', 'outside the workspace', 'what helps: ')
    assert json_of(tmp_path / 'out/summary.json')['last_rejections']['out_of_bounds'] > 0


@pytest.mark.parametrize('extension', ['obj', 'ply', 'glb'])
def test_structures_are_sound_and_those_of_their_seed(run, tmp_path, extension):
    facts = run(f'asset smoke --json -o smoke.{extension}').json
    report = run(f'lint --json smoke.{extension}').json
    assert report['usable'] and all(report[key] == facts[key] for key in ('faces', 'bounds_m'))

    def made(options):
        facts = run(f'asset random --json {options} -o a.{extension}').json
        return (tmp_path / f'a.{extension}').read_bytes(), facts['kind'], facts['seed']

    content, kind, seed = made('--seed 9')
    assert made(f'--kind {kind} --seed {seed}')[0] == content, 'the seed chose that kind'
    assert made('--seed 10')[0] != content
    assert made('') == made('--seed 1')
    run('asset --list', 'smoke\n', 'random --kind hall\n', 'random --kind mixed\n')


def test_run_repeats_what_lint_warns_of_and_no_more(run):
    run('asset smoke -o low.obj')
    fly = f'run smoke {ONE} --mesh low.obj'
    assert 'low.obj: ' not in run(f'{fly} --out sound').err
    sunk = '--set structure.file.offset_m=[0,0,-0.9] --set workspace_m.min=[-4,-4,-1]'
    lint = run(f'lint low.obj --scenario smoke {sunk}', 'below the ground').out
    said = run(f'{fly} {sunk} --out sunk', 'low.obj: ground: reaches 0.888 m below the ground').err
    assert said.count('low.obj: ') == lint.count('\nwarning')


def test_surface_that_is_cleared_through_is_said_once_by_run_and_lint(run):
    run('asset smoke -o box.obj')
    deep = '--set cameras.0.return_max_m=3'
    words = 'as planner.map.no_return is free: rgbd from 3 to 5 m'
    assert run(f'run smoke {ONE} {deep} --out deep').err.count(words) == 1
    assert run(f'run smoke {ONE} {deep} --mesh box.obj --out box').err.count(words) == 1
    assert run(f'lint box.obj --scenario smoke {deep}').out.count(words) == 1
    unknown = f'{deep} --set planner.map.no_return=unknown'
    assert 'no_return' not in run(f'run smoke {ONE} {unknown} --out unknown').err
    assert 'no_return' not in run(f'lint box.obj --scenario smoke {unknown}').out


def test_lint_takes_several_meshes_and_ends_as_the_worst(run, tmp_path):
    run('asset smoke -o good.obj')
    (tmp_path / 'nan.obj').write_text(NAN)
    one = run('lint good.obj').out
    assert run('lint good.obj good.obj', '2 meshes: 2 usable').out.startswith(f'{one}\n{one}')
    run('lint nan.obj good.obj', 'nan.obj:2: vertex 2', 'good.obj: usable',
        '1 usable, 1 not usable', code=1)
    run('lint absent.obj nan.obj good.obj', 'good.obj: usable', '1 unreadable', code=2)
    meshes = run('lint --json nan.obj good.obj', code=1).json['meshes']
    assert [mesh['usable'] for mesh in meshes] == [False, True]


def test_run_names_a_key_without_effect_and_flies(run):
    run(f'run smoke {ONE} --set structure.file.scale=2 --out run',
        'gnbv: structure.file.scale (--set structure.file.scale=2) has no effect: ')
    assert 'no effect' not in run('run run/scenario.yaml --quiet --out again').err


# a room of which little has to be looked at
SMALL = '--set planner.cloud.leaf_m=0.1 --set cameras.0.range_max_m=2.5'


@pytest.fixture
def cache(tmp_path):
    return {'GNBV_CACHE': str(tmp_path / 'cache')}


def without_time(json):
    return {key: value for key, value in json.items() if key != 'wall_s'}


def test_no_oracle_finds_more_than_the_ceiling(run, cache):
    ceiling = run(f'ceiling smoke --json {SMALL}', **cache).json
    assert without_time(run(f'ceiling smoke --json {SMALL}', **cache).json) == without_time(ceiling)
    flown = run(f'run smoke {SMALL} --utility oracle_metres --json --out run', **cache).json
    # where the views fall into leaves differs a little from the survey's
    assert flown['coverage']['final']['0.05'] <= ceiling['leaf_outside']['0.05'] + 0.02
    # that of a run is that of its scenario
    assert without_time(run('ceiling run --json', **cache).json) == without_time(ceiling)
    run('ceiling cache', 'scenario.yaml is missing', code=2, **cache)


def test_compare_looks_for_one_ceiling_of_a_scenario(run):
    def searches(more):
        end = run('compare smoke --seeds 1 --set planner.termination.max_iterations=1 '
                  f'--set planner.cloud.leaf_m=0.1 --out cells {more}')
        assert ('--no-ceiling' in more) != ('share of ceiling' in end.out)
        return len(re.findall('gnbv: ceiling of smoke', end.err))

    assert searches('--variant planner.agvs.step_m=0.5 --variant cameras.0.noise.model=nguyen '
                    '--variant planner.termination.max_distance_m=1 '
                    '--variant guidance.path_speed_m_s=2') == 1
    assert searches('--variant planner.agvs.step_m=0.5 --no-ceiling') == 0
    assert searches('--variant cameras.0.range_max_m=4') == 1  # the baseline's


@pytest.mark.skipif(os.geteuid() != 0, reason='needs root, to be a user who has no process yet')
@pytest.mark.parametrize('words', ['render run --what path -o p.png',
                                   'run smoke --quiet --threads 2 --out alone'])
def test_without_threads_the_system_is_blamed(gnbv, copy_of, tmp_path, words):
    copy_of('run', 'smoke', *ONE.split(), '--out')
    tmp_path.chmod(0o777)
    # whoever has this number runs nothing else here; one process is one thread
    gnbv.before = 'timeout 60 setpriv --reuid=64999 --clear-groups'.split()
    if gnbv('--version').code != 0:
        pytest.skip('another user cannot run gnbv here')
    gnbv.before += ['prlimit', '--nproc=1']
    gnbv(*words.split()).check({1}, ['Resource temporarily unavailable'])


def test_doctor_says_what_is_missing_and_how_to_get_it(run, tmp_path):
    def rows(**environment):
        table = run('doctor --json', **environment)
        return {row['need']: row for row in table.json['rows']}, table.json['notes']

    here, notes = rows()
    for need in ('symmetry module', 'Poisson module', 'Mesa', 'a font', 'Python: matplotlib',
                 'Python: matplotlib, jinja2', 'Python: PIL'):  # tools/setup brings them
        assert (here[need]['is_here'], here[need]['remedy']) == ('yes', '-')
    bare, notes = rows(PATH='/nowhere', GNBV_PYTHON='/nowhere/python', GNBV_FONT='/nowhere/font')
    for need, remedy in [('Python: matplotlib', 'apt install python3-matplotlib, or'),
                         ('ffmpeg', 'apt install ffmpeg'), ('sbatch', 'apt install slurm-client'),
                         ('a font', 'apt install fonts-dejavu-core')]:
        assert bare[need]['is_here'] == 'no' and remedy in bare[need]['remedy']
    assert any('/nowhere/font' in note for note in notes)
    (tmp_path / 'f.py').write_text('def score(views):\n    return views["free_voxels"]\n')
    python = tmp_path / 'python'  # which has NumPy, or has not
    python.write_text('#!/bin/sh\nPYTHONPATH=$NUMPYS exec /usr/bin/python3 -S "$@"\n')
    python.chmod(0o755)
    (tmp_path / 'has').mkdir()
    (tmp_path / 'has/numpy.py').touch()
    for path, says in [('/nowhere', 'no'), (str(tmp_path / 'has'), 'yes')]:
        there, _ = rows(GNBV_PYTHON=str(python), NUMPYS=path)
        assert there['Python: numpy']['is_here'] == says
    run(f'run smoke {ONE} --utility {tmp_path}/f.py:score', 'numpy', code=2,
        GNBV_PYTHON=str(python), NUMPYS='/nowhere')
    assert 'ffmpeg' in run('doctor').out
