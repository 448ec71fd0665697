#include "sim/flight/mixer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace gnbv {
namespace {

using Column = std::array<double, kRotors>;

constexpr double kYawHeadroom = 0.15;  // MINIMUM_YAW_MARGIN: yaw may ask for this much above full
constexpr double kHalfSqrt2 = 0.5 * std::numbers::sqrt2;

/// What one unit of roll, pitch and yaw torque asks of each rotor. Only the quadrant of a rotor
/// counts, as in PX4's normalised quad X.
struct QuadX {
  Column roll, pitch, yaw;
  explicit QuadX(const AirframeParameters& airframe) {
    for (std::size_t i = 0; i < kRotors; ++i) {
      const RotorMount& rotor = airframe.rotors[i];
      roll[i] = std::copysign(kHalfSqrt2, rotor.p_body_m.y());
      pitch[i] = std::copysign(kHalfSqrt2, -rotor.p_body_m.x());
      yaw[i] = -rotor.spin;  // the body is turned against the rotor
    }
  }
};

constexpr Column kThrustLess = {-1.0, -1.0, -1.0, -1.0};

void add(Column& commands, double gain, const Column& direction) {
  for (std::size_t i = 0; i < kRotors; ++i) commands[i] += gain * direction[i];
}

/// The step along `direction` that frees the rotors of saturation as far as it can: the sum of the
/// farthest steps asked for either way.
double desaturation_gain(const Column& commands, const Column& direction, double max) {
  double least = 0.0;
  double most = 0.0;
  for (std::size_t i = 0; i < kRotors; ++i) {
    const double excess = commands[i] < 0.0 ? commands[i] : std::max(commands[i] - max, 0.0);
    const double step = -excess / direction[i];
    least = std::min(least, step);
    most = std::max(most, step);
  }
  return least + most;
}

void desaturate(Column& commands, const Column& direction, double max, bool forward_only = false) {
  const double gain = desaturation_gain(commands, direction, max);
  if (forward_only && gain < 0.0) return;
  add(commands, gain, direction);
  // half of what is left balances what cannot be freed between both ends
  add(commands, 0.5 * desaturation_gain(commands, direction, max), direction);
}

double share_of(const Column& commands, const Column& column) {
  double dot = 0.0;
  double squared = 0.0;
  for (std::size_t i = 0; i < kRotors; ++i) {
    dot += commands[i] * column[i];
    squared += column[i] * column[i];
  }
  return dot / squared;
}

}  // namespace

MixerOutput mix(const AirframeParameters& airframe, const Vec3& torque, double thrust) {
  const QuadX quad(airframe);
  MixerOutput out;
  Column& commands = out.commands;
  commands.fill(thrust);
  add(commands, torque.x(), quad.roll);
  add(commands, torque.y(), quad.pitch);
  desaturate(commands, kThrustLess, 1.0, true);
  desaturate(commands, quad.roll, 1.0);
  desaturate(commands, quad.pitch, 1.0);
  add(commands, torque.z(), quad.yaw);
  desaturate(commands, quad.yaw, 1.0 + kYawHeadroom);
  desaturate(commands, kThrustLess, 1.0, true);
  for (double& command : commands) command = std::clamp(command, 0.0, 1.0);

  out.torque = {share_of(commands, quad.roll), share_of(commands, quad.pitch),
                share_of(commands, quad.yaw)};
  return out;
}

}  // namespace gnbv
