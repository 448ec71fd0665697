#include "tools/mesh_lint/mesh_warnings.hpp"

#include <fmt/format.h>

#include "tools/mesh_lint/mesh_report.hpp"

namespace gnbv {
namespace {

/// Of one mesh, whose keys are those below `section`.
void add_warnings(const Scenario& scenario, const MeshFileConfig& file, const std::string& section,
                  int threads, std::vector<std::string>& lines) {
  constexpr std::string_view kAlone = "structure.file.";
  Scenario alone = scenario;
  alone.structure.file = file;
  alone.structure.files.clear();
  const MeshReport report = report_on_mesh(alone, false, threads);
  for (const Finding& finding : report.findings) {
    if (finding.severity < Severity::warning || finding.check == "file") continue;
    std::string fix = finding.fix.empty() ? "" : "; fix: " + finding.fix;
    for (std::size_t at = fix.find(kAlone); at != std::string::npos;
         at = fix.find(kAlone, at + section.size())) {
      fix.replace(at, kAlone.size(), section);
    }
    lines.push_back(fmt::format("{}: {}: {}{}", report.path, finding.check, finding.what, fix));
  }
}

}  // namespace

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
