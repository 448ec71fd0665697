"""A planner of one's own, and what it can and cannot see."""

import contextlib
import csv
import multiprocessing
import signal
import time
import types
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import gnbv
from gnbv._utility import source_of


def asks_all(belief, history):
    """Answers by everything that can be asked for, so that one other answer is another view."""
    if len(history) == 5:
        return None
    if len(history) == 2 and not history.refused:
        return View(1e3, 0.0, 2.0, 0.0)  # noqa: F821  (in a file View is there, as np is)
    if history.refused:
        assert [(view.x, reason) for view, reason in history.refused] == [(1e3, "out_of_bounds")]
    everywhere = np.vstack([belief.sample(), belief.sample(2.0), belief.sample_frontiers()])
    views = belief.valid(everywhere)
    reasons, path_m = belief.validate(everywhere)
    stats = belief.evaluate(everywhere)
    where, density = belief.density
    way = belief.find_path(belief.current[:3], everywhere[0, :3])
    told = [belief.log_odds, belief.words, belief.cloud, belief.state, belief.is_predicted]
    told += [belief.entropy, belief.origin_m, belief.navigation_m, belief.current, where, density]
    told += [path_m, stats["unknown_voxels"], stats["rear_side_nat"], history.views["flown_m"]]
    told += [belief.entropy_nat, belief.resolution_m, belief.density_max, len(history)]
    told += [[len(reason) for reason in reasons], way if way is not None else [-1.0]]
    total = sum(float(np.sum(np.asarray(part, dtype=float))) for part in told)
    return views[int(total * 997) % len(views)]


def file_of(function, folder):
    file = folder / "planners.py"
    file.write_text(source_of(function))
    return f"{file}:{function.__name__}"


def test_a_planner_in_a_file_gets_the_answers_of_one_in_this_process(tmp_path, monkeypatch):
    monkeypatch.setitem(globals(), "View", gnbv.View)
    here = gnbv.run("smoke", planner=asks_all, seed=4)
    there = gnbv.run("smoke", utility=file_of(asks_all, tmp_path), seed=4)
    assert there.sha256 == here.sha256
    assert len(there.iterations) == 5 and there.termination == "route_flown"
    assert (here.folder / "views.csv").read_text() == (there.folder / "views.csv").read_text()
    for run in (here, there):  # both are known by its name and its text
        assert run.summary["utility"] == "asks_all"
        assert run.utility_source == source_of(asks_all)
    # the run repeats from its record, by the program alone
    again = gnbv.run(there.folder / "scenario.yaml", threads=1)
    assert again.sha256 == there.sha256
    # and is drawn without asking the planner
    assert again.render("voxels", out=tmp_path / "voxels.png")


WALK = """
steps = []  # remembered outside of the history
def walk(belief, history):
    steps.append(len(history))
    if len(history) > 5:
        return None
    views = belief.valid(belief.sample())
    return views[len(steps) % len(views)]
"""


def test_a_resumed_planner_flies_what_an_uninterrupted_one_flies(tmp_path):
    def planner():
        space = {}
        exec(WALK, space)
        return space["walk"]

    def ends(share, note):
        if note.startswith("view 3/"):
            raise LookupError("enough")

    whole = gnbv.run("smoke", planner=planner(), out=tmp_path / "whole")
    with pytest.raises(LookupError):
        gnbv.run("smoke", planner=planner(), out=tmp_path / "r", progress=ends)
    assert len(gnbv.load(tmp_path / "r").iterations) == 3
    resumed = gnbv.run("smoke", planner=planner(), out=tmp_path / "r", resume=True)
    assert resumed.sha256 == whole.sha256
    for name in ("scenario.yaml", "views.csv"):
        assert (resumed.folder / name).read_text() == (whole.folder / name).read_text()
    # a finished one is flown again by its views
    again = gnbv.run("smoke", planner=planner(), out=tmp_path / "r", resume=True)
    assert again.sha256 == whole.sha256


def test_a_planner_that_answers_otherwise_is_not_resumed(tmp_path):
    picks = [0]

    def picky(belief, history):
        if len(history) == 3 and picks[0] == 0:
            raise LookupError("enough")
        return belief.valid(belief.sample())[picks[0]]

    with pytest.raises(LookupError):
        gnbv.run("smoke", planner=picky, out=tmp_path / "r")
    assert len(gnbv.load(tmp_path / "r").iterations) == 3  # it ended in order
    picks[0] = 1
    with pytest.raises(gnbv.BadInput, match="another planner made this run"):
        gnbv.run("smoke", planner=picky, out=tmp_path / "r", resume=True)


def test_arrays_are_views_of_the_map_that_nobody_can_write():
    seen = []

    def looks(belief, history):
        for array in (belief.log_odds, belief.words, belief.cloud):
            assert not array.flags.writeable and not array.flags.owndata
            with pytest.raises(ValueError):
                array[...] = 0
        again = belief.log_odds
        assert again.ctypes.data == belief.log_odds.ctypes.data  # the same memory: zero-copy
        state, entropy = belief.state, belief.entropy
        assert set(np.unique(state)) <= {0, 1, 2}
        assert state.shape == belief.log_odds.shape == entropy.shape
        assert entropy.astype(float).sum() == pytest.approx(belief.entropy_nat, rel=1e-6)
        points = np.unique(voxel_of(belief, belief.cloud))
        where, density = belief.density
        assert set(points) == set(where) and (density >= 1).all()
        seen.append((len(belief.cloud), belief.entropy_nat, len(history)))
        return None

    gnbv.run("smoke", planner=looks)
    assert seen[0][0] > 0


def voxel_of(belief, points):
    key = np.floor((points - belief.origin_m) / belief.resolution_m + 1e-9).astype(int)
    _, y, x = belief.log_odds.shape
    return (key[:, 2] * y + key[:, 1]) * x + key[:, 0]


@pytest.mark.parametrize("ends", ["in order", "by an exception", "by a kept array"])
def test_a_belief_that_is_kept_answers_no_more_after_its_call(ends):
    """Its memory is the mission's, which changes with the next view and is freed with the last."""
    kept, arrays, grasped = [], [], []

    def keeps(belief, history):
        for old in kept:
            with pytest.raises(ReferenceError, match="during the call"):
                _ = old.state
        kept.append(belief)
        grasped.append(belief.sample())
        if len(history) < 3:
            return belief.valid(belief.sample())
        if ends == "by an exception":
            raise LookupError("lost")
        if ends == "by a kept array":
            arrays.append(belief.cloud)
        return None

    raised = {"by an exception": LookupError, "by a kept array": BufferError}.get(ends)
    with pytest.raises(raised) if raised else contextlib.nullcontext():
        gnbv.run("smoke", planner=keeps)
    with pytest.raises(KeyboardInterrupt):  # Python's own again
        signal.raise_signal(signal.SIGINT)
    assert len(kept) == 3 and all(np.isfinite(array).all() for array in arrays)
    for belief in kept:
        properties = [n for n in dir(type(belief)) if not n.startswith("_")]
        questions = {"validate", "valid", "evaluate"}
        for name in properties:
            with pytest.raises(ReferenceError, match="during the call"):
                asked = getattr(belief, name)
                if name in questions:
                    asked(grasped[0])
                elif name == "find_path":
                    asked(grasped[0][0], grasped[0][1])
                elif callable(asked):
                    asked()


def test_what_validate_says_becomes_of_a_view(tmp_path):
    random = np.random.default_rng(5)
    said = []

    def asks(belief, history):
        if len(said) == 150:
            return None
        low, high = np.asarray(belief.navigation_m)
        around = random.uniform(low - 0.3, high + 0.3, (20, 3))
        rows = np.column_stack([around, random.uniform(-3, 3, 20), np.zeros(20)])
        rows = np.vstack([rows, belief.current, belief.sample()])
        rows[3, 4] = 0.2  # there is no gimbal
        reasons, _ = belief.validate(rows)
        pick = random.integers(len(rows))
        said.append(reasons[pick])
        return rows[pick]

    run = gnbv.run(
        "smoke", planner=asks, out=tmp_path / "r", set={"planner.termination.max_iterations": 80}
    )
    with open(run.folder / "views.csv", newline="") as file:
        became = [row["reason"] for row in csv.DictReader(file)]
    assert became == said
    assert {"", "collision", "beyond_gimbal", "out_of_bounds"} <= set(said)


def test_threads_of_a_planner_get_the_answers_of_one():
    def asks(belief, history):
        views = np.tile(belief.sample(), (4, 1))
        alone = belief.evaluate(views)
        with ThreadPoolExecutor(4) as threads:
            for together in threads.map(belief.evaluate, [views] * 8):
                assert (together == alone).all()
        return None

    gnbv.run("smoke", planner=asks)


@pytest.mark.parametrize(
    "answer",
    [[1.0, 2.0], [np.nan] * 4, "there", {"x": 1.0}, [[1.0, 2.0], [3.0]], [1.0, 2.0, None, 3.0]]
    + [np.zeros(4) * 1j, np.ma.masked_array(np.zeros((2, 4)), mask=True), np.zeros((1, 1, 4))],
)
def test_what_is_no_view_is_refused(answer):
    with pytest.raises(gnbv.BadInput, match="view: expected finite"):
        gnbv.run("smoke", planner=lambda belief, history: answer)


def asks_wrongly(belief, history):
    """And what can be asked in other words; the arrays that it gets are its own."""
    here, no_number = belief.current, [np.nan, np.inf, -1.0, "2", None, 10**400]
    wrong = [(belief.sample, scale, "scale") for scale in no_number]
    wrong += [(belief.find_path, here, end) for end in ((0, 0), "abc", (np.nan, 0, 0))]
    wrong += [(belief.evaluate, [[0, 0, 1, 0], [1e9, 0, 0, 0]], "view 1, View(x=1000000000.0")]
    for asked, first, second in wrong:
        try:
            asked(first, second) if asked == belief.find_path else asked(first)
        except ValueError as bad:
            assert type(bad).__name__ == "BadInput" and (
                asked == belief.find_path or second in str(bad)
            )
        else:
            raise AssertionError((asked, first, second))
    assert len(belief.evaluate([[1e3, 0, -50, 0]])) == 1
    assert belief.find_path(here, belief.navigation_m[1] + 10.0) is None
    for scale in (np.int64(2), np.float32(2.0), np.array(2.0)):
        assert (belief.sample(scale) == belief.sample(2.0)).all()
    assert len(belief.sample(True)) == len(belief.find_path(here, here)) + len(belief.sample())
    for array in (*belief.density, belief.validate([here])[1], belief.find_path(here, here)):
        array[...] = 0
    return None


def test_wrong_questions_are_bad_input_and_end_nothing(short, tmp_path):
    gnbv.run("smoke", planner=asks_wrongly, set=short)
    gnbv.run("smoke", planner=file_of(asks_wrongly, tmp_path), set=short)


def test_what_a_planner_forks_hears_signals_as_if_no_mission_flew(short):
    """As multiprocessing's pools do, which end their processes by SIGTERM."""
    ends = []

    def forks(belief, history):
        child = multiprocessing.get_context("fork").Process(target=time.sleep, args=(60,))
        child.start()
        child.terminate()
        child.join(20)
        ends.append(child.exitcode)
        child.kill()
        return None

    gnbv.run("smoke", planner=forks, set=short)
    assert ends == [-signal.SIGTERM]


def test_a_planner_in_a_file_that_asks_the_terminal_hears_that_nobody_is_there(tmp_path):
    file = tmp_path / "asks.py"
    file.write_text("def plan(belief, history): return input('where to? ')")
    with pytest.raises(gnbv.UtilityFailed, match="EOFError"):
        gnbv.run("smoke", planner=f"{file}:plan")


def reachable(start):
    """All that can be had from an object by attributes, items, bound methods and closures."""
    found, todo = {}, [start]
    while todo:
        thing = todo.pop()
        if id(thing) in found or isinstance(thing, types.ModuleType | type | str | bytes):
            continue
        found[id(thing)] = thing
        if isinstance(thing, np.ndarray):
            todo.append(thing.base)
        elif isinstance(thing, dict):
            todo += [*thing.keys(), *thing.values()]
        elif isinstance(thing, list | tuple | set):
            todo += thing
        elif isinstance(thing, types.MethodType | types.BuiltinMethodType):
            todo.append(thing.__self__)
        elif isinstance(thing, types.FunctionType):
            todo += [cell.cell_contents for cell in thing.__closure__ or ()]
        elif type(thing).__module__.startswith("gnbv"):
            todo += [getattr(thing, name) for name in dir(thing)]
    return list(found.values())


TRUTH = "coverage ceiling scene world mesh structure truth reference score vehicle flight".split()


def test_no_truth_can_be_reached_from_what_a_planner_gets():
    tried = []

    def pries(belief, history):
        for thing in reachable(belief) + reachable(history):
            tried.append(type(thing).__name__)
            names = [n for n in dir(thing) if not n.startswith(("__", "T_world_"))]
            if type(thing).__module__.startswith("gnbv"):
                assert not [n for n in names if any(t in n.lower() for t in TRUTH)], names
        return None

    run = gnbv.run("smoke", planner=pries)
    assert "Belief" in tried and "BeliefView" in tried and "History" in tried
    # the points it saw are those that were measured, not the structure's
    assert run.summary["coverage"]["final"]["0.05"] < 1.0


def test_a_planner_excludes_a_utility():
    for given in ({"utility": "bircher"}, {"set": {"planner.utility.name": "bircher"}}):
        with pytest.raises(gnbv.BadInput, match="without a utility"):
            gnbv.run("smoke", planner=asks_all, **given)
