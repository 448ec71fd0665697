// A submission: one zip file that anybody can check by flying it again.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/score/run_figures.hpp"
#include "bench/suite/suite.hpp"

namespace gnbv {

// ---- score.cpp: what a mission scores in a task

/// Of one mission in one task; coverage is accurate coverage at 0.05 m, in fractions.
struct TaskFigures {
  std::string task;  // name of its structure
  std::string termination, result_sha256;
  std::uint64_t views = 0;
  double spent = 0.0;                // of the track's effort, at the last view
  double integral = 0.0;             // mean coverage over the budget
  double share = 0.0;                // of what the best known planner gets: the score
  double coverage = 0.0;             // by the last view within the budget
  std::optional<double> to_90 = {};  // effort at which that share of the ceiling was covered,
  std::optional<double> to_95 = {};  // within the budget
  double plan_s = 0.0;               // wall time of planning a view: stated, not recomputed

  bool operator==(const TaskFigures&) const = default;
};

/// Whether a mission ended so that nothing more counts: the vehicle hit something or was lost.
bool is_lost(const std::string& termination);

/// Mean coverage over [0, budget] of the effort: a view counts from where it was taken, nothing
/// before the first entry. Up to the last entry alone when the mission was lost there.
double mean_coverage(const CoverageCurve& curve, const BeforeViews& before, Effort effort,
                     double budget, bool is_lost);

/// Requires a frozen task of that effort, and a run with accurate coverage.
TaskFigures task_figures(const RunFigures& run, const SuiteTask& task, Effort effort);

/// A mean over structures, and the 95 % percentile interval of it over 10,000 resamples of them
/// (Efron 1979). The interval of one structure is the mean itself. The same numbers every time.
struct Interval {
  double mean = 0.0, low = 0.0, high = 0.0;
};
Interval bootstrap_mean(std::span<const double> values);

// ---- submission.cpp

/// Whose views they are: a planner of the program's, which flies again by its settings, or somebody
/// else's, whose views are flown again as they were given.
enum class EntryKind { planner, views };
constexpr std::array<std::string_view, 2> kEntryKindNames = {"planner", "views"};

struct SubmittedMission {
  TaskFigures figures;
  std::map<std::string, std::string> files = {};  // SHA-256 by name: kRecordFile, ...
  std::string trajectory_sha256 = {};  // of the whole trajectory.tum, of which the zip has a tenth

  bool operator==(const SubmittedMission&) const = default;
};

/// Figures of a whole track.
struct TrackFigures {
  Interval score, coverage;                         // shares of the best known; coverage at the end
  double public_score = 0.0, held_out_score = 0.0;  // 0 where the track has none
  std::optional<double> to_90 = {}, to_95 = {};     // medians; none: half of them do not get there
  double plan_s = 0.0;                              // mean over structures
};

struct Submission {
  int suite_version = 1;
  std::string track, track_sha256;
  std::string name;  // of the planner, as tables call it
  EntryKind kind = EntryKind::planner;
  std::vector<std::string> settings = {};  // KEY=VALUE, of a planner of the program's
  std::string description, licence, machine;
  std::string program, program_sha256;  // version, and flying_source_id()
  std::vector<SubmittedMission> missions = {};
  TrackFigures figures = {};

  std::filesystem::path file = {};                  // that it was read from
  std::map<std::string, std::string> records = {};  // "missions/TASK/FILE" and content
};

constexpr const char* kRecordFile = "iterations.csv";
constexpr const char* kGivenFile = "views.csv";  // of EntryKind::views
constexpr const char* kPathFile = "trajectory.tum";
constexpr const char* kCurveFile = "coverage.csv";

/// "missions/TASK/FILE".
std::string member_name(const std::string& task, const std::string& file);

/// Requires missions of the tasks in their order.
TrackFigures track_figures(const Suite& suite, const std::vector<SubmittedMission>& missions);

/// Throws BadInput naming place and key unless the text is UTF-8 of at most 4000 bytes that
/// controls no terminal; a description may have several lines, a hash is of 64 hexadecimal digits.
void need_text(const std::string& place, const std::string& key, const std::string& text);

/// Fills in the hashes of the records and writes the zip. Throws as need_text() before it does.
void write_submission(Submission submission, const std::filesystem::path& zip);

/// Throws BadInput as read_zip(), and naming file and key or member for a submission.json that is
/// not as write_submission() writes it, edited, or of another type somewhere; for members that it
/// does not name, that are missing or that have another hash.
Submission read_submission(const std::filesystem::path& zip);

/// Throws BadInput when it is of another suite or track, lacks a task, or says other figures of the
/// track than its missions give.
void need_of_suite(const Submission& submission, const Suite& suite);

}  // namespace gnbv
