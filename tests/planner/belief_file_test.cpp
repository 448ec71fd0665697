// A belief that was saved and loaded is the one that was not, and nothing else is ever loaded.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>

#include "bench/reference/analytic_scans.hpp"
#include "planner/core/belief.hpp"
#include "planner/planners.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/sha256.hpp"
#include "tests/support/fault.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

PlannerModel model_of(const PlannerConfig& config) {
  CameraConfig camera;
  camera.width_px = 80;
  camera.height_px = 60;
  const LidarConfig lidar;
  return make_model(config, Box3(Vec3(-10, -8, 0), Vec3(10, 8, 6)), {&camera, 1}, {&lidar, 1});
}

std::vector<DepthFrame> view(const PlannerModel& model, int index) {
  const double angle_rad = 0.7 * index;
  const Vec3 p_m(7.0 * std::cos(angle_rad), 6.0 * std::sin(angle_rad), 3.0);
  return {analytic_depth(example_scene(), model.cameras[0], T_world_body({p_m, angle_rad + kPi}))};
}

std::vector<LidarScan> profile(const PlannerModel& model) {
  const Isometry T = T_world_body({Vec3(-7.0, -6.0, 3.0), 0.6});
  return {analytic_scan(example_scene(), model.lidars[0].config, T)};
}

void expect_equal(const Belief& a, const Belief& b) {
  const auto voxels = static_cast<VoxelIndex>(a.grid.geometry().voxel_count());
  ASSERT_EQ(b.grid.geometry().voxel_count(), voxels);
  for (VoxelIndex v = 0; v < voxels; ++v) {
    ASSERT_EQ(std::bit_cast<std::uint32_t>(a.grid.log_odds(v)),
              std::bit_cast<std::uint32_t>(b.grid.log_odds(v)));
    ASSERT_EQ(a.grid.words()[v], b.grid.words()[v]);
    ASSERT_EQ(a.cloud.point_count(v), b.cloud.point_count(v));
    if (a.grid.is_shaded(v)) {
      ASSERT_EQ(a.shadow.steps_behind(v), b.shadow.steps_behind(v));
    }
    ASSERT_EQ(a.cloud.neighbour_sum(v), b.cloud.neighbour_sum(v));
  }
  EXPECT_EQ(a.grid.total_entropy_nat(), b.grid.total_entropy_nat());
  EXPECT_EQ(a.grid.occupied_count(), b.grid.occupied_count());
  EXPECT_EQ(a.grid.predicted_count(), b.grid.predicted_count());
  EXPECT_TRUE(std::ranges::equal(a.cloud.points_world_m(), b.cloud.points_world_m()));
  EXPECT_EQ(a.has_depth_return, b.has_depth_return);
}

class BeliefFile : public testing::Test {
 protected:
  /// A profile, a view, and some predicted voxels.
  static Belief early_belief(const PlannerModel& model) {
    Belief belief(model);
    Scratch scratch(model, 1);
    integrate_profile(model, profile(model), scratch, belief);
    integrate_view(model, view(model, 0), scratch, belief);
    for (std::size_t v = 0; v < belief.grid.geometry().voxel_count(); v += 97) {
      belief.grid.predict(static_cast<VoxelIndex>(v));
    }
    return belief;
  }
  std::string complaint(const std::string& content) const {
    write_file_atomically(path_, content);
    return test::fault_of([&] { read_belief(path_, model_); });
  }

  TempFolder folder_;
  fs::path path_ = folder_.path() / "belief.bin";
  PlannerModel model_ = model_of({});
};

/// `content` with a digest that fits.
std::string signed_again(std::string content) {
  content.resize(content.size() - 64);
  Sha256 sha;
  sha.add(std::string_view(content));
  return content + sha.hex();
}

TEST_F(BeliefFile, GoesOnAsIfItHadNeverBeenSaved) {
  PlannerConfig with_shadow, of_even_odds;
  with_shadow.utility.name = "proximity_count";  // reads the shadow band
  of_even_odds.map.prob_miss = 1.0 - of_even_odds.map.prob_hit;
  std::size_t shaded = 0;
  for (const PlannerConfig& config : {PlannerConfig{}, with_shadow, of_even_odds}) {
    const PlannerModel model = model_of(config);
    Belief unsaved = early_belief(model);
    unsaved.grid.apply({.free = {}, .occupied = {7}});  // measured, and perhaps still at even odds
    unsaved.grid.apply({.free = {7}, .occupied = {}});
    write_belief(unsaved, path_);
    Belief loaded = read_belief(path_, model);
    expect_equal(loaded, unsaved);
    EXPECT_GT(loaded.grid.predicted_count(), 100U);
    EXPECT_GT(loaded.cloud.points_world_m().size(), 500U);
    EXPECT_TRUE(loaded.has_depth_return);
    for (const VoxelWord word : loaded.grid.words()) shaded += (word & kShadowBit) != 0 ? 1 : 0;
    Scratch scratch(model, 1);
    for (int index = 1; index < 4; ++index) {
      for (Belief* each : {&unsaved, &loaded}) {
        integrate_view(model, view(model, index), scratch, *each);
      }
    }
    expect_equal(loaded, unsaved);
  }
  EXPECT_GT(shaded, 100U);
}

TEST_F(BeliefFile, OfAnEmptyMapIsSmall) {
  write_belief(Belief(model_), path_);
  EXPECT_LT(fs::file_size(path_), 300U);
  expect_equal(read_belief(path_, model_), Belief(model_));
}

TEST_F(BeliefFile, CutShortOrWithAFlippedBitIsRefused) {
  write_belief(early_belief(model_), path_);
  const std::string whole = read_file(path_);
  for (std::size_t twentieth = 0; twentieth < 20; ++twentieth) {
    EXPECT_THAT(complaint(whole.substr(0, whole.size() * twentieth / 20)),
                HasSubstr(path_.string() + ": "));
  }
  for (const std::size_t left : {1UL, 5UL, 13UL, 14UL, 77UL, 78UL, 79UL, whole.size() - 1}) {
    EXPECT_THAT(complaint(whole.substr(0, left)), HasSubstr("cut short")) << left;
  }
  EXPECT_THAT(complaint(whole + "x"), HasSubstr("damaged"));
  for (std::size_t step = 0; step < 300; ++step) {
    std::string flipped = whole;
    // all of the beginning, then here and there
    const std::size_t at = step < 200 ? step : whole.size() * (step - 200) / 100;
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << step % 8));
    EXPECT_THAT(complaint(flipped), HasSubstr(path_.string() + ": ")) << at;
  }
}

TEST_F(BeliefFile, WithNonsenseUnderAFittingDigestIsRefused) {
  write_belief(early_belief(model_), path_);
  const std::string whole = read_file(path_);
  const std::size_t body = whole.size() - 64;
  // the count of points is after the line, 16 settings and a flag
  const std::size_t count_at = 14 + 16 * 8 + 1;
  std::string many = whole;
  many.replace(count_at, 8, std::string(8, '\x7f'));
  EXPECT_THAT(complaint(signed_again(many)), HasSubstr("fewer points than it says"));
  std::string few = whole;
  few.replace(count_at, 8, std::string("\x01\0\0\0\0\0\0\0", 8));
  EXPECT_NE(complaint(signed_again(few)), "");
  for (std::size_t twentieth = 1; twentieth < 20; ++twentieth) {
    const std::string cut = whole.substr(0, body * twentieth / 20);
    EXPECT_NE(complaint(signed_again(cut + std::string(64, '0'))), "") << twentieth;
  }
  for (std::size_t step = 0; step < 300; ++step) {  // most of it is refused; none of it crashes
    std::string flipped = whole;
    const std::size_t at = count_at + (body - count_at) * step / 300;
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << step % 8));
    complaint(signed_again(flipped));
  }
}

TEST_F(BeliefFile, ThatIsSomethingElseIsRefused) {
  EXPECT_THAT(complaint("name: aircraft\n"), HasSubstr("is not a belief"));
  EXPECT_THAT(complaint(""), HasSubstr("is not a belief"));
  EXPECT_THAT(complaint(std::string(1000, '\0')), HasSubstr("is not a belief"));
  EXPECT_THROW(read_belief(folder_.path(), model_), BadInput);
  EXPECT_THROW(read_belief(folder_.path() / "none", model_), BadInput);
}

TEST_F(BeliefFile, OfAnotherMapIsRefused) {
  PlannerConfig odds, leaves, voxels, floor;
  odds.map.prob_hit = 0.8;
  leaves.cloud.leaf_m = 0.05;
  voxels.map.resolution_m = 0.1;
  floor.floor_z_m = 0.1;
  for (const auto& [config, what] :
       {std::pair(odds, "prob_hit is 0.8, not 0.7"), std::pair(leaves, "leaf_m is 0.05, not 0.02"),
        std::pair(voxels, "resolution_m is 0.1, not 0.2"),
        std::pair(floor, "floor_z_m is 0.1, not 0.3")}) {
    write_belief(Belief(model_of(config)), path_);
    EXPECT_THAT(complaint(read_file(path_)), AllOf(HasSubstr("another map"), HasSubstr(what)));
  }
}

}  // namespace
}  // namespace gnbv
