#!/usr/bin/env python3
"""Ten scenarios at several numbers of threads and every instruction set: one hash each.

With --also, another build of the same commit, clang's say, has to give that hash, too.
--tries is the number of views of each mission. An instruction set that the processor lacks is
its next lower one, and counts all the same.
"""
import itertools
import json
import shutil
import tempfile
from pathlib import Path

from run_attack import Gnbv, Table, arguments, complaint

THREADS = (1, 2, 3, 8)
SIMD = ('baseline', 'avx2', 'avx512')
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


def hash_of(gnbv, words, threads, simd, out):
    gnbv.environment['GNBV_SIMD'] = simd
    shutil.rmtree(out, ignore_errors=True)
    done = gnbv('run', *words, '--threads', threads, '--quiet', '--out', out)
    wrong = complaint(done)
    if wrong or done.returncode != 0:
        return None, wrong or done.stderr.decode(errors='replace')[-300:]
    found = json.loads((out / 'summary.json').read_text())['result_sha256']
    return found, None


def main():
    def extra(parser):
        parser.add_argument('--scenarios', default='', help='only those whose name holds this')
        parser.add_argument('--also', type=Path, action='append', default=[],
                            help='another build of the program; repeatable')

    options = arguments(__doc__, tries=6, extra=extra)
    table = Table()
    with tempfile.TemporaryDirectory(prefix='gnbv_attack_') as name:
        folder = Path(name)
        programs = [Gnbv(path, folder) for path in
                    (options.gnbv, *(also.resolve() for also in options.also))]
        for kind, words in SCENARIOS.items():
            if options.scenarios not in kind:
                continue
            words = [*words, '--set', f'planner.termination.max_iterations={options.tries}']
            first = None
            for gnbv, threads, simd in itertools.product(programs, THREADS, SIMD):
                found, wrong = hash_of(gnbv, words, threads, simd, folder / 'run')
                first = first or found
                if wrong is None and found != first:
                    wrong = f'{found[:10]} instead of {first[:10]}'
                table.count(kind, wrong and f'{gnbv.path}, {threads} threads, {simd}: {wrong}')
    return table.end()


if __name__ == '__main__':
    raise SystemExit(main())
