#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/pose.hpp"
#include "sim/core/rng.hpp"
#include "sim/core/sha256.hpp"
#include "sim/core/text.hpp"
#include "tests/support/fault.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

TEST(Pose, WrappedAngleIsTheSameDirectionWithinHalfATurnAndTheYawOfItsPose) {
  for (double angle_rad = -20.0; angle_rad < 20.0; angle_rad += 0.37) {
    const double wrapped_rad = wrap_angle_rad(angle_rad);
    EXPECT_GT(wrapped_rad, -kPi);
    EXPECT_LE(wrapped_rad, kPi);
    EXPECT_NEAR(std::cos(wrapped_rad), std::cos(angle_rad), 1e-12);
    EXPECT_NEAR(std::sin(wrapped_rad), std::sin(angle_rad), 1e-12);
    EXPECT_NEAR(yaw_of(T_world_body({Vec3(1, 2, 3), angle_rad})), wrapped_rad, 1e-14);
  }
  EXPECT_EQ(wrap_angle_rad(-kPi), kPi);
}

TEST(Pose, TurnBetweenDirectionsIsEigensLeastTurnAndAHalfTurnBetweenOppositeOnes) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    const auto number = [&](std::uint64_t k) {
      return uniform01({i, Stream::start_pose, k}) - 0.5;
    };
    const Vec3 from(number(0), number(1), number(2));
    const Vec3 to = i % 4 == 0 ? Vec3(-2.0 * from) : Vec3(number(3), number(4), number(5));
    const Eigen::Quaterniond q = turn_between(from, to);
    EXPECT_LT((q * from.normalized() - to.normalized()).norm(), 1e-9);
    if (i % 4 == 0) continue;
    EXPECT_EQ(q.coeffs(), Eigen::Quaterniond::FromTwoVectors(from, to).coeffs());
  }
}

TEST(Rng, EveryPartOfTheKeyChangesTheNumber) {
  const RandomKey key{1, Stream::start_pose, 2, 3};
  std::set<std::uint64_t> seen = {random_bits(key),
                                  random_bits({2, Stream::start_pose, 2, 3}),
                                  random_bits({1, Stream::bench, 2, 3}),
                                  random_bits({1, Stream::start_pose, 3, 3}),
                                  random_bits({1, Stream::start_pose, 2, 4}),
                                  random_bits({1, Stream::start_pose, 3, 2})};
  EXPECT_EQ(seen.size(), 6U);
}

TEST(Rng, UniformFillsItsTenthsEvenlyAndNormalHasMeanZeroAndVarianceOne) {
  constexpr int kDraws = 100000;
  std::array<int, 10> tenths{};
  double sum = 0.0, sum_of_squares = 0.0;
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    const double u = uniform01({7, Stream::bench, 0, i});
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ++tenths[static_cast<std::size_t>(u * 10.0)];
    const double x = standard_normal({7, Stream::bench, 1, i});
    sum += x;
    sum_of_squares += x * x;
  }
  // binomial: sigma = sqrt(n p (1 - p)) = 95; five sigma
  for (const int count : tenths) EXPECT_NEAR(count, kDraws / 10, 475);
  // five sigma of the mean (1 / sqrt n) and of the variance (sqrt(2 / n))
  EXPECT_NEAR(sum / kDraws, 0.0, 0.016);
  EXPECT_NEAR(sum_of_squares / kDraws, 1.0, 0.0224);
}

TEST(Sha256Hash, OfPartsAgreesWithThePublishedVectors) {
  // FIPS 180-2, appendix B.1, and the empty message
  Sha256 abc;
  abc.add("a");
  abc.add("bc");
  EXPECT_EQ(abc.hex(), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(Sha256().hex(), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

namespace fs = std::filesystem;

TEST(WriteFile, ReadsBackAndAFailedWriteLeavesTheOldFileAndNothingElse) {
  const TempFolder temp;
  const fs::path file = temp.path() / "f.txt";
  const std::string content("one\0two\n", 8);
  write_file_atomically(file, content);
  EXPECT_THROW(write_file_atomically(file,
                                     [](const fs::path& part) {
                                       std::ofstream(part) << "half";
                                       throw BadInput("disk full");
                                     }),
               BadInput);
  EXPECT_EQ(read_file(file), content);
  EXPECT_EQ(std::distance(fs::directory_iterator(temp.path()), {}), 1);
  EXPECT_TRUE(test::says(test::fault_of([&] { read_file(temp.path() / "absent"); }), {"absent"}));
  EXPECT_THROW(write_file_atomically(temp.path() / "no" / "such" / "f", "x"), BadInput);
  for (const fs::path& none : {temp.path(), fs::path("/dev/zero"), fs::path("/dev/urandom"),
                               fs::path("/dev/full")}) {  // devices have no end
    EXPECT_THROW(read_file(none), BadInput) << none;
  }
}

TEST(Check, SaysWhatDoesNotHoldAndWhere) {
  try {
    const int views = 3;
    GNBV_CHECK(views == 4, "{} views", views);
    FAIL();
  } catch (const BrokenInvariant& broken) {
    const std::string message = broken.what();
    EXPECT_NE(message.find("views == 4"), std::string::npos);
    EXPECT_NE(message.find("3 views"), std::string::npos);
    EXPECT_NE(message.find("core_test.cpp"), std::string::npos);
  }
}

/// Files of this process end at so many bytes, as on a full disk.
class FileLimit {
 public:
  explicit FileLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST(WriteFile, LinksStayAndSoDoesWhatIsNoFile) {
  const TempFolder temp;
  const fs::path link = temp.path() / "link.csv";
  fs::create_directory(temp.path() / "shared");
  fs::create_symlink("shared/target", link);
  for (const std::string content : {"new", "changed"}) {
    write_file_atomically(link, content);
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(read_file(temp.path() / "shared/target"), content);
  }
  const fs::path pipe = temp.path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(write_file_atomically(pipe, "x"), BadInput);
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST(WriteFile, ThatDoesNotFitIsNoBadInputAndLeavesNothing) {
  const TempFolder temp;
  const fs::path file = temp.path() / "file";
  {
    const FileLimit limit(1000);
    try {
      write_file_atomically(file, std::string(5000, 'x'));
      FAIL();
    } catch (const OutputFailed& failed) {
      EXPECT_NE(std::string(failed.what()).find("file: cannot write: File too large"),
                std::string::npos)
          << failed.what();
    }
  }
  EXPECT_TRUE(fs::is_empty(temp.path()));
  EXPECT_THROW(write_file_atomically(temp.path() / "no/file", ""), BadInput);
}

TEST(WriteFile, WhatADeadWriterLeftIsRemovedAndALivingOnesStays) {
  const TempFolder temp;
  std::string of_this_process;
  write_file_atomically(temp.path() / "a.csv", [&](const fs::path& part) {
    of_this_process = part.filename();
    std::ofstream(part) << "x";
  });
  const auto with_process = [&](const std::string& process) {
    std::string name = of_this_process;
    const std::string own = std::to_string(getpid());
    return temp.path() / name.replace(name.find(own), own.size(), process);
  };
  const fs::path dead = with_process("999999999");
  const fs::path living = with_process(std::to_string(getppid()));
  for (const fs::path& file : {dead, living, temp.path() / ".other"}) std::ofstream(file) << "x";
  EXPECT_TRUE(is_temporary(dead));
  EXPECT_FALSE(is_temporary(temp.path() / "iterations.csv.part"));
  remove_stale_temporaries(temp.path());
  remove_stale_temporaries(temp.path() / "absent");
  EXPECT_FALSE(fs::exists(dead));
  for (const fs::path& file : {living, temp.path() / ".other", temp.path() / "a.csv"}) {
    EXPECT_TRUE(fs::exists(file)) << file;
  }
}

TEST(FileLock, HasOneHolderAndNoneOnceItIsGone) {
  const TempFolder temp;
  const fs::path path = temp.path() / "lock";
  EXPECT_FALSE(is_locked(path));
  {
    const std::optional<FileLock> first = FileLock::take(path);
    ASSERT_TRUE(first.has_value());
    EXPECT_TRUE(is_locked(path));
    fs::permissions(path, fs::perms::owner_read);  // as of another user's
    EXPECT_TRUE(is_locked(path));
    fs::permissions(path, fs::perms::owner_all);
    EXPECT_FALSE(FileLock::take(path).has_value());
    fs::remove(path);  // as a holder does that has done its work: the name is free
    const std::optional<FileLock> second = FileLock::take(path);
    EXPECT_TRUE(second.has_value());
    EXPECT_FALSE(FileLock::take(path).has_value());
  }
  EXPECT_TRUE(FileLock::take(path).has_value());
}

TEST(Printable, ShowsWhatATerminalWouldObey) {
  EXPECT_EQ(printable("naïve → 5 µm\n\t"), "naïve → 5 µm\n\t");
  EXPECT_EQ(printable("\x1b[31m\r\x7f"), "\\x1b[31m\\x0d\\x7f");
  EXPECT_EQ(printable("\xff\xfe \xc2\x9b"), "\\xff\\xfe \\xc2\\x9b");
  EXPECT_EQ(printable("\xef\xbf\xbd"), "\xef\xbf\xbd");  // the replacement character itself
}

}  // namespace
}  // namespace gnbv
