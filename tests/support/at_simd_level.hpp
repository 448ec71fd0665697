// Tests that hold at every SimdLevel, each level a test of its own.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "sim/core/simd.hpp"

namespace gnbv {

/// Base of a fixture: the test runs at the level that is its parameter, and is skipped where the
/// processor has it not or GNBV_SIMD forbids it.
class AtSimdLevel : public testing::TestWithParam<SimdLevel> {
 protected:
  void SetUp() override {
    if (GetParam() > best_) {
      GTEST_SKIP() << name_of(GetParam())
                   << ": this processor has no more than, or GNBV_SIMD allows " << name_of(best_);
    }
    set_simd_level(GetParam());
  }
  void TearDown() override { set_simd_level(best_); }

 private:
  const SimdLevel best_ = simd_level();
};

inline std::string simd_test_name(const testing::TestParamInfo<SimdLevel>& info) {
  return std::string(name_of(info.param));
}

#define GNBV_AT_EVERY_SIMD_LEVEL(fixture) \
  INSTANTIATE_TEST_SUITE_P(               \
      AtEveryLevel, fixture,              \
      testing::Values(SimdLevel::baseline, SimdLevel::avx2, SimdLevel::avx512), simd_test_name)

}  // namespace gnbv
