// What a planner looks back on, and the rules that end its missions.
#include <gtest/gtest.h>

#include "planner/core/planner.hpp"

namespace gnbv {
namespace {

/// Views half a metre apart, each of which makes so many voxels occupied and adds so many points.
std::vector<MapProgress> walk(const std::vector<std::size_t>& voxels,
                              const std::vector<std::size_t>& points) {
  std::vector<MapProgress> progress = {{.occupied_voxels = 100, .cloud_points = 1000}};
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    progress.push_back({.occupied_voxels = progress.back().occupied_voxels + voxels[i],
                        .cloud_points = progress.back().cloud_points + points[i],
                        .straight_m = progress.back().straight_m + 0.5});
  }
  return progress;
}

/// How a mission with this behind it ends, if it does.
std::optional<Termination> end_of(const TerminationConfig& config, const History& history,
                                  const EndRules& rules = {}) {
  return end_after_view(config, rules, history);
}

/// The last, or the first, of what happened.
History last_of(std::span<const MapProgress> progress, std::size_t count) {
  return {.progress = {progress.end() - static_cast<std::ptrdiff_t>(count), progress.end()}};
}
History first_of(std::span<const MapProgress> progress, std::size_t count) {
  return last_of(progress.first(count), count);
}

TEST(GainIsLow, BelowTheThresholdOverTheWholeWindowAndNotBefore) {
  TerminationConfig config;
  config.new_voxels_window = 3;
  // 9 voxels in the last 1.5 m: 6 a metre
  const auto progress = walk({90, 6, 0, 3}, {0, 0, 0, 0});
  const History all = last_of(progress, 5);
  EXPECT_EQ(end_of(config, all), std::nullopt);  // off by default
  config.min_new_voxels_per_m = 6.0;
  EXPECT_EQ(end_of(config, all), std::nullopt);
  config.min_new_voxels_per_m = 6.001;
  EXPECT_EQ(end_of(config, all), Termination::low_gain);
  EXPECT_EQ(end_of(config, first_of(progress, 4)), std::nullopt);  // 96 voxels in it
  EXPECT_EQ(end_of(config, last_of(progress, 3)), std::nullopt);   // two views are no window
  config.new_voxels_window = 4;                                    // 99 voxels in 2 m
  EXPECT_EQ(end_of(config, all), std::nullopt);
  // of views that only turn it is unknown, of lost voxels negative
  config.new_voxels_window = 1;
  config.min_new_voxels_per_m = 1e-6;
  EXPECT_EQ(end_of(config, {.progress = {{100, 0, 2.0}, {100, 0, 2.0}}}), std::nullopt);
  EXPECT_EQ(end_of(config, {.progress = {{100, 0, 2.0}, {99, 0, 3.0}}}), Termination::low_gain);
}

TEST(NoNewPoints, AfterSoManyViewsInARowThatAddNone) {
  TerminationConfig config;
  const auto progress = walk({0, 0, 0, 0}, {7, 1, 0, 0});
  const History all = last_of(progress, 5);
  EXPECT_EQ(end_of(config, all), std::nullopt);  // off by default
  config.max_views_without_new_points = 2;
  EXPECT_EQ(end_of(config, all), Termination::no_new_points);
  EXPECT_EQ(end_of(config, first_of(progress, 4)), std::nullopt);
  EXPECT_EQ(end_of(config, last_of(progress, 2)), std::nullopt);
  config.max_views_without_new_points = 3;
  EXPECT_EQ(end_of(config, all), std::nullopt);
}

TEST(EntropyChange, NeedsEveryViewOfAFullWindowToBeQuiet) {
  TerminationConfig config{.entropy_change_percent = 0.001, .entropy_window = 3};
  const auto end = [&](std::vector<double> entropies_nat) {
    return end_of(config, {.entropies_nat = std::move(entropies_nat)});
  };
  EXPECT_EQ(end({2e6, 1e6, 1e6 - 5, 1e6 - 9, 1e6 - 10}), Termination::entropy_change);
  EXPECT_EQ(end({1e6, 1e6 - 5, 1e6 - 25, 1e6 - 26}), std::nullopt);  // 20 nat are 0.002 %
  EXPECT_EQ(end({1e6, 1e6, 1e6}), std::nullopt);
  EXPECT_EQ(end({1e6, 1e6, 1e6, 1e6}), Termination::entropy_change);
  config.entropy_change_percent = 0.0;
  EXPECT_EQ(end({1e6, 1e6, 1e6, 1e6}), std::nullopt);
}

/// So many views, from two places in turn.
std::vector<Decision> back_and_forth(int views) {
  std::vector<Decision> decisions;
  for (int i = 0; i < views; ++i) decisions.push_back({.view = {Vec3(i % 2, 0, 5), 0}});
  return decisions;
}

TEST(RepeatedMotion, BetweenTwoPlacesEndsAMissionAfterTenMoves) {
  TerminationConfig config = {.repeated_by = RepeatedBy::places};
  EXPECT_EQ(end_of(config, {.decisions = back_and_forth(12)}), Termination::repeated_motion);
  EXPECT_EQ(end_of(config, {.decisions = back_and_forth(11)}), std::nullopt);
  config.repeated_moves = 0;
  EXPECT_EQ(end_of(config, {.decisions = back_and_forth(12)}), std::nullopt);
}

TEST(RepeatedMotion, IsOfUtilitiesAtLagTwoWhereThereAreAny) {
  const auto end = [](const std::vector<double>& utilities, Sampler sampler = Sampler::agvs) {
    History history;
    for (const double utility : utilities) {
      history.decisions.push_back({.view = {}, .sampler = sampler, .score = {.value = utility}});
    }
    return end_of({.repeated_moves = 4}, history);
  };
  EXPECT_EQ(end({9, 1, 2, 1, 2}), Termination::repeated_motion);
  EXPECT_EQ(end({9, 1, 2, 1, 2}, Sampler::fvs), Termination::repeated_motion);
  EXPECT_EQ(end({1, 2, 1, 2}), std::nullopt) << "the authors ask for more views than the window";
  EXPECT_EQ(end({9, 1, 2, 1, 3}), std::nullopt);
  EXPECT_EQ(end({9, 8, 2, 1, 2}), std::nullopt);
  EXPECT_EQ(end({0, 0, 0, 0, 0, 0}, Sampler::route), std::nullopt) << "of a route none has one";
}

TEST(MaxIterations, IsTheFirstRuleAndNoPlannerSwitchesItOff) {
  const TerminationConfig config{.max_iterations = 12};
  const EndRules none = {.entropy = false, .gain = false, .repetition = false};
  EXPECT_EQ(end_of(config, {.decisions = back_and_forth(12)}), Termination::max_iterations);
  EXPECT_EQ(end_of(config, {.decisions = back_and_forth(12)}, none), Termination::max_iterations);
  EXPECT_EQ(end_of(config, {.decisions = back_and_forth(11)}, none), std::nullopt);
}

TEST(EndAfterView, TheFirstRuleNamesTheEndAndAPlannerMaySwitchRulesOff) {
  TerminationConfig config{.entropy_window = 1,
                           .repeated_moves = 2,
                           .repeated_by = RepeatedBy::places,
                           .min_new_voxels_per_m = 1.0,
                           .new_voxels_window = 1,
                           .max_views_without_new_points = 1};
  EndRules rules;
  const auto end = [&](double entropy_nat, std::size_t voxels, std::size_t points, int views = 3) {
    return end_of(config,
                  {.decisions = back_and_forth(views),
                   .entropies_nat = {5.0, entropy_nat},
                   .progress = walk({voxels}, {points})},
                  rules);
  };
  EXPECT_EQ(end(5.0, 0, 0), Termination::entropy_change);
  EXPECT_EQ(end(4.0, 0, 0), Termination::low_gain);
  EXPECT_EQ(end(4.0, 0, 1), Termination::low_gain);
  EXPECT_EQ(end(4.0, 1, 0), Termination::no_new_points);
  EXPECT_EQ(end(4.0, 1, 1), std::nullopt);
  EXPECT_EQ(end(5.0, 0, 0, 4), Termination::entropy_change);
  rules.entropy = false;
  EXPECT_EQ(end(5.0, 0, 0, 4), Termination::low_gain);
  rules.gain = false;
  EXPECT_EQ(end(5.0, 0, 0, 4), Termination::repeated_motion);
  rules.repetition = false;
  EXPECT_EQ(end(5.0, 0, 0, 4), std::nullopt);
}

TEST(EndAfterView, MayHaveToWaitForTheEndOfAPlan) {
  History history;
  history.decisions = back_and_forth(11);
  history.ahead = back_and_forth(2);
  TerminationConfig config = {.max_iterations = 10};
  EXPECT_EQ(end_of(config, history), Termination::max_iterations);
  config.within_plans = false;
  EXPECT_EQ(end_of(config, history), std::nullopt);
  history.ahead.clear();
  EXPECT_EQ(end_of(config, history), Termination::max_iterations);
}

TEST(NextDecision, ALegThatPassesTheLimitIsTooFarNotOneThatEndsOnIt) {
  TerminationConfig config;
  History history = {.progress = {{.straight_m = 7.5}}};
  const auto is_too_far = [&](double leg_m) {
    const auto next = next_decision(config, {}, history, [&] {
      return Plan{.views = {{.view = {Vec3(leg_m, 0, 0), 0}}}};
    });
    return std::holds_alternative<Termination>(next) &&
           std::get<Termination>(next) == Termination::max_distance;
  };
  EXPECT_FALSE(is_too_far(1e6));  // off by default
  config.max_distance_m = 10.0;
  EXPECT_FALSE(is_too_far(2.5));
  EXPECT_TRUE(is_too_far(2.5000001));
  EXPECT_TRUE(is_too_far(1.0));  // the plan at hand is asked again, not another one
}

TEST(History, ItsEntropiesBeginBeforeTheFirstViewWithADepthReturn) {
  const CameraConfig camera;
  const PlannerModel model({}, {}, Box3(Vec3(-8, -8, 0), Vec3(8, 8, 8)), {&camera, 1}, {});
  Belief belief(model);
  History history;
  const auto free = [&](VoxelIndex v) {
    belief.grid.apply({.free = {v}, .occupied = {}});
    return belief.grid.total_entropy_nat();
  };
  remember_start(belief, history);
  EXPECT_EQ(history.entropies_nat, std::vector<double>{belief.grid.total_entropy_nat()});
  const double blind_nat = free(0);
  remember({}, belief, 0.0, history);
  EXPECT_EQ(history.entropies_nat, std::vector<double>{blind_nat});
  belief.has_depth_return = true;
  const double first_nat = free(1);
  remember({}, belief, 0.0, history);
  const double second_nat = free(2);
  remember({}, belief, 2.0, history);
  EXPECT_EQ(history.entropies_nat, (std::vector<double>{blind_nat, first_nat, second_nat}));
  EXPECT_EQ(history.decisions.size(), 3U);
  EXPECT_EQ(planned_m(history, Vec3(1, 0, 0), {.view = {Vec3(1, 3, 0), 0}}), 5.0);
}

}  // namespace
}  // namespace gnbv
