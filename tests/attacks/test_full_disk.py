"""Commands on disks of every size: exit code 0 or 1, the cause named, and the run goes on."""
import pytest
from program import difference

TRIES = 12
SMOKE = ['smoke', '--set', 'planner.termination.max_iterations=6', '--quiet']
FRAMES = ['--frames', '--candidates']
SWEEP = 'scenarios: smoke\nutilities: [proposed]\nseeds: 2\n'
MAKERS = {
    'plot': ['plot', '{run}', '--format', 'svg,png,pdf', '-o', 'disk/plots'],
    'report': ['report', '{run}', '-o', 'disk/page.html'],
    **{f'export {form}': ['export', '{run}', '--format', form, '-o', f'disk/{form}']
       for form in ('tum', 'plain', 'colmap', 'nerfstudio')},
    'surface': ['surface', '{run}', '-o', 'disk/surface'],
    'render': ['render', '{run}', '-o', 'disk/path.png'],
    'asset': ['asset', 'smoke', '-o', 'disk/smoke.glb'],
    'sweep': ['sweep', 'sweep.yaml', '--quiet', '--out', 'disk/sweep'],
}


@pytest.mark.parametrize('more', [[], FRAMES], ids=['plain', 'frames'])
def test_a_run_that_fills_the_disk_goes_on_elsewhere(gnbv, whole, on_disk, tmp_path, dice, more,
                                                     attempt):
    command = ['run', *SMOKE, *more, '--out']
    undisturbed = whole(*command).path
    kib = sum(p.stat().st_size for p in undisturbed.rglob('*')) // 1024
    on_disk(f'size={dice.randrange(4, kib)}k')(*command, 'disk/run').check(
        {0, 1}, ['No space left'])
    gnbv(*command, 'rescued/run', '--resume').check({0})
    assert not difference(tmp_path / 'rescued/run', undisturbed)


@pytest.mark.parametrize('maker', MAKERS)
def test_what_does_not_fit_is_said(whole, on_disk, tmp_path, dice, maker, attempt):
    run = whole('run', *SMOKE, *FRAMES, '--out').path
    (tmp_path / 'sweep.yaml').write_text(SWEEP)
    gnbv = on_disk(f'size={dice.choice([4, 8, 16, 32, 64, 128])}k')
    end = gnbv(*[word.format(run=run) for word in MAKERS[maker]]).check({0, 1}, ['No space left'])
    empty = [p for p in (tmp_path / 'rescued').rglob('*') if p.is_file() and not p.stat().st_size]
    assert end.code or not empty
