#include "sim/core/parallel.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "sim/core/text.hpp"

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

// Laws of bytes as text, and of text as code points.

// RFC 4648, section 10
TEST(Base64, IsThatOfTheStandard) {
  const auto bytes_of = [](std::string_view text) {
    return std::vector<std::uint8_t>(text.begin(), text.end());
  };
  EXPECT_EQ(base64(bytes_of("")), "");
  EXPECT_EQ(base64(bytes_of("f")), "Zg==");
  EXPECT_EQ(base64(bytes_of("fo")), "Zm8=");
  EXPECT_EQ(base64(bytes_of("foo")), "Zm9v");
  EXPECT_EQ(base64(bytes_of("foobar")), "Zm9vYmFy");
  EXPECT_EQ(base64(std::vector<std::uint8_t>{0xff, 0xfe, 0xfb}), "//77");
}

std::u32string code_points(std::string_view text) {
  std::u32string codes;
  while (!text.empty()) codes += take_code_point(text);
  return codes;
}

TEST(Utf8, CodePointsOfOneToFourBytesComeOutInOrder) {
  EXPECT_EQ(code_points("K\xc3\xbchl \xe2\x82\xac\xf0\x9f\x9a\x81."),
            U"K\u00fchl \u20ac\U0001f681.");
  EXPECT_EQ(code_points(std::string_view("\0a", 2)), std::u32string(U"\0a", 2));
}

TEST(Utf8, BytesThatAreNoneAreReplacedOneByOne) {
  EXPECT_EQ(code_points("a\xff\xc3"), U"a\ufffd\ufffd");          // no lead, cut off
  EXPECT_EQ(code_points("\xc3\xc3\xbc"), U"\ufffd\u00fc");        // cut off by the next
  EXPECT_EQ(code_points("\xc0\xaf"), U"\ufffd\ufffd");            // longer than it must be
  EXPECT_EQ(code_points("\xed\xa0\x80"), U"\ufffd\ufffd\ufffd");  // a surrogate
  EXPECT_EQ(code_points("\xf4\x90\x80\x80")[0], U'\ufffd');       // beyond the last
  EXPECT_EQ(code_points("\xe2\x82"), U"\ufffd\ufffd");            // at the end of the text
}

TEST(FoldedText, BreaksAtBlanksButNotBetweenANumberAndItsUnit) {
  EXPECT_EQ(folded_text("up to 25 m, 38 s", 14), "up to 25 m,\n38 s");
  EXPECT_EQ(folded_text("up to 25 m, 38 s", 9), "up to\n25 m,\n38 s");
  EXPECT_EQ(folded_text("(n = 4 seeds)", 6), "(n = 4\nseeds)");  // no unit
  EXPECT_EQ(folded_text("one\n\ntwo", 5), "one\n\ntwo");
  EXPECT_EQ(folded_text("wider than that", 0), "wider than that");
}

TEST(FoldedText, IsTheTextItWasAndNoWiderWhereBlanksAllowIt) {
  const std::string text = "a longer sentence of 12 words with 0.05 m and 98.1 % in it.";
  for (std::size_t width = 9; width < 70; ++width) {
    std::string folded = folded_text(text, width);
    std::size_t begin = 0;
    for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
      end = folded.find('\n', begin);
      EXPECT_LE(folded.substr(begin, end - begin).size(), width) << folded;
    }
    std::replace(folded.begin(), folded.end(), '\n', ' ');
    EXPECT_EQ(folded, text);
  }
}

TEST(Shortened, EndsAfterAWordAndIsNeverWider) {
  EXPECT_EQ(shortened("finding what there is to see", 28), "finding what there is to see");
  EXPECT_EQ(shortened("finding what there is to see", 27), "finding what there is to…");
  EXPECT_EQ(shortened("view 6/12  12 m  2,306 points", 20), "view 6/12  12 m…");
  EXPECT_EQ(shortened("indivisible", 5), "");
}

TEST(Grouped, ThousandsOfCountsAreApart) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(1234567), "1,234,567");
}

TEST(Grouped, NumbersHaveTheirDecimalsAndNoNegativeZero) {
  EXPECT_EQ(grouped(10969.6, 0), "10,970");
  EXPECT_EQ(grouped(1234.56, 1), "1,234.6");
  EXPECT_EQ(grouped(-1234567.25, 1), "-1,234,567.2");
  EXPECT_EQ(grouped(999.0, 2), "999.00");
  EXPECT_EQ(grouped(-0.04, 1), "0.0");
}

}  // namespace
}  // namespace gnbv
