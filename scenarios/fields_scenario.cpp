#include "scenarios/fields.hpp"

namespace gnbv {

void fields(FieldVisitor& v, Box3& c) {
  constexpr Range kCoordinate_m = between(-1e4, 1e4);
  Vec3 min_m = c.min();
  Vec3 max_m = c.max();
  v.number("min", min_m, kCoordinate_m, "Lowest x, y and z, world ENU.");
  v.number("max", max_m, kCoordinate_m, "Highest x, y and z.");
  c = Box3(min_m, max_m);
}

void fields(FieldVisitor& v, StructureConfig& c) {
  v.only_if(c.file.path.empty(), ".file.path")
      .only_if(c.files.empty(), ".files")
      .choice("builtin", c.builtin, kStructureNames,
              "Built-in structure, unless file.path is given.");
  v.section("file", c.file, "A mesh of your own.");
  v.list("files", c.files, {0, 256}, "More meshes of the same structure, each placed by itself.");
  v.flag("ground", c.ground,
         "Whether there is a solid ground at z = 0, where no terrain is given.");
}

void fields(FieldVisitor& v, ObstacleConfig& c) {
  v.section("file", c.file, "A mesh.");
  v.section("box_m", c.box_m, "Without one, a box, world ENU.");
}

void fields(FieldVisitor& v, NoFlyConfig& c) { fields(v, c.box_m); }

void fields(FieldVisitor& v, ScoreConfig& c) {
  v.in_papers_setting().section("region_m", c.region_m,
                                "What of the structure is scored, world ENU.");
  v.number("sizes_m", c.sizes_m, between(0.01, 10),
           "Edges of the voxels that coverage is told of, beside the paper's 0.05, 0.10 and "
           "0.50, which are measured in any case.");
}

void fields(FieldVisitor& v, StartConfig& c) {
  v.number("position_m", c.pose.p_world_m, between(-1e4, 1e4), "Where the views begin, world ENU.");
  v.angle("yaw_deg", c.pose.yaw_rad, between(-360, 360), "Heading there, 0 = east, 90 = north.");
  v.number("jitter_m", c.jitter_m, between(0, 1e4),
           "The seed moves the start by up to this, within the navigation box.");
  v.angle("jitter_yaw_deg", c.jitter_yaw_rad, between(0, 180), "And turns it by up to this.");
}

void fields(FieldVisitor& v, BenchmarkConfig& c) {
  v.number("stop_at_coverage", c.stop_at_coverage, between(0, 1),
           "Over when the cloud covers this share of the voxels of 0.05 m with surface seen from "
           "outside, summary.json's coverage.final at 0.05; 0: never.");
}

void fields(FieldVisitor& v, Scenario& c) {
  v.begin_whole(c);
  v.word("name", c.name, "Name of the scenario, for reports.");
  v.integer("seed", c.seed, "Moves the start pose and keys all noise.");
  v.in_papers_setting().section("workspace_m", c.workspace_m,
                                "What is mapped and flown in, world ENU.");
  v.section("structure", c.structure, "What stands there.");
  v.in_papers_setting().section("terrain", c.terrain,
                                "A mesh in the place of the plane ground; not scored.");
  v.in_papers_setting().list("obstacles", c.obstacles, {0, 256},
                             "What is seen, solid, unknown and not scored.");
  v.in_papers_setting().list("no_fly", c.no_fly, {0, 256},
                             "Boxes that the collision sphere keeps out of; unseen.");
  v.section("score", c.score, "What is scored.");
  v.in_papers_setting().list("cameras", c.cameras, {1, 16}, "The depth cameras on the vehicle.");
  v.in_papers_setting().list("lidars", c.lidars, {0, 16}, "The LIDARs that scan the profile.");
  v.section("vehicle", c.vehicle, "What flies.");
  v.section("guidance", c.guidance, "How it flies from view to view.");
  v.in_papers_setting().section("wind", c.wind, "The air it flies in.");
  v.section("start", c.start, "Where the views begin.");
  v.section("planner", c.planner, "What is believed and decided.");
  v.in_papers_setting().section("benchmark", c.benchmark,
                                "What the truth decides, which no real mission knows.");
}

}  // namespace gnbv
