// gnbv: the program. Exit codes: 0 done, 1 the thing asked failed, 2 bad usage or bad input.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <sstream>
#include <system_error>

#include "bench/score/content_cache.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/portable.hpp"
#include "sim/core/simd.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/help.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/terminal/say.hpp"
#include "tools/terminal/streams.hpp"

namespace {

int run(int argc, char** argv) {
  gnbv::simd_level();         // refuses what GNBV_SIMD may not be
  gnbv::cache_limit_bytes();  // and GNBV_CACHE_LIMIT
  CLI::App app("Next-best-view 3D reconstruction with a UAV: simulate, measure, compare.", "gnbv");
  app.set_version_flag("--version", GNBV_VERSION);
  app.require_subcommand(1);
  gnbv::add_fly_command(app);
  gnbv::add_run_command(app);
  gnbv::add_sweep_command(app);
  gnbv::add_table_command(app);
  gnbv::add_compare_command(app);
  gnbv::add_bench_command(app);
  gnbv::add_ceiling_command(app);
  gnbv::add_render_command(app);
  gnbv::add_export_command(app);
  gnbv::add_plot_command(app);
  gnbv::add_paper_command(app);
  gnbv::add_report_command(app);
  gnbv::add_asset_command(app);
  gnbv::add_lint_command(app);
  gnbv::add_schema_command(app);
  gnbv::add_score_command(app);
  gnbv::add_check_command(app);
  gnbv::add_surface_command(app);
  gnbv::add_cache_command(app);
  gnbv::add_doctor_command(app);
  gnbv::refuse_odd_numbers(app);
  gnbv::refuse_empty_values(app);
  gnbv::lay_out_help(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream answer;
    std::ostringstream complaint;
    const bool is_answer = app.exit(error, answer, complaint) == 0;
    fmt::print("{}", answer.str());
    const std::vector<std::string> words(argv + 1, argv + std::max(argc, 1));
    const std::string meant = is_answer ? "" : gnbv::meant_instead(app, words);
    // that a word is none of the commands is said by the one that it comes near
    const bool is_command = error.get_name() == "RequiredError" && !meant.empty();
    if (!is_answer && !is_command) gnbv::say(std::string_view(complaint.str()));
    if (!meant.empty()) gnbv::say(meant);
    return is_answer ? 0 : 2;
  }
  return 0;
}

/// Says it; the exit code. Of the exceptions that nobody threw on purpose those of the system are
/// the machine's fault.
int say_why(const std::exception& error) {
  if (dynamic_cast<const gnbv::OutputFailed*>(&error) != nullptr) {
    gnbv::say(error.what());
    return 1;
  }
  if (const auto* const file = dynamic_cast<const std::filesystem::filesystem_error*>(&error)) {
    const std::filesystem::path path = file->path1().empty() ? "the current folder" : file->path1();
    try {
      gnbv::refuse_to_write(path, file->code().value());
    } catch (const gnbv::BadInput&) {
      gnbv::say("{}: {}", path.string(), file->code().message());
      return 2;
    } catch (const gnbv::OutputFailed& failed) {
      gnbv::say(failed.what());
      return 1;
    }
  }
  if (const auto* const system = dynamic_cast<const std::system_error*>(&error)) {
    if (std::ferror(stdout) == 0) gnbv::say("the system refuses: {}", system->what());
    return 1;
  }
  gnbv::say("internal error: {}", error.what());
  return 1;
}

/// A library's thread that cannot be started throws where nobody can catch it.
[[noreturn]] void end_uncaught() {
  try {
    if (const std::exception_ptr uncaught = std::current_exception()) {
      std::rethrow_exception(uncaught);
    }
    gnbv::say("internal error: terminated");
  } catch (const std::exception& error) {
    gnbv::say("the system or a library gives up: {}", error.what());
  } catch (...) {
    gnbv::say("internal error: terminated");
  }
  std::_Exit(1);
}

}  // namespace

int main(int argc, char** argv) {
  gnbv::prepare_standard_streams();
  std::set_terminate(end_uncaught);
  int exit_code = 1;
  try {
    exit_code = run(argc, argv);
  } catch (const gnbv::BadInput& error) {
    gnbv::say(error.what());
    exit_code = 2;
  } catch (const gnbv::UnportableMathematics& error) {
    gnbv::restart_with_portable_mathematics(argv);
    gnbv::say(error.what());
    exit_code = 2;
  } catch (const gnbv::CommandFailed& failed) {
    gnbv::say(failed.what());
  } catch (const std::bad_alloc&) {
    gnbv::say("out of memory");
  } catch (const std::exception& error) {
    exit_code = say_why(error);
  }
  return gnbv::flush_stdout() ? exit_code : 1;
}
