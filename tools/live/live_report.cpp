#include "tools/live/live_report.hpp"

#include <chrono>
#include <cstdlib>
#include <optional>
#include <thread>

#include "sim/core/error.hpp"
#include "tools/live/live_server.hpp"
#include "tools/page/report.hpp"
#include "tools/run/run_files.hpp"
#include "tools/terminal/interrupt.hpp"

namespace gnbv {
namespace {

constexpr std::chrono::milliseconds kLook{100};
constexpr int kLooksBetweenPages = 15;

/// What of the run there was when it was read last.
struct Stage {
  std::size_t views = 0;
  bool is_finished = false;

  bool operator==(const Stage&) const = default;
};

/// Nothing while the run has not begun, or is between two states of its files.
std::optional<RunRecord> read_growing(const std::filesystem::path& run) {
  try {
    return read_run(run);
  } catch (const BadInput&) {
    return std::nullopt;
  }
}

}  // namespace

void serve_report(const std::filesystem::path& run, const LiveReportOptions& options,
                  const std::function<void(const std::string& url)>& ready) {
  const InterruptGuard interrupt;
  LiveServer server(options.port);
  ready(server.url());
  std::optional<Stage> shown;
  for (int look = 0; !InterruptGuard::requested(); ++look) {
    if (look % kLooksBetweenPages == 0) {
      const bool was_finished =
          RunFiles(run).is_finished();  // asked first: the record has what it says
      const std::optional<RunRecord> record = read_growing(run);
      if (record && !record->views.empty()) {
        const Stage stage{record->views.size(), was_finished};
        if (shown != stage) {
          Report report =
              make_report({*record}, {.threads = options.threads, .is_live = true}, [](double) {});
          server.show(std::move(report.html), std::move(report.policy), stage.views,
                      record->figures.has_value());
          shown = stage;
        }
      }
    }
    std::this_thread::sleep_for(kLook);
  }
  std::_Exit(0);  // nothing is left to be put in order, and who trickles would hold us up
}

}  // namespace gnbv
