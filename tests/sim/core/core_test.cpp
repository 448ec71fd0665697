#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/pose.hpp"
#include "sim/core/rng.hpp"
#include "sim/core/sha256.hpp"

namespace gnbv {
namespace {

TEST(Pose, WrappedAngleIsTheSameDirectionWithinHalfATurn) {
  for (double angle_rad = -20.0; angle_rad < 20.0; angle_rad += 0.37) {
    const double wrapped_rad = wrap_angle_rad(angle_rad);
    EXPECT_GT(wrapped_rad, -kPi);
    EXPECT_LE(wrapped_rad, kPi);
    EXPECT_NEAR(std::cos(wrapped_rad), std::cos(angle_rad), 1e-12);
    EXPECT_NEAR(std::sin(wrapped_rad), std::sin(angle_rad), 1e-12);
  }
  EXPECT_EQ(wrap_angle_rad(-kPi), kPi);
}

TEST(Pose, YawOfALevelPoseIsItsYaw) {
  for (const double yaw_rad : {-3.0, -1.5, 0.0, 0.3, 2.9}) {
    EXPECT_NEAR(yaw_of(T_world_body({Vec3(1, 2, 3), yaw_rad})), yaw_rad, 1e-15);
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

TEST(Rng, UniformFillsItsTenthsEvenly) {
  constexpr int kDraws = 100000;
  std::array<int, 10> tenths{};
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    const double u = uniform01({7, Stream::bench, 0, i});
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ++tenths[static_cast<std::size_t>(u * 10.0)];
  }
  // binomial: sigma = sqrt(n p (1 - p)) = 95; five sigma
  for (const int count : tenths) EXPECT_NEAR(count, kDraws / 10, 475);
}

TEST(Rng, NormalHasMeanZeroAndVarianceOne) {
  constexpr int kDraws = 100000;
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    const double x = standard_normal({7, Stream::bench, 1, i});
    sum += x;
    sum_of_squares += x * x;
  }
  // five sigma of the mean (1 / sqrt n) and of the variance (sqrt(2 / n))
  EXPECT_NEAR(sum / kDraws, 0.0, 0.016);
  EXPECT_NEAR(sum_of_squares / kDraws, 1.0, 0.0224);
}

TEST(Sha256Hash, AgreesWithThePublishedVectors) {
  // FIPS 180-2, appendix B.1, and the empty message
  Sha256 abc;
  abc.add("abc");
  EXPECT_EQ(abc.hex(), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(Sha256().hex(), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(Sha256Hash, PartsHashAsTheirConcatenation) {
  Sha256 parts;
  parts.add("a");
  parts.add("bc");
  Sha256 whole;
  whole.add("abc");
  EXPECT_EQ(parts.hex(), whole.hex());
}

class AtomicFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("gnbv_core_test_" +
               std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::size_t files() const {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_)) ++count;
    return count;
  }
  std::filesystem::path folder_;
};

TEST_F(AtomicFile, ReadsBackWhatWasWritten) {
  const std::string content("one\0two\n", 8);
  write_file_atomically(folder_ / "f.txt", content);
  EXPECT_EQ(read_file(folder_ / "f.txt"), content);
  EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFile, AFailedWriteLeavesTheOldFileAndNothingElse) {
  write_file_atomically(folder_ / "f.txt", "old");
  EXPECT_THROW(write_file_atomically(folder_ / "f.txt",
                                     [](const std::filesystem::path& part) {
                                       std::ofstream(part) << "half";
                                       throw BadInput("disk full");
                                     }),
               BadInput);
  EXPECT_EQ(read_file(folder_ / "f.txt"), "old");
  EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFile, ErrorsNameThePath) {
  try {
    read_file(folder_ / "absent");
    FAIL();
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find("absent"), std::string::npos);
  }
  EXPECT_THROW(read_file(folder_), BadInput);
  EXPECT_THROW(write_file_atomically(folder_ / "no" / "such" / "f", "x"), BadInput);
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

}  // namespace
}  // namespace gnbv
