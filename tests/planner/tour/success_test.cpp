#include "planner/tour/success.hpp"

#include <gtest/gtest.h>

namespace gnbv {
namespace {

Patch looked_at(std::uint8_t looks, std::uint8_t points = 0) {
  return {.missing = 10.0F, .source = PatchSource::sampled, .looks = looks, .points = points};
}

TEST(LookSuccess, BelievesWhatItSawOftenEnough) {
  LookSuccess success(TourSuccess::learned);
  const float before = success.share(looked_at(0), 0);
  for (int i = 0; i < 100; ++i) success.learn(looked_at(0), 0, 1000.0, 250.0);
  EXPECT_NEAR(success.share(looked_at(0), 0), 0.25F, 0.01F);
  EXPECT_GT(before, 0.5F);
  const LookSuccess fresh(TourSuccess::learned);
  EXPECT_EQ(success.share(looked_at(0), 1), fresh.share(looked_at(0), 1))
      << "of others it has learned nothing";
  EXPECT_EQ(success.share(looked_at(0, 1), 0), fresh.share(looked_at(0, 1), 0));
}

TEST(LookSuccess, FixedLearnsNothing) {
  LookSuccess success(TourSuccess::fixed);
  const float before = success.share(looked_at(0), 0);
  success.learn(looked_at(0), 0, 1e6, 0.0);
  EXPECT_EQ(success.share(looked_at(0), 0), before);
}

TEST(LookSuccess, AllLooksBeyondTheLastBinAreAlike) {
  LookSuccess success(TourSuccess::learned);
  success.learn(looked_at(200), 2, 1e6, 5e5);
  EXPECT_EQ(success.share(looked_at(4), 2), success.share(looked_at(9), 2));
  EXPECT_NEAR(success.share(looked_at(4), 2), 0.5F, 0.01F);
}

TEST(LookSuccess, APatchWithHalfTheCreditPromisesHalf) {
  const LookSuccess success(TourSuccess::learned);
  Patch patch = looked_at(1);
  const float whole = success.share(patch, 0);
  patch.credit = 0.5F;
  EXPECT_EQ(success.share(patch, 0), 0.5F * whole);
}

TEST(LookSuccess, IncidenceBinsAreWhatTheySay) {
  const auto bin = [](double deg) {
    return incidence_bin(static_cast<float>(std::cos(deg_to_rad(deg))));
  };
  EXPECT_EQ(bin(44.9), 0U);
  EXPECT_EQ(bin(45.1), 1U);
  EXPECT_EQ(bin(64.9), 1U);
  EXPECT_EQ(bin(65.1), 2U);
}

}  // namespace
}  // namespace gnbv
