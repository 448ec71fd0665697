#include "tools/terminal/interrupt.hpp"

#include <unistd.h>

#include <array>
#include <csignal>
#include <mutex>

namespace gnbv {
namespace {

constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};

// a signal handler can reach nothing else
volatile std::sig_atomic_t stop_requests = 0;
volatile std::sig_atomic_t asks_left = 0;
volatile std::sig_atomic_t is_guest = 0;
volatile std::sig_atomic_t asked_process = 0;

// signals are the process's, and so are these
std::mutex guards_mutex;
int living_guards = 0;
std::array<struct sigaction, kSignals.size()> before{};

void give_back_signals() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before[i], nullptr);
}

void ask_to_stop(int signal) {
  if (::getpid() != asked_process) {  // a fork of ours, which nobody asks whether to stop
    give_back_signals();
    std::raise(signal);
    return;
  }
  stop_requests = stop_requests + 1;
  asks_left = asks_left - 1;
  if (asks_left > 0) return;
  give_back_signals();
  if (is_guest != 0) std::raise(signal);
}

}  // namespace

InterruptGuard::InterruptGuard(int asks) {
  const std::lock_guard lock(guards_mutex);
  if (living_guards > 0 && ::getpid() != asked_process) {  // those of whom this is a fork
    give_back_signals();
    living_guards = 0;
    stop_requests = 0;
  }
  if (living_guards++ > 0) return;
  asked_process = ::getpid();
  is_guest = asks == kGuest ? 1 : 0;
  asks_left = is_guest != 0 ? 2 : asks;
  struct sigaction ours {};
  ours.sa_handler = ask_to_stop;
  ours.sa_flags =
      is_guest != 0 ? 0 : SA_RESTART;  // the host's own calls hear of it, as with Python
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], nullptr, &before[i]);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    // who started the process wants it to live on: nohup, or a script with '&'
    if (before[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &ours, nullptr);
  }
}

InterruptGuard::~InterruptGuard() {
  const std::lock_guard lock(guards_mutex);
  if (--living_guards > 0) return;
  give_back_signals();
  stop_requests = 0;
}

int InterruptGuard::requests() { return stop_requests; }

}  // namespace gnbv
