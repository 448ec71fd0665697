#include "bench/limits/survey_task.hpp"

#include <algorithm>
#include <utility>

#include "planner/planners.hpp"
#include "sim/core/rng.hpp"
#include "sim/flight/guidance.hpp"

namespace gnbv {
namespace {

constexpr std::uint32_t kNoIndex = 0xffffffffU;

/// The items of a sample, in the order of the voxels; kNoIndex for all others.
std::vector<std::uint32_t> sample_of(std::size_t voxels) {
  constexpr std::size_t kMany = 100000;
  const std::size_t one_of = (voxels + kMany - 1) / kMany;
  std::vector<std::uint32_t> item(voxels, kNoIndex);
  std::uint32_t items = 0;
  for (std::size_t v = 0; v < voxels; ++v) {
    if (one_of == 1 || mix_bits(v) % one_of == 0) item[v] = items++;
  }
  return item;
}

}  // namespace

double duration_s(const Scenario& scenario, const ViewPose& from, const ViewPose& to) {
  const GuidanceConfig& guidance = scenario.guidance;
  return leg_duration_s(from, to, guidance.path_speed_m_s, guidance, scenario.vehicle);
}

double price_of_view(const Scenario& scenario) {
  constexpr double kOfFew_m = 1000.0;
  constexpr double kOfFewMetres_m = 0.3;
  const PlannerTraits traits = traits_of(scenario.planner);
  if (traits.counts_seconds) return duration_s(scenario, {}, {.yaw_rad = 0.25 * kPi});
  return traits.counts_metres ? kOfFewMetres_m : kOfFew_m;
}

// Climbing and descending have speeds of their own: the mean of the two ways round.
WayCost way_cost(const Scenario& scenario) {
  if (!traits_of(scenario.planner).counts_seconds) return {};
  return [&scenario, turn_s = price_of_view(scenario)](const Vec3& from_m, const Vec3& to_m,
                                                       double way_m) {
    const double straight_m = (to_m - from_m).norm();
    if (straight_m == 0.0) return 0.0;
    const ViewPose from{from_m};
    const ViewPose to{Vec3(from_m + way_m / straight_m * (to_m - from_m))};
    const double both_s = duration_s(scenario, from, to) + duration_s(scenario, to, from);
    return std::max(0.0, 0.5 * both_s - turn_s);
  };
}

SurveyTask::SurveyTask(const ViewSurvey& survey, std::size_t voxels, const LatticeWays& ways,
                       WayCost cost, int threads)
    : ways_(ways), cost_(std::move(cost)), threads_(threads), item_(sample_of(voxels)) {
  std::vector<std::uint32_t> index(ways.start(), kNoIndex);
  for (const SurveyedView& view : survey.views) {
    if (index[view.position] == kNoIndex) {
      index[view.position] = static_cast<std::uint32_t>(lattice_place_.size());
      lattice_place_.push_back(view.position);
    }
    place_.push_back(index[view.position]);
    finds_.push_back(sampled(view.finds));
  }
  const auto left_out = std::count(item_.begin(), item_.end(), kNoIndex);
  sets_ = CoverSets(finds_, voxels - static_cast<std::size_t>(left_out));
  lattice_place_.push_back(ways.start());
  rows_m_.resize(lattice_place_.size());
}

std::vector<std::uint32_t> SurveyTask::sampled(std::span<const std::uint32_t> voxels) const {
  std::vector<std::uint32_t> items;
  for (const std::uint32_t voxel : voxels) {
    if (item_[voxel] != kNoIndex) items.push_back(item_[voxel]);
  }
  return items;
}

CoverTask SurveyTask::task(std::uint64_t search_seed) {
  return {.views = sets_,
          .place = place_,
          .start = static_cast<std::uint32_t>(lattice_place_.size() - 1),
          .row_m = [this](std::uint32_t place) { return row_m(place); },
          .seed = search_seed};
}

std::span<const float> SurveyTask::row_m(std::uint32_t place) {
  std::vector<float>& row_m = rows_m_[place];
  if (!row_m.empty()) return row_m;
  row_m = ways_.distances_m(lattice_place_[place], lattice_place_, threads_);
  for (std::size_t other = 0; cost_ && other < row_m.size(); ++other) {
    row_m[other] = static_cast<float>(cost_(ways_.p_world_m(lattice_place_[place]),
                                            ways_.p_world_m(lattice_place_[other]),
                                            static_cast<double>(row_m[other])));
  }
  for (std::size_t other = 0; other < rows_m_.size(); ++other) {  // one length both ways
    if (other != place && !rows_m_[other].empty()) row_m[other] = rows_m_[other][place];
  }
  return row_m;
}

}  // namespace gnbv
