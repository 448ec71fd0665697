"""MAVSDK's server, and the Python client of most people's scripts (mavsdk before 4, mavsdk_grpc
since): it brings the server that flies the vehicle."""

import asyncio

import pytest
from conftest import first, free_port, is_at

mavsdk = pytest.importorskip("mavsdk_grpc")
from mavsdk_grpc.offboard import PositionNedYaw, VelocityNedYaw  # noqa: E402


async def fly_there_and_back(url):
    drone = mavsdk.System(port=free_port())
    await drone.connect(system_address=url)
    await first(drone.core.connection_state(), lambda state: state.is_connected)
    await first(drone.telemetry.health(),
                lambda health: health.is_global_position_ok and health.is_home_position_ok)
    # a client that this machine keeps waiting for a second is not a lost one
    await drone.param.set_param_float("COM_OF_LOSS_T", 4.0)
    start = (await first(drone.telemetry.position_velocity_ned())).position
    await drone.action.set_takeoff_altitude(2.0)
    await drone.action.arm()
    await drone.action.takeoff()
    await first(drone.telemetry.position(), lambda p: p.relative_altitude_m > 1.8)
    await drone.offboard.set_position_ned(PositionNedYaw(start.north_m, start.east_m, -2.0, 0.0))
    await drone.offboard.start()
    goal = start.north_m + 3.0, start.east_m, -2.0
    await drone.offboard.set_position_ned(PositionNedYaw(*goal, 90.0))
    print(await first(drone.telemetry.position_velocity_ned(), is_at(*goal)))
    await drone.offboard.set_velocity_ned(VelocityNedYaw(-1.0, 0.0, 0.0, 90.0))
    await first(drone.telemetry.position_velocity_ned(),
                lambda m: m.position.north_m < start.north_m + 0.5)
    await drone.offboard.stop()
    await drone.action.land()
    await first(drone.telemetry.armed(), lambda armed: not armed, 120)


def test_its_server_flies_the_vehicle(fly):
    vehicle = fly()
    asyncio.run(fly_there_and_back(f"udpin://0.0.0.0:{vehicle.port}"))
    summary = vehicle.end()
    assert summary["setpoints"] > 20 and summary["refused_setpoints"] == 0
