"""Safety of flight: random small worlds, flown by every utility, and nothing is touched.

Worlds of boxes, spheres, poles, thin walls, wires and gaps, with random sensors, noise, estimates,
starts, paths and profiles. No mission may touch what its map shows, every one has to end for a
stated reason, and no view may be taken nearer than the collision radius to surface that the profile
showed. Who touches a wire that no pixel or beam has met often enough for its map is counted by
itself: the planner knows nothing of it. So is who touches the ground in a mission that strayed from
its path by more than is kept free, and says so.

--tries N worlds, --keep DIR for the scenario and mesh of every world that failed.
"""
import csv
import math
import random
import shutil

from map_files import nearest_surface, read_mesh, read_points, read_surface
from program import json_of, summary

TRIES = 1000
VIEWS = 8

UTILITIES = """proposed bircher isler occlusion_aware unobserved_voxel rear_side_voxel
rear_side_entropy average_entropy proximity_count area_factor kriegel bircher_volume aep random
nearest_frontier uniform_hemisphere lawnmower tour route""".split()
HALF_M = 4.0  # the workspace is [-4, 4] x [-4, 4] x [0, 5]
TOP_M = 5.0
REACH_M = 2.3  # what stands there keeps so near to the middle: the profile flies on the faces


class Mesh:
    def __init__(self):
        self.vertices, self.faces = [], []

    def stack(self, rings):
        """Rings of points, one above the other, closed at both ends."""
        n, sides = len(self.vertices), len(rings[0])
        self.vertices += [point for ring in rings for point in ring]
        for low in range(n, n + sides * (len(rings) - 1), sides):
            self.faces += [(low + k, low + (k + 1) % sides, low + sides + (k + 1) % sides,
                            low + sides + k) for k in range(sides)]
        self.faces.append(tuple(reversed(range(n, n + sides))))
        self.faces.append(tuple(range(len(self.vertices) - sides, len(self.vertices))))

    def box(self, low, high):
        (x0, y0, z0), (x1, y1, z1) = low, high
        self.stack([[(x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z)] for z in (z0, z1)])

    def round(self, x, y, radii, sides=8):
        """Around an upright axis: (height, radius) from below."""
        turns = [2 * math.pi * k / sides for k in range(sides)]
        self.stack([[(x + r * math.cos(a), y + r * math.sin(a), z) for a in turns]
                    for z, r in radii])

    def ball(self, x, y, z, radius):
        ups = [math.pi * (i + 0.1) / 6.2 for i in range(7)]
        self.round(x, y, [(z - radius * math.cos(up), radius * math.sin(up)) for up in ups], 10)

    def wire(self, y, z, radius):
        turns = [2 * math.pi * k / 8 for k in range(8)]
        self.stack([[(x, y + radius * math.cos(a), z + radius * math.sin(a)) for a in turns]
                    for x in (-REACH_M, REACH_M)])

    def write(self, path):
        path.write_text("".join(["v %.5f %.5f %.5f\n" % v for v in self.vertices] + [
            "f " + " ".join(str(i + 1) for i in f) + "\n" for f in self.faces]))


def random_mesh(rng):
    mesh = Mesh()
    for _ in range(rng.randint(1, 4)):
        kind = rng.choice(["box", "ball", "pole", "wall", "wire", "gap"])
        x, y = (rng.uniform(-REACH_M + 0.6, REACH_M - 0.6) for _ in "xy")
        height = rng.choice([rng.uniform(0.5, 3.8), TOP_M])
        if kind == "box":
            a, b = rng.uniform(0.1, 0.6), rng.uniform(0.1, 0.6)
            mesh.box((x - a, y - b, 0), (x + a, y + b, height))
        elif kind == "ball":
            radius = rng.uniform(0.2, 0.6)
            mesh.ball(x, y, rng.uniform(radius, 3.5), radius)
        elif kind == "pole":
            mesh.round(x, y, [(z, rng.uniform(0.01, 0.1)) for z in (0, height)])
        elif kind == "wall":
            mesh.box((x, -REACH_M, 0),
                     (x + rng.uniform(0.005, 0.05), rng.uniform(0, REACH_M), height))
        elif kind == "wire":
            mesh.wire(y, rng.uniform(0.8, 4.0), rng.uniform(0.004, 0.02))
        else:  # two boxes with a gap about as wide as the vehicle
            half = rng.uniform(0.2, 1.2)
            mesh.box((x - 0.1, -REACH_M, 0), (x + 0.1, -half, height))
            mesh.box((x - 0.1, half, 0), (x + 0.1, REACH_M, height))
    if len(mesh.faces) < 30:  # something to measure
        mesh.box((-0.4, -0.4, 0), (0.4, 0.4, 1.0))
    return mesh


def world(rng, utility, views, estimate):
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
  kind: {"quadrotor" if estimate != "none" else rng.choice(["quadrotor"] * 3 + ["ideal"])}
  estimate: {{model: {estimate}}}
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


STRAYED = "off its path, more than"  # tools/run/mission_result.cpp
NOT_SHOWN = "what its map does not show"


def touched(gnbv, place):
    """What the mission touched: the ground, or something that the map shows or does not."""
    p = tuple(map(float, (place / "out/trajectory.tum").read_text().split("\n")[-2].split()[1:4]))
    nearest = nearest_surface(read_mesh(place / "mesh.obj"), p)
    if p[2] < math.dist(p, nearest):
        return "the ground"
    gnbv("export", "out", "--format", "plain", "-o", "map", "--quiet").check({0})
    voxel_m = json_of(place / "map/map.json")["voxel_m"]
    low = [voxel_m * (math.floor(x / voxel_m) - 1) for x in nearest]  # its voxel and those around
    is_shown = any(all(0 < x - least < 3 * voxel_m for x, least in zip(centre, low))
                   for centre in read_points(place / "map/voxels.ply"))
    return "what its map shows" if is_shown else NOT_SHOWN


def check_views(place, radius_m):
    """None is nearer to the profile, but for the first: the start may be near."""
    surface = read_surface(place / "out/profile.map")
    rows = list(csv.DictReader((place / "out/iterations.csv").open()))
    key = {name.split("_")[0]: name for name in rows[0]} if rows else {}
    for row in rows[1:]:
        p = tuple(float(row[key[axis]]) for axis in "xyz")
        nearest_m = min((math.dist(p, q) for q in surface), default=math.inf)
        assert nearest_m >= radius_m - 1e-6, f"view {row[key['iteration']]}"


def check_flight(gnbv, place, scenario, end):
    """How it ended."""
    flown = summary(place / "out")
    if flown is None:
        end.check({2}, ["gnbv: "])
        return "refused: " + end.err.split("\n")[-2].split(": value")[0].split(": ")[-1][:40]
    end.check({0, 1})
    if flown["termination"] == "collision" or flown.get("collisions", 0):
        what = touched(gnbv, place)
        if what == "the ground" and STRAYED in end.err:
            return "touched the ground, having strayed"
        assert what == NOT_SHOWN
    check_views(place, float(scenario.split("collision_radius_m: ")[1].split(",")[0]))
    return flown["termination"]


def test_touches_nothing_that_its_map_shows(gnbv, tmp_path, request, views, count, attempt):
    rng = random.Random(request.config.option.seed * 1_000_003 + attempt)
    utility = UTILITIES[attempt % len(UTILITIES)]
    random_mesh(rng).write(tmp_path / "mesh.obj")
    scenario = world(rng, utility, views, rng.choice(["none", "mocap"]))
    (tmp_path / "scenario.yaml").write_text(scenario)
    end = gnbv("run", "scenario.yaml", "--threads", "1", "--out", "out")
    try:
        count(check_flight(gnbv, tmp_path, scenario, end))
    except AssertionError:
        if keep := request.config.option.keep:
            shutil.copytree(tmp_path, keep / f"{attempt}-{utility}", dirs_exist_ok=True)
        raise
