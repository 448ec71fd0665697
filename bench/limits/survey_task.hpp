// The survey's views as a task for covering tours.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bench/limits/covering_tour.hpp"
#include "bench/limits/lattice_ways.hpp"
#include "bench/limits/view_survey.hpp"

namespace gnbv {

/// Places of the task are those that the survey looks from, and after them the start. Lengths
/// between them are LatticeWays::distances_m(), found when a search asks first: it stops at few of
/// the places. Of many voxels an even sample of about 100,000 stands for all: what a tour finds of
/// them is off by a few hundredths of a percent of what it finds of all. A task refers to this.
class SurveyTask {
 public:
  /// Keeps a reference to the ways. `voxels`: how many there are to find.
  SurveyTask(const ViewSurvey& survey, std::size_t voxels, const LatticeWays& ways, int threads);
  SurveyTask(const SurveyTask&) = delete;
  SurveyTask& operator=(const SurveyTask&) = delete;

  CoverTask task(std::span<const std::uint32_t> found_at_start);

  /// Of a place of the task: that of LatticeWays.
  std::size_t lattice_place(std::uint32_t place) const { return lattice_place_[place]; }

 private:
  std::vector<std::uint32_t> sampled(std::span<const std::uint32_t> voxels) const;
  std::span<const float> row_m(std::uint32_t place);

  const LatticeWays& ways_;
  int threads_;
  std::vector<std::uint32_t> item_;                // of each voxel; kNone: not in the sample
  std::vector<std::vector<std::uint32_t>> finds_;  // items of each view
  CoverSets sets_{{}, 0};
  std::vector<std::uint32_t> place_;  // of each view
  std::vector<std::size_t> lattice_place_;
  std::vector<std::vector<float>> rows_m_;  // of each place; empty: not asked for
};

}  // namespace gnbv
