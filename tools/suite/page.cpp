#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/suite/standings.hpp"
#include "sim/core/embed.hpp"
#include "sim/core/file.hpp"
#include "sim/core/sha256.hpp"
#include "tools/mission/execute.hpp"
#include "tools/page/page_text.hpp"
#include "tools/page/report.hpp"
#include "tools/suite/suite_work.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

GNBV_EMBED(suite_page_html, GNBV_SUITE_PAGE);

/// What a file may be called, of a name that a stranger chose: another one for every name.
std::string folder_name(const Submission& entry) {
  return entry.track + "-" + sha256_of(entry.name).substr(0, 16);
}

std::string mission_page(const Submission& entry, const std::string& task) {
  return fmt::format("missions/{}/{}.html", folder_name(entry), task);
}

void write_mission_pages(const Submission& entry, const std::vector<fs::path>& runs,
                         const fs::path& folder, const SuiteFlights& flights) {
  if (!why_no_page().empty()) return;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::string& task = entry.missions[i].figures.task;
    const fs::path page = folder / mission_page(entry, task);
    make_folder(page.parent_path());
    const ReportOptions options{.threads = thread_count(flights.threads),
                                .title = fmt::format("{}, {}", entry.name, task)};
    write_file_atomically(page, make_report({read_run(runs[i])}, options, [](double) {}).html);
  }
}

}  // namespace

void write_suite_page(const Suite& suite, const std::vector<Submission>& entries,
                      const fs::path& folder, const SuiteFlights& flights) {
  standings_tables(suite, entries);  // refuses before anything is flown
  make_folder(folder);
  if (const auto why = why_no_page(); !why.empty()) {
    say("no page of a mission: {}", why);
  }
  for (const Submission& entry : entries) {
    std::vector<fs::path> runs;
    const ScratchFolder scratch;  // nobody else's missions count as flown
    const auto differences = verify_submission(entry, suite, scratch.path(), flights, &runs);
    if (!differences.empty()) {
      throw CommandFailed("{}: is not what it says:\n{}", entry.file.string(),
                          fmt::join(differences, "\n"));
    }
    write_mission_pages(entry, runs, folder, flights);
  }
  const std::string json =
      standings_json(suite, entries, [](const Submission& entry, const auto& task) {
        return why_no_page().empty() ? mission_page(entry, task) : "";
      });
  write_file_atomically(folder / "standings.json", json + "\n");
  std::string html(suite_page_html());
  constexpr std::string_view kPlace = "@STANDINGS@";
  html.replace(html.find(kPlace), kPlace.size(), script_json(json));
  write_file_atomically(folder / "index.html", html);
}

}  // namespace gnbv
