
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "assets/catalog.hpp"
#include "scenarios/load.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/core/rng.hpp"
#include "sim/mesh/mesh_file.hpp"
#include "tests/bench/shapes.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/mesh_lint/mesh_report.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/mission/resolve.hpp"
#include "tools/mission/start_pose.hpp"

namespace gnbv {
namespace {

/// What a user has typed after `gnbv lint MESH`.
struct Typed {
  std::vector<std::string> sets;
  bool bounds_auto = false;
};

MeshReport report_on(const std::string& path, const std::string& scenario, const Typed& typed) {
  std::vector<std::string> sets = {"structure.file.path=" + path};
  sets.insert(sets.end(), typed.sets.begin(), typed.sets.end());
  return report_on_mesh(load_scenario(scenario, sets), typed.bounds_auto, 2);
}

/// As `gnbv run` begins: throws what it would refuse.
void begin_run(const std::string& path, const std::string& scenario_name, const Typed& typed) {
  ScenarioOptions options;
  options.scenario = scenario_name;
  options.mesh = path;
  options.overrides = typed.sets;
  options.bounds_auto = typed.bounds_auto;
  const Scenario scenario = resolve_scenario(options);
  std::vector<std::string> warnings;
  const World world = load_world(scenario, warnings);
  const RayScene scene(world);
  need_way_out(scenario, scene, bounds_m(world.structure), start_pose(scenario, scene), 1);
}

double between(double low, double high, std::uint64_t key, std::uint64_t i) {
  return low + (high - low) * uniform01({key, Stream::bench, 7, i});
}

/// The mesh in other units, on another axis, elsewhere.
TriangleMesh moved(TriangleMesh mesh, std::uint64_t key) {
  const double scale = std::pow(10.0, between(-3.0, 3.0, key, 0));
  const double turn = between(0.0, 3.0, key, 1);
  const char up = turn < 1.0 ? 'x' : turn < 2.0 ? 'y' : 'z';
  // farther off, float coordinates would not hold its shape
  const double spread_m = std::min(std::pow(10.0, between(-4.0, 6.0, key, 2)), 1e4 * scale);
  const bool is_moved = between(0.0, 1.0, key, 6) < 0.7;
  const Vec3 offset_m =
      (is_moved ? spread_m : 0.0) *
      Vec3(between(-1, 1, key, 3), between(-1, 1, key, 4), between(-1, 1, key, 5));
  const Eigen::Matrix3d R_file_world = R_z_up(up).transpose();
  for (Vec3f& v : mesh.vertices_m) {
    v = (scale * (R_file_world * v.cast<double>()) + offset_m).cast<float>();
  }
  return mesh;
}

/// Looks, does all it is told, looks again, does that, too; after which there is nothing to say
/// that keeps a mission from flying.
void expect_two_rounds_do(const std::string& path, const std::string& scenario,
                          const std::string& what) {
  Typed typed;
  for (int round = 0; round < 2; ++round) {
    const MeshReport report = report_on(path, scenario, typed);
    for (const std::string& set : report.advice.sets()) typed.sets.push_back(set);
    typed.bounds_auto = typed.bounds_auto || report.advice.needs_bounds;
  }
  const MeshReport last = report_on(path, scenario, typed);
  EXPECT_TRUE(last.is_usable()) << what << "\n" << terminal_text(last);
  EXPECT_TRUE(last.advice.sets().empty()) << what << "\n" << terminal_text(last);
  EXPECT_NO_THROW(begin_run(path, scenario, typed)) << what << "\n" << terminal_text(last);
}

TEST(Advice, TwoRoundsOfItMakeAnyTransformOfAMeshUsable) {
  TempFolder temp;
  const std::string path = (temp.path() / "t.obj").string();
  std::vector<std::pair<std::string, TriangleMesh>> meshes;
  for (const char* name : {"smoke", "lab_model", "lab_airplane", "aircraft"}) {
    meshes.emplace_back(name, make_builtin_structure(name));
  }
  TriangleMesh plate;
  test::add_sheet(plate, {0, 0, 0}, {4, 0, 0}, {0, 4, 0});
  meshes.emplace_back("plate", plate);
  TriangleMesh mast;
  test::add_box(mast, {0, 0, 0}, {0.2, 0.2, 40});
  meshes.emplace_back("mast", mast);
  TriangleMesh tower;
  test::add_box(tower, {-2, -3, 0}, {4, 6, 8});
  meshes.emplace_back("tower", tower);
  std::uint64_t key = 0;
  for (const auto& [name, mesh] : meshes) {
    const int transforms = mesh.faces.size() > 1000 ? 2 : 20;
    for (int i = 0; i < transforms; ++i) {
      write_mesh(moved(mesh, ++key), path);
      const std::string scenario = i % 2 == 0 ? "aircraft" : "lab_model";
      expect_two_rounds_do(path, scenario,
                           fmt::format("{}, transform {}, {}", name, key, scenario));
    }
  }
}

/// A mesh of boxes as a file.
struct Boxes {
  explicit Boxes(const std::vector<Box3>& boxes) {
    TriangleMesh mesh;
    for (const Box3& box : boxes) test::add_box(mesh, box.min(), box.sizes());
    write_mesh(mesh, path);
  }
  MeshReport report() const { return report_on(path, "aircraft", {}); }

  TempFolder temp;
  std::string path = (temp.path() / "t.obj").string();
};

TEST(Advice, WhatStandsOnTheGroundIsNotLaidDown) {
  // a pole of two boxes, a wall, a pier: thin along axes that begin elsewhere than at 0
  for (const Boxes& boxes : {Boxes({Box3(Vec3(-0.1, -0.03, 0), Vec3(0.1, 0.03, 9)),
                                    Box3(Vec3(-0.3, -0.03, 8), Vec3(0.3, 0.03, 8.5))}),
                             Boxes({Box3(Vec3(-4, 0, 0), Vec3(4, 0.2, 3))}),
                             Boxes({Box3(Vec3(-1, -10, 0), Vec3(1, 10, 0.5))})}) {
    const std::string text = terminal_text(boxes.report());
    EXPECT_EQ(text.find("up_axis="), std::string::npos) << text;
  }
}

TEST(Advice, WhatMayLieOnItsSideIsAHintAndNoMore) {
  // flat below along y, and no axis begins at 0
  const Boxes boxes({Box3(Vec3(1, 2, 1), Vec3(9, 2.001, 9)), Box3(Vec3(4, 2, 4), Vec3(5, 30, 5))});
  const MeshReport report = boxes.report();
  const std::string text = terminal_text(report);
  EXPECT_NE(text.find("if it lies on its side: --set structure.file.up_axis=y"), text.npos) << text;
  // a wall that begins at x = 0, a pole and a floating wall at y = 0
  std::vector<MeshReport> reports = {report};
  for (const Box3& standing :
       {Box3(Vec3(0, -0.2, -0.3), Vec3(10, 0.2, 6)), Box3(Vec3(-0.1, 0, -1), Vec3(0.1, 0.2, 8)),
        Box3(Vec3(-5, 0, 0.2), Vec3(5, 0.3, 4))}) {
    reports.push_back(Boxes({standing}).report());
  }
  for (const MeshReport& of : reports) {
    for (const std::string& set : of.advice.sets()) {
      EXPECT_EQ(set.find("up_axis"), set.npos) << set;
    }
  }
  // of glTF the axis is law
  const std::string glb = (boxes.temp.path() / "t.glb").string();
  write_mesh(load_mesh({.path = boxes.path}), glb);
  EXPECT_EQ(terminal_text(report_on(glb, "aircraft", {})).find("up_axis"), text.npos);
}

TEST(Advice, AHairBelowTheFloorIsNoFault) {
  const MeshReport report = Boxes({Box3(Vec3(-2, -3, -1e-4), Vec3(2, 3, 8))}).report();
  EXPECT_TRUE(report.advice.sets().empty()) << terminal_text(report);
  EXPECT_FALSE(report.advice.needs_bounds);
  EXPECT_EQ(terminal_text(report).find("all of it"), std::string::npos);
}

TEST(Advice, AFloorIsNeverRaised) {
  const Boxes site({Box3(Vec3(-50, -50, 0), Vec3(50, 50, 0.2)),  // most of it flat, with a tower
                    Box3(Vec3(-2, -2, 0), Vec3(2, 2, 50))});
  const MeshReport report = site.report();
  EXPECT_EQ(report.advice.floor, "planner.floor_z_m=0") << terminal_text(report);
  expect_two_rounds_do(site.path, "aircraft", "site");
}

TEST(Advice, AStartWithinTheStructureNeedsOtherBounds) {
  const Boxes hall({Box3(Vec3(-20, -24, 0), Vec3(20, 24, 8))});  // around the aircraft's start
  const MeshReport report = hall.report();
  EXPECT_TRUE(report.advice.needs_bounds);
  EXPECT_NE(terminal_text(report).find("all of it: --bounds auto"), std::string::npos)
      << terminal_text(report);
  expect_two_rounds_do(hall.path, "aircraft", "hall");
}

}  // namespace
}  // namespace gnbv
