#include "planner/core/plan.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "planner/core/belief.hpp"

namespace gnbv {
namespace {

// both in the order of their enumeration

constexpr std::array<std::string_view, 16> kTerminations = {
    "max_iterations",   "max_distance",   "max_flight_time", "entropy_change",
    "low_gain",         "no_new_points",  "no_valid_view",   "repeated_motion",
    "battery",          "route_flown",    "off_course",      "tour_complete",
    "coverage_reached", "utility_failed", "interrupted",     "collision"};
static_assert(kTerminations.size() == static_cast<std::size_t>(Termination::collision) + 1);

constexpr std::array<SamplerTraits, 6> kSamplers = {
    {{"start"},
     {.name = "fvs", .words = "around frontiers", .is_scored = true, .at_frontier = true},
     {.name = "agvs", .words = "of the grid", .is_scored = true, .on_grid = true},
     {"route"},
     {"oracle"},
     {"tour"}}};

}  // namespace

std::string_view name_of(Termination reason) {
  return kTerminations[static_cast<std::size_t>(reason)];
}

const SamplerTraits& traits_of(Sampler sampler) {
  return kSamplers[static_cast<std::size_t>(sampler)];
}

std::optional<Sampler> sampler_named(std::string_view name) {
  for (std::size_t i = 0; i < kSamplers.size(); ++i) {
    if (kSamplers[i].name == name) return static_cast<Sampler>(i);
  }
  return std::nullopt;
}

void check(ViewChecker& checker, const PlannerModel& model, Candidate& candidate) {
  FoundPath path = checker.check(candidate.view);
  const bool can_pitch = model.can_pitch(candidate.view.gimbal_pitch_rad);
  candidate.rejected = can_pitch ? path.rejected : Rejection::beyond_gimbal;
  candidate.path_m = checker.length_m(path, candidate.view);
  candidate.via_world_m = std::move(path.via_world_m);
}

bool Plan::is_chosen(std::size_t candidate) const {
  return std::find(chosen.begin(), chosen.end(), candidate) != chosen.end();
}

bool Plan::looks_at(int cluster) const {
  return std::ranges::any_of(
      chosen, [&](std::size_t candidate) { return candidates[candidate].cluster == cluster; });
}

std::map<Rejection, int> rejections_of(const Plan& plan) {
  std::map<std::array<double, 5>, std::optional<Rejection>> last;
  for (const Candidate& candidate : plan.candidates) {
    const ViewPose& view = candidate.view;
    const Vec3& p_m = view.p_world_m;
    last[{p_m.x(), p_m.y(), p_m.z(), view.yaw_rad, view.gimbal_pitch_rad}] = candidate.rejected;
  }
  std::map<Rejection, int> counts;
  for (const auto& [view, rejected] : last) {
    if (rejected) ++counts[*rejected];
  }
  return counts;
}

void choose(Plan& plan, std::size_t candidate, int sampled, int valid) {
  const Candidate& best = plan.candidates[candidate];
  plan.chosen = {candidate};
  plan.views = {{.view = best.view,
                 .sampler = best.sampler,
                 .scale = best.scale,
                 .candidates = sampled,
                 .valid = valid,
                 .score = best.score,
                 .via_world_m = best.via_world_m}};
}

}  // namespace gnbv
