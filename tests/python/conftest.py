"""Missions are short: smoke, a few views."""

import os
import subprocess
import sys

import pytest

SHORT = {"planner.termination.max_iterations": 6}


def python(*words, **more):
    """The end of a Python of its own, and what it said."""
    command = [sys.executable, *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, check=False, **more)


@pytest.fixture(scope="session")
def short() -> dict[str, int]:
    return dict(SHORT)


@pytest.fixture(scope="session")
def smoke(tmp_path_factory: pytest.TempPathFactory):
    import gnbv

    return gnbv.run("smoke", seed=3, set=SHORT, out=tmp_path_factory.mktemp("runs") / "smoke")


@pytest.fixture(autouse=True)
def _here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("GNBV_CACHE", os.environ.get("GNBV_CACHE", str(tmp_path / "cache")))
