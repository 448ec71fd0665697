"""`gnbv fly`: what it refuses, how it ends, what it prints, and that no flood stops its time.

Frames are written here anew, byte by byte (MAVLink 2, https://mavlink.io/en/guide/serialization).
"""
import ast
import itertools
import math
import re
import shutil
import signal
import socket
import struct
import subprocess
import threading
import time

import pytest
from program import end_of, until

PORT = 'smoke --mavlink udp://127.0.0.1:0'
LISTENS = r'gnbv: listening on udp://127.0.0.1:(\d+)'
CRC_EXTRA = {11: 89, 76: 152, 84: 143}
NUMBERS = itertools.count()


def frame(message_id, layout, *values):
    body = struct.pack('<' + layout, *values)
    packet = struct.pack('<BBBBBBHB', len(body), 0, 0, next(NUMBERS) % 256, 255, 190,
                         message_id & 0xffff, message_id >> 16) + body
    crc = 0xffff
    for byte in [*packet, CRC_EXTRA[message_id]]:  # X.25
        byte = (byte ^ crc) & 0xff
        byte ^= byte << 4 & 0xff
        crc = crc >> 8 ^ byte << 8 ^ byte << 3 ^ byte >> 4
    return b'\xfd' + packet + struct.pack('<H', crc & 0xffff)


@pytest.fixture
def flying(gnbv):
    """flying(line) -> a vehicle that listens, and its port."""
    processes = []

    def start(line):
        process = gnbv.start('fly', *line.split())
        processes.append(process)

        def port():
            process.files[1].seek(0)
            found = re.search(LISTENS, process.files[1].read().decode())
            process.port = found and int(found[1])
            return process.port

        until(30, 'it listens', port)
        return process

    yield start
    for process in processes:
        process.kill()
        process.wait()


@pytest.fixture
def client():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as udp:
        udp.bind(('127.0.0.1', 0))
        udp.settimeout(5)
        yield udp


def test_ends_after_its_duration_with_a_summary(run):
    flown = run(f'fly {PORT} --speed 20 --duration 2 --json').json
    assert (flown['end'], flown['flight_time_s'], flown['accepted']) == ('duration', 2.0, 0)
    assert flown['wall_s'] >= 0.09, 'not faster than asked for'
    assert flown['dropped']['bad_crc'] == 0
    end = run(f'fly {PORT} --speed 20 --duration 0.1', 'end: duration')
    assert re.match(LISTENS, end.err) and 'other machines' not in end.err
    run('fly smoke --mavlink udp://0.0.0.0:0 --speed 20 --duration 0.1',
        'can be reached from other machines')


def test_stands_on_terrain_where_there_is_any(run, tmp_path):
    def terrain(name, half_m):
        corners = ((-1, -1), (1, -1), (1, 1), (-1, 1))
        (tmp_path / name).write_text(
            ''.join(f'v {half_m * x} {half_m * y} {1 + 0.05 * half_m * x}\n' for x, y in corners)
            + 'f 1 2 3 4\n')
    terrain('hill.obj', 40)
    terrain('patch.obj', 1)
    run(f'fly {PORT} --set terrain.path=hill.obj --set start.position_m=[0,-2.8,3.5] --speed 20 --duration 1', 'end: duration')
    run(f'fly {PORT} --set terrain.path=patch.obj --set start.position_m=[0,-2.8,3.5] --duration 1', 'there is no terrain below x',
        code=2)
    run(f'fly {PORT} --set structure.ground=false --duration 1', 'structure.ground', code=2)


def test_is_hit_by_what_moves_when_it_comes(gnbv):
    cube = ('obstacles=[{box_m: {min: [-3, -3.3, 0], max: [-2, -2.3, 1]}, '
            'motion: {waypoints: [{offset_m: [6, 0, 0]}], speed_m_s: 1}}]')
    end = gnbv('fly', *PORT.split(), '--set', cube, '--set', 'start.jitter_m=[0, 0, 0]',
               '--speed', 20, '--duration', 5).check({1}, ['the vehicle hit an obstacle at ['])
    hull_m = 0.384  # of the Iris; the face is at x = t - 2
    assert abs(float(re.search(r'after ([\d.]+) s', end.err)[1]) - (2 - hull_m)) < 0.05


def test_speaks_first_to_where_its_client_waits(run, client):
    url = f'udpout://127.0.0.1:{client.getsockname()[1]}'
    end = run(f'fly smoke --speed 5 --duration 5 --mavlink {url} --set vehicle.estimate.model=gnss')
    assert end.err.startswith(f'gnbv: speaking to {url} from udp://127.0.0.1:')
    first = client.recv(2048)
    assert first[0] == 0xfd and first[7:10] == b'\0\0\0', 'a heartbeat'
    while (told := client.recv(2048))[7] != 32:
        pass
    place_m = struct.unpack_from('<3f', told, 14)
    assert math.hypot(*place_m) < 0.1, 'local NED counts from where it believes to stand'


def test_several_clients_hear_the_vehicle_under_its_number(run):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as a, \
            socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as b:
        links = []
        for udp in (a, b):
            udp.bind(('127.0.0.1', 0))
            udp.settimeout(5)
            links.append(f'--mavlink udpout://127.0.0.1:{udp.getsockname()[1]}')
        end = run(f'fly {" ".join(links)} smoke --set vehicle.system_id=7 --speed 5 --duration 5')
        assert end.err.count('gnbv: speaking to') == 2
        for udp in (a, b):
            first = udp.recv(2048)
            assert (first[0], first[5]) == (0xfd, 7) and first[7:10] == b'\0\0\0', 'a heartbeat'
    run('fly smoke --set vehicle.system_id=0', 'vehicle.system_id', code=2)
    run('fly smoke --local-origin nowhere', code=2)


def record_of(file):
    """Of a .npy file with one record: its fields, images as (shape, bytes)."""
    data = file.read_bytes()
    assert data[:8] == b'\x93NUMPY\x01\x00'
    begin = 10 + int.from_bytes(data[8:10], 'little')
    head = ast.literal_eval(data[10:begin].decode())
    assert begin % 64 == 0 and head['shape'] == () and not head['fortran_order']
    fields = {}
    for name, kind, *shape in head['descr']:
        count = math.prod(shape[0]) if shape else 1
        bytes_ = data[begin:begin + count * int(kind[2:])]
        begin += len(bytes_)
        values = struct.unpack(f'<{count}{dict(u8="Q", f8="d", f4="f", u1="B")[kind[1:]]}', bytes_)
        fields[name] = values if shape else values[0]
        fields[f'{name} shape'] = shape[0] if shape else ()
    assert begin == len(data)
    return fields


def newest(process, tmp_path, after=0):
    """The first frame of a camera after that one."""
    found = []

    def is_there():
        for file in (tmp_path / 'frames').glob('[!.]*.npy'):
            found[:] = [record_of(file)]
        return found and found[0]['sequence'] > after

    until(60, 'a frame', is_there)
    assert process.poll() is None
    return found[0]


def test_the_newest_frame_is_a_file_and_ends_with_the_flight(flying, tmp_path):
    process = flying(f'{PORT} --frames frames --frames-hz 20')
    first = newest(process, tmp_path)
    second = newest(process, tmp_path, after=first['sequence'] + 3)
    passed_s = second['time_s'] - first['time_s']
    assert passed_s >= 0.05 * (second['sequence'] - first['sequence']) - 0.02
    # the ground before a vehicle that stands on it: of every pixel of a row the same height
    height, width = second['depth_m shape']
    rows = [second['depth_m'][row * width:(row + 1) * width] for row in range(height)]
    row = max(r for r in range(height) if math.isfinite(sum(rows[r])))  # nearer ones are too near
    fx, _, cx, _, fy, cy = second['K'][:6]
    down = second['T_body_camera'][8:12]
    v = (row + 0.5 - cy) / fy
    heights_m = sorted(-rows[row][u] * (down[0] * (u + 0.5 - cx) / fx + down[1] * v + down[2])
                       for u in range(width))
    middle_m = heights_m[width // 2]
    assert 0.02 < middle_m < 0.5
    assert sum(abs(h - middle_m) < 2e-3 for h in heights_m) > 0.9 * width
    assert second['rgb shape'] == (height, width, 3) and len(set(second['rgb'])) > 20
    process.send_signal(signal.SIGINT)
    end = end_of(process)
    assert end.code == 0 and 'end: stopped' in end.out + end.err
    assert not list((tmp_path / 'frames').iterdir())


@pytest.mark.skipif(not shutil.which('ffmpeg'), reason='no ffmpeg')
def test_video_shows_what_the_frames_do(flying, client, tmp_path):
    port = client.getsockname()[1] & ~1  # RTCP takes the next one
    client.close()
    (tmp_path / 'video.sdp').write_text(
        f'v=0\no=- 0 0 IN IP4 127.0.0.1\ns=gnbv\nc=IN IP4 127.0.0.1\nt=0 0\n'
        f'm=video {port} RTP/AVP 96\na=rtpmap:96 H264/90000\n')
    process = flying(f'{PORT} --frames frames --video rtp://127.0.0.1:{port}')
    seen = subprocess.run(
        ['ffmpeg', '-v', 'error', '-protocol_whitelist', 'file,udp,rtp', '-i', 'video.sdp',
         '-frames:v', '1', '-f', 'rawvideo', '-pix_fmt', 'rgb24', '-'],
        cwd=tmp_path, capture_output=True, timeout=120).stdout
    frame = newest(process, tmp_path)['rgb']
    assert len(seen) == len(frame)
    assert sum(abs(a - b) for a, b in zip(seen, frame)) < 6 * len(frame), 'it stands still'


def test_touching_the_structure_is_a_failure_that_says_where(flying, client):
    """OFFBOARD, arming and the middle of the structure, asked for until it ends."""
    process = flying(f'{PORT} --speed 2 --duration 60 --local-origin scenario')
    while process.poll() is None:
        for packet in (frame(84, 'I11fHBBB', 0, 0, 0, -0.7, *[0] * 8, 2552, 1, 1, 1),
                       frame(11, 'IBB', 6 << 16, 1, 1),
                       frame(76, '7fHBBB', 1, *[0] * 6, 400, 1, 1, 0)):
            client.sendto(packet, ('127.0.0.1', process.port))
        time.sleep(0.02)
    end = end_of(process)
    assert end.code == 1 and 'hit the structure at [' in end.err, end


def test_frames_that_cannot_be_written_and_a_dead_ffmpeg_end_no_flight(gnbv, flying, tmp_path):
    (tmp_path / 'bin').mkdir()
    dies = tmp_path / 'bin' / 'ffmpeg'
    dies.write_text('#!/bin/sh\nexit 3\n')
    dies.chmod(0o755)
    gnbv.environment['PATH'] = f'{dies.parent}:{gnbv.environment["PATH"]}'
    process = flying(f'{PORT} --duration 4 --json --frames frames --video rtp://127.0.0.1:5600')
    newest(process, tmp_path)
    (tmp_path / 'frames').rename(tmp_path / 'gone')  # at once, whatever is written there now
    end = end_of(process)
    assert end.code == 0 and end.json['end'] == 'duration', end
    assert [end.err.count(each) for each in ('goes on without video', 'without frames')] == [1, 1]


# commands in MAVLink 1 that are too long, and positions in MAVLink 2 that are as long as a frame
# can be, which a newer sender may mean so: a CRC of 265 bytes at every tenth
@pytest.mark.parametrize('longest', [b'\xfe\xff\x4c', b'\xfd\xff\0\0\0\0\0\x1e\0\0'])
def test_a_flood_does_not_stop_time(flying, client, longest):
    process = flying(f'{PORT} --duration 3 --json')
    datagram = longest * (2040 // len(longest))
    is_over = threading.Event()

    def flood():
        while not is_over.is_set():
            for _ in range(100):
                client.sendto(datagram, ('127.0.0.1', process.port))
            time.sleep(0.01)  # 20 MB/s

    attacker = threading.Thread(target=flood)
    attacker.start()
    # a vehicle that refuses byte by byte flies a tenth of real time
    end = end_of(process, 30)
    is_over.set()
    attacker.join()
    assert end.code == 0 and end.json['datagrams'] > 1000, end


@pytest.mark.parametrize('words', [
    'smoke --mavlink udp://127.0.0.1:{taken}', 'smoke --mavlink tcp://127.0.0.1:14540',
    'smoke --mavlink udp://127.0.0.1', 'smoke --mavlink udpout://127.0.0.1:0',
    'smoke --mavlink udpout://0.0.0.0:14540',
    'smoke --mavlink udpout://127.0.0.1:14540 --mavlink udpout://localhost:14540', 'smoke --mavlink udp://8.8.8.8:14540',
    'smoke --mavlink udp://no-such-host.invalid:14540', f'{PORT} --speed 0', f'{PORT} --duration 0',
    f'{PORT} --frames /proc/none', f'{PORT} --video udp://127.0.0.1:5600',
    f'{PORT} --video rtp://127.0.0.1:0', f'{PORT} --video rtp://nowhere', f'{PORT} --frames f --frames-hz 0',
    f'{PORT} --set vehicle.kind=ideal', f'{PORT} --set structure.ground=false', 'no-such-scenario',
    # the tower's wall stands at x = 0.04: the start is above it, the ground below is in it
    f"{PORT} --set 'start={{position_m: [0.04, 0.12, 4], jitter_m: [0, 0, 0]}}'"])
def test_what_cannot_be_served_is_bad_input(run, client, words):
    words = words.replace('{taken}', str(client.getsockname()[1]))
    error = run(f'fly {words}', code=2).err
    assert 'listening' not in error and ('--video' not in words or 'udpout' not in error)
