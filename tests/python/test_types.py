"""What type checkers read agrees with what runs."""

import subprocess
import sys
from pathlib import Path

import pytest

import gnbv

PACKAGE = Path(gnbv.__file__).parent
SOURCES = Path(__file__).parents[2] / "tools" / "python" / "gnbv"


def test_the_stub_of_the_extension_is_current(tmp_path):
    pytest.importorskip("nanobind")
    out = tmp_path / "_core.pyi"
    subprocess.run(
        [sys.executable, "-m", "nanobind.stubgen", "-m", "gnbv._core", "-o", out], check=True
    )
    assert out.read_text() == (SOURCES / "_core.pyi").read_text(), (
        f"python -m nanobind.stubgen -m gnbv._core -o {SOURCES / '_core.pyi'}"
    )


def test_mypy_is_content():
    pytest.importorskip("mypy")
    said = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir=/dev/null", SOURCES],
        capture_output=True,
        text=True,
        check=False,
        cwd=SOURCES.parent,
    )
    assert said.returncode == 0, said.stdout


def test_stubtest_is_content():
    pytest.importorskip("mypy")
    said = subprocess.run(
        [sys.executable, "-m", "mypy.stubtest", "gnbv._core", "--ignore-missing-stub"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert said.returncode == 0, said.stdout + said.stderr


def test_ruff_is_content():
    ruff = pytest.importorskip("ruff")
    assert ruff
    for command in (["check"], ["format", "--check"]):
        said = subprocess.run(
            [sys.executable, "-m", "ruff", *command, SOURCES, Path(__file__).parent],
            capture_output=True,
            text=True,
            check=False,
        )
        assert said.returncode == 0, said.stdout


def test_the_package_is_typed():
    assert (PACKAGE / "py.typed").exists()
