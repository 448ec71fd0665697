// PX4's jerk-limited trajectories (VelocitySmoothing.cpp, TrajMath.hpp), one axis at a time: an
// S-curve of at most three phases of constant jerk (+j, 0, -j) to a wanted speed. Nothing is
// planned ahead: the curve is found anew at every step, so that the wanted speed may change.
#pragma once

#include <array>

namespace gnbv {

struct SmoothedAxis {
  double x_m = 0.0;
  double v_m_s = 0.0;
  double a_m_s2 = 0.0;
};

struct AxisLimits {
  double a_max_m_s2 = 3.0;
  double jerk_m_s3 = 4.0;
};

/// The way to a wanted speed: acceleration goes to its peak with the jerk, stays there, and
/// returns to zero with the opposite jerk.
struct SpeedChange {
  double jerk_m_s3 = 0.0;  // signed: that of the first phase
  double t1_s = 0.0;
  double t2_s = 0.0;
  double t3_s = 0.0;
  double duration_s() const { return t1_s + t2_s + t3_s; }
};

/// The fastest way from `now` to the speed `v_m_s`.
SpeedChange fastest_change(const SmoothedAxis& now, double v_m_s, const AxisLimits& limits);

/// The same change with a lower peak, so that it takes `duration_s` (not less than the fastest), or
/// as long as the acceleration at hand allows.
SpeedChange stretched_change(const SmoothedAxis& now, double v_m_s, const AxisLimits& limits,
                             double duration_s);

/// Where the axis is after `dt_s` of the change; it keeps its speed after the end.
SmoothedAxis advance(const SmoothedAxis& now, const SpeedChange& change, double dt_s);

/// One step of all three axes to the wanted speeds; the slower ones are waited for, so that all
/// changes end together and a straight way stays nearly straight.
std::array<SmoothedAxis, 3> advance_together(const std::array<SmoothedAxis, 3>& axes,
                                             const std::array<double, 3>& v_m_s,
                                             const std::array<AxisLimits, 3>& limits, double dt_s);

/// The speed from which a vehicle can still come to rest within `distance_m`; the jerk is granted 4
/// a^2 / j of speed times half the distance (TrajMath.hpp, computeMaxSpeedFromDistance).
double braking_speed_m_s(double distance_m, const AxisLimits& limits);

}  // namespace gnbv
