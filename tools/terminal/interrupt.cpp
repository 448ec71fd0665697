#include "tools/terminal/interrupt.hpp"

#include <array>
#include <csignal>
#include <mutex>

namespace gnbv {
namespace {

constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};

// a signal handler can reach nothing else
volatile std::sig_atomic_t stop_requests = 0;
volatile std::sig_atomic_t asks_left = 0;

// signals are the process's, and so are these
std::mutex guards_mutex;
int living_guards = 0;
std::array<struct sigaction, kSignals.size()> before{};

void ask_to_stop(int) {
  stop_requests = stop_requests + 1;
  asks_left = asks_left - 1;
  if (asks_left > 0) return;
  for (const int signal : kSignals) std::signal(signal, SIG_DFL);
}

}  // namespace

InterruptGuard::InterruptGuard(int asks) {
  const std::lock_guard lock(guards_mutex);
  if (living_guards++ > 0) return;
  stop_requests = 0;
  asks_left = asks;
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &before[i]);
    // who started the process wants it to live on: nohup, or a script with '&'
    if (before[i].sa_handler != SIG_IGN) std::signal(kSignals[i], ask_to_stop);
  }
}

InterruptGuard::~InterruptGuard() {
  const std::lock_guard lock(guards_mutex);
  if (--living_guards > 0) return;
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before[i], nullptr);
}

int InterruptGuard::requests() { return stop_requests; }

}  // namespace gnbv
