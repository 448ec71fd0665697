"""Fixtures of tests of the whole program: the program, whole runs, moments, counts."""
import collections
import os
import pathlib
import random
import shlex
import shutil
import signal
import subprocess
import tempfile
import time
import types

import pytest
from program import REPOSITORY, Gnbv

LINES, COUNTS = [], collections.Counter()
# a shell's background job is started with SIGINT ignored, which its children would inherit
signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_addoption(parser):
    group = parser.getgroup('gnbv')
    group.addoption('--gnbv', type=pathlib.Path, default=REPOSITORY / 'build/release/gnbv',
                    help='the program (default: the release build)')
    group.addoption('--cache', action='store_true',
                    help='true surfaces and ceilings are kept from test to test')
    group.addoption('--tries', type=int, help='of each kind (default: TRIES of the attack)')
    group.addoption('--seed', type=int, default=1, help='of the moments (default: 1)')
    group.addoption('--every', type=int, default=1, help='only each N-th test: the short version')
    group.addoption('--views', type=int, help='of a mission (default: VIEWS of the attack)')
    group.addoption('--file', default='', help='damaged-runs: files whose name holds this')
    group.addoption('--keep', type=pathlib.Path, help='safety: a folder for worlds that failed')


def pytest_configure(config):
    config.option.gnbv = config.option.gnbv.resolve()
    if not os.access(config.option.gnbv, os.X_OK):
        raise pytest.UsageError(f'{config.option.gnbv} is no program: tools/build makes it')
    if config.option.cache:
        folder = tempfile.TemporaryDirectory(prefix='gnbv-cache-')
        config.add_cleanup(folder.cleanup)
        Gnbv.cache = folder.name


def pytest_generate_tests(metafunc):
    if 'attempt' in metafunc.fixturenames:
        tries = metafunc.config.option.tries or metafunc.module.TRIES
        metafunc.parametrize('attempt', range(tries))


def pytest_collection_modifyitems(config, items):
    items[:] = items[::config.option.every]


def pytest_terminal_summary(terminalreporter):
    for line in LINES:
        terminalreporter.write_line(line)
    for what, count in COUNTS.most_common():
        terminalreporter.write_line(f'{count:7} {what}')


def pytest_sessionfinish(session):
    reporter = session.config.pluginmanager.get_plugin('terminalreporter')
    ends = set(reporter.stats)
    if 'skipped' in ends and not ends & {'passed', 'failed', 'error'}:
        session.exitstatus = 77  # this machine does not allow the attack


@pytest.fixture
def count():
    """count(what): the summary tells how often."""
    return lambda what: COUNTS.update([what])


@pytest.fixture
def tell():
    """tell(line): the summary holds it."""
    return LINES.append


@pytest.fixture
def test_program(request):
    """test_program(name) -> its path, where it was built beside the program."""
    def path(name):
        found = request.config.option.gnbv.parent / 'tests/end_to_end' / name
        if not found.exists():
            pytest.skip(f'no {found}')
        return found

    return path


@pytest.fixture
def gnbv(request, tmp_path):
    return Gnbv(request.config.option.gnbv, tmp_path)


@pytest.fixture
def run(gnbv):
    """run(line, *says, code=0, **environment) -> the end of `gnbv LINE`, which has that exit code
    and says these words."""
    def line(words, *says, code=0, **environment):
        here = Gnbv(gnbv.path, gnbv.folder, **environment)
        end = here(*shlex.split(words))
        said = end.out + end.err
        assert end.code == code, f'gnbv {words}: exit code {end.code}: {said[-600:]}'
        for word in says:
            assert word in said, f'gnbv {words}: no {word!r} in: {said[-1500:]}'
        return end

    return line


@pytest.fixture
def views(request):
    return request.config.option.views or request.module.VIEWS


@pytest.fixture
def dice(request):
    return random.Random(f'{request.config.option.seed} {request.node.name}')


@pytest.fixture(scope='session')
def whole(request, tmp_path_factory):
    """whole(*words) is that command undisturbed, once a session, with a folder of its own for the
    last word: the folder, how long it took and its end."""
    known = {}

    def made(*words, name='out'):
        if words not in known:
            folder = tmp_path_factory.mktemp('whole')
            begin = time.monotonic()
            end = Gnbv(request.config.option.gnbv, folder)(*words, folder / name).check({0})
            known[words] = types.SimpleNamespace(
                path=folder / name, takes_s=time.monotonic() - begin, end=end)
        return known[words]

    return made


@pytest.fixture
def copy_of(whole, tmp_path):
    """copy_of(*words) -> a copy of what that command makes, to be changed: `tmp_path / 'run'`."""
    return lambda *words: shutil.copytree(whole(*words).path, tmp_path / 'run')


@pytest.fixture(scope='session')
def may_mount():
    if subprocess.run(['unshare', '-rm', 'true'], capture_output=True).returncode != 0:
        pytest.skip('`unshare -rm` is not allowed here')


@pytest.fixture
def on_disk(request, may_mount, tmp_path):
    """on_disk(options of its tmpfs, `then`) -> the program with such a disk for its folder, and
    after the shell commands `then`. What it holds at the end is left in `tmp_path / 'rescued'`."""
    def made(options, then='true'):
        disk = tmp_path / 'disk'
        disk.mkdir(exist_ok=True)
        script = (f'mount -t tmpfs -o {options} tmpfs "$0" && {then} && {{ "$@"; code=$?; }}; '
                  'rm -rf "$0/../rescued"; cp -r "$0" "$0/../rescued"; exit $code')
        return Gnbv(request.config.option.gnbv, tmp_path,
                    ['unshare', '-rm', 'sh', '-c', script, str(disk)])

    return made
