#include "tools/terminal/interrupt.hpp"

#include <csignal>
#include <initializer_list>

namespace gnbv {
namespace {

// a signal handler can reach nothing else
volatile std::sig_atomic_t stop_requests = 0;
volatile std::sig_atomic_t asks_left = 0;

}  // namespace

InterruptGuard::InterruptGuard(int asks) {
  stop_requests = 0;
  asks_left = asks;
  const auto ask_to_stop = [](int) {
    stop_requests = stop_requests + 1;
    asks_left = asks_left - 1;
    if (asks_left > 0) return;
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
  };
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, ask_to_stop);
}

InterruptGuard::~InterruptGuard() {
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
}

int InterruptGuard::requests() { return stop_requests; }

}  // namespace gnbv
