#include "planner/tour/patch_view.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/planner/tour/free_grid.hpp"

namespace gnbv {
namespace {

const Box3 kBox(Vec3(-6, -6, 0), Vec3(6, 6, 6));

/// Points of a wall at x that faces -x, `y` and `z` from the first to the second.
void add_wall(double x, const Eigen::Vector2d& y, const Eigen::Vector2d& z,
              std::vector<Vec3f>& points) {
  for (double b = y[0]; b <= y[1]; b += 0.11) {
    for (double c = z[0]; c <= z[1]; c += 0.11) {
      points.push_back(Vec3(x, b, c).cast<float>());
    }
  }
}

struct Looked {
  std::vector<Patch> patches;
  std::vector<bool> is_seen;
};

Looked look(const std::vector<Vec3f>& points, const ViewPose& view) {
  const OccupancyGrid grid = free_grid(kBox);
  TourConfig config;
  SurfaceCells cells(kBox, config.detail_m);
  cells.add(points, grid, 1);
  Looked looked;
  looked.patches = find_patches(cells, grid, 1);
  CellBlocks blocks(kBox, cells.edge_m());
  blocks.follow(cells, 1);
  const CameraModel camera = make_camera_model({});
  const auto near = blocks.near(view.p_world_m, camera_reach_m(camera));
  std::vector<SeenPatch> seen;
  PatchViewer viewer;
  viewer.observe({config, cells, looked.patches}, camera, T_world_body(view), near,
                 blocks.radius_m(), seen);
  looked.is_seen.assign(looked.patches.size(), false);
  for (const SeenPatch& patch : seen) looked.is_seen[patch.patch] = true;
  return looked;
}

const ViewPose kView{Vec3(-4, 0, 3), 0.0};  // looks along +x

/// Whether the line to the target passes a screen at x = 0 with |y|, |z - 3| < half.
bool is_hidden(const Vec3f& target_m, double half_m) {
  const double t = 4.0 / (static_cast<double>(target_m.x()) + 4.0);
  return std::fabs(t * target_m.y()) < half_m && std::fabs(t * (target_m.z() - 3.0F)) < half_m;
}

TEST(PatchViewer, SeesWhatNothingHides) {
  std::vector<Vec3f> points;
  add_wall(2.03, {-5, 5}, {0.5, 5.5}, points);      // wall
  add_wall(0.03, {-0.6, 0.6}, {2.4, 3.6}, points);  // and a screen before it
  const Looked looked = look(points, kView);
  int seen = 0, hidden = 0, wrong = 0;
  for (std::size_t i = 0; i < looked.patches.size(); ++i) {
    const Patch& patch = looked.patches[i];
    if (patch.missing == 0.0F || patch.target_m.x() < 1.0F) continue;
    const Vec3f from = patch.target_m - kView.p_world_m.cast<float>();
    const bool is_in_image = std::fabs(from.y()) < 0.97F * from.x() * std::tan(deg_to_rad(30.0)) &&
                             std::fabs(from.z()) < 0.97F * from.x() * std::tan(deg_to_rad(22.5));
    if (patch.normal.x() > -0.9F) {
      EXPECT_FALSE(looked.is_seen[i]) << "from behind";
      continue;
    }
    if (!is_in_image) continue;
    // the screen's border is known to within a disc
    if (is_hidden(patch.target_m, 0.4)) {
      ++hidden;
      wrong += looked.is_seen[i] ? 1 : 0;
    } else if (!is_hidden(patch.target_m, 0.85)) {
      ++seen;
      wrong += looked.is_seen[i] ? 0 : 1;
    }
  }
  EXPECT_GT(seen, 200);
  EXPECT_GT(hidden, 10);
  EXPECT_LE(wrong, (seen + hidden) / 50);
}

TEST(PatchViewer, SeesNothingBeyondItsRange) {
  std::vector<Vec3f> points;
  add_wall(5.03, {-2, 2}, {2, 4}, points);
  const Looked looked = look(points, kView);
  for (std::size_t i = 0; i < looked.patches.size(); ++i) EXPECT_FALSE(looked.is_seen[i]);
}

}  // namespace
}  // namespace gnbv
