// Progress on stderr: one line that rewrites itself on a terminal; elsewhere a line each quarter,
// and each minute in between.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

namespace gnbv {

/// "1 h 20 min", "3 min 05 s" or "12 s".
std::string duration_text(double seconds);

/// What is left where `spent_s` made `share_done`, at the same pace. Nothing before a share or a
/// time says anything: the first hundredth, or the first second.
std::optional<double> seconds_left(double spent_s, double share_done);

/// The bar of a terminal in at most so many columns: a long note makes the bar narrower, and is
/// then cut after a word. `share` in [0, 1].
std::string progress_line(const std::string& label, double share, const std::string& time,
                          const std::string& note, std::size_t columns);

class ProgressBar {
 public:
  /// `label` stands before the bar. Silent when `quiet` or NO_PROGRESS is set.
  ProgressBar(const std::string& label, bool quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `share_done` in [0, 1]; `note` says what is being done. What is left is told by the pace so
  /// far, or as `left_s` says.
  void show(double share_done, const std::string& note);
  void show(double share_done, const std::string& note, std::optional<double> left_s);

 private:
  enum class Style { silent, lines, bar };
  std::string label_;
  Style style_;
  std::chrono::steady_clock::time_point begin_;
  std::chrono::steady_clock::time_point last_drawn_;
  std::chrono::steady_clock::time_point last_line_;
  int last_quarter_ = 0;
  bool bar_is_open_ = false;
};

}  // namespace gnbv
