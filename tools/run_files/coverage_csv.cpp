#include "tools/run_files/coverage_csv.hpp"

#include <algorithm>
#include <array>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run_files/separated_text.hpp"

namespace gnbv {
namespace {

constexpr std::string_view kHeader =
    "view,metres,seconds,coverage_0.05,coverage_0.10,coverage_0.50";

}  // namespace

std::string coverage_csv(const CoverageCurve& curve) {
  std::string csv = fmt::format("{}\n", kHeader);
  for (std::size_t view = 0; view < curve.coverage.size(); ++view) {
    const auto& [fine, middle, coarse] = curve.coverage[view];
    csv += fmt::format("{},{},{},{},{},{}\n", view, curve.metres[view], curve.seconds[view], fine,
                       middle, coarse);
  }
  return csv;
}

CoverageCurve read_coverage_csv(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  std::string_view rest = text;
  CoverageCurve curve;
  need_header(next_part(rest, '\n'), kHeader, {file, 1});
  for (int line = 2; !rest.empty(); ++line) {
    const TextPlace place{file, line};
    const std::string_view row = next_part(rest, '\n');
    if (std::count(row.begin(), row.end(), ',') != 5) {
      throw BadInput(fmt::format("{}: '{}' is no row of 6 numbers", to_string(place), row));
    }
    std::string_view cells = row;
    std::array<double, 6> values{};
    for (double& value : values) {
      value = to_number(next_part(cells, ','), place, fmt::format("'{}':", row));
    }
    if (values[0] != line - 2) {
      throw BadInput(fmt::format("{}: view {} must be {}", to_string(place), values[0], line - 2));
    }
    curve.metres.push_back(values[1]);
    curve.seconds.push_back(values[2]);
    curve.coverage.push_back({values[3], values[4], values[5]});
  }
  return curve;
}

}  // namespace gnbv
