// Progress on stderr: one line that rewrites itself on a terminal, a line each quarter elsewhere.
#pragma once

#include <chrono>
#include <string>

namespace gnbv {

class ProgressBar {
 public:
  /// `label` stands before the bar. Silent when `quiet` or NO_PROGRESS is set.
  ProgressBar(const std::string& label, bool quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `share_done` in [0, 1]; `note` says what is being done.
  void show(double share_done, const std::string& note);

 private:
  enum class Style { silent, lines, bar };
  std::string label_;
  Style style_;
  std::chrono::steady_clock::time_point begin_;
  std::chrono::steady_clock::time_point last_drawn_;
  int last_quarter_ = 0;
  bool bar_is_open_ = false;
};

}  // namespace gnbv
