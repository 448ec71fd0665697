// What a flight was foretold to draw against what it drew.
#include <gtest/gtest.h>

#include "sim/flight/guidance.hpp"
#include "sim/flight/rotors.hpp"
#include "sim/mesh/world.hpp"
#include "tests/support/streaming_flight.hpp"

namespace gnbv {
namespace {

TEST(LegEnergy, IsWhatALegDrawsAndNeverLess) {
  const VehicleConfig iris;
  const GuidanceConfig guidance;
  const Vec3 from_m(0, 0, 10);
  for (const ViewPose& to :
       {ViewPose{{0.5, 0, 10}, 0.0}, ViewPose{{30, 0, 10}, 0.0}, ViewPose{{0, 0, 40}, 0.0},
        ViewPose{{-10, 4, 4}, 0.0}, ViewPose{{0, 0, 10}, kPi}, ViewPose{{0.5, 0, 10}, -2.0}}) {
    const auto flight = make_flight(iris, World{}, {from_m, 0.0}, 1);
    ASSERT_EQ(fly_leg(*flight, to, guidance.path_speed_m_s, guidance, iris, {}), LegEnd::arrived);
    const double foretold_wh = leg_energy_wh(iris, guidance, {from_m, 0.0}, to);
    const double allowance_wh = hover_power_w(iris) * kArrival_s / kJoulesPerWattHour;
    EXPECT_LT(flight->energy_wh(), foretold_wh) << to.p_world_m.transpose() << ", " << to.yaw_rad;
    EXPECT_GT(flight->energy_wh(), 0.97 * (foretold_wh - allowance_wh))
        << to.p_world_m.transpose() << ", " << to.yaw_rad;
  }
}

TEST(LegEnergy, OfATurnAloneIsHoverPowerTimesItsTimeEitherWayRound) {
  const VehicleConfig iris;
  const GuidanceConfig guidance;
  const ViewPose from = {Vec3(1, 2, 3), 3.0};
  for (const double yaw_rad : {-2.0, 1.0, 3.0 - kPi}) {
    const ViewPose to = {from.p_world_m, yaw_rad};
    const double duration_s = leg_duration_s(from, to, 1.0, guidance, iris);
    EXPECT_GT(duration_s, 1.0);
    EXPECT_NEAR(leg_energy_wh(iris, guidance, from, to) * kJoulesPerWattHour,
                hover_power_w(iris) * (duration_s + kArrival_s), 1e-6);
  }
  EXPECT_EQ(leg_energy_wh(iris, guidance, from, from), 0.0);
}

TEST(LegEnergy, OfAnIdealVehicleIsHoverPowerTimesTheTime) {
  VehicleConfig ideal;
  ideal.kind = VehicleKind::ideal;
  const GuidanceConfig guidance;
  // 30 m at 2 m/s, 1 m/s^2 and 4 m/s^3: 30 / 2 + 2 / 1 + 1 / 4 seconds
  EXPECT_NEAR(leg_energy_wh(ideal, guidance, {Vec3(0, 0, 1), 0.0}, {Vec3(0, 0, 31), 0.0}) *
                  kJoulesPerWattHour,
              hover_power_w(ideal) * (15.0 + 2.0 + 0.25 + kArrival_s), 1e-6);
}

}  // namespace
}  // namespace gnbv
