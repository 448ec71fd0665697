"""What type checkers read agrees with what runs."""

import os
import shutil
from pathlib import Path

import pytest
from conftest import python

import gnbv

PACKAGE = Path(gnbv.__file__).parent
SOURCES = Path(__file__).parents[2] / "tools" / "python" / "gnbv"


def test_the_stub_of_the_extension_is_current(tmp_path):
    pytest.importorskip("nanobind")
    out = tmp_path / "_core.pyi"
    said = python("-m", "nanobind.stubgen", "-m", "gnbv._core", "-o", out)
    assert said.returncode == 0, said.stderr
    assert out.read_text() == (SOURCES / "_core.pyi").read_text(), (
        f"python -m nanobind.stubgen -m gnbv._core -o {SOURCES / '_core.pyi'}"
    )


def test_mypy_is_content():
    pytest.importorskip("mypy")
    words = ("mypy", "--strict", "--cache-dir=/dev/null")
    said = python("-m", *words, SOURCES, cwd=SOURCES.parent)
    assert said.returncode == 0, said.stdout


def test_ruff_is_content():
    pytest.importorskip("ruff")
    for command in (["check"], ["format", "--check"]):
        said = python("-m", "ruff", *command, SOURCES, Path(__file__).parent)
        assert said.returncode == 0, said.stdout


def test_the_package_is_typed():
    assert (PACKAGE / "py.typed").exists()


@pytest.mark.parametrize(
    ("spoilt", "said"),
    [
        ("_version.py", "two versions are installed in one place"),
        ("_core", "is not built for CPython"),
        ("gymnasium", "pip install 'gnbv[gym]'"),
    ],
)
def test_what_cannot_run_says_so_in_one_line(spoilt, said, tmp_path):
    copy = tmp_path / "gnbv"
    shutil.copytree(PACKAGE, copy, ignore=shutil.ignore_patterns("gnbv-program", "__pycache__"))
    if spoilt == "_version.py":
        (copy / spoilt).write_text('VERSION = "0.0.1"\n')
    elif spoilt == "_core":
        next(copy.glob("_core*.so")).write_bytes(b"\x7fELF, but cut short")
    else:
        (tmp_path / "gymnasium.py").write_text("raise ModuleNotFoundError('none')\n")
    ended = python("-c", "import gnbv.gym", env={**os.environ, "PYTHONPATH": str(tmp_path)})
    assert ended.returncode == 1
    last = ended.stderr.splitlines()[-1]
    assert last.startswith("ImportError: gnbv") and said in last
