// gnbv: the program. Exit codes: 0 done, 1 the thing asked failed, 2 bad usage or bad input.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>

#include "sim/core/error.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/shared_options.hpp"

namespace {

int run(int argc, char** argv) {
  CLI::App app("Next-best-view 3D reconstruction with a UAV: simulate, measure, compare.", "gnbv");
  app.set_version_flag("--version", GNBV_VERSION);
  app.require_subcommand(1);
  gnbv::add_fly_command(app);
  gnbv::add_run_command(app);
  gnbv::add_sweep_command(app);
  gnbv::add_table_command(app);
  gnbv::add_compare_command(app);
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
  gnbv::refuse_what_is_not_finite(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const int exit_code = run(argc, argv);
    if (std::fflush(stdout) == 0) return exit_code;
    fmt::print(stderr, "gnbv: stdout: {}\n", std::strerror(errno));
    return 1;
  } catch (const gnbv::BadInput& error) {
    fmt::print(stderr, "gnbv: {}\n", error.what());
    return 2;
  } catch (const std::filesystem::filesystem_error& error) {
    fmt::print(stderr, "gnbv: {}: {}\n", error.path1().string(), error.code().message());
    return 2;
  } catch (const gnbv::CommandFailed& failed) {
    fmt::print(stderr, "gnbv: {}\n", failed.what());
    return 1;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "gnbv: out of memory\n");
    return 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "gnbv: internal error: {}\n", error.what());
    return 1;
  }
}
