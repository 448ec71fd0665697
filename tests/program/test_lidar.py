"""Missions whose only sensor is a LIDAR."""
import signal

import pytest
from program import difference, hash_of, until

LIDAR = ('--quiet', '--set', 'cameras=[]', '--set')
VLP16 = 'lidars=[{preset: velodyne_vlp16, pitch_deg: 0}]'
AVIA = 'lidars=[{preset: livox_avia, pitch_deg: 0, looks: flight}]'


@pytest.mark.parametrize('lidar, utility', [(VLP16, 'proposed'), (VLP16, 'tour'), (AVIA, 'tour')])
def test_a_mission_is_the_same_on_any_threads_stopped_and_resumed(gnbv, tmp_path, lidar, utility):
    words = ('run', 'smoke', *LIDAR, lidar, '--utility', utility,
             '--set', 'planner.profiling.method=none', '--candidates')
    gnbv(*words, '--threads', 1, '--out', 'one').check({0})
    journal = tmp_path / 'two/iterations.csv.part'
    process = gnbv.start(*words, '--threads', 2, '--out', 'two')
    until(60, 'three views', lambda: journal.exists() and journal.read_text().count('\n') > 3)
    process.send_signal(signal.SIGINT)
    process.wait(60)
    gnbv(*words, '--threads', 2, '--out', 'two', '--resume').check({0})
    assert hash_of(tmp_path / 'one') == hash_of(tmp_path / 'two')
    assert not difference(tmp_path / 'one', tmp_path / 'two')


@pytest.mark.parametrize('words, says', [
    (['--set', 'lidars=[]'], ['cameras', 'at least one has to look']),
    (['--frames'], ['--frames', 'no camera']),
    (['--set', 'lidars.0.pattern=spinning', '--set', 'lidars.0.elevation_min_deg=20'],
     ['elevation_min_deg'])])
def test_what_cannot_look_is_refused(gnbv, tmp_path, words, says):
    end = gnbv('run', 'smoke', '--quiet', '--set', 'cameras=[]', *words, '--out', 'run').check({2})
    assert all(word in end.err for word in says), end.err
    assert not (tmp_path / 'run').exists()
