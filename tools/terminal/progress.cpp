#include "tools/terminal/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "sim/core/text.hpp"
#include "tools/terminal/say.hpp"
#include "tools/terminal/streams.hpp"

namespace gnbv {
namespace {

bool is_terminal() {
  const char* const term = std::getenv("TERM");
  return isatty(STDERR_FILENO) != 0 && term != nullptr && std::string_view(term) != "dumb";
}

}  // namespace

std::string duration_text(double seconds) {
  const auto whole = static_cast<long long>(std::llround(std::max(seconds, 0.0)));
  const long long minutes = whole / 60;
  if (minutes >= 60) return fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
  if (minutes > 0) return fmt::format("{} min {:02} s", minutes, whole % 60);
  return fmt::format("{} s", whole);
}

std::optional<double> seconds_left(double spent_s, double share_done) {
  constexpr double kLeastShare = 0.01;
  constexpr double kLeast_s = 1.0;
  if (!(share_done >= kLeastShare && share_done < 1.0) || !(spent_s >= kLeast_s)) return {};
  return spent_s * (1.0 - share_done) / share_done;
}

std::string progress_line(const std::string& label, double share, const std::string& time,
                          const std::string& note, std::size_t columns) {
  constexpr std::size_t kWidest = 24;
  constexpr std::size_t kNarrowest = 8;
  const std::string figures = fmt::format(" {:3.0f} % {}  ", 100.0 * share, time);
  const std::size_t around = width_of(label) + width_of(" []") + width_of(figures);
  const std::size_t room = columns - std::min(columns, around + width_of(note));
  const std::size_t width = std::clamp(room, kNarrowest, kWidest);
  const auto filled = static_cast<std::size_t>(share * static_cast<double>(width));
  const std::string bar =
      fmt::format("{} [{:#<{}}{:.<{}}]{}", label, "", filled, "", width - filled, figures);
  if (width_of(bar) > columns) return shortened(bar, columns);
  return bar + shortened(note, columns - width_of(bar));
}

ProgressBar::ProgressBar(const std::string& label, bool quiet)
    : label_(printable(label)),
      style_(quiet || std::getenv("NO_PROGRESS") != nullptr ? Style::silent
             : is_terminal()                                ? Style::bar
                                                            : Style::lines),
      begin_(std::chrono::steady_clock::now()),
      last_drawn_(begin_ - std::chrono::hours(1)),
      last_line_(begin_) {}

ProgressBar::~ProgressBar() {
  if (bar_is_open_) print_to_stderr("\n");
}

void ProgressBar::show(double share_done, const std::string& note) {
  const auto spent = std::chrono::steady_clock::now() - begin_;
  show(share_done, note, seconds_left(std::chrono::duration<double>(spent).count(), share_done));
}

void ProgressBar::show(double share_done, const std::string& note, std::optional<double> left_s) {
  const double share = std::clamp(share_done, 0.0, 1.0);
  const auto now = std::chrono::steady_clock::now();
  const double spent_s = std::chrono::duration<double>(now - begin_).count();
  const std::string left = left_s ? ", " + duration_text(*left_s) + " left" : "";
  if (style_ == Style::lines) {
    const int quarter = static_cast<int>(share * 4.0);
    if (quarter == last_quarter_ && now - last_line_ < std::chrono::minutes(1)) return;
    last_quarter_ = quarter;
    last_line_ = now;
    print_to_stderr(
        fmt::format("{} {:3.0f} % {}{}\n", label_, 100.0 * share, printable(note), left));
  } else if (style_ == Style::bar) {
    if (now - last_drawn_ < std::chrono::milliseconds(50) && share < 1.0) return;
    last_drawn_ = now;
    const std::string time = duration_text(spent_s) + left;
    print_to_stderr("\r\x1b[K" +
                    progress_line(label_, share, time, printable(note), stderr_columns() - 1));
    bar_is_open_ = true;
  }
}

}  // namespace gnbv
