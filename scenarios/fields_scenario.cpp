#include <algorithm>

#include "scenarios/fields.hpp"

namespace gnbv {
namespace {

/// Whether LIDARs see anything: the profile, surface between the views, or what cameras see.
bool lidars_scan(const Scenario& s) {
  const auto looks = [&](const LidarConfig& c) { return looks_at_views(c, !s.cameras.empty()); };
  return flies_a_profile(s) || s.planner.profiling.flight_rate_hz > 0.0 ||
         std::ranges::any_of(s.lidars, looks);
}

}  // namespace

void fields(const Keys& key, Box3& c) {
  constexpr Range kCoordinate_m = {-1e4, 1e4};
  Vec3 min_m = c.min();
  Vec3 max_m = c.max();
  key("min", min_m, kCoordinate_m, "Lowest x, y and z, world ENU.");
  key("max", max_m, kCoordinate_m, "Highest x, y and z.");
  c = Box3(min_m, max_m);
}

void fields(const Keys& key, MeshFileConfig& c) {
  constexpr std::array<std::string_view, 4> kUpAxes = {"auto", "x", "y", "z"};
  key.path("path", c.path,
           "Mesh file (OBJ, STL, PLY, DAE, GLTF, GLB, SDF, URDF) or the folder of a Gazebo model; "
           "empty: none.");
  const Keys of_mesh = key.only_if(!c.path.empty(), ".path");
  of_mesh("scale", c.scale, positive(1e6), "Factor on the file's coordinates.");
  of_mesh.angle("yaw_deg", c.yaw_rad, {-360, 360},
                "Turn about the file's origin, counter-clockwise when seen from above.");
  of_mesh(
      "offset_m", c.offset_m, {-1e8, 1e8},
      "Added after scaling, along the world's axes. Survey coordinates may be millions of metres.");
  of_mesh("up_axis", c.up_axis, kUpAxes,
          "Axis of the file that points up; auto: as the file says, else z.");
  of_mesh("unit_m", c.unit_m, {0, 1e6},
          "Metres per unit of the file; 0: as the file says, else 1.");
  of_mesh("lost_max", c.lost_max, {0, 1},
          "Share of the faces that may be unusable; beyond it the mesh is refused.");
}

void fields(const Keys& key, StructureConfig& c) {
  const Keys unless_files =
      key.only_if(c.file.path.empty(), ".file.path").only_if(c.files.empty(), ".files");
  unless_files("builtin", c.builtin, kStructureNames, "Built-in structure, without a file.");
  key.section("file", c.file, "A mesh of your own.");
  key.list("files", c.files, {0, 256}, "More meshes of the same structure, each placed by itself.");
  key("offset_m", c.offset_m, {-1e4, 1e4},
      "Moves the whole structure, also a built-in one, along the world's axes. `--mesh` sets it to "
      "0.");
  key("ground", c.ground, "Whether the plane z = 0 is solid ground, where no terrain is given.");
}

void fields(const Keys& key, WaypointConfig& c) {
  key("offset_m", c.offset_m, {-1e4, 1e4}, "From where the body stands, world axes.");
}

void fields(const Keys& key, MotionConfig& c) {
  key.list("waypoints", c.waypoints, {0, 256},
           "From where the body stands straight to each, without turning; none: it stands.");
  const Keys moving = key.only_if(!c.waypoints.empty(), ".waypoints");
  moving("speed_m_s", c.speed_m_s, positive(50), "All the way, from the mission's first moment.");
  moving("loop", c.loop, "Back to where it stood and around again; else it stays at the last one.");
  moving("known", c.known, "Whether legs are timed by it; else only what sensors saw is avoided.");
}

void fields(const Keys& key, ObstacleConfig& c) {
  key.section("file", c.file, "A mesh.");
  key.section("box_m", c.box_m, "Or a box, world ENU.");
  key.section("motion", c.motion, "How it moves.");
}

void fields(const Keys& key, NoFlyConfig& c) { fields(key, c.box_m); }

void fields(const Keys& key, ScoreConfig& c) {
  using enum ScoreReference;
  key("reference", c.reference, {{outside, "outside"}, {area_samples, "area_samples"}},
      "Which voxels coverage counts. outside: those with visible surface; area_samples: those with "
      "a point of a sparse sample of all surface, as the paper's authors count.");
  key.only_if(c.reference == area_samples, ".reference")(
      "area_samples", c.area_samples, {1, 1e7},
      "Number of points of that sample, drawn by area above planner.floor_z_m. All missions have "
      "the same points.");
  key.of_papers_setting().section("region_m", c.region_m, "What is scored, world ENU.");
  key("sizes_m", c.sizes_m, {0.01, 10},
      "Edges of the voxels of which coverage is shown; the paper's 0.05, 0.10 and 0.50 are always "
      "measured.");
  key("budget_views", c.budget_views, {1, 1e6},
      "Mean coverage is taken over this many views, however many a mission flew. A share that is "
      "reached later counts as not reached in tables and comparisons.");
  key("budget_m", c.budget_m, positive(1e6), "The same in metres from the first view on.");
  key("budget_s", c.budget_s, positive(1e7), "The same in seconds from the end of the profile on.");
}

void fields(const Keys& key, StartConfig& c) {
  std::vector<std::string_view> names;
  for (const NamedStart& start : kNamedStarts) names.push_back(start.name);
  const std::string before = c.preset;
  key("preset", c.preset, names, "Sets position and yaw to those of the authors' code.");
  if (c.preset != before && c.preset != "own") {
    c.pose = std::ranges::find(kNamedStarts, c.preset, &NamedStart::name)->pose;
  }
  key("position_m", c.pose.p_world_m, {-1e4, 1e4}, "Where the views begin, world ENU.");
  key.angle("yaw_deg", c.pose.yaw_rad, {-360, 360}, "Heading there, 0 = east, 90 = north.");
  key("jitter_m", c.jitter_m, {0, 1e4},
      "The seed moves the start by up to this, within the navigation box.");
  key.angle("jitter_yaw_deg", c.jitter_yaw_rad, {0, 180},
            "The seed turns the start by up to this.");
  key("on_ground", c.on_ground,
      "The mission takes off from the ground below the start; false: it begins at the start, "
      "hovering.");
}

void fields(const Keys& key, BenchmarkConfig& c) {
  key("stop_at_coverage", c.stop_at_coverage, {0, 1},
      "The mission ends when the cloud covers this share of the voxels of 0.05 m that "
      "score.reference counts (coverage.final in summary.json); 0: never.");
}

void fields(const Keys& key, Scenario& c) {
  const Keys papers = key.of_papers_setting();
  key.word("name", c.name, "Name of the scenario, for reports.");
  key("seed", c.seed, "Moves the start pose; all random numbers come from it.");
  papers.section("workspace_m", c.workspace_m, "The box that is mapped and flown in, world ENU.");
  key.section("structure", c.structure, "What is reconstructed and scored.");
  papers.section("terrain", c.terrain, "A mesh instead of the plane ground; it is not scored.");
  papers.list("obstacles", c.obstacles, {0, 256},
              "Meshes and boxes that are seen and solid. The planner does not know them, and they "
              "are not scored.");
  papers.list("no_fly", c.no_fly, {0, 256},
              "Boxes that the collision sphere keeps out of. No sensor sees them.");
  key.section("score", c.score, "What is scored.");
  papers.list("cameras", c.cameras, {0, 16}, "The depth cameras on the vehicle.");
  papers.only_if(lidars_scan, "planner.profiling.method")
      .list("lidars", c.lidars, {0, 16}, "The LIDARs on it.");
  key.section("vehicle", c.vehicle, "What flies.");
  key.section("guidance", c.guidance, "How the vehicle flies from view to view.");
  papers.section("wind", c.wind, "The air that the vehicle flies in.");
  key.section("start", c.start, "Where the views begin.");
  key.section("planner", c.planner, "What is believed and decided.");
  papers.section("benchmark", c.benchmark,
                 "What is decided on the true surface, which no real mission knows.");
  key("portable", c.portable,
      "The mission has the same digits on every x86-64 processor, for which sensing takes longer.");
}

}  // namespace gnbv
