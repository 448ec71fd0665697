// What one mission reached: what tables, statistics and gates are made of.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/score/cloud_metrics.hpp"
#include "bench/score/sized_coverage.hpp"

namespace gnbv {

/// Coverage as the mission went on. Entry 0 is the profile alone (0 views, 0 m, 0 s), entry n what
/// the first n views left. Metres are planned straight legs from the first view on, seconds are
/// simulated, from the end of the profile on.
struct CoverageCurve {
  std::vector<std::array<double, 3>> coverage;  // of what it counts, by kCoverageSizes_m
  std::vector<double> metres;
  std::vector<double> seconds;
  std::vector<std::array<double, 3>> accurate = {};  // coverage; none of runs of older versions
  /// Drawn since the mission began, and whether that is on one battery with the way home; entry 0
  /// has the first view's, which is at home. None of runs of older versions.
  std::vector<double> energy_wh = {};
  std::vector<bool> on_one_battery = {};

  std::size_t views() const { return coverage.empty() ? 0 : coverage.size() - 1; }
};

/// What a mission spends before its curve begins.
struct BeforeViews {
  double profile_m = 0.0;      // planned legs of the profile, its approach included
  double transfer_m = 0.0;     // planned, from the end of the profile to the first view
  double profile_end_s = 0.0;  // simulated, since the mission began
};

/// What a mission spends, the abscissa of a curve: views, metres and seconds as CoverageCurve has
/// them; then from take-off, where the mission begins in the air, with the profile and the way on
/// from it: metres of planned legs, seconds, and the energy that was drawn.
enum class Effort {
  views,
  metres,
  seconds,
  metres_with_profile,
  seconds_with_profile,
  wh_with_profile
};
constexpr std::array<Effort, 6> kEfforts = {Effort::views,
                                            Effort::metres,
                                            Effort::seconds,
                                            Effort::metres_with_profile,
                                            Effort::seconds_with_profile,
                                            Effort::wh_with_profile};
constexpr std::array<std::string_view, 6> kEffortNames = {
    "views", "metres", "seconds", "metres_with_profile", "seconds_with_profile", "wh_with_profile"};

constexpr std::string_view name_of(Effort effort) {
  return kEffortNames[static_cast<std::size_t>(effort)];
}
constexpr bool is_from_take_off(Effort effort) { return effort >= Effort::metres_with_profile; }

/// By views, metres and seconds: what mean coverage and efforts are judged over. 0: not known.
using Budgets = std::array<double, 3>;

/// Whether the curve has it: energy is not known of runs of older versions.
bool is_known(const CoverageCurve& curve, Effort effort);

/// Of the curve's entry. Requires that it is known.
double effort_at(const CoverageCurve& curve, const BeforeViews& before, Effort effort,
                 std::size_t entry);

/// Mean coverage (size index `size`) over [0, budget] of the effort. Surface counts from the view
/// that saw it; after the last view coverage stays what it is. In [0, 1]. Requires budget > 0 and a
/// curve, and an effort that counts from 0 on.
double area_under_coverage(const CoverageCurve& curve, Effort effort, std::size_t size,
                           double budget);

/// Shares of the ceiling (bench/limits/ceiling.hpp: what the cloud can hold at 0.05 m) whose effort
/// is told, and their names.
constexpr std::array<double, 5> kReachShares = {0.80, 0.90, 0.95, 0.98, 0.99};
constexpr std::array<std::string_view, 5> kReachNames = {"0.80", "0.90", "0.95", "0.98", "0.99"};

/// Seconds of the curve's entry as its metres count, as people read them: from the first view on,
/// without the way there from the end of the profile. Requires such an entry.
double seconds_of_views(const CoverageCurve& curve, std::size_t entry);

/// The curve's entry at which the cloud first covered so much of the finest voxels: what a mission
/// had spent by then tells one that is quick from one that ends early. Nothing when the mission
/// ended before: it is not reached, however much would have been spent. Requires a curve.
std::optional<std::size_t> entry_that_covers(const CoverageCurve& curve, double coverage);

/// Coverage as fractions by kCoverageSizes_m.
struct RunFigures {
  std::string scenario;
  std::string structure;  // built-in name, or path of the mesh
  std::string utility;
  std::string preset;
  std::uint64_t seed = 0;
  std::string version;
  std::string termination;
  std::string result_sha256;
  int iterations = 0;
  double entropy_reduction_nat = 0.0;
  double straight_m = 0.0;  // between consecutive views, without the profile
  double flown_m = 0.0;     // the same as the vehicle flew it
  BeforeViews before;
  double flight_time_s = 0.0;
  double energy_wh = 0.0;
  std::size_t area_samples = 0;                            // of the reference: what coverage counts
  std::array<double, 3> coverage_final{};                  // of that
  std::array<double, 3> coverage_profile{};                // the same, after the profile
  std::optional<std::array<double, 3>> coverage_accurate;  // (kAccurateShare); not of older runs
  bool is_noisy = false;  // depth noise or a pose estimate: accurate coverage is what tells
  std::array<double, 3> coverage_final_raw{};  // of all surface
  std::array<double, 3> coverage_profile_raw{};
  std::vector<SizedCoverage> more = {};   // at sizes beside the paper's, ascending
  double density_points_per_voxel = 0.0;  // cloud points per occupied voxel (Fig. 9)
  CloudDistances distances;               // precision, recall, F, Chamfer
  CloudDensity density;
  CoverageCurve curve;            // may be empty
  Budgets budgets{};              // of the scenario
  std::optional<double> ceiling;  // coverage at 0.05 m that the cloud can reach, when it is known
  double wall_s = 0.0;
};

}  // namespace gnbv
