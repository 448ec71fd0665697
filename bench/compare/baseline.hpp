// The regression gate: what a mission has to reach again, within stated tolerances.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/compare/text_table.hpp"
#include "bench/score/run_figures.hpp"

namespace gnbv {

/// Which way a metric gets better; `same`: any change beyond the tolerance is for the worse.
enum class Better { higher, lower, same };

struct BaselineMetric {
  std::string name;
  double value = 0.0;
  double tolerance = 0.0;  // absolute, in the metric's unit
  Better better = Better::same;
};

/// What a baseline is of. Figures of anything else are not comparable.
struct BaselineSubject {
  struct Content {
    std::string name;
    std::string sha256;
  };
  using Values = std::map<std::string, std::string>;

  Values configuration = {};                  // each value that the mission depends on, by its key
  std::map<std::string, Content> files = {};  // meshes, a saved profile; by key, too
  Values defaults = {};      // not written: what a key was before its version, for older baselines
  std::string version = {};  // of the program; may differ
  std::string reference = {};  // "outside", "area_samples 150000": what coverage counts
};

struct Baseline {
  BaselineSubject of;
  std::string termination;                        // how the mission ended
  std::vector<BaselineMetric> metrics = {};       // all that there are, in make_baseline()'s order
  std::optional<std::string> result_sha256 = {};  // when it has to be the same: on one machine only
};

/// A baseline file. Throws BadInput naming file and key: other schema, metric missing or unknown,
/// a value that is no number, a tolerance that is none or below 0, `better` that is none of the
/// three.
Baseline read_baseline(const std::filesystem::path& path);
std::string to_json(const Baseline& baseline);

/// What to do about a baseline file that is not of use any more.
std::string how_to_renew(const std::filesystem::path& path);

/// Of a run: coverage_0.05, coverage_0.10, coverage_0.50, precision, recall and
/// f (at 0.05 m), coverage at each further size that the run was scored at (coverage_0.02),
/// chamfer_m, density (points in a voxel that holds any), straight_m, flight_time_s, iterations,
/// entropy_reduction_nat. Tolerances are 0.02 for shares, 0.001 m for Chamfer, a tenth of the value
/// for all other metrics.
/// `of` without version and reference, which the figures name.
Baseline make_baseline(const RunFigures& run, const BaselineSubject& of);

/// The same with the tolerances of `before`, its `better`, and what it asks of the hash. Throws as
/// check_against() does.
Baseline updated_baseline(const RunFigures& run, const BaselineSubject& of, const Baseline& before,
                          const std::filesystem::path& path);

enum class GateVerdict { kept, better, regressed };

struct MetricChange {
  BaselineMetric baseline;
  double now = 0.0;
  GateVerdict verdict = GateVerdict::kept;
};

struct BaselineCheck {
  std::vector<MetricChange> metrics;  // in the baseline's order
  std::string termination;            // of the run
  std::string baseline_termination;
  bool is_termination_wrong = false;  // not the baseline's, or a collision, which never is right
  bool is_hash_wrong = false;
};

/// Throws BadInput naming `path` and every difference ("planner.x: 3 -> 4") when the run is of
/// something else.
BaselineCheck check_against(const Baseline& baseline, const std::filesystem::path& path,
                            const RunFigures& run, const BaselineSubject& of);

/// What got worse, by name: termination, result_sha256, metrics.
std::vector<std::string> regressed(const BaselineCheck& check);

/// A row a metric that is not within its tolerance, then how many are.
TextTable check_table(const BaselineCheck& check);

/// All of it, schema gnbv-check-1.
std::string check_json(const BaselineCheck& check);

}  // namespace gnbv
