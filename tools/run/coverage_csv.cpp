#include "tools/run/coverage_csv.hpp"

#include <algorithm>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run/separated_text.hpp"

namespace gnbv {
namespace {

constexpr std::string_view kHeader =
    "view,metres,seconds,coverage_0.05,coverage_0.10,coverage_0.50";

constexpr std::string_view kColumn = "coverage_";
constexpr std::size_t kColumns = 6;  // of the header above; others follow it

/// A row goes on from those before it, with shares from 0 to 1.
void need_curve(const CoverageCurve& before, std::span<const double> row, const TextPlace& place) {
  const double metres = before.metres.empty() ? 0.0 : before.metres.back();
  const double seconds = before.seconds.empty() ? 0.0 : before.seconds.back();
  if (!(row[1] >= metres && row[2] >= seconds)) {
    throw BadInput(fmt::format("{}: {} m and {} s after {} m and {} s", to_string(place), row[1],
                               row[2], metres, seconds));
  }
  for (const double share : row.subspan(3)) {
    if (share >= 0.0 && share <= 1.0) continue;
    throw BadInput(fmt::format("{}: coverage {} must be from 0 to 1", to_string(place), share));
  }
}

}  // namespace

std::string coverage_csv(const CoverageCurve& curve, std::span<const SizedCoverage> more) {
  std::string csv(kHeader);
  for (const SizedCoverage& at : more) csv += fmt::format(",{}{}", kColumn, size_name(at.size_m));
  csv += '\n';
  for (std::size_t view = 0; view < curve.coverage.size(); ++view) {
    const auto& [fine, middle, coarse] = curve.coverage[view];
    csv += fmt::format("{},{},{},{},{},{}", view, curve.metres[view], curve.seconds[view], fine,
                       middle, coarse);
    for (const SizedCoverage& at : more) csv += fmt::format(",{}", at.curve[view]);
    csv += '\n';
  }
  return csv;
}

CoverageFile read_coverage_csv(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  std::string_view rest = text;
  const std::string_view header = next_part(rest, '\n');
  const std::vector<std::string_view> names = split(header, ',');
  CoverageFile read;
  bool is_header = header.starts_with(kHeader);
  for (std::size_t i = kColumns; i < names.size(); ++i) {
    is_header = is_header && names[i].starts_with(kColumn);
    read.more_names.emplace_back(names[i].substr(std::min(kColumn.size(), names[i].size())));
  }
  if (!is_header) need_header(header, kHeader, {file, 1});
  read.more_curves.resize(read.more_names.size());
  const auto take = [&](std::string_view row, const TextPlace& place) {
    std::vector<double> values;
    for (const std::string_view cell : split(row, ',')) {
      values.push_back(to_number(cell, place, fmt::format("'{}':", row)));
    }
    if (values.size() != names.size()) {
      throw BadInput(
          fmt::format("{}: '{}' is no row of {} numbers", to_string(place), row, names.size()));
    }
    if (values[0] != place.line - 2) {
      throw BadInput(
          fmt::format("{}: view {} must be {}", to_string(place), values[0], place.line - 2));
    }
    need_curve(read.curve, values, place);
    read.curve.metres.push_back(values[1]);
    read.curve.seconds.push_back(values[2]);
    read.curve.coverage.push_back({values[3], values[4], values[5]});
    for (std::size_t i = kColumns; i < values.size(); ++i) {
      read.more_curves[i - kColumns].push_back(values[i]);
    }
  };
  for_each_line(rest, file, take, 2);
  return read;
}

}  // namespace gnbv
