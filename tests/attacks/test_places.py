"""Folders that vanish, move or cannot be written, and clocks that jump.

A mission whose folder goes away ends with its name, or finds what it needs. A run on a read-only
disk can be read by all commands that write elsewhere. Clocks that jump (where libfaketime is
installed) change no result.
"""
import glob
import shutil
import time

import pytest
from program import Gnbv, end_of, hash_of

TRIES = 10
SMOKE = ['smoke', '--set', 'planner.termination.max_iterations=30', '--quiet']
FLY = ['run', *SMOKE, '--frames', '--out']
FAKETIME = glob.glob('/usr/lib/*/faketime/libfaketimeMT.so.1')
VANISHING = {
    'the run removed': lambda place: shutil.rmtree(place / 'run', ignore_errors=True),
    'the folder above removed': lambda place: shutil.rmtree(place, ignore_errors=True),
    'the run moved': lambda place: (place / 'run').exists() and
    (place / 'run').rename(place.parent / 'moved'),
}
READ_ONLY = (
    ('run smoke --quiet --out disk/new', {1, 2}),
    (f'run {" ".join(SMOKE)} --resume --out disk/run', {0, 1, 2}),
    ('score disk/run', {0}),
    ('score disk/run --update', {1, 2}),
    ('render disk/run -o out.png', {0}),
    ('render disk/run', {1, 2}),
    ('plot disk/run -o out', {0}),
    ('plot disk/run', {1, 2}),
    ('report disk/run -o out.html', {0}),
    ('report disk/run', {1, 2}),
    ('surface disk/run -o out', {0}),
    ('surface disk/run', {1, 2}),
    ('export disk/run --format tum -o out', {0}),
    ('export disk/run --format tum', {1, 2}),
    ('table lab_model --quiet --out disk/cells', {1, 2}),
    ('asset smoke -o disk/smoke.obj', {1, 2}),
)


@pytest.mark.parametrize('how', VANISHING)
def test_a_folder_that_goes_away_is_named(gnbv, whole, tmp_path, dice, how, attempt):
    place = tmp_path / 'vanishing'
    place.mkdir()
    process = gnbv.start(*FLY, place / 'run')
    time.sleep(dice.uniform(0.0, whole(*FLY).takes_s))
    VANISHING[how](place)
    end_of(process).check(names=['run'])


@pytest.mark.parametrize('words, codes', READ_ONLY)
def test_a_read_only_disk_is_read_and_not_written(whole, on_disk, words, codes):
    gnbv = on_disk('size=200m', f'cp -r {whole(*FLY).path} disk/run && mount -o remount,ro disk')
    gnbv(*words.split()).check(codes, ['Read-only file system'])


@pytest.mark.skipif(not FAKETIME, reason='needs Debian\'s package faketime')
def test_a_clock_that_jumps_changes_no_result(gnbv, whole, tmp_path, dice, attempt):
    clock = tmp_path / 'clock'
    clock.write_text('+0\n')
    process = Gnbv(gnbv.path, tmp_path, LD_PRELOAD=FAKETIME[0], FAKETIME_TIMESTAMP_FILE=str(clock),
                   FAKETIME_NO_CACHE='1').start('run', *SMOKE, '--out', tmp_path / 'run')
    for _ in range(6):
        time.sleep(0.1)
        clock.write_text(dice.choice(['+10y', '-10y', '+1h', '-1h', '+0', '-3', '+3']) + '\n')
    end_of(process).check({0})
    assert hash_of(tmp_path / 'run') == hash_of(whole(*FLY).path)
