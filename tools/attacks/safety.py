#!/usr/bin/env python3
"""Safety of flight: random small worlds of boxes, spheres, poles, thin walls, wires and gaps, with
random sensors, noise, estimates, starts, paths and profiles, flown by every utility. No mission may
touch what its map shows, every one has to end for a stated reason, and no view may be taken nearer
than the collision radius to surface that the profile showed. Who touches a wire that no pixel or
beam has met often enough for its map is counted by itself: the planner knows nothing of it. So is
who touches the ground in a mission that strayed from its path by more than is kept free, and says so.

usage: safety.py [--gnbv FILE] [--worlds N] [--seed N] [--views N] [--jobs N] [--timeout S]
                 [--estimates MODEL,...] [--keep DIR]
  --timeout S  a mission may take, before it counts as one that does not end (300)
  --estimates  models of the state estimate to draw from (none,mocap)
  --keep DIR   the scenario and mesh of every world that failed
exit: 0 nothing found, 1 failures (named on stderr with the command), 2 bad usage
"""
import argparse
import collections
import concurrent.futures
import csv
import json
import math
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile

from map_files import nearest_surface, read_mesh, read_occupied, read_surface
from run_attack import REPOSITORY

UTILITIES = """proposed bircher isler occlusion_aware unobserved_voxel rear_side_voxel
rear_side_entropy average_entropy proximity_count area_factor kriegel bircher_volume aep random
nearest_frontier uniform_hemisphere lawnmower tour route""".split()
HALF_M = 4.0  # the workspace is [-4, 4] x [-4, 4] x [0, 5]
TOP_M = 5.0
REACH_M = 2.3  # what stands there keeps so near to the middle: the profile flies on the faces


class Mesh:
    def __init__(self):
        self.vertices, self.faces = [], []

    def box(self, low, high):
        n = len(self.vertices)
        self.vertices += [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1])
                          for z in (low[2], high[2])]
        self.faces += [tuple(n + i for i in face) for face in
                       ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4),
                        (1, 5, 7, 3))]

    def tube(self, low, high, radius, sides=8):
        """Upright or level: from one point to the other, closed."""
        n = len(self.vertices)
        level = abs(high[2] - low[2]) < 1e-9
        along = math.atan2(high[1] - low[1], high[0] - low[0])
        for end in (low, high):
            for k in range(sides):
                a = 2 * math.pi * k / sides
                c, s = radius * math.cos(a), radius * math.sin(a)
                self.vertices.append((end[0] - c * math.sin(along), end[1] + c * math.cos(along),
                                      end[2] + s) if level else (end[0] + c, end[1] + s, end[2]))
        for k in range(sides):
            j = (k + 1) % sides
            self.faces.append((n + k, n + j, n + sides + j, n + sides + k))
        self.faces.append(tuple(n + k for k in reversed(range(sides))))
        self.faces.append(tuple(n + sides + k for k in range(sides)))

    def ball(self, centre, radius, rings=6, sides=10):
        n = len(self.vertices)
        for i in range(1, rings):
            up = math.pi * i / rings
            for k in range(sides):
                a = 2 * math.pi * k / sides
                self.vertices.append((centre[0] + radius * math.sin(up) * math.cos(a),
                                      centre[1] + radius * math.sin(up) * math.sin(a),
                                      centre[2] + radius * math.cos(up)))
        top = len(self.vertices)
        self.vertices += [(centre[0], centre[1], centre[2] + radius),
                          (centre[0], centre[1], centre[2] - radius)]
        for k in range(sides):
            j = (k + 1) % sides
            self.faces.append((top, n + k, n + j))
            last = n + (rings - 2) * sides
            self.faces.append((top + 1, last + j, last + k))
            for i in range(rings - 2):
                a, b = n + i * sides, n + (i + 1) * sides
                self.faces.append((a + k, b + k, b + j, a + j))

    def write(self, path):
        with open(path, "w") as file:
            for v in self.vertices:
                file.write("v %.5f %.5f %.5f\n" % v)
            for f in self.faces:
                file.write("f " + " ".join(str(i + 1) for i in f) + "\n")


def random_mesh(rng):
    mesh = Mesh()
    def at():
        return rng.uniform(-REACH_M + 0.6, REACH_M - 0.6)
    for _ in range(rng.randint(1, 4)):
        kind = rng.choice(["box", "ball", "pole", "wall", "wire", "gap"])
        x, y = at(), at()
        height = rng.choice([rng.uniform(0.5, 3.8), TOP_M])
        if kind == "box":
            a, b = rng.uniform(0.1, 0.6), rng.uniform(0.1, 0.6)
            mesh.box((x - a, y - b, 0), (x + a, y + b, height))
        elif kind == "ball":
            radius = rng.uniform(0.2, 0.6)
            mesh.ball((x, y, rng.uniform(radius, 3.5)), radius)
        elif kind == "pole":
            mesh.tube((x, y, 0), (x, y, height), rng.uniform(0.01, 0.1))
        elif kind == "wall":
            mesh.box((x, -REACH_M, 0), (x + rng.uniform(0.005, 0.05), rng.uniform(0, REACH_M),
                                        height))
        elif kind == "wire":
            z = rng.uniform(0.8, 4.0)
            mesh.tube((-REACH_M, y, z), (REACH_M, y, z), rng.uniform(0.004, 0.02))
        else:  # two boxes with a gap about as wide as the vehicle
            half = rng.uniform(0.2, 1.2)
            mesh.box((x - 0.1, -REACH_M, 0), (x + 0.1, -half, height))
            mesh.box((x - 0.1, half, 0), (x + 0.1, REACH_M, height))
    if len(mesh.faces) < 30:  # something to measure
        mesh.box((-0.4, -0.4, 0), (0.4, 0.4, 1.0))
    return mesh


def world(rng, utility, views):
    """A scenario as YAML; mesh.obj stands beside it."""
    angle = rng.uniform(-math.pi, math.pi)
    radius = rng.uniform(2.4, 3.6)
    x, y = radius * math.cos(angle), radius * math.sin(angle)
    path = rng.choice(["straight", "straight", "astar"])
    method = rng.choice(["bounding_box", "bounding_box", "circular", "none"])
    # routes are laid around what the profile found
    if utility in ("uniform_hemisphere", "lawnmower"):
        method = "bounding_box"
    pose = "{{position_m: [{:.2f}, {:.2f}, {:.2f}], yaw_deg: {:.0f}}}"
    given = ", ".join(pose.format(rng.uniform(-3.9, 3.9), rng.uniform(-3.9, 3.9),
                                  rng.uniform(0.8, 4.9), rng.uniform(-180, 180))
                      for _ in range(views))
    noise = rng.choice(["none", "released", "khoshelham", "nguyen", "stereo"])
    return f"""name: safety
workspace_m: {{min: [-{HALF_M}, -{HALF_M}, 0], max: [{HALF_M}, {HALF_M}, {TOP_M}]}}
structure: {{file: {{path: mesh.obj}}}}
seed: {rng.randrange(1, 1 << 31)}
cameras:
  - {{name: a, width_px: {rng.choice([80, 160])}, height_px: {rng.choice([60, 120])},
     fov_x_deg: {rng.uniform(40, 100):.1f}, range_max_m: {rng.uniform(2.5, 6):.2f},
     rate_hz: {rng.choice([0, 0, 5])}, drop_probability: {rng.choice([0, 0, 0.3])},
     noise: {{model: {noise}}}}}
lidars: [{{name: l, beams: 181, rate_hz: 10, range_max_m: {rng.uniform(6, 12):.1f}}}]
vehicle:
  preset: {rng.choice(["iris", "iris_sitl_2019", "authors", "f450"])}
  kind: {rng.choice(["quadrotor", "quadrotor", "quadrotor", "ideal"])}
  estimate: {{model: none}}
guidance: {{profile_speed_m_s: {rng.choice([1, 2])}, path_speed_m_s: {rng.uniform(0.5, 3):.2f}}}
start: {{position_m: [{x:.2f}, {y:.2f}, {rng.uniform(0.9, 4.5):.2f}],
        yaw_deg: {rng.uniform(-180, 180):.0f}, jitter_m: [0, 0, 0]}}
planner:
  map: {{resolution_m: {rng.choice([0.1, 0.2, 0.2, 0.3])}}}
  cloud: {{leaf_m: 0.05}}
  profiling: {{method: {method}}}
  validity: {{collision_radius_m: {rng.uniform(0.6, 1.0):.2f}, path: {path}}}
  utility: {{name: {utility}}}
  routes: {{standoff_m: {rng.uniform(1.0, 2.5):.2f}{", views: [" + given + "]"
                                                    if utility == "route" else ""}}}
  termination: {{max_iterations: {views}}}
"""


STRAYED = "off its path, more than"  # tools/gnbv/margin_note.cpp
NOT_SHOWN = "what its map does not show"


def touched(place):
    """What the mission touched: the ground, or something that the map shows or does not."""
    out = os.path.join(place, "out")
    with open(os.path.join(out, "trajectory.tum")) as file:
        p = tuple(map(float, file.read().split("\n")[-2].split()[1:4]))
    nearest = nearest_surface(read_mesh(os.path.join(place, "mesh.obj")), p)
    if p[2] < math.dist(p, nearest):
        return "the ground"
    voxel_m, occupied = read_occupied(os.path.join(out, "map.bt"))
    key = tuple(math.floor(x / voxel_m) + 32768 for x in nearest)
    is_shown = any((key[0] + x, key[1] + y, key[2] + z) in occupied
                   for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1))
    return "what its map shows" if is_shown else NOT_SHOWN


def nearest_m(points, p):
    return min((math.dist(p, q) for q in points), default=math.inf)


def fault_of(place, scenario, notes):
    """(how it ended, fault or None) of a finished mission, and what it said."""
    out = os.path.join(place, "out")
    with open(os.path.join(out, "summary.json")) as file:
        summary = json.load(file)
    end = summary["termination"]
    if end == "collision" or summary.get("collisions", 0):
        what = touched(place)
        if what == "the ground" and STRAYED in notes:
            return "touched the ground, having strayed", None
        if what != NOT_SHOWN:
            return end, "touched " + what
        end = "touched " + what
    radius_m = float(scenario.split("collision_radius_m: ")[1].split(",")[0])
    surface = read_surface(os.path.join(out, "profile.map"))
    with open(os.path.join(out, "iterations.csv")) as file:
        rows = list(csv.DictReader(file))
    key = {name.split("_")[0]: name for name in rows[0]} if rows else {}
    for row in rows[1:]:  # the first is the start, which may be near
        p = tuple(float(row[key[axis]]) for axis in "xyz")
        if nearest_m(surface, p) < radius_m - 1e-6:
            return end, f"view {row[key['iteration']]} is {nearest_m(surface, p):.2f} m from the profile"
    return end, None


def fly(number, options, folder):
    """(utility, how it ended, fault or None)"""
    rng = random.Random(options.seed * 1_000_003 + number)
    utility = UTILITIES[number % len(UTILITIES)]
    place = os.path.join(folder, str(number))
    os.mkdir(place)
    random_mesh(rng).write(os.path.join(place, "mesh.obj"))
    scenario = world(rng, utility, options.views)
    if options.estimates:
        scenario = scenario.replace("{model: none}\nguid", "{model: %s}\nguid"
                                    % rng.choice(options.estimates)).replace(
                                        "kind: ideal", "kind: quadrotor")
    path = os.path.join(place, "scenario.yaml")
    with open(path, "w") as file:
        file.write(scenario)
    out = os.path.join(place, "out")
    command = [options.gnbv, "run", path, "--threads", "1", "--out", out]
    try:
        done = subprocess.run(command, capture_output=True, timeout=options.timeout,
                              stdin=subprocess.DEVNULL, env={**os.environ, "GNBV_CACHE": ""})
        notes = done.stderr.decode("utf-8", "replace").strip()
        said = notes.split("\n")[-1]
        if os.path.exists(os.path.join(out, "summary.json")):
            end, fault = fault_of(place, scenario, notes)
            if done.returncode not in (0, 1):
                fault = f"exit {done.returncode}: {said}"
        elif done.returncode == 2 and said.startswith("gnbv: "):
            end, fault = "refused: " + said.split(": value")[0].split(": ")[-1][:40], None
        else:
            end, fault = "failed", f"exit {done.returncode}: {said}"
    except subprocess.TimeoutExpired:
        end, fault = "timeout", "did not end"
    if fault and options.keep:
        shutil.copytree(place, os.path.join(options.keep, f"{options.seed}-{number}"),
                        dirs_exist_ok=True)
    shutil.rmtree(place)
    return utility, end, fault and f"world {number} ({utility}): {fault}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--gnbv", default=REPOSITORY / "build/release/gnbv")
    parser.add_argument("--worlds", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--views", type=int, default=8)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--timeout", type=float, default=300.0)
    parser.add_argument("--estimates", type=lambda s: s.split(","), default=["none", "mocap"],
                        help="models of the state estimate to draw from")
    parser.add_argument("--keep")
    options = parser.parse_args()
    options.gnbv = os.path.abspath(options.gnbv)
    ends, faults = collections.Counter(), []
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    with tempfile.TemporaryDirectory() as folder, \
            concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        flights = [pool.submit(fly, n, options, folder) for n in range(options.worlds)]
        try:
            for flight in flights:
                utility, end, fault = flight.result()
                ends[end] += 1
                if fault:
                    faults.append(fault)
                    print(fault, file=sys.stderr, flush=True)
        except KeyboardInterrupt:  # what was flown so far counts
            pool.shutdown(wait=True, cancel_futures=True)
    print(f"{'attack':<24}{'tries':>8}{'failures':>10}")
    print(f"{'safety of flight':<24}{ends.total():>8}{len(faults):>10}")
    for end, count in ends.most_common():
        print(f"  {end:<42}{count:>6}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
