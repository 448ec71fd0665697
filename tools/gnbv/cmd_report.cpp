#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/live/live_report.hpp"
#include "tools/mission/execute.hpp"
#include "tools/page/page_text.hpp"
#include "tools/page/report.hpp"
#include "tools/terminal/progress.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

struct ReportCommandOptions {
  std::vector<fs::path> runs;
  fs::path out;
  ReportOptions report;
  std::optional<int> live_port = {};
  bool quiet = false;
};

fs::path page_path(const ReportCommandOptions& options) {
  if (!options.out.empty()) return options.out;
  return options.runs.size() == 1 ? options.runs[0] / "report.html" : fs::path("report.html");
}

/// Before the work, which takes a while.
void check_can_be_written(const fs::path& page) {
  const fs::path folder = page.has_parent_path() ? page.parent_path() : fs::path(".");
  if (!fs::is_directory(folder)) {
    throw BadInput("{}: cannot write: {} is no directory; `mkdir -p` makes it", page.string(),
                   folder.string());
  }
  if (access(folder.c_str(), W_OK) != 0) {
    throw BadInput("{}: cannot write: {}: {}", page.string(), folder.string(),
                   std::strerror(errno));
  }
  if (fs::is_directory(page)) {
    throw BadInput("{}: is a directory; --out names the page itself", page.string());
  }
  if (extension_of(page) != ".html" && extension_of(page) != ".htm") {
    throw BadInput("{}: a page's name ends in .html", page.string());
  }
}

void check_page_is_built_in() {
  if (why_no_page().empty()) return;
  throw CommandFailed(
      "report: this gnbv was built without its page: {}; build it again where npm and its registry "
      "can be reached, or use a gnbv of another machine: the run directory is all that it needs",
      why_no_page());
}

void serve(const ReportCommandOptions& options) {
  if (options.runs.size() != 1) throw BadInput("--live: shows one run");
  if (!options.out.empty()) throw BadInput("--live: serves the page, --out writes it: not both");
  serve_report(options.runs[0], {.port = *options.live_port, .threads = options.report.threads},
               [](const std::string& url) {
                 fmt::print("{}\n", url);
                 std::fflush(stdout);
               });
}

void report(ReportCommandOptions options) {
  check_page_is_built_in();
  if (options.runs.size() > kMaxReportRuns) {
    throw BadInput(
        "report: {} runs, and a page has room for {}; `gnbv compare --from` compares more",
        options.runs.size(), kMaxReportRuns);
  }
  options.report.threads = thread_count(options.report.threads);
  if (options.live_port) return serve(options);
  const fs::path page = page_path(options);
  std::vector<RunRecord> records;
  for (const fs::path& run : options.runs) {
    records.push_back(read_run(run));
    for (const std::string& missing : records.back().missing) {
      say(missing);
    }
  }
  check_can_be_written(page);
  Report made;
  {
    ProgressBar bar("report", options.quiet);
    made = make_report(std::move(records), options.report,
                       [&](double share) { bar.show(share, "reading runs and frames"); });
  }
  for (const std::string& missing : made.missing) say(missing);
  write_file_atomically(page, made.html);
  fmt::print("{}\n", page.string());
}

}  // namespace

void add_report_command(CLI::App& app) {
  auto options = std::make_shared<ReportCommandOptions>();
  options->report.threads = 0;
  CLI::App* const command = app.add_subcommand(
      "report", "one offline page of runs: figures beside the paper's, plots, the mission in 3D");
  command->add_option("RUN", options->runs, "run directories, to compare if several")->required();
  command->add_option(
      "-o,--out", options->out,
      "HTML to write (default: RUN/report.html; for several runs, report.html here)");
  command->add_option("--title", options->report.title,
                      "title of the page, instead of the runs' own");
  command
      ->add_option("--live", options->live_port,
                   "PORT: write no page, but serve it to browsers of this machine until Ctrl-C; it "
                   "grows with the run. 0: any free port")
      ->check(CLI::Range(0, 65535));
  add_threads_option(*command, options->report.threads, "the page does");
  add_quiet_option(*command, options->quiet, "progress");
  command->callback([options] { report(*options); });
}

}  // namespace gnbv
