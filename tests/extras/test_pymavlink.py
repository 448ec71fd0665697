"""The real pymavlink flies the vehicle, asks what ground stations ask, and goes away."""

import math
import threading
import time

import pytest
from conftest import free_port

mavutil = pytest.importorskip("pymavlink.mavutil")
mavlink = mavutil.mavlink

POSITION_AND_YAW = 2552  # type masks: all but these ignored
VELOCITY_AND_YAW = 2503
HOLD, RETURN = (4, 3), (4, 5)  # PX4's main and sub modes
OFFBOARD = (6, 0)
CAMERA_INFORMATION, VIDEO_STREAM_INFORMATION = 259, 269  # ids of MAVLink 2 alone


class Client:
    """A companion computer in pymavlink's words."""

    def __init__(self, url: str):
        self.link = mavutil.mavlink_connection(url, source_system=245, source_component=190)
        self.setpoint = None
        self.is_closed = threading.Event()
        self.streaming = threading.Thread(target=self._stream, daemon=True)

    def close(self):
        self.is_closed.set()
        if self.streaming.is_alive():
            self.streaming.join()
        self.link.close()

    def _stream(self):
        while not self.is_closed.wait(0.05):
            self.link.mav.set_position_target_local_ned_send(0, 1, 1, 1, *self.setpoint)

    def stream(self, *setpoint):
        self.setpoint = setpoint
        if not self.streaming.is_alive():
            self.streaming.start()

    def to(self, north_m, east_m, down_m, yaw_rad=0.0):
        self.stream(POSITION_AND_YAW, north_m, east_m, down_m, 0, 0, 0, 0, 0, 0, yaw_rad, 0)

    def at(self, north_m_s, east_m_s, down_m_s, yaw_rad=0.0):
        self.stream(VELOCITY_AND_YAW, 0, 0, 0, north_m_s, east_m_s, down_m_s, 0, 0, 0, yaw_rad, 0)

    def connect(self):
        self.link.mav.heartbeat_send(mavlink.MAV_TYPE_GCS, mavlink.MAV_AUTOPILOT_INVALID, 0, 0, 0)
        heartbeat = self.until("HEARTBEAT", lambda m: m.autopilot == mavlink.MAV_AUTOPILOT_PX4)
        # a client that this machine keeps waiting for a second is not a lost one
        self.link.mav.param_set_send(1, 1, b"COM_OF_LOSS_T", 4.0, mavlink.MAV_PARAM_TYPE_REAL32)
        self.until("PARAM_VALUE", lambda m: m.param_id == "COM_OF_LOSS_T")
        return heartbeat

    def until(self, kind, holds=lambda message: True, timeout_s=60.0):
        """The first such message that it holds for."""
        end = time.monotonic() + timeout_s
        last = None
        while time.monotonic() < end:
            message = self.link.recv_match(type=kind, blocking=True, timeout=1.0)
            if message is not None and holds(message):
                return message
            last = message or last
        raise AssertionError(f"no such {kind} in {timeout_s} s; the last: {last}")

    def command(self, command, *params, times=10):
        """MAV_RESULT, asked again while it is rejected for the moment."""
        for _ in range(times):
            self.link.mav.command_long_send(1, 1, command, 0, *(*params, *[0.0] * 7)[:7])
            ack = self.until("COMMAND_ACK", lambda m: m.command == command)
            if ack.result != mavlink.MAV_RESULT_TEMPORARILY_REJECTED:
                break
            time.sleep(0.2)
        return ack.result

    def set_mode(self, mode):
        return self.command(mavlink.MAV_CMD_DO_SET_MODE, 1, *mode)

    def position(self):
        return self.until("LOCAL_POSITION_NED")

    def reach(self, north_m, east_m, down_m, within_m=0.4):
        return self.until("LOCAL_POSITION_NED", lambda m: math.dist(
            (m.x, m.y, m.z), (north_m, east_m, down_m)) < within_m)

    def take_off(self):
        """2.5 m above the ground in OFFBOARD; where it stood."""
        start = self.position()
        assert self.command(mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 1) == 0
        assert self.command(mavlink.MAV_CMD_NAV_TAKEOFF, 0, 0, 0, 0, 0, 0, math.nan) == 0
        self.until("LOCAL_POSITION_NED", lambda m: m.z < -2.3)
        self.to(start.x, start.y, -2.5)
        assert self.set_mode(OFFBOARD) == 0
        return start

    def until_disarmed(self):
        return self.until("HEARTBEAT", lambda m: m.autopilot == mavlink.MAV_AUTOPILOT_PX4
                          and not m.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED)


@pytest.fixture
def connected():
    clients = []

    def connect(url):
        clients.append(Client(url))
        clients[-1].connect()
        return clients[-1]

    yield connect
    for client in clients:
        client.close()


def mode_of(heartbeat):
    return heartbeat.custom_mode >> 16 & 255, heartbeat.custom_mode >> 24


def test_flies_squares_turns_returns_and_lands(fly, connected):
    vehicle = fly()
    client = connected(f"udpin:127.0.0.1:{vehicle.port}")
    client.link.mav.param_set_send(1, 1, b"RTL_RETURN_ALT", 5.0, mavlink.MAV_PARAM_TYPE_REAL32)
    assert client.until("PARAM_VALUE").param_value == 5.0
    start = client.take_off()

    for north, east in ((5, 0), (5, 5), (0, 5), (0, 0)):
        client.to(start.x + north, start.y + east, -3.0)
        at = client.reach(start.x + north, start.y + east, -3.0)
        print(f"corner {north} {east} reached at {at.time_boot_ms / 1000} s")

    for north, east in ((1, 0), (0, 1), (-1, 0), (0, -1)):
        begin = client.position()
        client.at(north, east, 0.0)
        side = client.until("LOCAL_POSITION_NED", lambda m, begin=begin: math.dist(
            (m.x, m.y), (begin.x, begin.y)) > 2.5)
        along = (side.x - begin.x) * north + (side.y - begin.y) * east
        assert along > 2.0, "it flies where it is told to"
        assert math.hypot(side.vx, side.vy) < 1.6

    for yaw_rad in (math.pi / 2, -2.0):
        client.to(start.x, start.y, -3.0, yaw_rad)
        client.until("ATTITUDE", lambda m, wanted=yaw_rad: abs(
            math.remainder(m.yaw - wanted, math.tau)) < 0.1)

    client.to(start.x + 4, start.y + 4, -3.0)
    client.reach(start.x + 4, start.y + 4, -3.0)
    assert client.set_mode(RETURN) == 0
    client.until("EXTENDED_SYS_STATE",
                 lambda m: m.landed_state == mavlink.MAV_LANDED_STATE_ON_GROUND, 120)
    client.until_disarmed()
    end = client.position()
    assert math.dist((end.x, end.y), (start.x, start.y)) < 1.0, "home is where it was armed"
    summary = vehicle.end()
    assert summary["setpoints"] > 100 and summary["refused_setpoints"] == 0
    assert not any(summary["dropped"].values()), "pymavlink's frames are all understood"


def test_a_lost_client_is_missed_and_may_come_back(fly, connected):
    vehicle = fly()
    client = connected(f"udpin:127.0.0.1:{vehicle.port}")
    client.take_off()
    client.until("HEARTBEAT", lambda m: mode_of(m) == OFFBOARD)
    client.close()
    time.sleep(6.0)  # more than COM_OF_LOSS_T

    again = connected(f"udpin:127.0.0.1:{vehicle.port}")
    heartbeat = again.until("HEARTBEAT", lambda m: m.autopilot == mavlink.MAV_AUTOPILOT_PX4)
    assert mode_of(heartbeat) == HOLD and heartbeat.system_status == mavlink.MAV_STATE_CRITICAL
    assert heartbeat.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED
    assert again.position().z < -1.0, "it stays where it is"
    assert again.command(mavlink.MAV_CMD_NAV_LAND) == 0
    again.until_disarmed()
    vehicle.end()


def test_ground_stations_are_answered_in_order(fly, connected):
    vehicle = fly()
    client = connected(f"udpin:127.0.0.1:{vehicle.port}")

    client.link.mav.param_request_list_send(1, 1)
    first = client.until("PARAM_VALUE")
    values = {first.param_index: first}
    while len(values) < first.param_count:
        value = client.until("PARAM_VALUE")
        values[value.param_index] = value
    print(*sorted(f"{v.param_id} {v.param_value}" for v in values.values()), sep="\n")
    client.link.mav.param_request_read_send(1, 1, b"MIS_TAKEOFF_ALT", -1)
    assert client.until("PARAM_VALUE").param_value == 2.5
    client.link.mav.param_request_read_send(1, 1, b"NO_SUCH_THING", -1)
    assert "NO_SUCH_THING" in client.until("STATUSTEXT").text

    for kind in (mavlink.MAV_MISSION_TYPE_FENCE, mavlink.MAV_MISSION_TYPE_RALLY):
        client.link.mav.mission_request_list_send(1, 1, kind)
        count = client.until("MISSION_COUNT")
        assert (count.count, count.mission_type) == (0, kind)
        client.link.mav.mission_count_send(1, 1, 3, kind)
        assert client.until("MISSION_ACK").type == mavlink.MAV_MISSION_UNSUPPORTED

    request = mavlink.MAV_CMD_REQUEST_MESSAGE
    assert client.command(mavlink.MAV_CMD_REQUEST_AUTOPILOT_CAPABILITIES, 1) == 0
    client.link.mav.command_long_send(1, 1, request, 0, 148, 0, 0, 0, 0, 0, 0)
    version = client.until("AUTOPILOT_VERSION")
    assert client.until("COMMAND_ACK").result == 0, "and the acknowledgement behind it"
    assert version.capabilities & mavlink.MAV_PROTOCOL_CAPABILITY_MAVLINK2
    assert client.command(request, 300) == 0, "PROTOCOL_VERSION"
    unsupported = mavlink.MAV_RESULT_UNSUPPORTED
    assert client.command(request, 397) == unsupported, "COMPONENT_METADATA"
    assert client.command(mavlink.MAV_CMD_DO_REPOSITION) == unsupported

    client.link.mav.timesync_send(0, 123456789)
    assert client.until("TIMESYNC").ts1 == 123456789
    summary = vehicle.end()
    assert not any(summary["dropped"].values()) and summary["ignored"] == 0


def test_a_camera_says_where_its_video_goes(fly, connected):
    vehicle = fly("--video", f"rtp://127.0.0.1:{free_port()}")
    client = connected(f"udpin:127.0.0.1:{vehicle.port}")
    client.until("HEARTBEAT", lambda m: m.type == mavlink.MAV_TYPE_CAMERA
                 and m.get_srcComponent() == mavlink.MAV_COMP_ID_CAMERA)
    for kind in (CAMERA_INFORMATION, VIDEO_STREAM_INFORMATION):
        client.link.mav.command_long_send(1, mavlink.MAV_COMP_ID_CAMERA,
                                          mavlink.MAV_CMD_REQUEST_MESSAGE, 0, kind, 0, 0, 0, 0, 0, 0)
    camera = client.until("CAMERA_INFORMATION")
    assert bytes(camera.vendor_name).startswith(b"gnbv")
    assert camera.flags == mavlink.CAMERA_CAP_FLAGS_HAS_VIDEO_STREAM
    video = client.until("VIDEO_STREAM_INFORMATION")
    assert (video.framerate, video.resolution_h) == (10.0, camera.resolution_h)
    assert (video.type, video.encoding) == (mavlink.VIDEO_STREAM_TYPE_RTPUDP,
                                            mavlink.VIDEO_STREAM_ENCODING_H264)


def test_a_mission_is_uploaded_read_back_and_flown(fly, connected):
    vehicle = fly()
    client = connected(f"udpin:127.0.0.1:{vehicle.port}")
    home = client.until("HOME_POSITION")

    def item(command, north_m, east_m, up_m, hold_s=0):
        return (6, command, 0, 1, hold_s, 0, 0, math.nan, home.latitude + round(north_m * 89.9),
                home.longitude + round(east_m * 132.8), up_m)

    corners = [(1.5, 0), (1.5, 1.5), (0, 1.5)]
    items = [item(mavlink.MAV_CMD_NAV_TAKEOFF, 0, 0, 3),
             *(item(mavlink.MAV_CMD_NAV_WAYPOINT, n, e, 3, 1) for n, e in corners),
             item(mavlink.MAV_CMD_NAV_LAND, 0, 1.5, 0)]
    client.link.mav.mission_count_send(1, 1, len(items), 0)
    for _ in items:
        seq = client.until("MISSION_REQUEST_INT").seq
        client.link.mav.mission_item_int_send(1, 1, seq, *items[seq], 0)
    assert client.until("MISSION_ACK").type == mavlink.MAV_MISSION_ACCEPTED
    client.link.mav.mission_request_list_send(1, 1, 0)
    assert client.until("MISSION_COUNT").count == len(items)
    for seq, wanted in enumerate(items):
        client.link.mav.mission_request_int_send(1, 1, seq, 0)
        got = client.until("MISSION_ITEM_INT")
        assert (got.seq, got.command, got.x, got.y, got.z) == (seq, wanted[1], *wanted[8:])

    assert client.command(mavlink.MAV_CMD_MISSION_START, 0, 0) == 0
    for seq in range(len(items)):
        assert client.until("MISSION_ITEM_REACHED").seq == seq
    client.until_disarmed()
    end = client.position()
    assert math.dist((end.x, end.y), (0, 1.5)) < 0.7, "local places count from home"
    vehicle.end()


def test_a_ground_station_listens_beside_the_program(fly, connected):
    """The connection of a ground station, in the words of mavlink.io's services."""
    port = free_port()
    vehicle = fly("--mavlink", f"udpout://127.0.0.1:{port}",
                  "--mavlink", f"udpout://127.0.0.1:{port + 1}", port=port)
    program = connected(f"udpin:127.0.0.1:{port}")
    station = connected(f"udpin:127.0.0.1:{port + 1}")
    for command, message in ((148, "AUTOPILOT_VERSION"), (42, "MISSION_CURRENT"),
                             (242, "HOME_POSITION"), (331, "ODOMETRY"), (105, "HIGHRES_IMU")):
        station.link.mav.command_long_send(1, 1, mavlink.MAV_CMD_REQUEST_MESSAGE, 0, command,
                                           0, 0, 0, 0, 0, 0)
        station.until(message)
    for kind in range(3):
        station.link.mav.mission_request_list_send(1, 1, kind)
        assert station.until("MISSION_COUNT").count == 0
    while program.link.recv_match() is not None:
        pass  # what it was not read for; a full buffer would lose the answer
    assert program.command(mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 1) == 0
    station.until("STATUSTEXT", lambda m: m.text.startswith("Local NED counts from"))
    station.until("HEARTBEAT", lambda m: m.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED)
    vehicle.end()
