#include "planner/tour/timed_tour.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <set>

#include "planner/motion/config.hpp"
#include "tests/planner/tour/random_problem.hpp"

namespace gnbv {
namespace {

using Views = std::span<const std::uint32_t>;

/// The views of a random problem, each with a heading; a frame within 1.2 m of a view is that view.
struct RandomTimedProblem {
  explicit RandomTimedProblem(std::uint64_t seed) : random_one(seed, 6) {
    for (std::uint32_t v = 0; v < 6; ++v) {
      poses.push_back(
          {random_one.p_m[v + 1], deg_to_rad(45.0) * std::floor(8.0 * random(seed, 4, v))});
    }
    problem = {.views = &random_one.problem,
               .poses = poses,
               .start = {random_one.p_m[0], 0.0},
               .travel = &travel,
               .view_at = [this](const ViewPose& pose) { return view_at(pose); }};
  }

  std::optional<std::uint32_t> view_at(const ViewPose& pose) const {
    for (std::uint32_t v = 0; v < poses.size(); ++v) {
      if ((poses[v].p_world_m - pose.p_world_m).norm() < 1.2) return v;
    }
    return std::nullopt;
  }

  /// Of the tour and its frames on the way, a metre or 45 deg apart, less its price.
  double worth(Views views) const {
    std::set<std::uint32_t> seen(views.begin(), views.end());
    double sum_s = 0.0;
    ViewPose from = problem.start;
    Vec3 in_m = Vec3::Zero();
    for (const std::uint32_t view : views) {
      const ViewPose& to = poses[view];
      const Vec3 out_m = to.p_world_m - from.p_world_m;
      const double turn_rad = wrap_angle_rad(to.yaw_rad - from.yaw_rad);
      sum_s += travel.leg_s(out_m.norm(), turn_rad);
      const double scale_m2 = in_m.norm() * out_m.norm();
      if (scale_m2 > 0.0) sum_s += 0.8 * (1.0 - in_m.dot(out_m) / scale_m2);
      const double steps =
          std::ceil(std::max(out_m.norm(), std::abs(turn_rad) / deg_to_rad(45.0)) - 1e-6);
      for (double i = 1.0; i < steps; i += 1.0) {
        const auto passed = view_at({from.p_world_m + i / steps * out_m, 0.0});
        if (passed) seen.insert(*passed);
      }
      from = to;
      in_m = out_m;
    }
    const std::vector<std::uint32_t> all(seen.begin(), seen.end());
    const double stops = static_cast<double>(views.size());
    return random_one.found(all) -
           random_one.problem.price * (sum_s + random_one.problem.way_per_view * stops);
  }

  RandomProblem random_one;
  TravelConfig travel;
  std::vector<ViewPose> poses;
  TimedProblem problem;
};

/// The order is shortened without the corners, and what is put in does not count its frames on the
/// way; weighed exactly, flights took no less (aircraft, seeds 1 to 5, means: 185 s, and 180).
TEST(TimedTour, IsNearTheBestOfAllWhereTheyCanBeCounted) {
  constexpr std::uint64_t kTasks = 20;
  double sum_of_shares = 0.0;
  for (std::uint64_t seed = 0; seed < kTasks; ++seed) {
    const RandomTimedProblem task(seed);
    const double worth = task.worth(solve(task.problem, {}, 300, seed));
    const double best_worth =
        task.random_one.best_of_all([&](Views views) { return task.worth(views); });
    EXPECT_LE(worth, best_worth + 1e-4);
    EXPECT_GE(worth, 0.85 * best_worth) << "seed " << seed;
    sum_of_shares += worth / best_worth;
  }
  EXPECT_GE(sum_of_shares / kTasks, 0.95);
}

TEST(TimedTour, BeginsWithThatGivenAndStaysWhereNothingPays) {
  RandomTimedProblem task(3);
  const auto searched = solve(task.problem, {}, 300, 1);
  EXPECT_GE(task.worth(solve(task.problem, searched, 0, 1)), task.worth(searched) - 1e-4);
  task.random_one.problem.price = 1000.0;
  EXPECT_TRUE(solve(task.problem, {}, 100, 1).empty());
}

TEST(TimedTour, AViewThatFramesOnTheWayTakeIsNotStoppedAt) {
  // three in a row, the middle one on the way to the last
  OrienteeringProblem views;
  views.price = 0.1;
  views.way_per_view = 1.0;
  std::vector<std::vector<float>> rows_m(4);
  for (int from = 0; from < 4; ++from) {
    for (int to = 0; to < 4; ++to)
      rows_m[from].push_back(static_cast<float>(2 * std::abs(from - to)));
  }
  views.row_m = [&](std::uint32_t node) -> std::span<const float> { return rows_m[node]; };
  std::vector<ViewPose> poses;
  for (std::uint32_t v = 0; v < 3; ++v) {
    views.weight.push_back(10.0F);
    views.observations.push_back({{v, 0.9F}});
    views.node.push_back(v + 1);
    poses.push_back({Vec3(2.0 * (v + 1), 0, 1), 0.0});
  }
  const TravelConfig travel;
  TimedProblem problem{
      .views = &views, .poses = poses, .start = {Vec3(0, 0, 1), 0.0}, .travel = &travel};
  EXPECT_EQ(solve(problem, {}, 100, 1).size(), 3U);
  problem.view_at = [](const ViewPose& pose) -> std::optional<std::uint32_t> {
    const auto v = static_cast<int>(std::lround(pose.p_world_m.x() / 2.0)) - 1;
    return v < 0 ? std::nullopt : std::optional(static_cast<std::uint32_t>(v));
  };
  EXPECT_EQ(solve(problem, {}, 100, 1), std::vector<std::uint32_t>{2});
}

}  // namespace
}  // namespace gnbv
