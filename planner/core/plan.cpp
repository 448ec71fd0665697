#include "planner/core/plan.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace gnbv {
namespace {

constexpr std::array kSamplers = {
    SamplerTraits{Sampler::start, "start", ""},
    SamplerTraits{Sampler::fvs, "fvs", "around frontiers", true, false, true},
    SamplerTraits{Sampler::agvs, "agvs", "of the grid", true, true, false},
    SamplerTraits{Sampler::route, "route", ""},
    SamplerTraits{Sampler::oracle, "oracle", ""},
    SamplerTraits{Sampler::tour, "tour", ""},
};

}  // namespace

const SamplerTraits& traits_of(Sampler sampler) {
  return kSamplers[static_cast<std::size_t>(sampler)];
}

std::span<const SamplerTraits> all_samplers() { return kSamplers; }

std::optional<Sampler> sampler_named(std::string_view name) {
  const auto* const found =
      std::find_if(kSamplers.begin(), kSamplers.end(),
                   [&](const SamplerTraits& traits) { return traits.name == name; });
  if (found == kSamplers.end()) return std::nullopt;
  return found->sampler;
}

void check(ViewChecker& checker, Candidate& candidate) {
  FoundPath path = checker.check(candidate.view);
  candidate.rejected = path.rejected;
  candidate.path_m = checker.length_m(path, candidate.view);
  candidate.via_world_m = std::move(path.via_world_m);
}

bool Plan::is_chosen(std::size_t candidate) const {
  return std::find(chosen.begin(), chosen.end(), candidate) != chosen.end();
}

std::map<Rejection, int> rejections_of(const Plan& plan) {
  std::map<Rejection, int> counts;
  std::set<std::array<double, 5>> counted;
  for (auto candidate = plan.candidates.rbegin(); candidate != plan.candidates.rend();
       ++candidate) {
    const ViewPose& view = candidate->view;
    const Vec3& p_m = view.p_world_m;
    const bool is_last =
        counted.insert({p_m.x(), p_m.y(), p_m.z(), view.yaw_rad, view.gimbal_pitch_rad}).second;
    if (is_last && candidate->rejected) ++counts[*candidate->rejected];
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
