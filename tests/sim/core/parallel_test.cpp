#include "sim/core/parallel.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "sim/core/text.hpp"

namespace gnbv {
namespace {

TEST(Parallel, EveryTaskRunsOnceAtAnyNumberOfThreadsAlsoInNestedCallsAndChunks) {
  for (const int threads : {0, 1, 2, 5, 16}) {
    std::vector<std::atomic<int>> runs(101), nested(40 * 30), in_chunks(101);
    parallel_for(threads, runs.size(), [&](std::size_t i) { ++runs[i]; });
    parallel_for(threads, 40, [&](std::size_t i) {
      parallel_for(threads, 30, [&](std::size_t j) { ++nested[i * 30 + j]; });
    });
    for (const std::size_t count : {0U, 1U, 10U, 99U, 100U, 101U}) {
      std::atomic<int> short_ones{0};
      parallel_for_chunks(threads, count, 10, [&](std::size_t begin, std::size_t end) {
        EXPECT_EQ(begin % 10, 0U);
        if (end - begin != 10) ++short_ones;
        for (std::size_t i = begin; i < end; ++i) ++in_chunks[i];
      });
      EXPECT_EQ(short_ones, count % 10 == 0 ? 0 : 1);
      for (std::size_t i = 0; i < 101; ++i) EXPECT_EQ(in_chunks[i].exchange(0), i < count ? 1 : 0);
    }
    for (const auto* const all : {&runs, &nested}) {
      for (const auto& count : *all) EXPECT_EQ(count.load(), 1);
    }
  }
}

/// What the call throws.
std::string thrown_by(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "nothing";
}

TEST(Parallel, TheFirstFailureByIndexIsThrownAlsoOutOfANestedCall) {
  for (const int threads : {1, 4}) {
    EXPECT_EQ(thrown_by([&] {
                parallel_for(threads, 50, [](std::size_t i) {
                  if (i == 7 || i == 31) throw std::runtime_error(std::to_string(i));
                });
              }),
              "7");
    EXPECT_EQ(thrown_by([&] {
                parallel_for(threads, 8, [&](std::size_t i) {
                  parallel_for(threads, 8, [i](std::size_t j) {
                    if (i >= 3 && j >= 5) throw std::runtime_error(std::to_string(10 * i + j));
                  });
                });
              }),
              "35");
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
  for (const auto& [text, encoded] :
       {std::pair("", ""), std::pair("f", "Zg=="), std::pair("fo", "Zm8="),
        std::pair("foo", "Zm9v"), std::pair("foobar", "Zm9vYmFy"),
        std::pair("\xff\xfe\xfb", "//77")}) {
    EXPECT_EQ(base64(bytes_of(text)), encoded);
  }
}

std::u32string code_points(std::string_view text) {
  std::u32string codes;
  while (!text.empty()) codes += take_code_point(text);
  return codes;
}

TEST(Utf8, CodePointsComeOutInOrderAndBytesThatAreNoneAreReplacedOneByOne) {
  using namespace std::string_view_literals;
  for (const auto& [bytes, codes] : std::vector<std::pair<std::string_view, std::u32string_view>>{
           {"K\xc3\xbchl \xe2\x82\xac\xf0\x9f\x9a\x81."sv, U"K\u00fchl \u20ac\U0001f681."sv},
           {"\0a"sv, U"\0a"sv},
           {"a\xff\xc3"sv, U"a\ufffd\ufffd"sv},                    // no lead, cut off
           {"\xc3\xc3\xbc"sv, U"\ufffd\u00fc"sv},                  // cut off by the next
           {"\xc0\xaf"sv, U"\ufffd\ufffd"sv},                      // longer than it must be
           {"\xed\xa0\x80"sv, U"\ufffd\ufffd\ufffd"sv},            // a surrogate
           {"\xf4\x90\x80\x80"sv, U"\ufffd\ufffd\ufffd\ufffd"sv},  // beyond the last
           {"\xe2\x82"sv, U"\ufffd\ufffd"sv}}) {                   // at the end of the text
    EXPECT_EQ(code_points(bytes), codes);
  }
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

TEST(Grouped, ThousandsAreApartAndNumbersHaveTheirDecimalsAndNoNegativeZero) {
  for (const auto& [count, text] : {std::pair(0U, "0"), std::pair(999U, "999"),
                                    std::pair(1000U, "1,000"), std::pair(1234567U, "1,234,567")}) {
    EXPECT_EQ(grouped(count), text);
  }
  EXPECT_EQ(grouped(10969.6, 0), "10,970");
  EXPECT_EQ(grouped(1234.56, 1), "1,234.6");
  EXPECT_EQ(grouped(-1234567.25, 1), "-1,234,567.2");
  EXPECT_EQ(grouped(999.0, 2), "999.00");
  EXPECT_EQ(grouped(-0.04, 1), "0.0");
}

}  // namespace
}  // namespace gnbv
