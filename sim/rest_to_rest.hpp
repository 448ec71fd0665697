// How far along a leg the reference is: from rest to rest, limited in speed and acceleration, with
// the corners of the trapezoidal speed profile rounded so that the jerk is limited too.
#pragma once

#include <array>

namespace gnbv {

class RestToRest {
 public:
  struct Sample {
    double position = 0.0;
    double speed = 0.0;
    double acceleration = 0.0;
  };

  /// Any unit of length: metres or radians. distance >= 0, the limits > 0, smoothing_s > 0: the
  /// trapezoid is averaged over this time, which makes the jerk at most acceleration / smoothing_s.
  RestToRest(double distance, double speed_max, double acceleration_max, double smoothing_s);

  double duration_s() const { return trapezoid_s_ + smoothing_s_; }
  /// At `time_s` since the start; exactly (distance, 0, 0) from duration_s() on.
  Sample at(double time_s) const;

 private:
  struct Phase {
    double start_s = 0.0, integral = 0.0, position = 0.0, speed = 0.0, acceleration = 0.0;
  };
  struct Trapezoid {
    double integral = 0.0, position = 0.0, speed = 0.0;  // integral of the position over time
  };
  static Trapezoid along(const Phase& phase, double time_s);
  Trapezoid trapezoid(double time_s) const;

  double distance_;
  double smoothing_s_;
  double trapezoid_s_ = 0.0;
  std::array<Phase, 4> phases_;  // speed up, cruise, slow down, rest
};

}  // namespace gnbv
