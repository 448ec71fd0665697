#include "sim/flight/mixer.hpp"

#include <algorithm>
#include <cmath>

namespace gnbv {
namespace {

constexpr double kYawHeadroom = 0.15;  // MINIMUM_YAW_MARGIN: yaw may ask for this much above full

/// The commands of the rotors there are; the rest stay 0.
class Desaturation {
 public:
  explicit Desaturation(std::size_t rotors) : rotors_(rotors) {}

  void add(double gain, const RotorValues& direction) {
    for (std::size_t i = 0; i < rotors_; ++i) commands[i] += gain * direction[i];
  }

  void along(const RotorValues& direction, double max) {
    add(gain(direction, max), direction);
    // half of what is left balances what cannot be freed between both ends
    add(0.5 * gain(direction, max), direction);
  }

  void thrust_down(const RotorValues& thrust, double max) {
    RotorValues less{};
    for (std::size_t i = 0; i < rotors_; ++i) less[i] = -thrust[i];
    if (gain(less, max) >= 0.0) along(less, max);
  }

  double share_of(const TorqueAllocation& axis) const {
    double dot = 0.0;
    for (std::size_t i = 0; i < rotors_; ++i) dot += commands[i] * axis.share[i];
    return dot / axis.share_divisor;
  }

  RotorCommands commands{};

 private:
  /// The step along `direction` that frees the rotors of saturation as far as it can: the sum of
  /// the farthest steps asked for either way.
  double gain(const RotorValues& direction, double max) const {
    double least = 0.0;
    double most = 0.0;
    for (std::size_t i = 0; i < rotors_; ++i) {
      if (std::abs(direction[i]) < 1e-3) continue;  // it hardly moves this rotor
      const double excess = commands[i] < 0.0 ? commands[i] : std::max(commands[i] - max, 0.0);
      const double step = -excess / direction[i];
      least = std::min(least, step);
      most = std::max(most, step);
    }
    return least + most;
  }

  std::size_t rotors_;
};

}  // namespace

MixerOutput mix(const Allocation& allocation, const Vec3& torque, double thrust) {
  const auto& [roll, pitch, yaw] = allocation.torque;
  Desaturation rotors(allocation.rotors);
  rotors.add(thrust, allocation.thrust);
  rotors.add(torque.x(), roll.command);
  rotors.add(torque.y(), pitch.command);
  rotors.thrust_down(allocation.thrust, 1.0);
  rotors.along(roll.command, 1.0);
  rotors.along(pitch.command, 1.0);
  rotors.add(torque.z(), yaw.command);
  rotors.along(yaw.command, 1.0 + kYawHeadroom);
  rotors.thrust_down(allocation.thrust, 1.0);
  for (double& command : rotors.commands) command = std::clamp(command, 0.0, 1.0);
  return {rotors.commands, {rotors.share_of(roll), rotors.share_of(pitch), rotors.share_of(yaw)}};
}

}  // namespace gnbv
