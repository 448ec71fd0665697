#include "tools/run/coverage_csv.hpp"

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run/separated_text.hpp"

namespace gnbv {
namespace {

constexpr std::string_view kHeader =
    "view,metres,seconds,coverage_0.05,coverage_0.10,coverage_0.50";

constexpr std::string_view kColumn = "coverage_";
constexpr std::string_view kEnergy = ",energy_wh,one_battery";  // behind all others
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
    throw BadInput("{}: {} m and {} s after {} m and {} s", to_string(place), row[1], row[2],
                   metres, seconds);
  }
  for (const double share : row.subspan(3)) {
    if (share >= 0.0 && share <= 1.0) continue;
    throw BadInput("{}: coverage {} must be from 0 to 1", to_string(place), share);
  }
}

void add_energy(double energy_wh, double on_one_battery, const TextPlace& place,
                CoverageCurve& curve) {
  const double before_wh = curve.energy_wh.empty() ? 0.0 : curve.energy_wh.back();
  if (!(energy_wh >= before_wh) || (on_one_battery != 0.0 && on_one_battery != 1.0)) {
    throw BadInput("{}: {} Wh after {} Wh, one_battery {}", to_string(place), energy_wh, before_wh,
                   on_one_battery);
  }
  curve.energy_wh.push_back(energy_wh);
  curve.on_one_battery.push_back(on_one_battery == 1.0);
}

}  // namespace

std::string coverage_csv(const CoverageCurve& curve, std::span<const SizedCoverage> more) {
  const bool has_accurate = !curve.accurate.empty();
  std::vector<std::string> more_names;
  for (const SizedCoverage& at : more) more_names.push_back(size_name(at.size_m));
  const bool has_energy = !curve.energy_wh.empty();
  std::string csv = header_of(more_names, has_accurate);
  csv += has_energy ? fmt::format("{}\n", kEnergy) : "\n";
  for (std::size_t view = 0; view < curve.coverage.size(); ++view) {
    const auto& [fine, middle, coarse] = curve.coverage[view];
    csv += fmt::format("{},{},{},{},{},{}", view, curve.metres[view], curve.seconds[view], fine,
                       middle, coarse);
    for (const SizedCoverage& at : more) csv += fmt::format(",{}", at.curve[view]);
    if (has_accurate) {
      for (const double share : curve.accurate[view]) csv += fmt::format(",{}", share);
      for (const SizedCoverage& at : more) csv += fmt::format(",{}", at.accurate_curve[view]);
    }
    if (has_energy) {
      csv += fmt::format(",{},{:d}", curve.energy_wh[view], bool(curve.on_one_battery[view]));
    }
    csv += '\n';
  }
  return csv;
}

CoverageFile read_coverage_csv(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  std::string_view rest = text;
  std::string_view header = next_part(rest, '\n');
  const bool has_energy = header.ends_with(kEnergy);
  if (has_energy) header.remove_suffix(kEnergy.size());
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
    const std::size_t count = names.size() + (has_energy ? 2 : 0);
    if (values.size() != count) {
      throw BadInput("{}: '{}' is no row of {} numbers", to_string(place), row, count);
    }
    if (values[0] != place.line - 2) {
      throw BadInput("{}: view {} must be {}", to_string(place), values[0], place.line - 2);
    }
    need_curve(read.curve, std::span(values).first(names.size()), place);
    if (has_energy) add_energy(values[names.size()], values.back(), place, read.curve);
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
