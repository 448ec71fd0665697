"""What nobody tuned to: random structures are clean, and missions around them end for a reason.

Lints structures of every kind and flies coarse missions of 20 views around each, with every utility
that scores candidates by the map (tests/end_to_end/random_missions_test.cpp). --tries of each kind.
"""
import collections
import subprocess

import pytest
from program import Gnbv, end_of

TRIES = 26  # makes 208 structures


def pytest_generate_tests(metafunc):
    if 'kind' in metafunc.fixturenames:
        listed = subprocess.run([metafunc.config.option.gnbv, 'asset', '--list'],
                                capture_output=True, check=True, text=True).stdout
        kinds = [line.split()[-1] for line in listed.splitlines() if line.startswith('random')]
        metafunc.parametrize('kind', kinds)


def test_is_usable_without_a_warning(gnbv, kind, attempt):
    gnbv('asset', 'random', '--kind', kind, '--seed', attempt + 1, '-o', 'r.ply').check({0})
    found = gnbv('lint', 'r.ply', '--bounds', 'auto').check({0})
    assert 'usable: 0 errors, 0 warnings' in found.out + found.err


def test_missions_go_on_while_a_frontier_can_be_reached(test_program, tmp_path, request, tell):
    tries, table = request.config.option.tries or TRIES, tmp_path / 'missions.csv'
    end = end_of(Gnbv(test_program('random_missions_test'), tmp_path,
                      GNBV_RANDOM_SEEDS=f'1-{tries}', GNBV_RANDOM_TABLE=str(table)).start(), None)
    rows = [line.split(',') for line in table.read_text().splitlines()]
    early = collections.Counter(row[0] for row in rows if row[4] != 'max_iterations')
    for kind, flown in collections.Counter(row[0] for row in rows).items():
        tell(f'{kind:8} {flown:6} missions, {early[kind]} of them ended early')
    assert end.code == 0, end.out[-3000:]
