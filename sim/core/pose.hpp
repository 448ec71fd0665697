// Frames and poses. World: ENU, metres, z up. Body: FLU. Optical: x right, y down, z forward.
// T_a_b maps coordinates in b to coordinates in a: T_world_camera = T_world_body * T_body_camera.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace gnbv {

using Vec3 = Eigen::Vector3d;
using Vec3f = Eigen::Vector3f;
using Isometry = Eigen::Isometry3d;
using Box3 = Eigen::AlignedBox3d;

constexpr double kPi = std::numbers::pi;
constexpr double deg_to_rad(double angle_deg) { return angle_deg * (kPi / 180.0); }
constexpr double rad_to_deg(double angle_rad) { return angle_rad * (180.0 / kPi); }

/// The same angle in (-pi, pi].
inline double wrap_angle_rad(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * kPi);
  return wrapped <= -kPi ? wrapped + 2.0 * kPi : wrapped;
}

/// A level pose of the vehicle at a view. Yaw turns about world z, 0 = east (+x).
struct ViewPose {
  Vec3 p_world_m = Vec3::Zero();
  double yaw_rad = 0.0;
  double gimbal_pitch_rad = 0.0;  // positive looks down; 0 without a gimbal
};

inline bool is_same_view(const ViewPose& a, const ViewPose& b) {
  return a.p_world_m == b.p_world_m && a.yaw_rad == b.yaw_rad &&
         a.gimbal_pitch_rad == b.gimbal_pitch_rad;
}

Isometry T_world_body(const ViewPose& pose);

/// Mounting of a sensor on the body: roll about x first, then pitch about y, then yaw about z.
Isometry mounted(const Vec3& p_body_m, double roll_rad, double pitch_rad, double yaw_rad);

/// The least turn that takes the direction of `from` to that of `to`; of opposite ones, one of the
/// half turns. Eigen's FromTwoVectors has an SVD for these, which takes the compiler 8 s.
Eigen::Quaterniond turn_between(const Vec3& from, const Vec3& to);

/// Heading of the body x axis in the world's horizontal plane, in (-pi, pi].
inline double yaw_of(const Isometry& T_world_body) {
  return std::atan2(T_world_body.linear()(1, 0), T_world_body.linear()(0, 0));
}

/// Squared distance from a point to the segment between two others, in m2.
inline double distance_to_segment_m2(const Vec3& p_m, const Vec3& from_m, const Vec3& to_m) {
  const Vec3 along_m = to_m - from_m;
  const double length2_m2 = along_m.squaredNorm();
  const double share =
      length2_m2 > 0.0 ? std::clamp((p_m - from_m).dot(along_m) / length2_m2, 0.0, 1.0) : 0.0;
  return (p_m - from_m - share * along_m).squaredNorm();
}
inline double distance_to_segment_m(const Vec3& p_m, const Vec3& from_m, const Vec3& to_m) {
  return std::sqrt(distance_to_segment_m2(p_m, from_m, to_m));
}

}  // namespace gnbv
