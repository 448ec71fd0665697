#include "tools/run/coverage_csv.hpp"

#include <algorithm>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run/separated_text.hpp"

namespace gnbv {
namespace {

constexpr std::string_view kHeader =
    "view,metres,seconds,coverage_0.05,coverage_0.10,coverage_0.50";

constexpr std::string_view kColumn = ",coverage_";

/// The names behind the columns of the paper's sizes.
std::vector<std::string> more_names_of(std::string_view header, const TextPlace& place) {
  std::vector<std::string> names;
  std::string_view rest = header;
  if (!rest.starts_with(kHeader)) need_header(header, kHeader, place);
  rest.remove_prefix(kHeader.size());
  while (!rest.empty()) {
    if (!rest.starts_with(kColumn)) need_header(header, kHeader, place);
    rest.remove_prefix(kColumn.size());
    names.emplace_back(rest.substr(0, rest.find(',')));
    rest.remove_prefix(names.back().size());
  }
  return names;
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
  std::string csv(kHeader);
  for (const SizedCoverage& at : more) csv += fmt::format("{}{}", kColumn, size_name(at.size_m));
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
  CoverageFile read;
  read.more_names = more_names_of(next_part(rest, '\n'), {file, 1});
  read.more_curves.resize(read.more_names.size());
  std::vector<double> values(6 + read.more_names.size());
  for (int line = 2; !rest.empty(); ++line) {
    const TextPlace place{file, line};
    const std::string_view row = next_part(rest, '\n');
    if (static_cast<std::size_t>(std::count(row.begin(), row.end(), ',')) + 1 != values.size()) {
      throw BadInput(
          fmt::format("{}: '{}' is no row of {} numbers", to_string(place), row, values.size()));
    }
    std::string_view cells = row;
    for (double& value : values) {
      value = to_number(next_part(cells, ','), place, fmt::format("'{}':", row));
    }
    if (values[0] != line - 2) {
      throw BadInput(fmt::format("{}: view {} must be {}", to_string(place), values[0], line - 2));
    }
    need_curve(read.curve, values, place);
    read.curve.metres.push_back(values[1]);
    read.curve.seconds.push_back(values[2]);
    read.curve.coverage.push_back({values[3], values[4], values[5]});
    for (std::size_t i = 6; i < values.size(); ++i) read.more_curves[i - 6].push_back(values[i]);
  }
  return read;
}

}  // namespace gnbv
