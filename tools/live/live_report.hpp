// The report of a run directory while it grows.
#pragma once

#include <filesystem>
#include <functional>

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

}  // namespace gnbv
