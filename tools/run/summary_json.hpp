// summary.json: what a run reached, for people and programs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "bench/score/mission_score.hpp"
#include "scenarios/scenario.hpp"
#include "tools/run/mission_result.hpp"

namespace gnbv {

/// 2: precision_recall, accuracy_m, completeness_m, chamfer_m, density, auc; coverage.csv.
/// 3: ceiling_at_0.05, effort_to_reach; later budget and mean_coverage, which may be absent.
constexpr unsigned kSummarySchema = 3;

/// A score as an object of its own; without the run's curve and profile when it is only a cloud
/// that was scored.
std::string score_json(const MissionScore& score, bool is_run);

std::string summary_json(const Scenario& scenario, const MissionResult& result,
                         const MissionScore& score, double total_wall_s);

/// What summaries of every version say, as far as this one does.
struct RunSummary {
  std::uint64_t schema = 0;
  std::optional<std::string> termination = {};
  std::optional<std::uint64_t> iterations = {};
  std::optional<double> profile_end_s = {};  // since the start of the mission,
  std::optional<double> views_begin_s = {};  // as is where the planned views begin
  std::optional<double> profile_m = {};      // planned legs: of the profile,
  std::optional<double> transfer_m = {};     // and from there to the first view
  std::optional<std::string> result_sha256 = {};
  std::optional<std::string> views_sha256 = {};  // of iterations.csv
};

/// Throws BadInput naming the folder when it holds no finished run, and file and key of whatever is
/// damaged.
RunSummary read_summary(const std::filesystem::path& run);

/// Throws BadInput when the views, those of the file, are not those that the run ended with.
void need_views_of_summary(const std::filesystem::path& csv, const RunSummary& summary,
                           std::span<const ViewRecord> views);

/// The figures of a finished run directory, from summary.json and coverage.csv. Throws BadInput
/// naming file and key for a run that is not finished, or that another version wrote (the message
/// names the command that scores it anew).
RunFigures read_run_figures(const std::filesystem::path& run);

/// Puts a score into coverage.csv and summary.json, of this schema or an earlier one, each by
/// rename; all else stays as it is. With the score it has, a summary of this schema stays the same,
/// byte for byte. Throws BadInput naming the file for what is no summary, or one of a later schema.
void rescore_summary(const std::filesystem::path& run, const MissionScore& score);

}  // namespace gnbv
