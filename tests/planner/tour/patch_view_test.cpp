#include "planner/tour/patch_view.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/tour/orienteering.hpp"
#include "planner/tour/surface_cells.hpp"
#include "sim/core/rng.hpp"
#include "tests/planner/map/drawn_map.hpp"

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
  points.clear();
  add_wall(5.03, {-2, 2}, {2, 4}, points);  // beyond the range
  EXPECT_EQ(std::ranges::count(look(points, kView).is_seen, true), 0);
}

double random(std::uint64_t seed, std::uint64_t frame, std::uint64_t index) {
  return uniform01({seed, Stream::bench, frame, index});
}

OrienteeringProblem random_problem(std::uint64_t seed, std::size_t views, std::size_t items) {
  OrienteeringProblem problem;
  for (std::size_t i = 0; i < items; ++i) {
    problem.weight.push_back(static_cast<float>(1.0 + 9.0 * random(seed, 0, i)));
  }
  for (std::size_t v = 0; v < views; ++v) {
    problem.observations.emplace_back();
    for (std::uint32_t i = 0; i < items; ++i) {
      if (random(seed, 1 + v, i) < 0.3) {
        problem.observations.back().push_back(
            {i, static_cast<float>(0.98 * random(seed, 100 + v, i))});
      }
    }
    problem.node.push_back(0);
  }
  return problem;
}

/// The definition, from scratch.
double found(const OrienteeringProblem& problem, const std::vector<bool>& chosen) {
  double sum = 0.0;
  for (std::uint32_t i = 0; i < problem.weight.size(); ++i) {
    double missed = 1.0;
    for (std::size_t v = 0; v < problem.observations.size(); ++v) {
      if (!chosen[v]) continue;
      for (const ItemObservation& one : problem.observations[v]) {
        if (one.item == i) missed *= 1.0 - static_cast<double>(one.success);
      }
    }
    sum += static_cast<double>(problem.weight[i]) * (1.0 - missed);
  }
  return sum;
}

TEST(ExpectedCover, IsTheDefinitionAfterAnyChanges) {
  const OrienteeringProblem problem = random_problem(1, 20, 30);
  ExpectedCover cover(problem);
  std::vector<bool> chosen(20, false);
  for (std::uint64_t step = 0; step < 2000; ++step) {
    const auto view = static_cast<std::uint32_t>(random_bits({2, Stream::bench, step, 0}) % 20);
    chosen[view] = !chosen[view];
    cover.set(view, chosen[view]);
    if (step % 50 != 0) continue;
    ASSERT_NEAR(cover.found(), found(problem, chosen), 1e-6);
    for (std::uint32_t v = 0; v < 20; ++v) {
      std::vector<bool> other = chosen;
      other[v] = !other[v];
      const double difference = found(problem, other) - found(problem, chosen);
      const double told = chosen[v] ? -cover.loss_without(v) : cover.gains()[v];
      ASSERT_NEAR(told, difference, 1e-6) << "view " << v;
    }
  }
}

/// Of the points of a square in the plane, the share that lies in the cube, times its area.
double counted_area(const Vec3& normal, double distance) {
  constexpr int kSteps = 400;
  constexpr double kHalf = 1.0;  // beyond the half diagonal of the cube
  const Vec3 u = normal.unitOrthogonal();
  const Vec3 v = normal.cross(u);
  int inside = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double a = kHalf * (2.0 * (i + 0.5) / kSteps - 1.0);
      const double b = kHalf * (2.0 * (j + 0.5) / kSteps - 1.0);
      const Vec3 p = distance * normal + a * u + b * v;
      if (p.cwiseAbs().maxCoeff() <= 0.5) ++inside;
    }
  }
  return 4.0 * kHalf * kHalf * inside / (kSteps * kSteps);
}

TEST(PlaneSection, IsWhatCountedPointsSay) {
  for (std::uint64_t i = 0; i < 40; ++i) {
    const auto drawn = [&](std::uint64_t k) { return 2.0 * random(3, i, k) - 1.0; };
    const Vec3 normal = Vec3(drawn(0), drawn(1), drawn(2)).normalized();
    const double distance = 0.9 * drawn(3);
    EXPECT_NEAR(plane_section_area(normal, distance, 1.0), counted_area(normal, distance), 0.02)
        << normal.transpose() << " at " << distance;
  }
  EXPECT_NEAR(plane_section_area(Vec3::UnitZ(), 0.1, 1.0), 1.0, 0.02);
  EXPECT_EQ(plane_section_area(Vec3::UnitZ(), 0.52, 1.0), 0.0);
  EXPECT_NEAR(plane_section_area(Vec3(1, 1, 1).normalized(), 0.0, 2.0), 3.0 * std::sqrt(3.0), 1e-9)
      << "a regular hexagon through the middle";
}

}  // namespace
}  // namespace gnbv
