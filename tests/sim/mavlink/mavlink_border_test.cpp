// The border between ENU/FLU and NED/FRD. Numbers in brackets: tests of the vehicle's
// specification.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <ostream>

#include "sim/core/rng.hpp"
#include "sim/mavlink/border.hpp"
#include "tests/sim/mavlink/mavlink_session.hpp"

namespace gnbv::mavlink {
namespace {

constexpr double kExact = 1e-12;
constexpr std::uint16_t kPositionAndYaw = 2552;      // mavros setpoint_position
constexpr std::uint16_t kVelocityAndYawRate = 1479;  // mavros setpoint_velocity

/// Every field set, so that whatever is not ignored shows.
SetPositionTargetLocalNed full_message(std::uint16_t type_mask, std::uint8_t frame = 1) {
  return {.p_m = {1.0F, 2.0F, -3.0F},
          .v_m_s = {0.5F, -0.25F, 0.125F},
          .a_m_s2 = {4.0F, 5.0F, 6.0F},
          .yaw_rad = 0.5F,
          .yaw_rate_rad_s = -0.75F,
          .type_mask = type_mask,
          .coordinate_frame = frame};
}

Setpoint read(const SetPositionTargetLocalNed& message, double yaw_world_rad = 0.0) {
  return std::get<Setpoint>(setpoint_of(message, yaw_world_rad));
}

bool is_refused(const SetPositionTargetLocalNed& message) {
  return std::holds_alternative<Refusal>(setpoint_of(message, 0.0));
}

/// Same numbers, and NaN at the same places.
void expect_same(const Setpoint& actual, const Setpoint& expected) {
  const auto same = [](double a, double b) {
    return (std::isnan(a) && std::isnan(b)) || std::abs(a - b) < kExact;
  };
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_TRUE(same(actual.p_world_m[axis], expected.p_world_m[axis])) << "p " << axis;
    EXPECT_TRUE(same(actual.v_world_m_s[axis], expected.v_world_m_s[axis])) << "v " << axis;
    EXPECT_TRUE(same(actual.a_world_m_s2[axis], expected.a_world_m_s2[axis])) << "a " << axis;
  }
  EXPECT_TRUE(same(actual.yaw_rad, expected.yaw_rad)) << actual.yaw_rad;
  EXPECT_TRUE(same(actual.yaw_rate_rad_s, expected.yaw_rate_rad_s)) << actual.yaw_rate_rad_s;
}

TEST(MavlinkBorder, MavrosMasksMeanNotControlled) {  // (10)
  expect_same(read(full_message(kPositionAndYaw)),
              {.p_world_m = {2.0, 1.0, 3.0}, .yaw_rad = kPi / 2.0 - 0.5});
  expect_same(read(full_message(kVelocityAndYawRate)),
              {.v_world_m_s = {-0.25, 0.5, -0.125}, .yaw_rate_rad_s = 0.75});
}

TEST(MavlinkBorder, EveryMaskBitIgnoresItsOwnField) {
  const Setpoint all = read(full_message(0));
  const auto values = [](const Setpoint& s) {  // in the order of the bits, NED
    const Vec3 p = swap_enu_ned(s.p_world_m);
    const Vec3 v = swap_enu_ned(s.v_world_m_s);
    const Vec3 a = swap_enu_ned(s.a_world_m_s2);
    return std::array{p.x(), p.y(), p.z(), v.x(), v.y(),     v.z(),
                      a.x(), a.y(), a.z(), 0.0,   s.yaw_rad, s.yaw_rate_rad_s};
  };
  for (std::size_t bit = 0; bit < 12; ++bit) {
    if (bit == 9) continue;  // the force bit
    const auto masked = values(read(full_message(static_cast<std::uint16_t>(1U << bit))));
    for (std::size_t i = 0; i < masked.size(); ++i) {
      EXPECT_EQ(std::isnan(masked[i]), i == bit) << "bit " << bit << " field " << i;
      EXPECT_TRUE(i == bit || masked[i] == values(all)[i]);
    }
  }
}

TEST(MavlinkBorder, NanInAFieldIsAsGoodAsItsMaskBit) {
  SetPositionTargetLocalNed message = full_message(0);
  message.v_m_s.fill(std::nanf(""));
  message.a_m_s2.fill(std::nanf(""));
  message.yaw_rate_rad_s = std::nanf("");
  expect_same(read(message), read(full_message(kPositionAndYaw)));
}

TEST(MavlinkBorder, BodyForwardAtHeadingEastMovesEast) {  // (11)
  SetPositionTargetLocalNed message = full_message(kVelocityAndYawRate, 8);
  message.v_m_s = {1.0F, 0.0F, 0.0F};
  const double heading_east_ned_rad = kPi / 2.0;
  const double yaw_world_rad = swap_yaw_enu_ned(heading_east_ned_rad);
  expect_same(read(message, yaw_world_rad),
              {.v_world_m_s = {1.0, 0.0, 0.0}, .yaw_rate_rad_s = 0.75});
  message.v_m_s = {0.0F, 1.0F, 0.5F};  // right and down
  expect_same(read(message, yaw_world_rad),
              {.v_world_m_s = {0.0, -1.0, -0.5}, .yaw_rate_rad_s = 0.75});
}

TEST(MavlinkBorder, BodyFrameHasNoPositionAndNoHalfVelocity) {
  expect_same(read(full_message(0, 8), 0.3), [] {
    Setpoint s = read(full_message(kVelocityAndYawRate & ~0x1c0, 8), 0.3);
    s.yaw_rad = kPi / 2.0 - 0.5;
    return s;
  }());
  EXPECT_TRUE(read(full_message(0, 8)).p_world_m.array().isNaN().all());
  const Setpoint without_vx = read(full_message(8, 8));
  EXPECT_TRUE(without_vx.v_world_m_s.array().isNaN().all());
  EXPECT_FALSE(without_vx.a_world_m_s2.hasNaN());
}

TEST(MavlinkBorder, OtherFramesForceAndNothingToControlAreRefused) {  // (12), (13)
  for (int frame = 0; frame < 256; ++frame) {
    const auto message = full_message(kVelocityAndYawRate, static_cast<std::uint8_t>(frame));
    EXPECT_EQ(is_refused(message), frame != 1 && frame != 8) << frame;
  }
  EXPECT_TRUE(is_refused(full_message(512)));
  EXPECT_TRUE(is_refused(full_message(kPositionAndYaw | 512)));
  EXPECT_TRUE(is_refused(full_message(0x1ff)));
  EXPECT_TRUE(is_refused(full_message(0x1f8, 8)));  // a position alone means nothing in the body
}

TEST(MavlinkBorder, EveryAxisHasABoundAndNoNumberIsInfinite) {
  SetPositionTargetLocalNed message = full_message(0);
  struct Number {
    float* value;
    float limit;
    unsigned bit;
  };
  constexpr float kMost = std::numeric_limits<float>::max();
  std::vector<Number> numbers = {{&message.yaw_rad, kMost, 10},
                                 {&message.yaw_rate_rad_s, kMost, 11}};
  for (unsigned axis = 0; axis < 3; ++axis) {
    numbers.push_back({&message.p_m[axis], 1e6F, axis});
    numbers.push_back({&message.v_m_s[axis], 1e3F, 3 + axis});
    numbers.push_back({&message.a_m_s2[axis], 1e3F, 6 + axis});
  }
  for (const std::uint8_t frame : {std::uint8_t{1}, std::uint8_t{8}}) {
    message = full_message(0, frame);
    for (const auto& [value, limit, bit] : numbers) {
      const bool is_no_position = frame == 8 && bit < 3;  // which it does not have
      const float before = *value;
      for (const float sign : {1.0F, -1.0F}) {
        *value = sign * (frame == 1 ? limit : before);
        EXPECT_FALSE(is_refused(message)) << "bit " << bit;
        for (const float beyond :
             {frame == 1 ? std::nextafter(limit, HUGE_VALF) : HUGE_VALF, HUGE_VALF}) {
          *value = sign * beyond;
          EXPECT_EQ(is_refused(message), !is_no_position) << beyond << " bit " << bit;
          // ignored it does no harm, and in the body with its whole vector
          message.type_mask = static_cast<std::uint16_t>(1U << bit);
          EXPECT_FALSE(is_refused(message)) << "bit " << bit;
          message.type_mask = 0;
        }
      }
      *value = before;
    }
  }
}

/// Oracle: the definition of the angles, Rz Ry Rx in NED/FRD, carried to ENU/FLU by matrices.
Isometry world_body_of(const Vec3& roll_pitch_yaw_rad) {
  const Vec3& e = roll_pitch_yaw_rad;
  Eigen::Matrix3d enu_ned;
  enu_ned << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  const Eigen::Matrix3d frd_flu = Vec3(1, -1, -1).asDiagonal();
  Isometry T = Isometry::Identity();
  T.linear() = enu_ned *
               (Eigen::AngleAxisd(e[2], Vec3::UnitZ()) * Eigen::AngleAxisd(e[1], Vec3::UnitY()) *
                Eigen::AngleAxisd(e[0], Vec3::UnitX()))
                   .toRotationMatrix() *
               frd_flu;
  return T;
}

TEST(MavlinkBorder, EverySwapIsItsOwnInverse) {  // (14)
  for (std::uint64_t i = 0; i < 100; ++i) {
    const auto random = [&](std::uint64_t index) {
      return 20.0 * uniform01({1, Stream::bench, i, index}) - 10.0;
    };
    const Vec3 v(random(0), random(1), random(2));
    EXPECT_LT((swap_enu_ned(swap_enu_ned(v)) - v).norm(), kExact);
    EXPECT_LT((swap_flu_frd(swap_flu_frd(v)) - v).norm(), kExact);
    EXPECT_LT(std::abs(wrap_angle_rad(swap_yaw_enu_ned(swap_yaw_enu_ned(random(3))) - random(3))),
              kExact);
  }
}

TEST(MavlinkBorder, AttitudeSurvivesTheRoundTrip) {  // (14)
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const auto random = [&](std::uint64_t index) {
      return 2.0 * uniform01({2, Stream::bench, i, index}) - 1.0;
    };
    // pitch stays clear of 90 deg, where roll and yaw turn about the same axis
    const Vec3 sent(kPi * random(0), 1.5 * random(1), kPi * random(2));
    const Vec3 read = roll_pitch_yaw_ned_frd(world_body_of(sent));
    EXPECT_LT(std::abs(wrap_angle_rad(read[0] - sent[0])), kExact);
    EXPECT_LT(std::abs(read[1] - sent[1]), kExact);
    EXPECT_LT(std::abs(wrap_angle_rad(read[2] - sent[2])), kExact);
  }
}

TEST(MavlinkBorder, TelemetryHasMavlinksSigns) {
  VehicleState state;
  state.T_world_body.translation() = Vec3(1.0, 2.0, 3.0);
  state.v_world_m_s = Vec3(4.0, 5.0, 6.0);
  state.omega_body_rad_s = Vec3(0.1, 0.2, 0.3);
  // facing north, nose 0.2 rad up: a turn to the left about z, then a negative turn about body y
  state.T_world_body.linear() =
      (Eigen::AngleAxisd(kPi / 2.0, Vec3::UnitZ()) * Eigen::AngleAxisd(-0.2, Vec3::UnitY()))
          .toRotationMatrix();
  const LocalPositionNed position = said<LocalPositionNed>({.estimate = state, .time_boot_ms = 77});
  EXPECT_EQ(position.time_boot_ms, 77U);
  EXPECT_EQ(position.p_ned_m, (std::array{2.0F, 1.0F, -3.0F}));
  EXPECT_EQ(position.v_ned_m_s, (std::array{5.0F, 4.0F, -6.0F}));
  const Attitude attitude = said<Attitude>({.estimate = state, .time_boot_ms = 77});
  EXPECT_NEAR(attitude.roll_pitch_yaw_rad[2], 0.0, 1e-7);  // float
  EXPECT_NEAR(attitude.roll_pitch_yaw_rad[1], 0.2, 1e-7);
  EXPECT_NEAR(attitude.roll_pitch_yaw_rad[0], 0.0, 1e-7);
  EXPECT_EQ(attitude.omega_frd_rad_s, (std::array{0.1F, -0.2F, -0.3F}));
}

}  // namespace
}  // namespace gnbv::mavlink
