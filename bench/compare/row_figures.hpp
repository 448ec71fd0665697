// What the rows of the paper's tables show: means over runs, and what the paper printed.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "bench/compare/paper_figures.hpp"
#include "bench/compare/statistics.hpp"
#include "bench/limits/ceiling.hpp"
#include "bench/score/run_figures.hpp"

namespace gnbv {

/// That differ in their seeds alone.
using RunsOfRow = std::vector<const RunFigures*>;

/// What a row shows, each estimated over its runs or printed by the paper.
struct RowFigures {
  std::string label;
  std::string kind;  // ours, paper, ...
  std::optional<std::size_t> runs = {};
  std::optional<MeanEstimate> iterations = {};
  std::optional<MeanEstimate> entropy_reduction = {};
  std::optional<MeanEstimate> distance_m = {};
  std::optional<MeanEstimate> time_min = {};
  std::array<std::optional<MeanEstimate>, 3> coverage = {};
  std::map<double, MeanEstimate> more = {};  // by the size that all runs have beside these
  std::optional<MeanEstimate> share_of_ceiling = {};
  std::optional<MeanEstimate> density = {};
  std::string mark = {};  // of the finest two coverages
};

template <typename Value>
MeanEstimate estimate(const RunsOfRow& runs, const Value& value_of) {
  std::vector<double> values;
  for (const RunFigures* run : runs) values.push_back(value_of(*run));
  return estimate_mean(values);
}

/// Sizes beside the paper's that some of the runs have.
std::set<double> more_sizes(std::span<const RunFigures> runs);

RowFigures paper_figures(const PaperRow& row);

RowFigures our_figures(const std::string& label, const RunsOfRow& runs,
                       const std::optional<Ceiling>& ceiling);

/// Ours after as many views as the paper's row took, at most; nothing when no run took more. Of
/// entropy and density only the end is known.
std::optional<RowFigures> our_figures_as_long(const std::string& label, const RunsOfRow& runs,
                                              const PaperRow& row,
                                              const std::optional<Ceiling>& ceiling);

/// The profile does not depend on the utility: one run a seed.
RowFigures our_profile(const RunsOfRow& runs, const std::optional<Ceiling>& ceiling);

RowFigures ceiling_figures(const std::string& kind, const std::array<double, 3>& coverage);

}  // namespace gnbv
