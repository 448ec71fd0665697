// Figures of a flight: where the vehicle was, and how well it kept to its legs.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tools/figures/figure.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

/// "flight": position, attitude, speed and distance from the leg over the time of the views, from
/// trajectory.tum. Nothing for a run without two views, or without its path.
std::optional<Figure> flight_figure(const RunRecord& record);

/// "tracking": over the time of the views, how far the vehicle truly was from the straight legs
/// that were checked for it, beside what the collision radius leaves beyond the hull (the safety
/// margin); and its tilt. Nothing for a run without two views, or without its path.
std::optional<Figure> tracking_figure(const RunRecord& record);

/// A line of yaws in [-180, 180] deg: what goes past 180 is drawn on to 190 before the line breaks
/// (NaN) and goes on at the other end, so that a vehicle that looks that way does not jump to and
/// fro.
Series yaw_series(std::span<const double> times_s, std::span<const double> yaws_deg);

/// Samples of a flight over time: as they are, or of many those of each of 240 even steps: their
/// mean, and a band that holds `share` of them.
class Traces {
 public:
  /// Requires ascending times and 0 < share <= 1.
  explicit Traces(std::vector<double> times_s, double share = 1.0);

  /// Requires a value a time.
  Series series(std::string name, const std::vector<double>& values, std::size_t colour) const;
  /// The most of the values in each step; nothing where the samples are drawn.
  std::optional<Series> most(std::string name, const std::vector<double>& values,
                             std::size_t colour) const;
  /// What line and band are: "line: mean of each 6 s; band: least to most"; empty where the samples
  /// are drawn.
  std::string note() const;

 private:
  std::vector<double> of_step(const std::vector<double>& values, std::size_t step) const;

  std::vector<double> times_s_;
  double share_;
  double step_s_ = 0.0;
  std::vector<std::size_t> begins_;  // of the steps that have samples, and the end; empty: few
  std::vector<double> middles_s_;
};

}  // namespace gnbv
