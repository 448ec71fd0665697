// Motion along one axis under a limited jerk, in metres or radians: PX4's smoothed change of speed
// (VelocitySmoothing.cpp, TrajMath.hpp), found anew at every step, and a whole leg from rest to
// rest.
#pragma once

#include <array>
#include <optional>

namespace gnbv {

struct Motion {
  double position = 0.0;
  double speed = 0.0;
  double acceleration = 0.0;
};

struct AxisLimits {
  double acceleration = 3.0;
  double jerk = 4.0;
};

/// A change of speed: acceleration goes to its peak with the jerk, stays there, and returns to zero
/// with the opposite jerk.
struct SpeedChange {
  double jerk = 0.0;  // signed: that of the first phase
  double t1_s = 0.0;
  double t2_s = 0.0;
  double t3_s = 0.0;
  double duration_s() const { return t1_s + t2_s + t3_s; }
};

/// The fastest change from `now` to that speed; or one with a lower peak that takes `duration_s`
/// (not less than the fastest), as far as the acceleration at hand allows.
SpeedChange speed_change(const Motion& now, double speed, const AxisLimits& limits,
                         std::optional<double> duration_s = std::nullopt);

/// The motion after `dt_s` of the change; it keeps its speed after the end.
Motion advance(const Motion& now, const SpeedChange& change, double dt_s);

/// One step of all three axes to the wanted speeds. The faster axes wait for the slowest: all
/// changes end together, and a straight way stays nearly straight.
std::array<Motion, 3> advance_together(const std::array<Motion, 3>& axes,
                                       const std::array<double, 3>& speeds,
                                       const std::array<AxisLimits, 3>& limits, double dt_s);

/// The speed from which a vehicle can still brake to `end_speed`, by default to rest, within
/// `distance`; the jerk is granted 4 a^2 / j of speed times half the distance (TrajMath.hpp,
/// computeMaxSpeedFromDistance).
double braking_speed(double distance, const AxisLimits& limits, double end_speed = 0.0);

/// From rest to rest in the least time that limits on speed, acceleration and jerk allow.
class RestToRest {
 public:
  struct Limits {  // all above 0
    double speed = 0.0;
    double acceleration = 0.0;
    double jerk = 0.0;
  };

  /// distance >= 0.
  RestToRest(double distance, const Limits& limits);

  double duration_s() const { return 2.0 * speeding_up_s_ + cruise_s_; }
  /// At `time_s` since the start; exactly (distance, 0, 0) from duration_s() on.
  Motion at(double time_s) const;

 private:
  Motion first_half(double time_s) const;

  double distance_;
  double jerk_;
  double jerk_s_ = 0.0;         // the acceleration grows, and later fades, for this long
  double speeding_up_s_ = 0.0;  // growing, constant and fading acceleration
  double cruise_s_ = 0.0;       // at the peak speed
};

}  // namespace gnbv
