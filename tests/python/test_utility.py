"""A utility in five lines."""

import functools
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from conftest import python

import gnbv
from gnbv._program import call, environment
from gnbv._utility import source_of


def mine(views):
    """Unknown voxels per metre of the way."""
    return views["unknown_voxels"] / (1.0 + views["path_m"])


def same_as_bircher(views):
    return views["entropy_per_ray_nat"] * np.exp(-0.2 * views["path_m"])


def test_bircher_in_numpy_decides_as_bircher(short):
    """But for what the built-in one refuses: views that see no surface."""
    ours = gnbv.run("smoke", utility=same_as_bircher, seed=1, set=short)
    theirs = gnbv.run("smoke", utility="bircher", seed=1, set=short)
    for column in ("x", "y", "z", "yaw"):
        assert (ours.iterations[column] == theirs.iterations[column]).all()
    assert ours.utility_source == source_of(same_as_bircher)
    np.testing.assert_allclose(ours.iterations["utility"], theirs.iterations["utility"], rtol=1e-12)


def test_only_fields_that_the_source_names_are_computed(short):
    def rays_too(views):
        with open("names", "w") as file:
            file.write(" ".join(views.dtype.names))
        return views["rear_side_nat"]

    gnbv.run("smoke", utility=rays_too, set=short)
    names = Path("names").read_text().split()
    documented = Path(__file__).parents[2].joinpath("docs/reference/python.md").read_text()
    assert len(names) == 26 and not [n for n in names if f"`{n}`" not in documented]

    def by_another_name(views):
        return views["rear_side" + "_nat"]

    with pytest.raises(gnbv.UtilityFailed, match="no field of name rear_side_nat"):
        gnbv.run("smoke", utility=by_another_name, set=short)


def test_what_raises_ends_the_run_with_its_place_and_a_complete_record(short):
    def raises(views):
        if (views["path_m"] > 0.9).any():
            raise ValueError("too far")
        return views["path_m"]

    with pytest.raises(gnbv.UtilityFailed) as failed:
        gnbv.run("smoke", utility=raises, set=short)
    assert "ValueError: too far" in failed.value.traceback
    assert 'raise ValueError("too far")' in failed.value.traceback
    assert failed.value.candidate is not None
    run = gnbv.load(failed.value.folder)
    assert run.termination == "utility_failed"
    assert len(run.iterations) == failed.value.iteration and len(run.cloud) > 0
    assert "too far" in run.summary["failure"]


def test_free_variables_and_lambdas_are_refused():
    weight = 2.0

    def closes(views):
        return weight * views["path_m"]

    with pytest.raises(gnbv.BadInput, match="uses weight from around it"):
        gnbv.run("smoke", utility=closes)
    for nameless in (lambda views: views["path_m"], functools.partial(mine)):
        with pytest.raises(gnbv.BadInput, match="expected a function with a name"):
            gnbv.run("smoke", utility=nameless)


def wander(belief, history):
    views = belief.valid(belief.sample())
    return views[len(history) % len(views)]


def curves_of(folder):
    """The labels of the runs in a folder, as plots have them, and how many runs each has."""
    runs = [gnbv.load(each) for each in (folder / "cells").iterdir() if each.is_dir()]
    return Counter(run.summary["utility"] for run in runs)


def test_functions_and_planners_are_rows_like_every_other(short, tmp_path):
    """Their seeds are pooled, and they are tested against the others."""
    (tmp_path / "other.py").write_text("def mine(views):\n    return -views['path_m']\n")
    compared = {"seeds": 2, "set": short, "ceiling": False, "out": tmp_path / "c", "jobs": 2}
    utilities = ["proposed", mine, tmp_path / "other.py", wander]
    rows = gnbv.compare("smoke", utilities=utilities, **compared)[0].rows
    methods = ["proposed", "test_utility.py:mine", "other.py:mine", "wander"]
    assert list(dict.fromkeys(rows["method"])) == methods
    coverage = rows[rows["metric"] == "coverage at 0.05 m (%)"]
    assert len(coverage) == 4 and (coverage["n"] == 2).all()
    assert np.isfinite(coverage["difference"][1:]).all() and np.isfinite(coverage["p"][1:]).all()
    assert set(curves_of(tmp_path / "c").values()) == {2, 4}  # two are called mine
    # other names, the same missions
    flown = sorted(path.name for path in (tmp_path / "c" / "cells").iterdir())
    named = gnbv.compare("smoke", utilities={"a": "proposed", "b": mine, "w": wander}, **compared)
    assert list(dict.fromkeys(named[0].rows["method"])) == ["a", "b", "w"]
    assert sorted(path.name for path in (tmp_path / "c" / "cells").iterdir()) == flown


@pytest.mark.parametrize("given", ["proposed", ["proposed", "my,dir/own.py:gain"], 3])
def test_utilities_are_a_list_and_hold_no_commas(given, tmp_path):
    with pytest.raises(gnbv.BadInput, match="utilities: value"):
        gnbv.compare("smoke", utilities=given, out=tmp_path / "c")


def test_names_are_words(tmp_path):
    for name in ("", "a b", "a,b", "a=b"):
        with pytest.raises(gnbv.BadInput, match="a name is one word"):
            gnbv.compare("smoke", utilities={name: mine}, out=tmp_path / "c")


def test_a_function_is_a_row_of_the_papers_table(short, tmp_path):
    how = {"oracle": False, "set": short, "out": tmp_path / "c", "jobs": 2}
    tables = gnbv.table("lab_model", utilities={"my_own": mine, "walk": wander}, **how)
    for label in ("my_own", "walk", "Proposed"):
        assert label in str(tables[0])


def test_a_failing_function_is_a_failed_cell_that_says_why(short, tmp_path):
    def raises(views):
        raise RuntimeError("no such luck")

    def lost(belief, history):
        raise LookupError("no way")

    how = {"seeds": 1, "set": short, "ceiling": False, "out": tmp_path / "c"}
    with pytest.raises(gnbv.Failed) as failed:
        gnbv.compare("smoke", utilities=["proposed", raises, lost], **how)
    # the last line of each traceback, and whose it is
    said = str(failed.value)
    assert "smoke, raises: without a result: exit code 1: RuntimeError: no such luck" in said
    assert "smoke, lost: without a result: exit code 1: LookupError: no way" in said


def test_what_the_program_says_is_utf_8_in_any_locale(tmp_path):
    (tmp_path / "bad.yaml").write_text("n\u00e4me: 1\n", encoding="utf-8")
    code = (
        "import gnbv; from gnbv._program import call\n"
        "try: call('run', 'bad.yaml')\n"
        "except gnbv.BadInput as bad: print('n\\u00e4me: is no' in str(bad), ascii(str(bad)))\n"
    )
    ascii_only = {**environment(), "LC_ALL": "C", "PYTHONCOERCECLOCALE": "0"}
    done = python("-X", "utf8=0", "-c", code, env=ascii_only)
    assert done.stdout.startswith("True"), done.stdout + done.stderr


def test_a_failure_that_speaks_of_interruptions_is_a_failure(tmp_path, monkeypatch):
    program = tmp_path / "program"
    program.write_text("#!/bin/sh\necho 'gnbv: smoke: ended by interrupted' >&2\nexit 1\n")
    program.chmod(0o755)
    monkeypatch.setattr("gnbv._program.PROGRAM", program)
    with pytest.raises(gnbv.Failed, match="ended by interrupted"):
        call("table")
