// A process of its own that serves a run's page while the mission flies in this one.
#pragma once

#include <filesystem>
#include <string>

#include "sim/core/child_process.hpp"

namespace gnbv {

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
