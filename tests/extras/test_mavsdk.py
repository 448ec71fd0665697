"""The real MAVSDK flies the vehicle, by default where PX4 speaks: to port 14540."""

import asyncio
import math
import socket

import pytest
from conftest import first, is_at

mavsdk = pytest.importorskip("mavsdk.asyncio", reason="needs mavsdk >= 4")
from mavsdk import ComponentType, Configuration  # noqa: E402
from mavsdk.asyncio.plugins.action import ActionAsync  # noqa: E402
from mavsdk.asyncio.plugins.mission_raw import MissionRawAsync  # noqa: E402
from mavsdk.asyncio.plugins.offboard import OffboardAsync  # noqa: E402
from mavsdk.asyncio.plugins.param import ParamAsync  # noqa: E402
from mavsdk.asyncio.plugins.telemetry import TelemetryAsync  # noqa: E402
from mavsdk.plugins.offboard import (  # noqa: E402
    PositionNedYaw,
    VelocityBodyYawspeed,
    VelocityNedYaw,
)
from mavsdk.plugins.telemetry import LandedState  # noqa: E402


async def fly_square(system):
    action, offboard, telemetry = (kind(system) for kind in
                                   (ActionAsync, OffboardAsync, TelemetryAsync))
    health = await first(telemetry.subscribe_health(), lambda h: h.is_global_position_ok
                         and h.is_home_position_ok and h.is_local_position_ok and h.is_armable)
    print(health)
    # a client that this machine keeps waiting for a second is not a lost one
    await ParamAsync(system).set_param_float("COM_OF_LOSS_T", 4.0)
    await telemetry.set_rate_position_velocity_ned(20.0)
    await telemetry.set_rate_attitude_euler(10.0)
    await action.set_takeoff_altitude(3.0)
    assert await action.get_takeoff_altitude() == 3.0
    await action.set_return_to_launch_altitude(5.0)
    start = (await first(telemetry.subscribe_position_velocity_ned())).position
    north, east = start.north_m, start.east_m

    await action.arm()
    await first(telemetry.subscribe_armed(), bool)
    await action.takeoff()
    await first(telemetry.subscribe_position(), lambda p: p.relative_altitude_m > 2.7)

    await offboard.set_position_ned(PositionNedYaw(north, east, -3.0, 0.0))
    await offboard.start()
    assert await offboard.is_active()
    for n, e in ((5, 0), (5, 5), (0, 5), (0, 0)):
        await offboard.set_position_ned(PositionNedYaw(north + n, east + e, -3.0, 0.0))
        print("corner", await first(telemetry.subscribe_position_velocity_ned(),
                                    is_at(north + n, east + e, -3.0)))
    for n, e in ((1, 0), (0, 1), (-1, 0), (0, -1)):
        await offboard.set_velocity_ned(VelocityNedYaw(n, e, 0.0, 0.0))
        velocity = await first(telemetry.subscribe_velocity_ned(), lambda v, wanted=(n, e):
                               math.dist((v.north_m_s, v.east_m_s), wanted) < 0.2)
        print("velocity", velocity)
    await offboard.set_velocity_body(VelocityBodyYawspeed(0.0, 0.0, 0.0, 45.0))
    await first(telemetry.subscribe_attitude_euler(), lambda a: abs(a.yaw_deg) > 90)
    await offboard.set_position_ned(PositionNedYaw(north + 3, east + 3, -3.0, 90.0))
    await first(telemetry.subscribe_attitude_euler(), lambda a: abs(a.yaw_deg - 90) < 5)
    await first(telemetry.subscribe_position_velocity_ned(), is_at(north + 3, east + 3, -3.0))
    await offboard.stop()

    await action.return_to_launch()
    await first(telemetry.subscribe_landed_state(), lambda s: s == LandedState.ON_GROUND, 120)
    await first(telemetry.subscribe_armed(), lambda armed: not armed)
    home = (await first(telemetry.subscribe_position_velocity_ned())).position
    assert math.dist((home.north_m, home.east_m), (north, east)) < 1.0

    await action.arm()  # and once more, to land where it is
    await action.takeoff()
    await first(telemetry.subscribe_position(), lambda p: p.relative_altitude_m > 2.0)
    await action.land()
    await first(telemetry.subscribe_armed(), lambda armed: not armed, 120)


async def ask(system):
    parameters = await ParamAsync(system).get_all_params()
    print(len(parameters.float_params), "parameters of numbers,",
          len(parameters.int_params), "of integers")
    assert len(parameters.float_params) > 20 and len(parameters.int_params) > 10
    raw = MissionRawAsync(system)
    assert len(await raw.download_mission()) == 0


async def meet(url, *conversations):
    configuration = Configuration.create_with_component_type(ComponentType.GROUND_STATION)
    async with mavsdk.Mavsdk(configuration) as sdk:
        print("MAVSDK", await sdk.version())
        await sdk.add_any_connection(url)
        system = await sdk.first_autopilot(timeout_s=30.0)
        assert system is not None, "no autopilot in 30 s"
        for converse in conversations:
            await converse(system)


def test_flies_as_it_flies_px4(fly):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.bind(("0.0.0.0", 14540))
        except OSError:
            pytest.skip("somebody else waits at port 14540")
    vehicle = fly(port=14540)
    asyncio.run(meet("udpin://0.0.0.0:14540", fly_square))
    summary = vehicle.end()
    assert summary["setpoints"] > 100 and summary["refused_setpoints"] == 0
    assert summary["dropped"]["bad_crc"] == summary["dropped"]["oversized"] == 0


def test_asks_for_parameters_and_missions(fly):
    vehicle = fly()
    asyncio.run(meet(f"udpin://0.0.0.0:{vehicle.port}", ask))
    vehicle.end()
