// Ours beside every number and sentence of the paper that can be checked against missions.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/compare/paper_figures.hpp"
#include "tools/figures/group_figures.hpp"
#include "tools/paper/missions.hpp"
#include "tools/paper/verdicts.hpp"

namespace gnbv {

/// A number that the paper prints of a row.
struct PaperFigure {
  std::string_view head;  // with the unit
  int decimals = 0;
  bool is_coverage = false;
  std::optional<double> (*printed)(const PaperRow& row) = nullptr;
  /// Of a mission after its first `views` views. Nothing when it is not on record.
  std::optional<double> (*ours)(const PaperMission& mission, std::size_t views) = nullptr;
  std::optional<double> (*profile)(const PaperMission& mission) = nullptr;  // of the profile alone
};

/// In the order of the page's columns: entropy reduction, distance, time, coverages, density.
std::span<const PaperFigure> compared_figures();

/// Ours beside the paper's; each may be missing.
struct ComparedFigure {
  std::optional<double> printed = {};
  std::optional<MeanEstimate> ours = {};
  std::optional<Agreement> agreement = {};
};

/// Whether a limit of ours (views, metres, time, battery) ended the mission before it had as many
/// views as the row.
bool is_cut(const PaperMission& mission, const PaperRow& row);

/// A row of a table. Ours is taken after as many views as the paper's row took, or after all of
/// them where there are fewer: the paper's planners stopped by themselves at numbers of their own.
struct ComparedRow {
  std::string label;    // as the paper names it
  std::string utility;  // empty for the profile
  std::size_t missions = 0;
  std::optional<int> printed_views = {};
  int views = 0;        // after which ours is taken, at most over the seeds
  int flown_views = 0;  // of all that were flown, at most over the seeds
  bool is_doubtful = false;
  std::vector<ComparedFigure> figures;  // of compared_figures()
};

/// The rows of a table and its profile.
std::vector<ComparedRow> compare_rows(const PaperMaterial& material, const PaperTable& table);

/// Two planners by one figure.
struct ComparedPair {
  std::string first;  // labels
  std::string second;
  std::size_t figure = 0;  // of compared_figures()
  double printed = 0.0;    // the first's minus the second's
  MeanEstimate ours = {};  // the same, paired by seed
  PairOrder order = PairOrder::undecided;
};

/// All pairs of planners by all figures that the paper prints of both and some seed gives of both.
std::vector<ComparedPair> compare_pairs(const PaperMaterial& material, const PaperTable& table);

/// A sentence of the paper about what a figure shows, in our words.
struct CheckedClaim {
  std::string figure;    // "9": of which figure
  std::string sentence;  // what the paper says
  std::string finding;   // what our missions show
  std::string rule;      // when such a sentence holds
  ClaimVerdict verdict = ClaimVerdict::fails;
};

/// Those that the scenarios' missions can answer, in the order of the paper's figures.
std::vector<CheckedClaim> check_claims(const PaperMaterial& material);

std::vector<DrawnGroup> mean_densities(const PaperMaterial& material, const PaperTable& table);

}  // namespace gnbv
