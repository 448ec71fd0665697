#include "planner/tour/success.hpp"

#include <gtest/gtest.h>

namespace gnbv {
namespace {

TEST(LookSuccess, BelievesWhatItSawOftenEnough) {
  LookSuccess success(TourSuccess::learned);
  const float before = success.share(PatchSource::sampled, 0, 0);
  for (int i = 0; i < 100; ++i) success.learn(PatchSource::sampled, 0, 0, 1000.0, 250.0);
  EXPECT_NEAR(success.share(PatchSource::sampled, 0, 0), 0.25F, 0.01F);
  EXPECT_GT(before, 0.5F);
  EXPECT_EQ(success.share(PatchSource::sampled, 0, 1),
            LookSuccess(TourSuccess::learned).share(PatchSource::sampled, 0, 1))
      << "of others it has learned nothing";
}

TEST(LookSuccess, FixedLearnsNothing) {
  LookSuccess success(TourSuccess::fixed);
  const float before = success.share(PatchSource::sampled, 0, 0);
  success.learn(PatchSource::sampled, 0, 0, 1e6, 0.0);
  EXPECT_EQ(success.share(PatchSource::sampled, 0, 0), before);
}

TEST(LookSuccess, AllLooksBeyondTheLastBinAreAlike) {
  LookSuccess success(TourSuccess::learned);
  success.learn(PatchSource::sampled, 200, 2, 1e6, 5e5);
  EXPECT_EQ(success.share(PatchSource::sampled, 4, 2), success.share(PatchSource::sampled, 9, 2));
  EXPECT_NEAR(success.share(PatchSource::sampled, 4, 2), 0.5F, 0.01F);
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
