"""How a mission's cost grows, as a curve: finer voxels, larger structures, a large site.

Tells a row a mission: voxels of the map, wall seconds of the views and of each stage, the largest
memory, and exponents against the row before: of time in voxels' edges (the steps of a candidate's
rays grow with the third power: one ray a voxel of the far plane, each longer) and of memory in
voxels. One mission each, on this machine as it is; --views of each (100), the site's twice as many.
"""
import math
import os

import pytest
from program import summary

VIEWS = 100
STAGES = ('sense', 'map', 'plan', 'fly')


def fly(gnbv, name, words, views):
    """Its wall seconds a stage and its largest memory in MiB."""
    out = gnbv.folder / name
    process = gnbv.start('run', *words, '--quiet', '--out', out, '--set',
                         f'planner.termination.max_iterations={views}')
    _, status, usage = os.wait4(process.pid, 0)
    assert status == 0, name
    flown = summary(out)
    wall_s = flown['wall_s']
    return {'name': name, 'wall_s': wall_s, 'mib': usage.ru_maxrss / 1024,
            'view_s': sum(wall_s[stage] for stage in STAGES) / max(flown['iterations'], 1)}


def sized(size_m, factor):
    """A workspace of the aircraft's shape."""
    x, y, z = (factor * side for side in size_m)
    return f'workspace_m={{min: [-{x / 2}, -{y / 2}, 0], max: [{x / 2}, {y / 2}, {z}]}}'


def finer_voxels(gnbv):
    return [(f'{m} m', ['aircraft', '--set', f'planner.map.resolution_m={m}'], (40, 40, 20), m,
             0.2 / m) for m in (0.2, 0.1, 0.05)]


def larger_structures(gnbv):
    gnbv('asset', 'aircraft', '-o', 'aircraft.ply').check({0})
    return [(f'aircraft x {k}', [
        'aircraft', '--mesh', 'aircraft.ply', '--set', f'structure.file.scale={k}', '--set',
        sized((40, 40, 20), k), '--set', f'start.position_m=[0, {-20 * k}, 5]'],
        (40 * k, 40 * k, 20 * k), 0.2, k) for k in (1, 2, 4)]


def large_site(gnbv):
    """The plant, four times as large, so that the site is full of it, with a LIDAR that reaches it
    from the faces of the workspace; the start in front of it."""
    gnbv('asset', 'power_plant', '-o', 'power_plant.ply').check({0})
    return [('200 x 200 x 50 m', [
        'power_plant', '--mesh', 'power_plant.ply', '--set', 'structure.file.scale=4', '--set',
        sized((200, 200, 50), 1), '--set', 'lidars.0.range_max_m=60', '--set',
        'start.position_m=[0, -58, 5]'], (200, 200, 50), 0.2, 1)]


@pytest.mark.parametrize('missions', [finer_voxels, larger_structures, large_site])
def test_growth(gnbv, views, tell, missions):
    tell(f"{missions.__name__:18}{'voxels':>14}{'s/view':>9}"
         + ''.join(f'{stage:>8}' for stage in (*STAGES, 'profile'))
         + f"{'MiB':>8}{'time ^':>8}{'memory ^':>10}")
    before = None
    for name, words, size_m, resolution_m, edges in missions(gnbv):
        row = fly(gnbv, name, words, (1 + (missions is large_site)) * views) | {'edges': edges}
        exponents = ('-', '-') if before is None else tuple(
            f'{math.log(row[key] / before[key]) / power / math.log(edges / before["edges"]):.2f}'
            for key, power in (('view_s', 1), ('mib', 3)))
        voxels = math.prod(round(side / resolution_m) for side in size_m)
        tell(f"{name:18}{voxels:>14,}{row['view_s']:>9.3f}"
             + ''.join(f"{row['wall_s'][stage]:>8.1f}" for stage in (*STAGES, 'profile'))
             + f"{row['mib']:>8.0f}{exponents[0]:>8}{exponents[1]:>10}")
        before = row
