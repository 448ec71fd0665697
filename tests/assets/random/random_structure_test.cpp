// Laws over 208 random structures, 26 of each kind.
#include "assets/random/random_structure.hpp"

#include <gtest/gtest.h>

#include <map>

#include "scenarios/load.hpp"
#include "scenarios/problems.hpp"
#include "sensors/capture.hpp"
#include "tests/assets/structure_laws.hpp"
#include "tests/support/random_structures.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/mesh_lint/mesh_report.hpp"
#include "tools/mission/auto_bounds.hpp"

namespace gnbv {
namespace {

constexpr std::uint64_t kSeeds = 26;

class RandomKind : public testing::TestWithParam<std::string_view> {
 protected:
  static std::vector<RandomStructure> all() { return random_structures(GetParam(), kSeeds); }
};

TEST_P(RandomKind, IsMadeOfClosedPartsOfSoundMaterials) {
  for (const RandomStructure& r : all()) {
    SCOPED_TRACE(r.name());
    EXPECT_GE(expect_closed_parts(r.mesh), 3U);
    expect_sound_materials(r.mesh);
    EXPECT_GT(least_face_height_m(r.mesh), 1e-4);
  }
}

TEST_P(RandomKind, StandsOnTheGroundAboutTheZAxisAndIsOfASizeToFlyAround) {
  double smallest_m = 1e9, largest_m = 0.0;
  for (const RandomStructure& r : all()) {
    SCOPED_TRACE(r.name());
    const Box3 box_m = bounds_m(r.mesh);
    const double extent_m = box_m.sizes().maxCoeff();
    EXPECT_EQ(box_m.min().z(), 0.0);
    EXPECT_NEAR(box_m.center().x(), 0.0, 1e-4);
    EXPECT_NEAR(box_m.center().y(), 0.0, 1e-4);
    EXPECT_GE(extent_m, 8.0 - 1e-3);  // millimetres: of parts placed in double, rounded to float
    EXPECT_LE(extent_m, 58.0 + 1e-3);
    smallest_m = std::min(smallest_m, extent_m);
    largest_m = std::max(largest_m, extent_m);
  }
  EXPECT_GT(largest_m, 2.0 * smallest_m) << "all alike";
}

TEST_P(RandomKind, IsTheSameForASeedAndAnotherForAnother) {
  std::map<std::string, std::uint64_t> seed_of;
  for (const RandomStructure& r : all()) {
    const std::string hash = sha256_of(r.mesh);
    EXPECT_EQ(hash, sha256_of(make_random_structure(r.seed, r.kind))) << r.name();
    const auto [at, is_new] = seed_of.try_emplace(hash, r.seed);
    EXPECT_TRUE(is_new) << r.name() << " is that of seed " << at->second;
  }
}

/// As `gnbv lint` reports it with --bounds auto, but for what its rays find out.
MeshReport report_of(const TriangleMesh& mesh, const Scenario& scenario) {
  MeshReport report;
  report.reading.mesh = mesh;
  report.lint = lint_mesh(mesh);
  report.outside.area_m2 = surface_area_m2(mesh);
  report.advice = advise(report, scenario, true);
  report.findings = findings_of(report, scenario, true);
  return report;
}

TEST_P(RandomKind, HasNothingThatLintWarnsOf) {
  const Scenario scenario = load_scenario("aircraft", {});
  for (const RandomStructure& r : all()) {
    const MeshReport report = report_of(r.mesh, scenario);
    EXPECT_TRUE(report.advice.sets().empty()) << r.name();
    for (const Finding& finding : report.findings) {
      // the foot of what stands on the ground
      const bool is_expected = finding.severity == Severity::ok || finding.check == "floor";
      EXPECT_TRUE(is_expected && finding.severity <= Severity::note)
          << r.name() << ": " << finding.check << ": " << finding.what;
    }
  }
}

/// Pixels of all cameras that measure the structure from the start, a thirtieth of them looked at.
std::size_t returns_at_start(const Scenario& scenario, const TriangleMesh& mesh) {
  const World world{.structure = mesh, .has_ground = false};
  const RayScene scene(world);
  std::size_t returns = 0;
  for (CameraConfig config : scenario.cameras) {
    config.width_px = 120;
    config.height_px = 90;
    config.noise = {};
    const DepthFrame frame = capture_depth(scene, make_camera_model(config), 0,
                                           T_world_body(scenario.start.pose), {}, 2);
    for (const float depth_m : frame.depth_m) returns += depth_m != kNoReturn && depth_m > 0.0F;
  }
  return returns;
}

TEST_P(RandomKind, HasAWorkspaceAndAStartThatSeesItByBoundsAuto) {
  const Scenario scenario = load_scenario("aircraft", {});
  for (const RandomStructure& r : all()) {
    const Scenario around = with_bounds_around(scenario, extent_of(r.mesh));
    const std::vector<Problem> faults = problems(around);
    EXPECT_TRUE(faults.empty()) << r.name() << ": " << faults.front().what;
    EXPECT_GT(returns_at_start(around, r.mesh), 0U) << r.name();
  }
}

TEST_P(RandomKind, PassesTheWholeOfLint) {
  const TempFolder temp;
  for (const RandomStructure& r : random_structures(GetParam(), 1)) {
    Scenario scenario = load_scenario("aircraft", {});
    scenario.structure.file.path = (temp.path() / "r.ply").string();
    write_mesh(r.mesh, scenario.structure.file.path);
    for (const Finding& finding : report_on_mesh(scenario, true, 2).findings) {
      EXPECT_LE(finding.severity, Severity::note) << r.name() << ": " << finding.what;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Random, RandomKind, testing::ValuesIn(kRandomKinds),
                         [](const auto& kind) { return std::string(kind.param); });

TEST(RandomKinds, AreChosenBySeedEachAsOftenAsTheOthers) {
  constexpr int kDraws = 8000;
  std::map<std::string_view, int> count;
  for (std::uint64_t seed = 0; seed < kDraws; ++seed) ++count[random_kind(seed)];
  EXPECT_EQ(count.size(), kRandomKinds.size());
  // five standard deviations of a binomial of 1 in 8: sqrt(8000 / 8 * 7 / 8) = 30
  for (const auto& [kind, times] : count) EXPECT_NEAR(times, kDraws / 8, 150) << kind;
}

}  // namespace
}  // namespace gnbv
