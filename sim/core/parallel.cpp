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

/// A call of parallel_for() under way.
struct Fork {
  Fork(const Task& its_task, std::size_t its_count, std::size_t helpers)
      : task(its_task), count(its_count), to_come(helpers), failed_at(count) {}

  bool has_work() const { return next.load(std::memory_order_relaxed) < count; }
  /// Each thread that takes part runs the next index until none is left.
  void run() {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        task(i);
      } catch (...) {
        const std::lock_guard lock(failing);
        if (i >= failed_at) continue;
        failed_at = i;
        error = std::current_exception();
      }
    }
  }

  const Task& task;
  const std::size_t count;
  // the pool reads and writes these under its lock
  std::size_t to_come;      // helpers that may still join
  std::size_t helping = 0;  // those that have joined and not left
  std::condition_variable left;

  std::atomic<std::size_t> next{0};
  std::mutex failing;
  std::size_t failed_at;
  std::exception_ptr error;
};

/// Threads that wait for forks, as many as the largest call has asked for. They live as long as the
/// process. The caller works too, and waits only for indices that other threads have taken. So a
/// busy pool, or one without a free core, delays no caller, and nested forks cannot deadlock.
class Pool {
 public:
  void run(Fork& fork) {
    const std::size_t helpers = fork.to_come;
    {
      const std::lock_guard lock(mutex_);
      add_workers(helpers);
      forks_.push_back(&fork);
    }
    for (std::size_t i = 0; i < helpers; ++i) wake_.notify_one();
    fork.run();
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
        wake_.wait(lock);
        continue;
      }
      Fork& fork = **open;
      --fork.to_come;
      ++fork.helping;
      lock.unlock();
      fork.run();
      lock.lock();
      if (--fork.helping == 0) fork.left.notify_one();
    }
  }

  std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<Fork*> forks_;
  std::size_t workers_ = 0;
};

/// Never destroyed: its threads wait in it until the process ends. A child process has none of
/// these threads and makes a pool of its own.
Pool& the_pool() {
  alignas(Pool) static std::byte memory[sizeof(Pool)];
  [[maybe_unused]] static const bool is_made = [] {
    const auto make = [] { new (memory) Pool; };
    make();
    return pthread_atfork(nullptr, nullptr, make) == 0;
  }();
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
  if (fork.error) std::rethrow_exception(fork.error);
}

void parallel_for_chunks(int threads, std::size_t count, std::size_t chunk,
                         const std::function<void(std::size_t begin, std::size_t end)>& task) {
  parallel_for(threads, (count + chunk - 1) / chunk,
               [&](std::size_t i) { task(i * chunk, std::min(count, (i + 1) * chunk)); });
}

}  // namespace gnbv
