// Laws of clusters of frontiers, voxels and what lies over a scene, as things to draw.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "tests/tools/render/watched.hpp"
#include "tools/render/frontier_items.hpp"
#include "tools/render/place_marks.hpp"
#include "tools/render/voxel_items.hpp"

namespace gnbv {
namespace {

/// Numbers of clusters keep off the chosen view and off each other.
TEST(PlaceMarks, BadgesAsideCoverNeitherEndsOfLinesNorEachOther) {
  RenderView view;
  view.width_px = 400;
  view.height_px = 300;
  view.T_world_camera = look_at({0, -10, 0}, {0, 0, 0});
  Panel panel;
  panel.lines = {{{0.1, 0, 0}, {0.1, 0, 0}, {1, 2, 3}, 8.0}};
  for (const double x : {0.0, 0.2}) {
    panel.labels.push_back({Vec3(x, 0, 0), "1", Rgb8{0, 90, 200}, true});
  }
  Image image{400, 300, {}};
  image.rgb.assign(static_cast<std::size_t>(3 * 400 * 300), 200);
  draw_place_marks(panel, view, 1.0, true, image);
  const Vec3 dot_px = *project(view, {0.1, 0, 0});
  EXPECT_EQ(image.at(static_cast<int>(dot_px.x()), static_cast<int>(dot_px.y())), (Rgb8{1, 2, 3}));
  int badge_px = 0;
  for (int y = 0; y < 300; ++y) {
    for (int x = 0; x < 400; ++x) badge_px += image.at(x, y) == Rgb8{0, 90, 200} ? 1 : 0;
  }
  EXPECT_GT(badge_px, 300);  // two discs of 17 px, less their digits
  panel.labels.pop_back();
  image.rgb.assign(image.rgb.size(), 200);
  draw_place_marks(panel, view, 1.0, true, image);
  int one_px = 0;
  for (int y = 0; y < 300; ++y) {
    for (int x = 0; x < 400; ++x) one_px += image.at(x, y) == Rgb8{0, 90, 200} ? 1 : 0;
  }
  EXPECT_GT(badge_px, 19 * one_px / 10);
}

Box3 voxel_box_m(const GridGeometry& geometry, VoxelIndex voxel) {
  const Vec3 centre_m = geometry.center_m(geometry.key_at(voxel));
  const Vec3 half_m = Vec3::Constant(0.5 * geometry.resolution_m());
  return {centre_m - half_m, centre_m + half_m};
}

TEST(FrontierItems, TheChosenClusterStandsOutInWhateverOrderTheyWereTried) {
  const FrontierConfig& config = watched().flown.scenario.planner.fvs.frontier;
  ReplayedDecision decision{.belief = watched().beliefs.back(), .plan = {}};
  const Belief& belief = decision.belief;
  FrontierMarks marks(belief.grid.geometry().voxel_count());
  const auto found = find_frontiers(config, belief.grid, belief.cloud, marks);
  ASSERT_GE(found.size(), 2U);
  for (const std::size_t first : {std::size_t{0}, found.size() - 1}) {
    decision.plan.clusters = {found[first]};  // the others may not be tried
    decision.plan.candidates = {{.view = {}, .sampler = Sampler::fvs, .cluster = 0}};
    decision.plan.chosen = {0};
    Panel panel;
    add_frontiers(config, decision, 0.1, {}, panel);
    EXPECT_EQ(panel.scene.surfaces.size(), found.size());
    // the map's own cubes may fill their voxels, and do not hide them
    const SurfaceItem& chosen = panel.scene.surfaces.front();
    const Box3 voxel_m = voxel_box_m(belief.grid.geometry(), found[first].voxels.front());
    Box3 cube_m;
    for (std::size_t i = 0; i < 8; ++i) cube_m.extend(chosen.mesh.vertices_m[i].cast<double>());
    EXPECT_TRUE(cube_m.contains(voxel_m));
    EXPECT_GT(cube_m.volume(), 1.001 * voxel_m.volume());
    ASSERT_EQ(panel.scene.balls.size(), 1U);
    EXPECT_EQ(panel.scene.balls[0].centre_m, found[first].centroid_world_m.cast<float>());
    EXPECT_EQ(panel.scene.balls[0].colour, kFrontierLook.looked_at);
  }
}

/// From that side of the middle of the map, as far away as shows all of it.
RenderView view_along(const OccupancyGrid& grid, const Vec3& from) {
  const GridGeometry& geometry = grid.geometry();
  const Vec3 middle_m =
      geometry.center_m(geometry.key_at(static_cast<VoxelIndex>(geometry.voxel_count() / 2)));
  RenderView view;
  view.T_world_camera = look_at(middle_m + 100.0 * from, middle_m);
  return view;
}

/// Against the ray from each voxel's middle, in much finer steps, along the axes about.
TEST(VoxelItems, FacesAreSeenWhereNothingStandsBetween) {
  const OccupancyGrid& grid = watched().beliefs.front().grid;
  const double resolution_m = grid.geometry().resolution_m();
  std::size_t seen = 0;
  std::size_t hidden = 0;
  for (const Vec3& axis :
       {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)}) {
    const RenderView view = view_along(grid, axis + Vec3(0.003, 0.002, 0.001));
    for (const VoxelIndex v : sort_voxels(grid).occupied) {
      const Vec3 p_m = grid.geometry().center_m(grid.geometry().key_at(v));
      const SurfaceItem faces = free_faces(grid, std::array{v}, {1, 1, 1}, 0.5F);
      if (grid.state_at(p_m + resolution_m * axis) != VoxelState::free) continue;  // no such face
      const Vec3 away_m = view.T_world_camera.translation() - p_m;
      bool is_covered = false;
      for (double t = 0.6 * resolution_m; t < away_m.norm(); t += 0.05 * resolution_m)
        is_covered |= grid.state_at(p_m + t * away_m.normalized()) == VoxelState::occupied;
      EXPECT_TRUE(is_covered || is_seen(faces, grid, view));
      ++(is_covered && !is_seen(faces, grid, view) ? hidden : seen);
    }
  }
  EXPECT_GT(seen, 0U);
  EXPECT_GT(hidden, 0U);
}

/// A number before what hides its cluster would say that the cluster is there.
TEST(FrontierItems, NumbersAreShownWhereTheirClustersAreAndApartFromEachOther) {
  const Belief& belief = watched().beliefs.back();
  const OccupancyGrid& grid = belief.grid;
  const double resolution_m = grid.geometry().resolution_m();
  const SortedVoxels voxels = sort_voxels(grid);
  ASSERT_FALSE(voxels.occupied.empty());
  const RenderView above = view_along(grid, {0.01, 0.0, 1.0});
  std::size_t hidden = 0;
  std::size_t shown = 0;
  for (const VoxelIndex v : voxels.occupied) {
    const Vec3 p_m = grid.geometry().center_m(grid.geometry().key_at(v));
    const Vec3 away_m = above.T_world_camera.translation() - p_m;
    bool is_covered = false;  // the oracle: in much finer steps, all the way
    for (double t = 3.0 * resolution_m; t < away_m.norm(); t += 0.05 * resolution_m)
      is_covered |= grid.state_at(p_m + t * away_m.normalized()) == VoxelState::occupied;
    const bool is_said = is_hidden(grid, above, p_m, 3.0 * resolution_m);
    EXPECT_LE(is_said, is_covered);
    if (is_covered == is_said) ++(is_said ? hidden : shown);
  }
  EXPECT_GT(hidden + shown, 9 * voxels.occupied.size() / 10);  // not where a corner is in the way
  EXPECT_GT(hidden, 0U);
  EXPECT_GT(shown, 0U);

  const FrontierConfig& config = watched().flown.scenario.planner.fvs.frontier;
  ReplayedDecision decision{.belief = belief, .plan = {}};
  FrontierMarks marks(grid.geometry().voxel_count());
  decision.plan.clusters = find_frontiers(config, grid, belief.cloud, marks);
  ASSERT_GE(decision.plan.clusters.size(), 2U);
  const int last = static_cast<int>(decision.plan.clusters.size()) - 1;
  decision.plan.candidates = {{.view = {}, .sampler = Sampler::fvs, .cluster = last}};
  std::size_t most = 0;
  for (const Vec3& from : {Vec3(0.01, 0, 1), Vec3(1, 0, 0.2), Vec3(-1, 0, 0.2), Vec3(0, 1, 0.2),
                           Vec3(0, -1, 0.2), Vec3(1, 1, 1)}) {
    const RenderView view = view_along(grid, from);
    std::size_t in_sight = 0;
    for (const FrontierCluster& cluster : decision.plan.clusters)
      in_sight += is_hidden(grid, view, cluster.centroid_world_m, 3.0 * resolution_m) ? 0 : 1;
    most = std::max(most, in_sight);
    Panel panel;
    add_frontiers(config, decision, 0.1, view, panel);
    EXPECT_EQ(panel.labels.empty(), in_sight == 0);
    EXPECT_LE(panel.labels.size(), in_sight);
    for (std::size_t i = 0; i < panel.labels.size(); ++i) {
      EXPECT_FALSE(is_hidden(grid, view, panel.labels[i].p_world_m, 3.0 * resolution_m));
      const Vec3 px = project(view, panel.labels[i].p_world_m).value();
      for (std::size_t k = 0; k < i; ++k) {
        EXPECT_GE((px - *project(view, panel.labels[k].p_world_m)).head<2>().norm(), 30.0);
      }
    }
    RenderView small = view;  // all of them in one place
    small.fov_y_rad = deg_to_rad(170.0);
    Panel crowded;
    add_frontiers(config, decision, 0.1, small, crowded);
    EXPECT_EQ(crowded.labels.size(), std::min<std::size_t>(in_sight, 1));
  }
  EXPECT_GE(most, 2U);
}

}  // namespace
}  // namespace gnbv
