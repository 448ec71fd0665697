#include "tools/gnbv/interrupt.hpp"

#include <csignal>
#include <initializer_list>

namespace gnbv {
namespace {

// a signal handler can reach nothing else
volatile std::sig_atomic_t stop_requested = 0;

}  // namespace

InterruptGuard::InterruptGuard() {
  stop_requested = 0;
  const auto ask_to_stop = [](int signal) {
    stop_requested = 1;
    std::signal(signal, SIG_DFL);
  };
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, ask_to_stop);
}

InterruptGuard::~InterruptGuard() {
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
}

bool InterruptGuard::requested() { return stop_requested != 0; }

}  // namespace gnbv
