// Laws of the allocation to rotors: what is asked is given, and what gives way first.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/flight/rotors.hpp"

namespace gnbv {
namespace {

const AirframeParameters kIris;
const Allocation kQuad = allocation_of(kIris);

TEST(Mixer, SacrificesYawBeforeRoll) {
  const MixerOutput out = mix(kQuad, Vec3(0.4, 0.0, 0.6), 1.0);
  EXPECT_NEAR(out.torque.x(), 0.4, 1e-12);
  EXPECT_NEAR(out.torque.z(), 0.15, 1e-12);  // what the headroom leaves
  // beyond the headroom's reach roll gives way a little, yaw most of itself
  const MixerOutput extreme = mix(kQuad, Vec3(0.6, 0.0, 0.6), 1.0);
  EXPECT_GT(extreme.torque.x(), 0.9 * 0.6);
  EXPECT_LT(extreme.torque.z(), 0.3 * 0.6);
  for (const double command : extreme.commands) {
    EXPECT_GE(command, 0.0);
    EXPECT_LE(command, 1.0);
  }
}

TEST(Mixer, SacrificesThrustBeforeRoll) {
  const MixerOutput out = mix(kQuad, Vec3(0.5, 0.0, 0.0), 1.0);
  EXPECT_NEAR(out.torque.x(), 0.5, 1e-12);
  double mean = 0.0;
  for (const double command : out.commands) mean += 0.25 * command;
  EXPECT_NEAR(mean, 1.0 - 0.5 * std::sqrt(0.5), 1e-12);  // the higher pair just reaches 1
}

TEST(Mixer, NeverRaisesThrustForAttitude) {
  for (const double thrust : {0.0, 0.05, 0.1}) {  // airmode off
    const MixerOutput out = mix(kQuad, Vec3(0.4, 0.3, 0.2), thrust);
    double mean = 0.0;
    for (const double command : out.commands) mean += 0.25 * command;
    EXPECT_LE(mean, thrust + 1e-12);
  }
}

}  // namespace
}  // namespace gnbv
