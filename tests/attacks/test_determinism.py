"""Ten scenarios at several numbers of threads and every instruction set: one hash each.

An instruction set that the processor lacks is its next lower one, and counts all the same. The hash
of another build of the same commit, clang's say, is printed by it, too: --gnbv, and -s to see it.
"""
import pytest
from program import Gnbv, hash_of

VIEWS = 6
SCENARIOS = {
    'smoke, proposed': ['smoke'],
    'smoke, tour': ['smoke', '--utility', 'tour'],
    'smoke, bircher_volume': ['smoke', '--utility', 'bircher_volume'],
    'smoke, kriegel, A*': ['smoke', '--utility', 'kriegel', '--set', 'planner.validity.path=astar'],
    'smoke, stereo noise': ['smoke', '--utility', 'isler',
                            '--set', 'cameras.0.noise.model=stereo'],
    'smoke, GNSS': ['smoke', '--set', 'vehicle.estimate.model=gnss'],
    'smoke, gusts': ['smoke', '--set', 'wind.gust_w20_m_s=7.7'],
    'smoke, frames in flight': ['smoke', '--set', 'cameras.0.rate_hz=5'],
    'smoke, coarse': ['smoke', '--utility', 'random', '--set', 'planner.map.resolution_m=0.3'],
    'lab_model': ['lab_model'],
}


@pytest.mark.parametrize('scenario', SCENARIOS)
def test_one_hash(gnbv, tmp_path, views, scenario):
    hashes = {}
    for threads in (1, 2, 3, 8):
        for simd in ('baseline', 'avx2', 'avx512'):
            run = tmp_path / f'{threads}-{simd}'
            Gnbv(gnbv.path, tmp_path, GNBV_SIMD=simd)(
                'run', *SCENARIOS[scenario], '--threads', threads, '--quiet', '--out', run,
                '--set', f'planner.termination.max_iterations={views}').check({0})
            hashes.setdefault(hash_of(run), []).append((threads, simd))
    print(scenario, *hashes)
    assert len(hashes) == 1, hashes
