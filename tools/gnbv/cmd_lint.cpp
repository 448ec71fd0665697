#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "sim/core/text.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/mesh_lint/mesh_report.hpp"
#include "tools/mission/execute.hpp"

namespace gnbv {
namespace {

struct LintOptions {
  ScenarioOptions scenario;  // without its mesh
  std::vector<std::string> meshes;
  bool json = false;
};

MeshReport report_of(const LintOptions& options, const std::string& mesh) {
  // not resolve_scenario()'s bounds: a mesh that has none is what this is to find out
  ScenarioOptions as_it_lies = options.scenario;
  as_it_lies.mesh = mesh;
  as_it_lies.bounds_auto = false;
  return report_on_mesh(resolve_scenario(as_it_lies), options.scenario.bounds_auto,
                        thread_count(0));
}

/// Of several meshes: what of them is usable. One that cannot be looked at stops nothing.
struct Tally {
  std::vector<std::string> unusable;
  std::vector<std::string> faults;  // a mesh that is not there, a value that does not fit

  void throw_if_any() const {
    if (!faults.empty()) throw BadInput("{}", fmt::join(faults, "\ngnbv: "));
    if (unusable.empty()) return;
    throw CommandFailed("{}: not usable as {}", fmt::join(unusable, ", "),
                        unusable.size() == 1 ? "it is" : "they are");
  }
};

std::string sum_of(std::size_t meshes, const Tally& tally) {
  const std::size_t bad = tally.unusable.size() + tally.faults.size();
  return fmt::format("{} meshes: {} usable, {} not usable as {}, {} unreadable\n", meshes,
                     meshes - bad, tally.unusable.size(),
                     tally.unusable.size() == 1 ? "it is" : "they are", tally.faults.size());
}

std::string json_of(const std::vector<std::string>& reports) {
  if (reports.size() == 1) return reports.front();
  nlohmann::ordered_json all = {{"schema", 1}, {"meshes", nlohmann::ordered_json::array()}};
  for (const std::string& report : reports) {
    all["meshes"].push_back(nlohmann::ordered_json::parse(report));
  }
  return all.dump(2) + '\n';
}

void lint(const LintOptions& options) {
  Tally tally;
  std::vector<std::string> reports;
  for (const std::string& mesh : options.meshes) {
    try {
      const MeshReport report = report_of(options, mesh);
      if (!report.is_usable()) tally.unusable.push_back(report.path);
      reports.push_back(options.json ? json_text(report) : terminal_text(report));
    } catch (const BadInput& error) {
      tally.faults.emplace_back(error.what());
    }
  }
  if (options.json && !reports.empty()) fmt::print("{}", json_of(reports));
  if (!options.json) {
    fmt::print("{}", printable(fmt::to_string(fmt::join(reports, "\n"))));
    if (options.meshes.size() > 1) {
      fmt::print("{}{}", reports.empty() ? "" : "\n", sum_of(options.meshes.size(), tally));
    }
  }
  tally.throw_if_any();
}

}  // namespace

void add_lint_command(CLI::App& app) {
  auto options = std::make_shared<LintOptions>();
  options->scenario.scenario = "aircraft";
  CLI::App* const command =
      app.add_subcommand("lint", "say what is wrong with meshes and how to put it right");
  command->add_option("MESH", options->meshes, "mesh files")->required();
  command
      ->add_option("--scenario", options->scenario.scenario,
                   "scenario that the meshes are meant for: built-in name or YAML file")
      ->capture_default_str();
  command
      ->add_option("--set", options->scenario.overrides,
                   "KEY=VALUE of the scenario file, as for `run`; repeatable "
                   "(structure.file.scale, .unit_m, .up_axis, .offset_m)")
      ->allow_extra_args(false);
  add_bounds_option(*command, options->scenario);
  command->add_flag("--json", options->json, "print JSON instead of text");
  command->callback([options] { lint(*options); });
}

}  // namespace gnbv
