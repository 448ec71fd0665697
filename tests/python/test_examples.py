"""The examples run as they are."""

import json
from pathlib import Path

import pytest
from conftest import python

EXAMPLES = Path(__file__).parents[2] / "tools" / "python" / "examples"


def said(name, *arguments):
    done = python(EXAMPLES / name, *arguments)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_compare_utility():
    assert "curious" in said("compare_utility.py", "smoke", 2)


def test_greedy_planner():
    assert "route_flown after 5 views" in said("greedy_planner.py", "smoke", 5)


def test_train_ppo(tmp_path):
    """Optional: it learns more than chance finds."""
    for package in ("gymnasium", "skrl", "jax", "matplotlib"):
        pytest.importorskip(package)
    lines = said("train_ppo.py", 3000, tmp_path / "c.png").splitlines()
    by_chance, learnt = (float(line.split(": ")[1].split()[0]) for line in lines[:2])
    assert learnt > 2.0 * by_chance > 0.0
    assert (tmp_path / "c.png").read_bytes()[:4] == b"\x89PNG"


def test_the_notebook():
    cells = json.loads((EXAMPLES / "sweep.ipynb").read_text())["cells"]
    code = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]
    space: dict = {}
    for part in code:
        exec(compile(part, "sweep.ipynb", "exec"), space)
    assert len(space["runs"]) == 3
