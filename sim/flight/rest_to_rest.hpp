// How far along a leg the reference is: from rest to rest in the least time that limits on speed,
// acceleration and jerk allow.
#pragma once

namespace gnbv {

/// A leg whose reference takes longer is not begun: fly_leg() gives it up as a timeout at once.
constexpr double kLongestLeg_s = 3600.0;

class RestToRest {
 public:
  /// In any unit of length: metres or radians. All above 0.
  struct Limits {
    double speed = 0.0;
    double acceleration = 0.0;
    double jerk = 0.0;
  };
  struct Sample {
    double position = 0.0;
    double speed = 0.0;
    double acceleration = 0.0;
  };

  /// distance >= 0.
  RestToRest(double distance, const Limits& limits);

  double duration_s() const { return 2.0 * speeding_up_s_ + cruise_s_; }
  /// At `time_s` since the start; exactly (distance, 0, 0) from duration_s() on.
  Sample at(double time_s) const;

 private:
  Sample first_half(double time_s) const;

  double distance_;
  double jerk_;
  double jerk_s_ = 0.0;         // the acceleration grows, and later fades, for this long
  double speeding_up_s_ = 0.0;  // growing, constant and fading acceleration
  double cruise_s_ = 0.0;       // at the peak speed
};

}  // namespace gnbv
