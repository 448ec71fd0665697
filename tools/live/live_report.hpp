// The report of a run directory while it grows.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "sim/core/child_process.hpp"

namespace gnbv {

struct LiveReportOptions {
  int port = 0;  // 0: any free one
  int threads = 1;
};

/// Serves the page of the run, anew whenever it has more views, until it is asked to stop by a
/// signal. The run need not have begun: the page appears when it has. Calls `ready` with the
/// address once browsers are heard. Reads the directory alone: whoever flies is not touched. Throws
/// BadInput when the port cannot be had.
void serve_report(const std::filesystem::path& run, const LiveReportOptions& options,
                  const std::function<void(const std::string& url)>& ready);

/// While it lives, `gnbv report RUN --live PORT` runs beside us, at the lowest priority: it shares
/// nothing with the mission but the run directory, which it reads, so that no browser can change or
/// slow the mission. It dies with us, however we die.
class LiveChild {
 public:
  /// Returns when browsers are heard. Throws BadInput when the port cannot be had,
  /// std::system_error when the system gives no process.
  LiveChild(const std::filesystem::path& run, int port);
  ~LiveChild();

  const std::string& url() const { return url_; }

 private:
  ChildProcess child_;
  std::string url_;
};

}  // namespace gnbv
