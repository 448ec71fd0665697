#include "tools/live/live_child.hpp"

#include <fmt/format.h>

#include <csignal>
#include <system_error>

#include "sim/core/error.hpp"

namespace gnbv {

LiveChild::LiveChild(const std::filesystem::path& run, int port)
    : child_({"gnbv", "report", run.string(), "--live", std::to_string(port), "--threads", "1",
              "--quiet"},
             {.out = ChildStream::pipe,
              .err = ChildStream::nothing,
              .program = "/proc/self/exe",
              .is_apart = true,
              .niceness = 19}) {
  url_ = child_.read_line();
  if (child_.start_error() != 0) {
    throw std::system_error(child_.start_error(), std::generic_category(),
                            fmt::format("--live {}", port));
  }
  if (url_.empty()) {
    throw BadInput(fmt::format(
        "--live {}: this port of 127.0.0.1 cannot be had: it is taken, or yours begin at 1024; 0 "
        "takes a free one",
        port));
  }
}

LiveChild::~LiveChild() { child_.send(SIGKILL); }

}  // namespace gnbv
