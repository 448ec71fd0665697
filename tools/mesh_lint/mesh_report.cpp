#include "tools/mesh_lint/mesh_report.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "sim/core/text.hpp"

namespace gnbv {
namespace {

std::string verdict(const MeshReport& report) {
  const auto count = [&](Severity severity) {
    return static_cast<std::size_t>(
        std::count_if(report.findings.begin(), report.findings.end(),
                      [&](const Finding& f) { return f.severity == severity; }));
  };
  return fmt::format("{}: {}, {}, {}", report.is_usable() ? "usable" : "not usable as it is",
                     counted(count(Severity::error), "error", "errors"),
                     counted(count(Severity::warning), "warning", "warnings"),
                     counted(count(Severity::note), "note", "notes"));
}

std::array<double, 3> array_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

/// Of one mesh, whose keys are those below `section`.
void add_warnings(const Scenario& scenario, const MeshFileConfig& file, const std::string& section,
                  int threads, std::vector<std::string>& lines) {
  constexpr std::string_view kAlone = "structure.file.";
  Scenario alone = scenario;
  alone.structure.file = file;
  alone.structure.files.clear();
  const MeshReport report = report_on_mesh(alone, false, threads);
  for (const Finding& finding : report.findings) {
    const bool is_of_mesh = finding.check != "file" && finding.check != "returns";
    if (finding.severity < Severity::warning || !is_of_mesh) continue;
    std::string fix = finding.fix.empty() ? "" : "; fix: " + finding.fix;
    for (std::size_t at = fix.find(kAlone); at != std::string::npos;
         at = fix.find(kAlone, at + section.size())) {
      fix.replace(at, kAlone.size(), section);
    }
    lines.push_back(fmt::format("{}: {}: {}{}", report.path, finding.check, finding.what, fix));
  }
}

}  // namespace

std::string_view name_of(Severity severity) {
  constexpr std::array<std::string_view, 4> kNames = {"ok", "note", "warning", "error"};
  return kNames[static_cast<std::size_t>(severity)];
}

bool MeshReport::is_usable() const {
  return std::none_of(findings.begin(), findings.end(),
                      [](const Finding& f) { return f.severity == Severity::error; });
}

MeshReport report_on_mesh(const Scenario& scenario, bool bounds_auto, int threads) {
  MeshReport report;
  report.path = scenario.structure.file.path;
  try {
    report.reading = read_mesh(scenario.structure.file);
  } catch (const BadInput& error) {
    report.findings.push_back({"file", Severity::error, error.what(), ""});
    return report;
  }
  report.lint = lint_mesh(report.reading.mesh);
  report.outside = view_from_outside(report.reading.mesh, report.lint, threads);
  const bool can_fly = report.lint.sound.count > 0 && report.lint.not_finite_vertices == 0;
  if (can_fly) report.advice = advise(report, scenario, bounds_auto);
  report.findings = findings_of(report, scenario, bounds_auto);
  std::stable_sort(report.findings.begin(), report.findings.end(),
                   [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
  return report;
}

std::string terminal_text(const MeshReport& report) {
  std::string out = fmt::format("{}: {}\n", report.path, verdict(report));
  if (report.lint.sound.count > 0) {
    out += fmt::format("{} with an area, {:.4g} m2; {}\n",
                       counted(report.lint.sound.count, "face", "faces"), report.lint.sound.area_m2,
                       counted(report.reading.mesh.vertices_m.size(), "vertex", "vertices"));
  }
  out += '\n';
  for (const Finding& finding : report.findings) {
    out += fmt::format("{:<9}{:<13}{}\n", name_of(finding.severity), finding.check, finding.what);
    if (!finding.fix.empty()) out += fmt::format("{:<22}fix: {}\n", "", finding.fix);
  }
  std::string flags;
  for (const std::string& set : report.advice.sets()) flags += " --set " + shell_word(set);
  if (report.advice.needs_bounds) flags += " --bounds auto";
  if (!flags.empty()) out += fmt::format("\nall of it:{}\n", flags);
  return out;
}

std::string json_text(const MeshReport& report) {
  nlohmann::ordered_json out = {
      {"schema", 1}, {"path", report.path}, {"usable", report.is_usable()}};
  if (report.lint.sound.count > 0) {
    const Box3& box = report.lint.box_m;
    out["unit_m"] = report.reading.unit_m;
    out["up_axis"] = std::string(1, report.reading.up_axis);
    out["vertices"] = report.reading.mesh.vertices_m.size();
    out["faces"] = report.lint.sound.count;
    out["area_m2"] = report.lint.sound.area_m2;
    out["bounds_m"] = {{"min", array_of(box.min())}, {"max", array_of(box.max())}};
    out["two_sided_share"] = report.lint.two_sided.area_m2 / report.lint.sound.area_m2;
    out["hidden_share"] = report.outside.hidden_area_m2 / report.outside.area_m2;
  }
  out["findings"] = nlohmann::ordered_json::array();
  for (const Finding& finding : report.findings) {
    out["findings"].push_back({{"check", finding.check},
                               {"severity", name_of(finding.severity)},
                               {"what", finding.what},
                               {"fix", finding.fix}});
  }
  out["advice"] = {{"set", report.advice.sets()},
                   {"bounds", report.advice.needs_bounds ? "auto" : "scenario"}};
  return out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

std::vector<std::string> mesh_warnings(const Scenario& scenario, int threads) {
  const StructureConfig& structure = scenario.structure;
  std::vector<std::string> lines;
  if (!structure.file.path.empty()) {
    add_warnings(scenario, structure.file, "structure.file.", threads, lines);
  }
  for (std::size_t i = 0; i < structure.files.size(); ++i) {
    add_warnings(scenario, structure.files[i], fmt::format("structure.files.{}.", i), threads,
                 lines);
  }
  return lines;
}

}  // namespace gnbv
