#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/compare/baseline.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/run/summary_json.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

struct CheckOptions {
  fs::path run;
  fs::path against;
  bool update = false;
  bool json = false;
};

std::string_view name_of(GateVerdict verdict) {
  switch (verdict) {
    case GateVerdict::kept:
      return "kept";
    case GateVerdict::better:
      return "better";
    case GateVerdict::regressed:
      return "regressed";
  }
  GNBV_CHECK(false, "verdict {}", static_cast<int>(verdict));
}

std::string terminal_text(const Baseline& baseline, const BaselineCheck& check) {
  std::string text;
  std::size_t kept = 0;
  for (const MetricChange& change : check.metrics) {
    if (change.verdict == GateVerdict::kept) {
      ++kept;
      continue;
    }
    if (text.empty()) {
      text = fmt::format("{:<10}{:<24}{:>12}{:>12}{:>12}{:>12}\n", "", "metric", "baseline", "now",
                         "change", "allowed");
    }
    const BaselineMetric& metric = change.baseline;
    text += fmt::format("{:<10}{:<24}{:>12.6g}{:>12.6g}{:>+12.4g}{:>12.4g}\n",
                        name_of(change.verdict), metric.name, metric.value, change.now,
                        change.now - metric.value, metric.tolerance);
  }
  if (check.is_termination_wrong) {
    text += fmt::format("regressed termination: {}, the baseline's is {}\n", check.termination,
                        baseline.termination);
  }
  if (check.is_hash_wrong) text += "regressed result_sha256: is another\n";
  return text +
         fmt::format("{} of {} metrics within their tolerance\n", kept, check.metrics.size());
}

std::string json_text(const Baseline& baseline, const BaselineCheck& check, std::size_t regressed) {
  nlohmann::ordered_json metrics = nlohmann::ordered_json::array();
  for (const MetricChange& change : check.metrics) {
    metrics.push_back({{"metric", change.baseline.name},
                       {"baseline", change.baseline.value},
                       {"now", change.now},
                       {"allowed", change.baseline.tolerance},
                       {"verdict", name_of(change.verdict)}});
  }
  const nlohmann::ordered_json json = {{"schema", "gnbv-check-1"},
                                       {"regressed", regressed},
                                       {"termination",
                                        {{"baseline", baseline.termination},
                                         {"now", check.termination},
                                         {"regressed", check.is_termination_wrong}}},
                                       {"result_sha256_differs", check.is_hash_wrong},
                                       {"metrics", metrics}};
  return json.dump(2) + "\n";
}

void update(const CheckOptions& options) {
  const RunFigures run = read_run_figures(options.run);
  const Baseline now = fs::exists(options.against)
                           ? updated_baseline(run, read_baseline(options.against), options.against)
                           : make_baseline(run);
  write_file_atomically(options.against, to_json(now));
  fmt::print("{}\n", options.against.string());
}

void check(const CheckOptions& options) {
  const Baseline baseline = read_baseline(options.against);
  const BaselineCheck check =
      check_against(baseline, options.against, read_run_figures(options.run));
  std::size_t regressed = 0;
  std::string names;
  const auto count = [&](bool is_worse, const std::string& name) {
    if (!is_worse) return;
    ++regressed;
    names += " " + name;
  };
  count(check.is_termination_wrong, "termination");
  count(check.is_hash_wrong, "result_sha256");
  for (const MetricChange& change : check.metrics) {
    count(change.verdict == GateVerdict::regressed, change.baseline.name);
  }
  fmt::print("{}",
             options.json ? json_text(baseline, check, regressed) : terminal_text(baseline, check));
  if (regressed == 0) return;
  throw CommandFailed(fmt::format("{} regressed against {}:{}", options.run.string(),
                                  options.against.string(), names));
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
