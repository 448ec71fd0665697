"""`gnbv bench`: entries flown, submitted, verified by flying them again, edited and refused."""

import hashlib
import io
import json
import os
import pathlib
import re
import shlex
import shutil
import stat
import sys
import zipfile

import pytest
from program import REPOSITORY, Gnbv, end_of

TINY = REPOSITORY / "examples/bench/tiny.yaml"
WORDS = ("description", "licence", "machine", "name", "program", "program_sha256")  # of no flight
PLANNER = """import json, math, sys
told = json.loads(sys.stdin.readline())
x, y, z = told['position_m']
room = told['task']['workspace_m']
assert room['min'][0] < x < room['max'][0] and told['task']['cameras'][0]['fx_px'] > 0
print('x,y,z,yaw_deg', flush=True)
bearing = math.degrees(math.atan2(y, x))
while told['left']['metres'] > 3 and told['left']['views'] > 0:
    bearing += 40
    a = math.radians(bearing)
    print(3.2 * math.cos(a), 3.2 * math.sin(a), 1.8, bearing - 180, sep=',', flush=True)
    told = json.loads(sys.stdin.readline())
    while told['event'] == 'refused':
        sys.exit('refused')
"""
FUNCTION = """import math
def around(belief, history):
    n = len(history)
    if n > 3:
        return None
    a = math.radians(40 * n - 90)
    return View(3.2 * math.cos(a), 3.2 * math.sin(a), 1.8, a + math.pi)
"""


@pytest.fixture(scope="module")
def made(request, tmp_path_factory):
    """A folder with tiny.yaml and an entry of `nearest_frontier`: the folder n, n.zip."""
    folder = tmp_path_factory.mktemp("bench")
    gnbv = Gnbv(request.config.option.gnbv, folder)
    shutil.copy(TINY, folder / "tiny.yaml")
    run = "bench run --suite tiny.yaml --track tiny --planner nearest_frontier -o n --quiet"
    gnbv(*run.split(), "--jobs", "2", "--threads", "1").check({0})
    gnbv("bench", "submit", "n", "-o", "n.zip", "--description", "a baseline").check({0})
    return folder


@pytest.fixture
def bench(gnbv, made, tmp_path):
    """bench(words, *says, code=0) -> the end of `gnbv bench WORDS` beside what is made."""
    shutil.copytree(made, tmp_path, dirs_exist_ok=True)

    def call(words, *says, code=0):
        end = gnbv("bench", *shlex.split(words)).check({code})
        for say in says:
            assert say in end.out + end.err, end.out + end.err
        return end

    return call


def members_of(path):
    with zipfile.ZipFile(path) as file:
        return {name: file.read(name) for name in file.namelist()}


def write(path, members):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as file:
        for name, content in members.items():
            file.writestr(name, content)


class Number(float):
    """With the digits that were read: of a number of 17 there may be others as good."""

    def __new__(cls, digits):
        number = super().__new__(cls, digits)
        number.digits = digits
        return number


def json_of(told, **how):
    def marked(value):
        if isinstance(value, dict):
            return {key: marked(one) for key, one in value.items()}
        if isinstance(value, list):
            return [marked(one) for one in value]
        return f"<{value.digits}>" if isinstance(value, Number) else value

    return re.sub('"<([^"]*)>"', r"\1", json.dumps(marked(told), ensure_ascii=False, **how))


def sealed(told):
    """The text of submission.json, its own hash made anew."""
    told.pop("sha256", None)
    compact = json_of(told, separators=(",", ":"))
    told["sha256"] = hashlib.sha256(compact.encode()).hexdigest()
    return json_of(told, indent=1) + "\n"


def resealed(members, told):
    """As somebody writes it who knows the format: all hashes fit."""
    for mission in told["missions"]:
        for name in mission["files"]:
            content = members.get(f"missions/{mission['task']}/{name}", b"")
            mission["files"][name] = hashlib.sha256(content).hexdigest()
    return {**members, "submission.json": sealed(told).encode()}


def told_by(members):
    return json.loads(members["submission.json"], parse_float=Number)


def test_a_submission_is_what_it_says(bench, tmp_path):
    verify = "verify n.zip --suite tiny.yaml --quiet"
    bench(f"{verify} --jobs 2", "verified: 2 missions flown again")
    smoke = bench(f"{verify} --task smoke --task smoke -o kept", "verified: 1 mission flown again")
    assert "not flown: 1 other" in smoke.out
    bench(f"{verify} -o kept", "kept: holds missions already", code=2)  # what lies there was flown by whom?
    table = bench("table n.zip --suite tiny.yaml --format csv").out.splitlines()
    told = told_by(members_of(tmp_path / "n.zip"))
    assert str(told["figures"]["score"]) in table[1]
    bench("table n.zip --suite tiny.yaml --plot drawn.svg")
    drawn = (tmp_path / "drawn.svg").read_text()
    assert all(word in drawn for word in ("nearest_frontier", "track tiny", "best known"))
    bench("table n.zip --suite tiny.yaml --plot drawn.gif", "must end in .svg", code=2)
    shares = [mission["share"] for mission in told["missions"]]
    assert told["figures"]["score"] == pytest.approx(sum(shares) / 2)
    # the reseal of these tests is the program's own
    assert sealed(dict(told)).encode() == members_of(tmp_path / "n.zip")["submission.json"]


@pytest.mark.parametrize("entry, task", [("random", "smoke")])  # one of each frozen track
def test_a_committed_entry_is_flown_again(bench, entry, task):
    file = REPOSITORY / f"suite/entries/{entry}.zip"
    bench(f"verify {file} --task {task} --quiet", "verified: 1 mission flown again")
    bench(f"verify {file} --task nowhere", "no such task", code=2)


def edited(value):
    if isinstance(value, bool) or value is None:
        return 0.5
    if isinstance(value, str):
        return value[:-1] + ("0" if value[-1:] != "0" else "1")
    if isinstance(value, list):
        return [*value, "planner.utility.name=random"]
    return value + 1


def places(told):
    yield from ((told, key) for key in told if key not in ("figures", "missions", "sha256"))
    yield from ((told["figures"], key) for key in told["figures"])
    for mission in told["missions"]:
        yield from ((mission, key) for key in mission if key != "files")


def test_an_edited_field_is_refused_and_resealed_it_is_found(bench, tmp_path):
    members = members_of(tmp_path / "n.zip")
    for where, key in places(told := told_by(members)):
        before, where[key] = where[key], edited(where[key])
        text = json_of(told, indent=1) + "\n"
        write(tmp_path / "e.zip", {**members, "submission.json": text})
        bench("verify e.zip --suite tiny.yaml", "e.zip", code=2)
        where[key] = before
    # whoever makes the hashes fit is refused for what the suite or the missions say, or found by
    # flying again: what the track's figures are of changes places, so that these stay
    told, flown, numbers = told_by(members), told_by(members), []
    for (where, key), (other, _) in zip(places(told), places(flown), strict=True):
        if where is told and key in WORDS:
            continue
        if where in (told, told["figures"]) or key == "task":
            before, where[key] = where[key], edited(where[key])
            write(tmp_path / "e.zip", resealed(members, told))
            for command in ("verify --quiet", "table"):
                bench(f"{command} e.zip --suite tiny.yaml", "e.zip: ", code=2)
            where[key] = before
            continue
        if key in ("share", "coverage", "plan_s"):
            other[key] = next(m[key] for m in told["missions"] if m is not where)
        elif key not in ("to_90", "to_95") or where is told["missions"][0]:
            other[key] = edited(other[key])
        else:
            continue  # the median over both stays where one of them is not reached
        numbers.append(key)
    of = flown["figures"]
    of["public_score"], of["held_out_score"] = of["held_out_score"], of["public_score"]
    write(tmp_path / "e.zip", resealed(members, flown))
    said = bench("verify e.zip --suite tiny.yaml --quiet --jobs 2", code=1).out
    for key in numbers:
        assert len(re.findall(rf"\b{key}\b", said)) >= numbers.count(key), (key, said)


@pytest.mark.parametrize("name", ["iterations.csv", "trajectory.tum", "coverage.csv"])
def test_an_edited_record_is_refused_and_resealed_it_is_found(bench, tmp_path, name):
    members = members_of(tmp_path / "n.zip")
    member = f"missions/smoke/{name}"
    lines = members[member].decode().splitlines()
    cells = re.split("([, ])", lines[-1])
    cells[2 if name != "coverage.csv" else -5] = "1.25"
    members[member] = "\n".join([*lines[:-1], "".join(cells), ""]).encode()
    write(tmp_path / "e.zip", members)
    bench("verify e.zip --suite tiny.yaml", f"'{member}': is damaged or edited", code=2)
    write(tmp_path / "e.zip", resealed(members, told_by(members)))
    bench("verify e.zip --suite tiny.yaml --quiet", "smoke: ", code=1)


def with_member(name, content=b"x", **attributes):
    def change(path, members):
        write(path, members)
        with zipfile.ZipFile(path, "a", zipfile.ZIP_DEFLATED) as file:
            info = zipfile.ZipInfo(name)
            info.compress_type = zipfile.ZIP_DEFLATED
            for key, value in attributes.items():
                setattr(info, key, value)
            file.writestr(info, content)

    return change


def with_json(change):
    def hostile(path, members):
        told = told_by(members)
        change(told)
        write(path, {**members, "submission.json": sealed(told)})

    return hostile


def with_bytes(change):
    def hostile(path, members):
        write(path, members)
        path.write_bytes(change(path.read_bytes()))

    return hostile


def negative_time(path, members):
    member = "missions/smoke/iterations.csv"
    head, *rows = (row.split(",") for row in members[member].decode().splitlines())
    rows[0][head.index("wall_plan_s")] = "-1"
    members[member] = "".join(",".join(row) + "\n" for row in [head, *rows]).encode()
    write(path, resealed(members, told_by(members)))


def other_checksum(zipped):
    """Of the first member, at both places."""
    with zipfile.ZipFile(io.BytesIO(zipped)) as file:
        crc = file.infolist()[0].CRC
    return zipped.replace(crc.to_bytes(4, "little"), (crc ^ 1).to_bytes(4, "little"))


def with_setting(text):
    return with_json(lambda told: told["settings"].append(text))


def with_mission(**fields):
    return with_json(lambda told: told["missions"][0].update(fields))


LINK = {"create_system": 3, "external_attr": (stat.S_IFLNK | 0o777) << 16}
CODE = 'planner.utility={name: python, python: {source: "def f(s): return s", function: f}}'
PROFILE = "planner.profiling={method: saved, file: pipe}"
HOSTILE = {
    "absolute": (with_member("/etc/cron.d/x"), "is an absolute path"),
    "parent": (with_member("missions/../../x"), "leads out of its folder"),
    "backslash": (with_member("missions\\x"), "is no plain path"),
    "control": (with_member("missions/a\x1b[2J"), "other characters than ASCII"),
    "folder": (with_member("missions/", b""), "is a folder"),
    "link": (with_member("missions/l", b"/etc/passwd", **LINK), "is a link"),
    "twice": (with_member("missions/smoke/coverage.csv"), ""),
    "ratio": (with_member("missions/bomb", bytes(1 << 24)), "bomb"),
    "large": (with_member("missions/large", bytes((64 << 20) + 1)), "larger than any"),
    "unknown": (with_member("missions/smoke/run.sh"), "belongs to no submission"),
    "python": (with_member("utility.py"), "belongs to no submission"),
    "method": (with_member("missions/b", b"b" * 9, compress_type=zipfile.ZIP_BZIP2), "deflate"),
    "text for a number": (with_mission(share="1"), "missions.0: share: expects a number"),
    "number for a text": (with_json(lambda t: t.update(name=1)), "name: expects a text"),
    "list for an object": (with_json(lambda t: t.update(figures=[])), "figures: expects an object"),
    "null": (with_json(lambda t: t.update(missions=None)), "missions: expects a list"),
    "missing key": (with_json(lambda t: t.pop("track")), "track: is missing"),
    "more keys": (with_json(lambda t: t.update(more=1)), "not as `gnbv bench submit` writes it"),
    "code": (with_setting(CODE), "of the user"),
    "sensor": (with_setting("cameras.0.range_max_m=50"), "may not set cameras.0.range_max_m"),
    "figures": (with_json(lambda t: t["figures"].update(score=1.5)),
                "figures.score: value 1.5: its missions give 0.8"),
    "file": (with_setting("cameras.0.calibration=pipe"), "may not set cameras.0.calibration"),
    "profile": (with_setting(PROFILE), "may not set planner.profiling"),
    "another planner": (with_setting("planner.utility={name: isler}"), "'isler': names another"),
    "another name": (with_json(lambda t: t.update(name="tour")), "name: value 'tour'"),
    "oracle": (with_setting("planner.utility.name=oracle_metres"),
               "oracle_metres, which knows the mesh"),
    "terminal": (with_mission(termination="\x1b[2J"),
                 "missions.0: termination: expects a line of UTF-8 text"),
    "hash": (with_mission(result_sha256="/../../x"),
             "result_sha256: expects 64 hexadecimal digits"),
    "time": (negative_time, "plan_s: value -1: expects a number, 0 or more"),
    "track": (with_json(lambda t: t.update(track="ours")), "h.zip: track 'ours': is none"),
    "checksum": (with_bytes(other_checksum), "is damaged"),
    "path as a task": (with_mission(task="../../x"), ""),
    "cut": (with_bytes(lambda b: b[: len(b) // 2]), "is no zip archive"),
    "flipped": (with_bytes(lambda b: b[:300] + bytes([b[300] ^ 0xFF]) + b[301:]), ""),
    "no zip": (with_bytes(lambda b: b"hello"), "is no zip archive"),
}


@pytest.mark.parametrize("attack", HOSTILE)
def test_a_hostile_zip_is_refused_by_name(bench, tmp_path, attack):
    change, says = HOSTILE[attack]
    members = members_of(tmp_path / "n.zip")
    os.mkfifo(tmp_path / "pipe")
    change(tmp_path / "h.zip", members)
    before = list(tmp_path.iterdir())
    bench("verify h.zip --suite tiny.yaml --quiet -o out", "h.zip", says, code=2)
    assert {*tmp_path.iterdir()} <= {*before, tmp_path / "out"}
    assert not list(tmp_path.glob("out/cells/*/summary.json"))


def test_resumed_is_as_uninterrupted(bench, tmp_path):
    run = "run --suite tiny.yaml --track tiny --planner nearest_frontier -o r --quiet"
    bench(f"{run} --task smoke-east")
    bench("submit r -o r.zip", "not flown by this program: smoke", code=2)
    bench(run, "--resume goes on", code=2)
    bench(f"{run} --resume")
    bench("submit r -o r.zip --description x")
    one, two = (members_of(tmp_path / name) for name in ("n.zip", "r.zip"))
    for name in one:
        if name.endswith((".tum", "coverage.csv")):
            assert one[name] == two[name]
    told = [told_by(members) for members in (one, two)]
    for key in ("score", "coverage", "to_90"):
        assert told[0]["figures"][key] == told[1]["figures"][key]
    bench(f"{run} --resume --set planner.agvs.step_m=0.6", "of another planner", code=2)


@pytest.mark.parametrize("planner", ["command", "function"])
def test_a_planner_of_others_is_flown_again_without_it(bench, gnbv, tmp_path, planner):
    if planner == "function":
        pytest.importorskip("numpy")  # which gnbv hands to it
    (tmp_path / "planner.py").write_text(PLANNER if planner == "command" else FUNCTION)
    word = "python3 planner.py" if planner == "command" else "planner.py:around"
    run = "run --suite tiny.yaml --track tiny --name ours -o f --quiet"
    limit = "planner.termination.max_iterations=4"
    bench(f"{run} --planner '{word}' --set {limit}")
    bench("submit f -o f.zip")
    (tmp_path / "planner.py").unlink()
    members = members_of(tmp_path / "f.zip")
    told = told_by(members)
    assert (told["kind"], told["settings"], told["name"]) == ("views", [limit], "ours")
    assert all(mission["views"] > 2 for mission in told["missions"])
    bench("verify f.zip --suite tiny.yaml --quiet", "verified")
    told["settings"] = []  # what was set beside it is flown again, too
    write(tmp_path / "e.zip", resealed(members, told))
    bench("verify e.zip --suite tiny.yaml --quiet", "smoke: ", code=1)
    told["settings"] = [limit]
    lines = members["missions/smoke/views.csv"].decode().splitlines()
    cells = lines[2].split(",")
    cells[3] = "2.4"  # z of the second view that it gave
    lines[2] = ",".join(cells)
    members["missions/smoke/views.csv"] = "\n".join([*lines, ""]).encode()
    write(tmp_path / "e.zip", resealed(members, told))
    bench("verify e.zip --suite tiny.yaml --quiet", "smoke: ", code=1)
    table = bench("table n.zip f.zip --suite tiny.yaml").out
    assert "too few structures" in table


ROS = """import math, struct, sys, types
# a planner at the other side of the topics: each answer is followed by the next view
told, callbacks = {}, {}
def filled(**fields):
    return types.SimpleNamespace(**fields)
def header():
    return filled(stamp=filled(sec=0, nanosec=0), frame_id='')
def pose():
    return filled(header=header(), pose=filled(position=filled(x=0., y=0., z=0.),
                                               orientation=filled(x=0., y=0., z=0., w=1.)))
class Node:
    count = 0
    def create_subscription(self, kind, topic, callback, depth):
        callbacks[topic] = callback
    def create_publisher(self, kind, topic, depth):
        return filled(publish=lambda message: told.update({topic: message}))
def spin_once(node, timeout_sec):
    image = told['~/camera/rgbd/depth']
    depths = struct.unpack(f'<{image.width * image.height}f', image.data)
    assert any(0.3 < depth < 5 for depth in depths), 'nothing in sight'
    assert told['~/camera/rgbd/info'].k[0] > 0
    node.count += 1
    if node.count > 3:
        return callbacks['~/end'](None)
    a = math.atan2(told['~/pose'].pose.position.y, told['~/pose'].pose.position.x) + 0.7
    view = pose()
    view.pose.position = filled(x=3.2 * math.cos(a), y=3.2 * math.sin(a), z=1.8)
    view.pose.orientation = filled(x=0., y=0., z=math.sin((a + math.pi) / 2),
                                   w=math.cos((a + math.pi) / 2))
    callbacks['~/next_view'](view)
def module(name, **members):
    sys.modules[name] = made = types.ModuleType(name)
    made.__dict__.update(members)
module('rclpy', init=lambda: None, shutdown=lambda: None, ok=lambda: True, spin_once=spin_once,
       create_node=lambda name: Node())
module('geometry_msgs'); module('sensor_msgs'); module('std_msgs')
module('geometry_msgs.msg', PoseStamped=pose)
module('sensor_msgs.msg', Image=lambda: filled(header=header()),
       CameraInfo=lambda: filled(header=header()))
module('std_msgs.msg', Empty=lambda: filled(), String=lambda: filled(data=''))
"""


def test_the_bridge_to_ros_flies_what_comes_by_its_topics(gnbv, tmp_path):
    pytest.importorskip("numpy")
    bridge = REPOSITORY / "examples/ros_bridge.py"
    (tmp_path / "bridge.py").write_text(f"{ROS}\nexec(open({str(bridge)!r}).read())\n")
    shared = set(pathlib.Path("/dev/shm").glob("gnbv-*"))
    views = f"|{sys.executable} bridge.py"
    gnbv(*"run smoke --utility route --out r --quiet --views".split(), views).check({0})
    rows = (tmp_path / "r/views.csv").read_text().splitlines()
    assert [row.split(",")[6] for row in rows[1:]] == ["flown"] * 3
    assert set(pathlib.Path("/dev/shm").glob("gnbv-*")) <= shared


def test_a_planner_that_gives_no_view_is_verified(bench, tmp_path):
    (tmp_path / "none.py").write_text("import sys\nsys.stdin.readline()\n")
    bench("run --suite tiny.yaml --track tiny --planner 'python3 none.py' -o f --quiet")
    bench("submit f -o f.zip")
    bench("verify f.zip --suite tiny.yaml --quiet", "verified: 2 missions")


def test_texts_are_looked_at_before_anything_is_flown_or_written(bench, tmp_path):
    for words in ("--description", "--licence"):
        for text in ("x" * 5000, b"\xe9".decode("utf-8", "surrogateescape")):
            bench(f"submit n -o n.zip {words} '{text}'", f"n.zip: {words[2:]}: ", code=2)
    bench("table n.zip --suite tiny.yaml")  # the good one is still there
    run = "run --suite tiny.yaml --track tiny -o x --planner oracle_views"
    bench(f"{run} --name {'x' * 5000}", "name: is too long", code=2)
    bench(f"{run} --name ours", "which knows the mesh", code=2)
    assert not (tmp_path / "x").exists()


def test_many_processes_claim_a_folder_at_once(gnbv, tmp_path):
    shutil.copy(TINY, tmp_path)
    run = "bench run --suite tiny.yaml --track tiny --planner random -o r --quiet --resume"
    for child in [gnbv.start(*run.split(), "--threads", "1") for _ in range(8)]:
        end_of(child).check({0})


def test_a_planner_that_fails_has_no_mission(bench, gnbv, tmp_path):
    run = "run --suite tiny.yaml --track tiny --planner 'false no' -o f --quiet"
    bench(run, "the planner `false no` ended before the mission", code=1)
    bench("submit f -o f.zip", "not flown", code=2)


def test_what_a_planner_may_not_set_is_named(bench, tmp_path):
    run = "run --suite tiny.yaml --track tiny -o x --planner"
    bench(f"{run} tour --set cameras.0.range_max_m=9", "may not set cameras.0.range_max_m", code=2)
    another = "--set planner.utility.name=isler"
    for planner in ("tour", "'python3 planner.py'"):
        bench(f"{run} {planner} {another} --name x", "planner.utility.name: value 'isler'", code=2)
    bench(f"{run} isler --name tour", "name: value 'tour': is another planner", code=2)
    bench(f"{run} tuor", "did you mean 'tour'", code=2)
    bench(f"{run} tour --task hall", "no such task", code=2)
    track = "run --suite tiny.yaml --track takeoff -o x --planner tour --set"
    bench(f"{track} 'planner.profiling={{method: saved, file: p}}'", "profiling.file", code=2)
    bench("run --suite tiny.yaml --track tniy -o x --planner tour", "did you mean 'tiny'", code=2)
    (tmp_path / "u.py").write_text('def u(stats):\n    return stats["path_m"]\n')
    bench(f"{run} u.py", "is a utility", code=2)
    assert not (tmp_path / "x").exists()


def test_a_task_of_a_random_structure_is_checked_before_its_folder_is_claimed(bench, tmp_path):
    run = "run --track small --task hall-1 --planner lawnmower -o h --quiet"
    bench(f"{run} --set seed=5", "may not set seed", code=2)
    assert not (tmp_path / "h").exists()
    bench(run)


def test_freezing_finds_the_same_numbers_again(bench, tmp_path):
    frozen = (tmp_path / "tiny.yaml").read_text()
    loose = re.sub(r", ceiling: [^}]*", "", frozen)
    (tmp_path / "loose.yaml").write_text(loose)
    run = "run --suite loose.yaml --track takeoff --planner random -o l --quiet"
    bench(run, "not frozen yet: no score")
    bench("submit l -o l.zip", "not frozen yet, so that nothing can be submitted: smoke", code=2)
    bench("freeze loose.yaml --track takeoff --planners random,tour -o z --quiet")
    line = next(line for line in frozen.splitlines() if "track: takeoff, " in line)
    assert line in (tmp_path / "loose.yaml").read_text()
    bench("table n.zip --suite loose.yaml", "is of another suite", code=2)


def test_the_page_holds_the_standings_and_every_mission(bench, tmp_path):
    told = told_by(members := members_of(tmp_path / "n.zip"))
    for i, name in enumerate(["木" * 90 + " A", "木" * 90 + "+A"]):  # of which neither is a folder's
        write(tmp_path / f"{i}.zip", resealed(members, {**told, "name": name}))
    end = bench("page n.zip 0.zip 1.zip --suite tiny.yaml -o site --quiet --jobs 2")
    assert end.out == "site/index.html\n"
    html = (tmp_path / "site/index.html").read_text()
    data = json.loads(re.search(r'id="standings">(.*?)</script>', html, re.S)[1])
    entry = next(e for e in data["tracks"][0]["entries"] if e["name"] == "nearest_frontier")
    links = [m["link"] for e in data["tracks"][0]["entries"] for m in e["missions"] if m["link"]]
    assert len(set(links)) == len(links)
    assert (entry["name"], entry["description"]) == ("nearest_frontier", "a baseline")
    for mission in entry["missions"]:
        if mission["link"]:
            assert (tmp_path / "site" / mission["link"]).stat().st_size > 10000


def test_the_standings_of_the_rules_are_those_of_the_entries(gnbv):
    entries = sorted(map(str, (REPOSITORY / "suite/entries").glob("*.zip")))
    table = gnbv("bench", "table", *entries, "--format", "markdown").check({0}).out
    assert table.strip() in (REPOSITORY / "docs/suite.md").read_text()
