#include "sim/core/parallel.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace gnbv {
namespace {

TEST(Parallel, EveryTaskRunsOnceAtAnyNumberOfThreads) {
  for (const int threads : {0, 1, 2, 5, 16}) {
    std::vector<std::atomic<int>> runs(101);
    parallel_for(threads, runs.size(), [&](std::size_t i) { ++runs[i]; });
    for (const auto& count : runs) EXPECT_EQ(count.load(), 1);
  }
}

TEST(Parallel, ChunksAreOfTheSizeAskedForAndTogetherTheWhole) {
  for (const std::size_t count : {0U, 1U, 10U, 99U, 100U, 101U}) {
    std::vector<std::atomic<int>> runs(count);
    std::atomic<int> short_ones{0};
    parallel_for_chunks(4, count, 10, [&](std::size_t begin, std::size_t end) {
      EXPECT_EQ(begin % 10, 0U);
      if (end - begin != 10) ++short_ones;
      for (std::size_t i = begin; i < end; ++i) ++runs[i];
    });
    for (const auto& each : runs) EXPECT_EQ(each.load(), 1);
    EXPECT_EQ(short_ones, count % 10 == 0 ? 0 : 1);
  }
}

TEST(Parallel, TheFirstFailureByIndexIsThrown) {
  for (const int threads : {1, 4}) {
    try {
      parallel_for(threads, 50, [](std::size_t i) {
        if (i == 7 || i == 31) throw std::runtime_error(std::to_string(i));
      });
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "7");
    }
  }
}

TEST(Parallel, NestedCallsRunEveryTaskOnce) {
  std::vector<std::atomic<int>> runs(40 * 30);
  parallel_for(4, 40, [&](std::size_t i) {
    parallel_for(3, 30, [&](std::size_t j) { ++runs[i * 30 + j]; });
  });
  for (const auto& count : runs) EXPECT_EQ(count.load(), 1);
}

TEST(Parallel, AFailureInsideANestedCallIsThrownByBoth) {
  try {
    parallel_for(2, 8, [](std::size_t i) {
      parallel_for(2, 8, [i](std::size_t j) {
        if (i >= 3 && j >= 5) throw std::runtime_error(std::to_string(10 * i + j));
      });
    });
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "35");
  }
}

TEST(Parallel, NoCallStartsThreadsOfItsOwn) {
  std::set<pid_t> threads;
  std::mutex adding;
  for (int call = 0; call < 200; ++call) {
    parallel_for(2, 8, [&](std::size_t) {
      const std::lock_guard lock(adding);
      threads.insert(gettid());
    });
  }
  // this one, and the most helpers that any test of this program has asked for
  EXPECT_LE(threads.size(), 17U);
}

TEST(Parallel, NoMoreThreadsThanAskedForTakePart) {
  parallel_for(8, 8, [](std::size_t) {});  // more are there
  std::atomic<int> inside{0};
  std::atomic<int> most{0};
  parallel_for(3, 60, [&](std::size_t) {
    const int now = ++inside;
    for (int before = most; before < now && !most.compare_exchange_weak(before, now);) {
    }
    usleep(500);
    --inside;
  });
  EXPECT_LE(most.load(), 3);
}

TEST(Parallel, ABusyPoolDelaysNobody) {
  constexpr int kThreads = 16;  // as many as any test of this program asks for
  std::atomic<int> held{0};
  std::atomic<bool> let_go{false};
  std::thread hold([&] {
    parallel_for(kThreads, kThreads, [&](std::size_t) {
      ++held;
      let_go.wait(false);
    });
  });
  while (held < kThreads) usleep(100);
  std::atomic<int> runs{0};
  parallel_for(4, 100, [&](std::size_t) { ++runs; });
  EXPECT_EQ(runs.load(), 100);
  let_go = true;
  let_go.notify_all();
  hold.join();
}

TEST(Parallel, AChildProcessHasAPoolOfItsOwn) {
  parallel_for(4, 100, [](std::size_t) {});
  const pid_t child = fork();
  if (child == 0) {
    alarm(20);  // ends it when nobody comes
    std::atomic<int> begun{0};
    parallel_for(2, 2, [&](std::size_t) {
      ++begun;
      while (begun < 2) usleep(100);
    });
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace gnbv
