#include "tools/terminal/interrupt.hpp"

#include <csignal>
#include <tuple>

namespace gnbv {
namespace {

constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};

// a signal handler can reach nothing else
volatile std::sig_atomic_t stop_requests = 0;
volatile std::sig_atomic_t asks_left = 0;

}  // namespace

InterruptGuard::InterruptGuard(int asks) {
  static_assert(kSignals.size() == std::tuple_size_v<decltype(before_)>);
  stop_requests = 0;
  asks_left = asks;
  const auto ask_to_stop = [](int) {
    stop_requests = stop_requests + 1;
    asks_left = asks_left - 1;
    if (asks_left > 0) return;
    for (const int signal : kSignals) std::signal(signal, SIG_DFL);
  };
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    struct sigaction before {};
    sigaction(kSignals[i], nullptr, &before);
    before_[i] = before.sa_handler;
    // who started the process wants it to live on: nohup, or a script with '&'
    if (before_[i] != SIG_IGN) std::signal(kSignals[i], ask_to_stop);
  }
}

InterruptGuard::~InterruptGuard() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) std::signal(kSignals[i], before_[i]);
}

int InterruptGuard::requests() { return stop_requests; }

}  // namespace gnbv
