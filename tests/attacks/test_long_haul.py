"""Many missions in one process and many after each other: memory, descriptors, files stay flat.

Those in one process are flown by the test program long_haul_test, --tries of them; ten times as
many are flown one after the other by the program itself, with a cache of a few megabytes.
"""
import os
import shutil

import pytest
from program import Gnbv, end_of

TRIES = 50
LIMIT_BYTES = 4_000_000  # of the cache: some references of the smoke structure
FLAT = 1.1  # the largest memory of the last ones, of that of the first ones


@pytest.fixture
def tries(request):
    return request.config.option.tries or TRIES


def peak_kib(process):
    """The most memory that it had, and whether it came to its end."""
    _, status, usage = os.wait4(process.pid, 0)
    assert os.waitstatus_to_exitcode(status) == 0
    return usage.ru_maxrss


def test_missions_after_each_other(gnbv, tmp_path, tries):
    temporary, cache, runs = (tmp_path / name for name in ('tmp', 'cache', 'runs'))
    for place in (temporary, cache, runs):
        place.mkdir()
    gnbv = Gnbv(gnbv.path, tmp_path, TMPDIR=str(temporary), GNBV_CACHE=str(cache),
                GNBV_CACHE_LIMIT=str(LIMIT_BYTES))
    peaks = []
    for i in range(10 * tries):
        # another floor rule, so that each keeps a reference of its own
        peaks.append(peak_kib(gnbv.start(
            'run', 'smoke', '--quiet', '--seed', i + 1, '--out', runs / 'run', '--set',
            f'planner.floor_z_m={0.3 + 1e-4 * i}')))
        assert any((runs / 'run').iterdir())
        shutil.rmtree(runs / 'run')
        assert not [*temporary.iterdir(), *runs.iterdir()], f'mission {i + 1} left them'
        kept = sum(p.stat().st_size for p in cache.rglob('*') if p.is_file())
        assert kept <= LIMIT_BYTES, f'mission {i + 1}'
    third = max(1, len(peaks) // 3)
    print(f'peak memory {min(peaks)} to {max(peaks)} KiB, the last {peaks[-1]}')
    assert max(peaks[-third:]) <= FLAT * max(peaks[:third])


def test_missions_in_one_process(test_program, tmp_path, tries):
    missions = str(max(9, tries))  # fewer do not show what grows
    end = end_of(Gnbv(test_program('long_haul_test'), tmp_path, GNBV_MISSIONS=missions).start(),
                 timeout_s=None)
    print(end.out)
    assert end.code == 0, end.out[-2000:]
