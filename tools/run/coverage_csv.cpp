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

std::string header_of(const std::vector<std::string>& more_names, bool has_accurate) {
  std::string header(kHeader);
  for (const std::string& name : more_names) header += fmt::format(",{}{}", kColumn, name);
  if (!has_accurate) return header;
  for (const double size_m : kCoverageSizes_m) header += ",accurate_" + size_name(size_m);
  for (const std::string& name : more_names) header += ",accurate_" + name;
  return header;
}

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
  const bool has_accurate = !curve.accurate.empty();
  std::vector<std::string> more_names;
  for (const SizedCoverage& at : more) more_names.push_back(size_name(at.size_m));
  std::string csv = header_of(more_names, has_accurate) + '\n';
  for (std::size_t view = 0; view < curve.coverage.size(); ++view) {
    const auto& [fine, middle, coarse] = curve.coverage[view];
    csv += fmt::format("{},{},{},{},{},{}", view, curve.metres[view], curve.seconds[view], fine,
                       middle, coarse);
    for (const SizedCoverage& at : more) csv += fmt::format(",{}", at.curve[view]);
    if (has_accurate) {
      for (const double share : curve.accurate[view]) csv += fmt::format(",{}", share);
      for (const SizedCoverage& at : more) csv += fmt::format(",{}", at.accurate_curve[view]);
    }
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
  for (std::size_t i = kColumns; i < names.size() && names[i].starts_with(kColumn); ++i) {
    read.more_names.emplace_back(names[i].substr(kColumn.size()));
  }
  const std::size_t more = read.more_names.size();
  const bool has_accurate = header == header_of(read.more_names, true);
  if (!has_accurate && header != header_of(read.more_names, false)) {
    need_header(header, kHeader, {file, 1});
  }
  read.more_curves.resize(more);
  read.more_accurate.resize(more);
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
    for (std::size_t i = 0; i < more; ++i) {
      read.more_curves[i].push_back(values[kColumns + i]);
      if (has_accurate) read.more_accurate[i].push_back(values[kColumns + more + 3 + i]);
    }
    const std::size_t at = kColumns + more;
    if (has_accurate) read.curve.accurate.push_back({values[at], values[at + 1], values[at + 2]});
  };
  for_each_line(rest, file, take, 2);
  return read;
}

}  // namespace gnbv
