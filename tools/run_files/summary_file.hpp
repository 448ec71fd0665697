// summary.json and coverage.csv: what a run reached, for people and programs.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "bench/score/mission_score.hpp"
#include "scenarios/scenario.hpp"
#include "tools/run_files/mission_result.hpp"

namespace gnbv {

/// 2: precision_recall, accuracy_m, completeness_m, chamfer_m, density, auc; coverage.csv.
constexpr unsigned kSummarySchema = 2;

constexpr std::string_view kCoverageCsvHeader =
    "view,metres,seconds,coverage_0.05,coverage_0.10,coverage_0.50";

std::string summary_json(const Scenario& scenario, const MissionResult& result,
                         const MissionScore& score, double total_wall_s);

/// summary.json of a run. Throws BadInput naming the folder when it holds no finished run.
std::string read_summary(const std::filesystem::path& run);

/// The scoring part of a summary as an object of its own; without the run's curve and profile when
/// it is only a cloud that was scored.
std::string score_json(const MissionScore& score, bool is_run);

/// A summary of this schema or an earlier one, scored anew; all else stays as it is. With the score
/// it has, a summary of this schema stays the same, byte for byte. Throws BadInput, beginning with
/// `name`, for what is no summary, or one of a later schema.
std::string rescored_summary_json(const std::string& name, const std::string& summary,
                                  const MissionScore& score);

/// A row an entry of the curve. Numbers are written so that they read back exactly.
std::string coverage_csv(const CoverageCurve& curve);

}  // namespace gnbv
