"""gnbv.run, gnbv.load and what they say of bad input."""

import io
import json
import os
import pickle
import shutil
import signal
import subprocess
import sys
import textwrap
import time
from pathlib import Path

import numpy as np
import pytest
from conftest import python

import gnbv


def test_import_brings_no_package_but_numpy():
    code = "import sys; import gnbv; print(*sys.modules)"
    brought = {name.split(".")[0] for name in python_says(code)}
    assert "gnbv" in brought
    assert not brought & {"gymnasium", "jinja2", "matplotlib", "pandas", "PIL", "tqdm"}


def test_a_run_is_what_the_program_flies(smoke, short, tmp_path):
    from gnbv._program import call

    settings = [f"--set={key}={value}" for key, value in short.items()]
    said = call("run", "smoke", "--seed", "3", *settings, "--out", str(tmp_path / "p"), "--json")
    assert json.loads(said)["result_sha256"] == smoke.sha256


def test_a_run_reads_back_as_arrays(smoke):
    assert smoke.summary["iterations"] == len(smoke.iterations) == len(smoke.coverage) - 1
    assert smoke.iterations["sampler"][0] == "start"
    assert smoke.iterations["cloud_points"][-1] == len(smoke.cloud)
    assert smoke.cloud.dtype == np.float32 and smoke.cloud.shape[1] == 3
    assert smoke.coverage["coverage_0.05"][-1] == pytest.approx(smoke.final_coverage)
    assert smoke.coverage["accurate_0.05"][-1] == pytest.approx(smoke.accurate_coverage)
    assert (np.diff(smoke.coverage["coverage_0.05"]) >= 0).all()
    assert smoke.trajectory.shape[1] == 8
    again = gnbv.load(smoke.folder)
    assert again.sha256 == smoke.sha256
    assert "smoke" in repr(again)


def test_the_map_and_the_cloud_are_what_the_planner_believed_last():
    kept = {}

    def plan(belief, history):
        kept.update(odds=belief.log_odds.copy(), cloud=belief.cloud.copy(), nat=belief.entropy_nat)
        kept.update(low_m=belief.origin_m, voxel_m=belief.resolution_m)
        return None if len(history) == 3 else belief.valid(belief.sample())

    run = gnbv.run("smoke", planner=plan)
    odds = np.zeros_like(kept["odds"])
    for *center_m, size_m, log_odds in run.map.tolist():
        first = (np.array(center_m) - 0.5 * size_m - kept["low_m"]) / kept["voxel_m"]
        count = round(size_m / kept["voxel_m"])  # a leaf may begin below the map
        x, y, z = (slice(max(low, 0), low + count) for low in np.rint(first).astype(int))
        assert not odds[z, y, x].any()
        odds[z, y, x] = log_odds
    assert len(run.map) > 100 and np.array_equal(odds, kept["odds"])
    assert np.array_equal(np.unique(run.cloud, axis=0), np.unique(kept["cloud"], axis=0))
    assert run.summary["entropy_nat"]["final"] == kept["nat"]


def test_a_picture_and_a_report_are_drawn(smoke, tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "stderr", None)  # as a daemon has it
    pictures = smoke.render(out=tmp_path / "path.png")
    assert [p.read_bytes()[:4] for p in pictures] == [b"\x89PNG"]
    assert b"<html" in smoke.report(tmp_path / "r.html").read_bytes()[:2000]


def test_bad_input_says_where(tmp_path):
    with pytest.raises(gnbv.BadInput) as bad:
        gnbv.run("smoke", set={"planner.utility.alpha": "much", "planner.map.nme": 1})
    assert bad.value.file == "--set planner.utility.alpha=much"
    assert (bad.value.key, bad.value.value) == ("planner.utility.alpha", "much")
    assert len(bad.value.faults) == 2

    file = tmp_path / "bad.yaml"
    file.write_text("name: x\nplanner:\n  utility:\n    alpha: [1]\n")
    with pytest.raises(gnbv.BadInput) as bad:
        gnbv.run(file)
    fault = next(f for f in bad.value.faults if f.key == "planner.utility.alpha")
    assert (fault.file, fault.line, fault.value) == (str(file), 4, "[1]")
    file.write_text("name: x\nplanner: {utility: {alpha: \u00e9}}\n", encoding="latin-1")
    with pytest.raises(gnbv.BadInput, match=r"utility\.alpha: value '\\xe9': expects a number"):
        gnbv.run(file)

    with pytest.raises(gnbv.BadInput, match="no built-in scenario"):
        gnbv.run("nowhere")
    with pytest.raises(gnbv.BadInput, match=r"summary[.]json"):
        gnbv.load(tmp_path)


@pytest.mark.parametrize(
    ("file", "text", "line", "asked"),
    [("summary.json", text, line, "summary") for text, line in [(b"{\n]", 2), (b"[]", 0)]]
    + [(f"{name}.csv", b"", 1, name) for name in ("iterations", "coverage")]
    + [("coverage.csv", b"view,metres\n0,1\n1\n", 3, "coverage")]
    + [("coverage.csv", b"view,metres\n0,x\n", 2, "coverage")]
    + [("trajectory.tum", text, 0, "trajectory") for text in (b"1 2 3\n", b"1 2 3 4 5 6 7 x\n")]
    + [
        (file, b"\xff", 0, asked)
        for file, asked in [("summary.json", "summary"), ("iterations.csv", "iterations")]
        + [("trajectory.tum", "trajectory"), ("utility.py", "utility_source")]
        + [("cloud.ply", "cloud"), ("map.ot", "map")]
    ],
)
def test_a_damaged_file_of_a_run_is_named(file, text, line, asked, smoke, tmp_path):
    shutil.copytree(smoke.folder, tmp_path / "r")
    (tmp_path / "r" / file).write_bytes(text)
    with pytest.raises(gnbv.BadInput) as bad:
        getattr(gnbv.load(tmp_path / "r"), asked)
    assert (bad.value.file, bad.value.line) == (str(tmp_path / "r" / file), line)


@pytest.mark.parametrize(
    ("named", "given"),
    [(n, {n: v}) for n, v in [("bounds", "Auto"), ("bounds", None)]]
    + [("threads", {"threads": value}) for value in (1.0, -1, 2**40, "2")]
    + [("frames", {"frames": value}) for value in (None, "no", 2)]
    + [("out", {"out": value}) for value in ("a\0b", os.fsdecode(b"\xff"), 3)]
    + [("start.yaw_deg", {"set": {"start.yaw_deg": value}}) for value in (1j, object())],
)
def test_arguments_that_mean_nothing_are_bad_input(named, given):
    with pytest.raises(gnbv.BadInput, match=named):
        gnbv.run("smoke", **given)


@pytest.mark.parametrize(
    "error",
    [gnbv.UtilityFailed("utility f: iteration 2, candidate 3: no", "runs/a")]
    + [gnbv.Interrupted("runs/a"), gnbv.BadInput("a.yaml:3: b: value 'c': no")],
)
def test_errors_come_whole_from_another_process(error):
    again = pickle.loads(pickle.dumps(error))
    assert (type(again), str(again), vars(again)) == (type(error), str(error), vars(error))


def test_a_setting_may_be_a_path(short, tmp_path):
    file = tmp_path / "\U0001f681.obj"
    for key, value in [("terrain.path", file), ("obstacles", [{"path": str(file)}])]:
        with pytest.raises(gnbv.BadInput, match=str(file)):
            gnbv.run("smoke", set={**short, key: value})


def test_progress_is_told(short):
    shares = []
    gnbv.run("smoke", set=short, progress=lambda share, note: shares.append(share))
    assert shares == sorted(shares) and shares[-1] == 1.0


@pytest.mark.parametrize("at", ["view 2/", "profile"])
def test_what_progress_raises_ends_the_mission_where_it_is(at, short, tmp_path):
    def tells(share, note):
        if note.startswith(at):
            raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        gnbv.run("smoke", seed=3, set=short, progress=tells, out=tmp_path / "r")
    ended = gnbv.load(tmp_path / "r")
    assert ended.termination == "interrupted"
    assert len(ended.iterations) == (2 if at == "view 2/" else 0)
    resumed = gnbv.run("smoke", seed=3, set=short, out=tmp_path / "r", resume=True)
    assert len(resumed.iterations) == short["planner.termination.max_iterations"]


def test_progress_on_a_terminal_is_by_tqdm(short, monkeypatch):
    pytest.importorskip("tqdm")

    class Terminal(io.StringIO):
        def isatty(self):
            return True

    monkeypatch.setattr(sys, "stderr", Terminal())
    gnbv.run("smoke", set=short)
    # states that come soon after each other are not all drawn; the last one is
    assert "smoke: " in sys.stderr.getvalue() and "scoring" in sys.stderr.getvalue()


def test_ctrl_c_ends_in_order_and_resume_goes_on(tmp_path):
    code = """
import gnbv, time
def told(share, note):
    if note.startswith("view 2/"): print("flying", flush=True)
    if note.startswith("view "): time.sleep(0.1)  # it is not over before we are asked to end
try:
    gnbv.run("smoke", seed=3, set={"planner.termination.max_iterations": 40}, out="r",
             progress=told)
except gnbv.Interrupted as stopped:
    print("stopped", stopped.folder, flush=True)
try:
    time.sleep(20)
except KeyboardInterrupt:
    print("python again", flush=True)
"""
    child = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    assert child.stdout is not None
    assert child.stdout.readline() == "flying\n"
    child.send_signal(signal.SIGINT)
    assert child.stdout.readline() == "stopped r\n"
    time.sleep(0.2)
    child.send_signal(signal.SIGINT)
    assert child.stdout.readline() == "python again\n"
    assert child.wait() == 0
    settings = {"planner.termination.max_iterations": 40}
    resumed = gnbv.run("smoke", seed=3, set=settings, out="r", resume=True)
    whole = gnbv.run("smoke", seed=3, set=settings, out=tmp_path / "whole")
    assert resumed.sha256 == whole.sha256


def python_says(code):
    """What a Python of its own prints, word by word."""
    done = python("-c", textwrap.dedent(code), timeout=120)
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


def test_one_ctrl_c_ends_all_missions_that_fly_and_python_has_the_next():
    """The second begins when the first was asked to end, and outlives it."""
    said = python_says("""
        import gnbv, os, signal, threading
        begun = {"a": threading.Event(), "b": threading.Event()}
        a_may_go_on, a_is_over = threading.Event(), threading.Event()
        ended = {}
        def fly(name, at, may_go_on):
            def told(share, note):
                if note.startswith(at):
                    begun[name].set()
                    may_go_on.wait()
            try:
                gnbv.run("smoke", set={"planner.termination.max_iterations": 40}, out=name,
                         progress=told)
                ended[name] = "whole"
            except gnbv.Interrupted:
                ended[name] = "interrupted"
        a = threading.Thread(target=fly, args=("a", "view 2/", a_may_go_on))
        b = threading.Thread(target=fly, args=("b", "", a_is_over))
        a.start()
        begun["a"].wait()
        os.kill(os.getpid(), signal.SIGINT)
        b.start()
        begun["b"].wait()
        a_may_go_on.set()
        a.join()
        a_is_over.set()
        b.join()
        print(ended["a"], ended["b"])
        try:
            os.kill(os.getpid(), signal.SIGINT)
            print("deaf")
        except KeyboardInterrupt:
            print("python")
    """)
    assert said == ["interrupted", "interrupted", "python"]


def test_no_ctrl_c_kills_python_and_one_that_comes_late_is_pythons():
    said = python_says("""
        import gnbv, os, signal
        def told(share, note):
            if note == "scoring":
                for _ in range(3): os.kill(os.getpid(), signal.SIGINT)
        try:
            gnbv.run("smoke", set={"planner.termination.max_iterations": 2}, out="r",
                     progress=told)
            print("deaf")
        except KeyboardInterrupt:
            print(gnbv.load("r").termination)
    """)
    assert said == ["max_iterations"]


@pytest.mark.parametrize(
    ("what", "body"),
    [("planner", "while True: pass")] + [(w, "time.sleep(600)") for w in ("planner", "utility")],
)
def test_a_second_ctrl_c_ends_what_the_users_own_code_does(what, body):
    """That code runs in this process (a planner) or in one of its own (a utility)."""
    Path("own.py").write_text(
        "def own(*asked):\n"
        "    import os, subprocess, time\n"
        "    twice = 'for i in 1 2; do sleep 0.5; kill -INT ' + os.environ['MISSION'] + '; done'\n"
        "    subprocess.Popen(['sh', '-c', twice])\n"
        f"    {body}\n"
    )
    said = python_says(f"""
        import gnbv, os, own
        os.environ["MISSION"] = str(os.getpid())
        try:
            gnbv.run("smoke", {what}=own.own, out="r")
        except KeyboardInterrupt:
            print(gnbv.load("r").termination)
    """)
    assert said == ["interrupted"]


def test_the_command_is_the_program():
    said = python("-c", "from gnbv._program import main; main()", "--version")
    assert said.stdout.strip() == gnbv.__version__
