"""`gnbv fly` beside the clients that fly it, and a run to be read. GNBV names the program."""

import asyncio
import csv
import json
import math
import os
import re
import signal
import socket
import subprocess
import sys
from pathlib import Path

import pytest


def free_port() -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def gnbv(*arguments, code=0, folder=None, **environment) -> subprocess.CompletedProcess[str]:
    """The program in that folder, to its end with that exit code."""
    command = [os.environ["GNBV"], *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, cwd=folder,
                          env=os.environ | environment)
    assert done.returncode == code, f"{arguments}: {done.returncode}: {done.stderr}"
    return done


def without_packages(folder: Path) -> dict[str, str]:
    """The environment in which gnbv finds a Python that has no packages."""
    python = folder / "python"
    python.write_text(f'#!/bin/sh\nexec {sys.executable} -S -E "$@"\n')
    python.chmod(0o755)
    return {"GNBV_PYTHON": str(python)}


def rows(file: Path) -> list[dict[str, str]]:
    with file.open(newline="") as text:
        return list(csv.DictReader(text))


@pytest.fixture(scope="session")
def run(tmp_path_factory) -> Path:
    """A mission of `smoke` that kept its frames, of views between which it turns little."""
    folder = tmp_path_factory.mktemp("runs") / "run"
    gnbv("run", "smoke", "--quiet", "--frames", "--set", "planner.fvs.mode=single", "--out", folder)
    return folder


@pytest.fixture(scope="session")
def export(run):
    """export(format) -> the folder that `gnbv export` wrote."""

    return lambda kind: Path(gnbv("export", run, "--format", kind).stdout.strip())


async def first(stream, holds=lambda value: True, timeout_s=60.0):
    async def wait():
        async for value in stream:
            if holds(value):
                return value
        raise AssertionError("the stream ended")

    return await asyncio.wait_for(wait(), timeout_s)


def is_at(north_m: float, east_m: float, down_m: float):
    """Whether a position and velocity of MAVSDK's are there."""
    return lambda m: math.dist(
        (m.position.north_m, m.position.east_m, m.position.down_m), (north_m, east_m, down_m)) < 0.4


class Vehicle:
    """A quadrotor on the ground of `smoke`, in real time."""

    def __init__(self, port: int, *arguments: str):
        self.port = port
        self.process = subprocess.Popen(
            [os.environ["GNBV"], "fly", "smoke", "--json", *arguments],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.ready = ""
        while not re.match(r"gnbv: (speaking to|listening on) ", self.ready):
            self.ready = self.process.stderr.readline()
            assert self.ready, "gnbv fly ended at once"

    @property
    def address(self) -> tuple[str, int]:
        """Where it is spoken to."""
        where = re.search(r"(?:from|on) udp://([0-9.]+):(\d+)", self.ready)
        return where[1], int(where[2])

    def end(self) -> dict:
        """Its summary, after an ordinary end."""
        self.process.send_signal(signal.SIGINT)
        summary, complaints = self.process.communicate(timeout=30)
        assert self.process.returncode == 0, complaints
        print(summary)
        return json.loads(summary)


@pytest.fixture
def fly():
    """fly(*arguments, port=...) -> Vehicle that speaks first to that port of this machine."""
    vehicles = []

    def start(*arguments: str, port: int | None = None) -> Vehicle:
        port = free_port() if port is None else port
        if "--mavlink" not in arguments and port != 14540:  # which is the default
            arguments += ("--mavlink", f"udpout://127.0.0.1:{port}")
        vehicles.append(Vehicle(port, *arguments))
        return vehicles[-1]

    yield start
    for vehicle in vehicles:
        if vehicle.process.poll() is None:
            vehicle.process.kill()
            vehicle.process.communicate()
