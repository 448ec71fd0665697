#include "bench/speed/map_speed.hpp"

#include <gtest/gtest.h>

#include "sim/core/simd.hpp"

namespace gnbv {
namespace {

TEST(MapSpeed, MapsAreIdenticalToOctomapsAtEveryLevel) {
  const std::vector<SpeedRow> rows = map_speed();
  ASSERT_EQ(rows.size(), simd_level() == SimdLevel::baseline ? 2U : 3U);
  for (const SpeedRow& row : rows) {
    EXPECT_TRUE(row.identical) << row.name;
    EXPECT_DOUBLE_EQ(row.ratio, row.reference / row.ours) << row.name;
  }
}

}  // namespace
}  // namespace gnbv
