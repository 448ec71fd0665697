#include "sim/core/parallel.hpp"

#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace gnbv {
namespace {

using Task = std::function<void(std::size_t)>;

/// A call of parallel_for() under way. Each thread that takes part runs the next index until none
/// is left.
class Fork {
 public:
  Fork(const Task& task, std::size_t count, std::size_t helpers)
      : to_come(helpers), task_(task), count_(count), failed_at_(count) {}

  bool has_work() const { return next_.load(std::memory_order_relaxed) < count_; }
  std::size_t take() { return next_++; }
  void run_from(std::size_t i) {
    for (; i < count_; i = take()) run(i);
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

  // the pool reads and writes these under its lock
  std::size_t to_come;      // helpers that may still join
  std::size_t helping = 0;  // those that have joined and not left
  std::condition_variable left;

 private:
  void run(std::size_t i) {
    try {
      task_(i);
    } catch (...) {
      const std::lock_guard lock(failing_);
      if (i >= failed_at_) return;
      failed_at_ = i;
      error_ = std::current_exception();
    }
  }

  const Task& task_;
  const std::size_t count_;
  std::atomic<std::size_t> next_{0};
  std::mutex failing_;
  std::size_t failed_at_;
  std::exception_ptr error_;
};

/// Threads that wait for forks, as many as the largest call has asked for. They live as long as the
/// process. The caller works as well, and waits only for pieces that other threads have begun. So a
/// busy pool, or one without a free core, delays no caller, and nested forks cannot deadlock.
class Pool {
 public:
  void run(Fork& fork) {
    std::size_t to_wake = 0;
    {
      const std::lock_guard lock(mutex_);
      add_workers(fork.to_come);
      forks_.push_back(&fork);
      to_wake = std::min(idle_, fork.to_come);
    }
    for (; to_wake > 0; --to_wake) wake_.notify_one();
    fork.run_from(fork.take());
    std::unique_lock lock(mutex_);
    std::erase(forks_, &fork);
    fork.left.wait(lock, [&] { return fork.helping == 0; });
  }

 private:
  /// Adds fewer threads when the system refuses more.
  void add_workers(std::size_t wanted) {
    try {
      for (; workers_ < wanted; ++workers_) std::thread([this] { work(); }).detach();
    } catch (const std::system_error&) {
    }
  }

  [[noreturn]] void work() {
    std::unique_lock lock(mutex_);
    while (true) {
      // the youngest fork first: its caller is itself a part of an older fork
      const auto open = std::find_if(forks_.rbegin(), forks_.rend(), [](const Fork* fork) {
        return fork->to_come > 0 && fork->has_work();
      });
      if (open == forks_.rend()) {
        ++idle_;
        wake_.wait(lock);
        --idle_;
        continue;
      }
      help(**open, lock);
    }
  }

  void help(Fork& fork, std::unique_lock<std::mutex>& lock) {
    --fork.to_come;
    ++fork.helping;
    const std::size_t first = fork.take();  // under the lock: a thread that has joined has begun
    lock.unlock();
    fork.run_from(first);
    lock.lock();
    if (--fork.helping == 0) fork.left.notify_one();
  }

  std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<Fork*> forks_;
  std::size_t workers_ = 0;
  std::size_t idle_ = 0;
};

/// Never destroyed, because its threads wait in it until the process ends. A child process, which
/// has none of these threads, makes a new one.
Pool& the_pool() {
  alignas(Pool) static std::byte memory[sizeof(Pool)];
  static const bool is_made = [] {
    const auto make = [] { new (memory) Pool; };
    make();
    return pthread_atfork(nullptr, nullptr, make) == 0;
  }();
  static_cast<void>(is_made);
  return *std::launder(reinterpret_cast<Pool*>(memory));
}

}  // namespace

void parallel_for(int threads, std::size_t count, const Task& task) {
  const std::size_t takers = std::min(count, static_cast<std::size_t>(std::max(threads, 1)));
  if (takers <= 1) {
    for (std::size_t i = 0; i < count; ++i) task(i);
    return;
  }
  Fork fork(task, count, takers - 1);
  the_pool().run(fork);
  fork.rethrow();
}

void parallel_for_chunks(int threads, std::size_t count, std::size_t chunk,
                         const std::function<void(std::size_t begin, std::size_t end)>& task) {
  parallel_for(threads, (count + chunk - 1) / chunk,
               [&](std::size_t i) { task(i * chunk, std::min(count, (i + 1) * chunk)); });
}

}  // namespace gnbv
