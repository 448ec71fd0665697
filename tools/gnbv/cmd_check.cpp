#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "bench/compare/baseline.hpp"
#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/text.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/run_inputs.hpp"
#include "tools/run/summary_json.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

struct CheckOptions {
  fs::path run;
  fs::path against;
  bool update = false;
  bool json = false;
};

/// "RUN regressed against FILE: recall f", or nothing.
std::string regressed_text(const CheckOptions& options, const BaselineCheck& check) {
  const std::vector<std::string> names = regressed(check);
  return names.empty() ? ""
                       : fmt::format("{} regressed against {}: {}", options.run.string(),
                                     options.against.string(), fmt::join(names, " "));
}

/// What the run was of: not where its files lie, not what they are called, and not the sizes that
/// it was scored at, which are metrics.
BaselineSubject subject_of(const fs::path& run) {
  const auto values_of = [](Scenario scenario) {
    for (const MeshFileKey& mesh : mesh_files(scenario)) mesh.file->path.clear();
    scenario.planner.profiling.file.clear();
    scenario.planner.utility.python.label.clear();
    scenario.planner.utility.python.file.clear();
    scenario.score.sizes_m.clear();
    const ScoreConfig usual;  // budgets judge none of a gate's figures
    scenario.score.budget_views = usual.budget_views;
    scenario.score.budget_m = usual.budget_m;
    scenario.score.budget_s = usual.budget_s;
    const auto values = scenario_values(scenario);
    return BaselineSubject::Values(values.begin(), values.end());
  };
  const Scenario flown = load_flown_scenario((run / kScenarioFile).string());
  BaselineSubject of{.configuration = values_of(flown), .defaults = values_of(usual_beside(flown))};
  for (const RunInput& input : read_inputs(run)) of.files[input.key] = {input.name, input.sha256};
  return of;
}

void update(const CheckOptions& options) {
  const RunFigures run = read_run_figures(options.run);
  const BaselineSubject of = subject_of(options.run);
  Baseline now = make_baseline(run, of);
  if (fs::exists(options.against)) {
    const Baseline before = read_baseline(options.against);
    now = updated_baseline(run, of, before, options.against);
    const BaselineCheck check = check_against(before, options.against, run, of);
    if (const std::string worse = regressed_text(options, check); !worse.empty()) {
      say("{}; the baseline asks for no more than that from now on", worse);
    }
  }
  write_file_atomically(options.against, to_json(now));
  fmt::print("{}\n", options.against.string());
}

void check(const CheckOptions& options) {
  if (!fs::exists(options.against)) {
    throw BadInput(
        "{}: no such baseline; `gnbv check {} --against {} --update` writes one of the run",
        options.against.string(), shell_word(options.run.string()),
        shell_word(options.against.string()));
  }
  const Baseline baseline = read_baseline(options.against);
  const BaselineCheck check = check_against(baseline, options.against,
                                            read_run_figures(options.run), subject_of(options.run));
  fmt::print("{}", options.json ? check_json(check) : terminal_text(check_table(check)));
  const std::string worse = regressed_text(options, check);
  if (!worse.empty()) throw CommandFailed(worse);
}

}  // namespace

void add_check_command(CLI::App& app) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* const command =
      app.add_subcommand("check", "compare a run with a baseline; exit 1 when it is worse");
  command->add_option("RUN", options->run, "run directory")->required();
  command->add_option("--against", options->against, "baseline file (JSON)")->required();
  CLI::Option* const update_flag =
      command->add_flag("--update", options->update,
                        "write the run's figures to the baseline; tolerances there are kept");
  command->add_flag("--json", options->json, "print JSON instead of a table")
      ->excludes(update_flag);
  command->callback([options] { options->update ? update(*options) : check(*options); });
}

}  // namespace gnbv
