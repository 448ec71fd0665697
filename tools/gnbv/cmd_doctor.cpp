#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>

#include "bench/compare/text_table.hpp"
#include "planner/symmetry/symmetry.hpp"
#include "sim/core/child_process.hpp"
#include "sim/core/error.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/page/page_text.hpp"
#include "tools/render/caption.hpp"
#include "tools/render/renderer.hpp"
#include "tools/surface/poisson_module.hpp"

namespace gnbv {
namespace {

/// What a command opens or starts by name when it needs it.
struct Need {
  std::string commands;
  std::string what;
  std::function<bool()> is_here;  // false, or BadInput with the reason, where it is not
  std::string remedy;
};

bool succeeds(const std::vector<std::string>& command) {
  return ChildProcess(command, {.out = ChildStream::nothing, .err = ChildStream::nothing})
      .end()
      .is_success();
}

/// Of the Python that runs, or Debian's, which ask_python() asks next and a user's function does
/// not.
Need python_need(const std::string& commands, const std::string& modules, const std::string& apt,
                 const std::string& pip, bool asks_debians = true) {
  const std::string python = python_program();
  const auto is_here = [=] {
    const std::string script = "import " + modules;
    return succeeds({python, "-c", script}) ||
           (asks_debians && python == "python3" && succeeds({"/usr/bin/python3", "-c", script}));
  };
  const std::string debian = apt.empty() ? "" : fmt::format("apt install {}, or ", apt);
  return {commands, "Python: " + modules, is_here,
          fmt::format("{}{} -m pip install {}", debian, python, pip)};
}

std::vector<Need> needs() {
  const std::string again = "install gnbv again: its files belong together";
  const auto program = [](const std::string& commands, const std::string& name,
                          const std::string& option, const std::string& apt) -> Need {
    return {commands, name, [=] { return succeeds({name, option}); }, "apt install " + apt};
  };
  return {
      {"run and all that flies", "symmetry module", [] { return &symmetry_module() != nullptr; },
       again},
      {"surface", "Poisson module", [] { return &poisson_module() != nullptr; }, again},
      {"report, run --live", "the page", [] { return why_no_page().empty(); },
       "build gnbv where npm and its registry can be reached"},
      {"render, surface, paper", "Mesa", [] { return Renderer(), true; },
       "apt install libosmesa6, or where it is no more libegl1 libegl-mesa0"},
      {"render, surface, paper", "a font", [] { return text_width_px("a", 1.0) > 0.0; },
       "apt install fonts-dejavu-core"},
      python_need("utilities and planners in Python", "numpy", "python3-numpy", "numpy", false),
      python_need("plot", "matplotlib", "python3-matplotlib", "matplotlib"),
      python_need("paper", "matplotlib, jinja2", "python3-matplotlib python3-jinja2",
                  "matplotlib jinja2"),
      program("render --what movie, .mp4", "ffmpeg", "-version", "ffmpeg"),
      python_need("render --what movie, .apng, .gif, .webp", "PIL", "python3-pil", "pillow"),
      python_need("export --format rerun", "numpy, rerun", "", "numpy 'rerun-sdk>=0.28'"),
      python_need("export --format mcap",
                  "numpy, mcap, mcap_protobuf, foxglove_schemas_protobuf, PIL", "",
                  "numpy mcap mcap-protobuf-support foxglove-schemas-protobuf pillow"),
      program("sweep --slurm", "sbatch", "--version", "slurm-client"),
  };
}

bool is_here(const Need& need, std::string& reason) {
  try {
    return need.is_here();
  } catch (const BadInput& error) {
    reason = error.what();
    return false;
  }
}

void doctor(bool json) {
  TextTable table{.columns = {{"Commands", "commands", ColumnKind::text},
                              {"Need", "need", ColumnKind::text},
                              {"Is here", "is_here", ColumnKind::text},
                              {"How to get it", "remedy", ColumnKind::text}}};
  for (const Need& need : needs()) {
    std::string reason;
    const bool here = is_here(need, reason);
    table.rows.push_back({TableCell{need.commands}, TableCell{need.what},
                          TableCell{here ? "yes" : "no"}, TableCell{here ? "-" : need.remedy}});
    if (!reason.empty()) table.notes.push_back(fmt::format("{}: {}", need.what, reason));
  }
  fmt::print("{}", json ? json_text(table) : terminal_text(table));
}

}  // namespace

void add_doctor_command(CLI::App& app) {
  auto json = std::make_shared<bool>(false);
  CLI::App* const command =
      app.add_subcommand("doctor", "say what this machine lacks, for which command");
  command->add_flag("--json", *json, "print JSON instead of a table");
  command->callback([json] { doctor(*json); });
}

}  // namespace gnbv
