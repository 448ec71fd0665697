"""One hash of a portable mission: by every instruction set, on processors of both makers.

Embree and our vector code are held to each instruction set (one that the processor lacks is its
next lower one), and qemu-user, where it is installed, plays processors of Intel and AMD. --tries
says on how many a mission is flown (all without it), and --views how far: qemu takes a minute for a
few views.
"""
import itertools
import shutil

import pytest
from program import Gnbv, hash_of

VIEWS = 400
EMBREE = ('avx512', 'sse2', 'avx2', 'avx', 'sse4.2')
SIMD = ('avx512', 'baseline', 'avx2')
OURS = [(isa, SIMD[i % 3]) for i, isa in enumerate(EMBREE)]  # each once, then the other pairs
OURS += [pair for pair in itertools.product(EMBREE, SIMD) if pair not in OURS]
PROCESSORS = ('EPYC', 'Haswell', 'Nehalem', 'Opteron_G3,+sse4.1,+sse4.2,+ssse3', 'Skylake-Client')
UNFUSED = 'glibc.cpu.hwcaps=-FMA,-FMA4'  # started again, the program would leave qemu
TASKS = ('smoke', 'hall-1', 'truss-3', 'hull-2', 'crane-1')
MISSIONS = {
    'noise, movers and gusts': [
        'cameras.0.noise.model=stereo', 'lidars.0.range_sigma_m=0.01', 'wind.gust_w20_m_s=3',
        'obstacles=[{box_m: {min: [3, -2, 0], max: [3.3, -1.7, 1]}, '
        'motion: {waypoints: [{offset_m: [0, 3, 0]}]}}]'],
    'tour': ['planner.utility.name=tour', 'vehicle.estimate.model=rtk'],
}


def fly(gnbv, words, run):
    gnbv('run', *words, '--quiet', '--threads', 2, '--out', run, timeout_s=6000).check({0})
    return hash_of(run)


def scenario_of(gnbv, mission, folder):
    """Of a task of the suite's, or of smoke with the mission's settings."""
    if mission in TASKS:
        words = f'bench run --track small --planner proposed --task {mission} -o task --quiet'
        Gnbv(gnbv.path, folder)(*words.split(), timeout_s=6000).check({0})
        return [next(folder.glob('task/cells/*/scenario.yaml'))]
    return ['smoke', *itertools.chain(*(('--set', s) for s in MISSIONS[mission]))]


def words_of(gnbv, mission, folder, views):
    return [*scenario_of(gnbv, mission, folder), '--portable', '--set',
            f'planner.termination.max_iterations={views}']


@pytest.mark.parametrize('mission', [*MISSIONS, *TASKS])
def test_instruction_sets_agree(gnbv, tmp_path, request, views, mission):
    words = words_of(gnbv, mission, tmp_path, views)
    hashes = {}
    for isa, simd in OURS[:request.config.option.tries]:
        program = Gnbv(gnbv.path, tmp_path, GNBV_EMBREE=f'max_isa={isa}', GNBV_SIMD=simd)
        hashes.setdefault(fly(program, words, tmp_path / f'{isa}-{simd}'), []).append((isa, simd))
    print(mission, hashes)
    assert len(hashes) == 1, hashes


@pytest.mark.skipif(not shutil.which('qemu-x86_64'), reason='no qemu-user')
@pytest.mark.parametrize('mission', [*MISSIONS, *TASKS])
def test_processors_agree(gnbv, tmp_path, request, views, mission):
    words = words_of(gnbv, mission, tmp_path, views)
    hashes = {fly(gnbv, words, tmp_path / 'here'): ['here']}
    for cpu in PROCESSORS[:request.config.option.tries]:
        program = Gnbv(gnbv.path, tmp_path, ['qemu-x86_64', '-cpu', cpu], GLIBC_TUNABLES=UNFUSED)
        hashes.setdefault(fly(program, words, tmp_path / cpu), []).append(cpu)
    print(mission, hashes)
    assert len(hashes) == 1, hashes
