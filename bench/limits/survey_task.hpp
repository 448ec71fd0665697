// The survey's views as a task for covering tours.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bench/limits/covering_tour.hpp"
#include "bench/limits/lattice_ways.hpp"
#include "bench/limits/view_survey.hpp"

namespace gnbv {

/// Seconds of a leg at path speed, from rest to rest.
double duration_s(const Scenario& scenario, const ViewPose& from, const ViewPose& to);

/// What a view costs beside the way to its place, for the scenario's oracle and in its unit of
/// ways: 0.3 m; so many that few views come first; or the seconds of an eighth of a turn, the step
/// of the survey's yaws.
double price_of_view(const Scenario& scenario);

/// Of a way of so many metres between two places, the same both ways round; none: its metres.
using WayCost =
    std::function<double(const Vec3& from_world_m, const Vec3& to_world_m, double way_m)>;

/// For the scenario's oracle: metres, or as many seconds as a way takes more than a view costs.
/// Keeps a reference to the scenario.
WayCost way_cost(const Scenario& scenario);

/// Places of the task are those that the survey looks from, and after them the start. Lengths
/// between them are LatticeWays::distances_m(), found when a search asks first: it stops at few of
/// the places. Where ways have another cost, the task's metres are that. Of many voxels an even
/// sample of about 100,000 stands for all: what a tour finds of them is off by a few hundredths of
/// a percent of what it finds of all. A task refers to this.
class SurveyTask {
 public:
  /// Keeps a reference to the ways. `voxels`: how many there are to find.
  SurveyTask(const ViewSurvey& survey, std::size_t voxels, const LatticeWays& ways, WayCost cost,
             int threads);
  SurveyTask(const SurveyTask&) = delete;
  SurveyTask& operator=(const SurveyTask&) = delete;

  /// From the start, without anything that is given.
  CoverTask task(std::uint64_t search_seed);

  /// The items of the task that stand for some of the voxels.
  std::vector<std::uint32_t> sampled(std::span<const std::uint32_t> voxels) const;

  /// Of a place of the task: that of LatticeWays.
  std::size_t lattice_place(std::uint32_t place) const { return lattice_place_[place]; }

 private:
  std::span<const float> row_m(std::uint32_t place);

  const LatticeWays& ways_;
  WayCost cost_;
  int threads_;
  std::vector<std::uint32_t> item_;                // of each voxel; kNone: not in the sample
  std::vector<std::vector<std::uint32_t>> finds_;  // items of each view
  CoverSets sets_{{}, 0};
  std::vector<std::uint32_t> place_;  // of each view
  std::vector<std::size_t> lattice_place_;
  std::vector<std::vector<float>> rows_m_;  // of each place; empty: not asked for
};

}  // namespace gnbv
