#include "tools/plots/traces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/compare/statistics.hpp"
#include "sim/core/error.hpp"
#include "tools/plots/script_parts.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kSteps = 240;  // some 4 pixels of a column of a paper each

/// In a row of bands, from 0: of the low end of a value's band.
std::size_t low_column(std::size_t value) { return 4 * value - 3; }

}  // namespace

std::vector<double> Traces::band_row(std::size_t begin, std::size_t end, double middle_s) const {
  std::vector<double> row = {middle_s};
  for (std::size_t v = 1; v < rows_.front().size(); ++v) {
    std::vector<double> values;
    for (std::size_t i = begin; i < end; ++i) values.push_back(rows_[i][v]);
    const double mean = mean_of(values);
    std::sort(values.begin(), values.end());
    const double last = static_cast<double>(values.size() - 1);
    const auto at = [&](double share) {
      return values[static_cast<std::size_t>(std::lround(share * last))];
    };
    row.insert(row.end(), {at(0.5 - 0.5 * share_), mean, at(0.5 + 0.5 * share_), values.back()});
  }
  return row;
}

Traces::Traces(std::vector<std::vector<double>> rows, double share)
    : rows_(std::move(rows)), share_(share) {
  GNBV_CHECK(!rows_.empty() && share > 0.0 && share <= 1.0, "{} samples, {} of them", rows_.size(),
             share);
  const double begin_s = rows_.front()[0];
  step_s_ = (rows_.back()[0] - begin_s) / static_cast<double>(kSteps);
  if (rows_.size() <= 2 * kSteps || !(step_s_ > 0.0)) return;
  const auto step_of = [&](std::size_t i) {
    return std::min(kSteps - 1, static_cast<std::size_t>((rows_[i][0] - begin_s) / step_s_));
  };
  for (std::size_t begin = 0, end = 0; begin < rows_.size(); begin = end) {
    while (end < rows_.size() && step_of(end) == step_of(begin)) ++end;
    const double middle = static_cast<double>(step_of(begin)) + 0.5;
    bands_.push_back(band_row(begin, end, begin_s + middle * step_s_));
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
    const std::size_t low = low_column(v) + 1;  // gnuplot counts columns from 1
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

std::string Traces::drawn_most(std::size_t value) const {
  if (bands_.empty()) return "";
  return fmt::format("$bands using 1:{} with lines lw 0.5 lc rgb '{}', ", low_column(value) + 4,
                     kPalette[0]);
}

std::pair<double, double> Traces::range(std::size_t first, std::size_t last) const {
  std::pair<double, double> range{std::numeric_limits<double>::infinity(),
                                  -std::numeric_limits<double>::infinity()};
  for (std::size_t v = first; v <= last; ++v) {
    for (const auto& band : bands_) {
      range = {std::min(range.first, band[low_column(v)]),
               std::max(range.second, band[low_column(v) + 2])};
    }
    for (std::size_t i = 0; bands_.empty() && i < rows_.size(); ++i) {
      range = {std::min(range.first, rows_[i][v]), std::max(range.second, rows_[i][v])};
    }
  }
  return range;
}

std::vector<KeyEntry> Traces::key() const {
  if (bands_.empty()) return {};
  const int beyond = static_cast<int>(std::lround(50.0 * (1.0 - share_)));
  return {
      {.colour = kPalette[0], .text = fmt::format("mean of each {:.2g} s", step_s_), .line = 1.0},
      {.colour = kPalette[0],
       .text = beyond == 0 ? "least to most" : fmt::format("{} to {} %", beyond, 100 - beyond),
       .has_band = true}};
}

}  // namespace gnbv
