// A mission as one row: words that say which one it is, and its figures by name. Tables and
// comparisons are made of such rows alone, whether they were just flown or come from a file.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "bench/limits/ceiling.hpp"
#include "bench/score/run_figures.hpp"

namespace gnbv {

/// Figures by name; what is not known is not there. Coverages are fractions, lengths metres, times
/// seconds unless the name says otherwise. An effort to reach what was not reached is infinite.
using Figures = std::map<std::string, double, std::less<>>;

struct MissionRow {
  std::string id = {};        // of what was flown, whatever program flew it (CellNamer)
  std::string scenario = {};  // as a table or comparison names it
  std::string method = {};
  std::string setting = {};  // what sets it apart from other rows of its method: "exact sensors"
  std::uint64_t seed = 0;
  std::string structure = {};         // built-in name, or path of the mesh
  std::string structure_sha256 = {};  // of the mesh as it was flown around
  std::string program = {};           // that flew it: flying_source_id()
  std::string commit = {};            // of the program, where the caller knows it
  std::string termination = {};
  std::string result_sha256 = {};
  Figures figures = {};

  std::optional<double> find(std::string_view name) const;
  /// By which structures are told apart: files of one name may hold different meshes. The name of
  /// those whose mesh is not known.
  const std::string& structure_id() const {
    return structure_sha256.empty() ? structure : structure_sha256;
  }
};

/// Of the missions of a scenario, where any has the figure.
std::optional<double> largest_figure(std::span<const MissionRow> missions,
                                     std::string_view scenario, std::string_view figure);

/// What a mission came to at its end, after fewer views, or after its profile: the same names with
/// a prefix before them.
constexpr std::string_view kAtEnd = "";
constexpr std::string_view kCut = "cut_";        // after as many views as the paper's row
constexpr std::string_view kWithin = "within_";  // after as many views as the scenario's budget
constexpr std::string_view kProfile = "profile_";

/// Of what was spent until a share of kReachNames was reached: "metres_to_0.95_with_profile".
std::string figure_to_reach(Effort effort, std::string_view share);
constexpr std::string_view kOneBatteryTo = "one_battery_to_";  // and the share

/// A run as a row, named by its own scenario and utility. Figures: iterations, distance_m, time_min
/// and coverage_0.05 (and so on for each size), with each prefix, kCut where the paper has a row of
/// this utility in this scenario and the run took more views; the
/// same as accurate_coverage_*; raw_coverage_*; noisy (1 or 0); entropy_reduction,
/// density_points_per_voxel, flown_m, flight_time_s, energy_wh, wall_s, f_0.05, chamfer_m,
/// area_samples; budget_* by kEffortNames (from take-off: what was spent before, and the budget; of
/// energy what the mission draws by then at its mean power) and mean_coverage_* by the first of
/// them. With a ceiling: ceiling_* (of the cloud) and physical_ceiling_* by size, and by
/// kReachNames figure_to_reach() of all efforts and kOneBatteryTo (1: reached, by a view on one
/// battery as view_marks() has it; 0). Who knows the scenario adds (1 or 0) seeds_key_noise,
/// papers_structure and papers_setting.
MissionRow mission_row(const RunFigures& run);
void add_ceiling(const RunFigures& run, const Ceiling& ceiling, MissionRow& row);

/// The figures whose names begin with the prefix, without it. Of kAtEnd all figures.
Figures with_prefix(const Figures& figures, std::string_view prefix);

}  // namespace gnbv
