#include "tools/plots/traces.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/core/error.hpp"
#include "tools/plots/script_parts.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kSteps = 240;  // some 4 pixels of a column of a paper each

}  // namespace

Traces::Traces(std::vector<std::vector<double>> rows) : rows_(std::move(rows)) {
  GNBV_CHECK(!rows_.empty(), "no samples");
  const double begin_s = rows_.front()[0];
  step_s_ = (rows_.back()[0] - begin_s) / static_cast<double>(kSteps);
  if (rows_.size() <= 2 * kSteps || !(step_s_ > 0.0)) return;
  const std::size_t values = rows_.front().size() - 1;
  std::size_t count = 0;  // of the samples in the last band
  for (const auto& row : rows_) {
    const auto step = std::min(kSteps - 1, static_cast<std::size_t>((row[0] - begin_s) / step_s_));
    const double middle_s = begin_s + (static_cast<double>(step) + 0.5) * step_s_;
    if (bands_.empty() || bands_.back()[0] != middle_s) {
      bands_.push_back({middle_s});
      for (std::size_t v = 1; v <= values; ++v) {
        bands_.back().insert(bands_.back().end(), {row[v], 0.0, row[v]});
      }
      count = 0;
    }
    count += 1;
    for (std::size_t v = 1; v <= values; ++v) {
      double* const band = &bands_.back()[3 * v - 2];
      band[0] = std::min(band[0], row[v]);
      band[1] += (row[v] - band[1]) / static_cast<double>(count);
      band[2] = std::max(band[2], row[v]);
    }
  }
}

std::string Traces::data() const {
  return data_block("samples", rows_) + (bands_.empty() ? "" : data_block("bands", bands_));
}

std::string Traces::drawn(std::size_t first, std::size_t last) const {
  std::string bands;
  std::string lines;
  for (std::size_t v = first; v <= last; ++v) {
    const std::string_view colour = kPalette[v - first];
    const std::size_t low = 3 * v - 1;  // gnuplot counts columns from 1
    if (bands_.empty()) {
      lines += fmt::format(", $samples using 1:{} with lines lw 1.0 lc rgb '{}'", v + 1, colour);
      continue;
    }
    bands += fmt::format(
        ", $bands using 1:{}:{} with filledcurves fc rgb '{}' fs transparent solid 0.25 noborder",
        low, low + 2, colour);
    lines += fmt::format(", $bands using 1:{} with lines lw 1.0 lc rgb '{}'", low + 1, colour);
  }
  return (bands + lines).substr(2);
}

std::pair<double, double> Traces::range(std::size_t first, std::size_t last) const {
  std::pair<double, double> range{rows_.front()[first], rows_.front()[first]};
  for (const auto& row : rows_) {
    for (std::size_t v = first; v <= last; ++v) {
      range = {std::min(range.first, row[v]), std::max(range.second, row[v])};
    }
  }
  return range;
}

std::string Traces::time_label() const {
  const std::string label = "mission time (s)";
  return bands_.empty() ? label : label + fmt::format("; bands: extremes in {:.2g} s", step_s_);
}

}  // namespace gnbv
