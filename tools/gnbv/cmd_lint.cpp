#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>

#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/mesh_lint/mesh_report.hpp"
#include "tools/mission/execute.hpp"

namespace gnbv {
namespace {

struct LintOptions {
  ScenarioOptions scenario;
  bool json = false;
};

void lint(const LintOptions& options) {
  // not resolve_scenario()'s bounds: a mesh that has none is what this is to find out
  ScenarioOptions as_it_lies = options.scenario;
  as_it_lies.bounds_auto = false;
  const MeshReport report =
      report_on_mesh(resolve_scenario(as_it_lies), options.scenario.bounds_auto, thread_count(0));
  fmt::print("{}", options.json ? json_text(report) : terminal_text(report));
  if (!report.is_usable()) {
    throw CommandFailed(fmt::format("{}: not usable as it is", report.path));
  }
}

}  // namespace

void add_lint_command(CLI::App& app) {
  auto options = std::make_shared<LintOptions>();
  options->scenario.scenario = "aircraft";
  CLI::App* const command =
      app.add_subcommand("lint", "say what is wrong with a mesh and how to put it right");
  command->add_option("MESH", options->scenario.mesh, "mesh file")->required();
  command
      ->add_option("--scenario", options->scenario.scenario,
                   "scenario it is meant for: built-in name or YAML file")
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
