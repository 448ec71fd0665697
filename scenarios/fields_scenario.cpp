#include "scenarios/fields.hpp"

namespace gnbv {
namespace {

constexpr Range kCoordinate_m = between(-1e4, 1e4);

}  // namespace

void fields(FieldVisitor& v, StructureConfig& c) {
  v.choice("builtin", c.builtin, kStructureNames, "Built-in structure, unless file.path is given.");
  v.section("file", c.file, "A mesh of your own.");
  v.flag("ground", c.ground, "Whether there is a solid ground at z = 0.");
}

void fields(FieldVisitor& v, StartConfig& c) {
  v.number("position_m", c.pose.p_world_m, kCoordinate_m, "Where the views begin, world ENU.");
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

void fields(FieldVisitor& v, ScoreConfig& c) {
  v.numbers("sizes_m", c.sizes_m, between(0.01, 10),
            "Edges of the voxels that coverage is told of, beside the paper's 0.05, 0.10 and "
            "0.50, which are measured in any case.");
}

void fields(FieldVisitor& v, Scenario& c) {
  v.word("name", c.name, "Name of the scenario, for reports.");
  v.integer("seed", c.seed, "Moves the start pose and keys all noise.");
  v.box("workspace_m", c.workspace_m, kCoordinate_m, "What is mapped and flown in, world ENU.");
  v.section("structure", c.structure, "What stands there.");
  v.list("cameras", c.cameras, {1, 16}, "The depth cameras on the vehicle.");
  v.list("lidars", c.lidars, {0, 16}, "The LIDARs that scan the profile.");
  v.section("vehicle", c.vehicle, "What flies.");
  v.section("guidance", c.guidance, "How it flies from view to view.");
  v.section("start", c.start, "Where the views begin.");
  v.section("planner", c.planner, "What is believed and decided.");
  v.section("benchmark", c.benchmark, "What the truth decides, which no real mission knows.");
  v.section("score", c.score, "What missions are scored by.");
}

}  // namespace gnbv
