#include "sim/core/pose.hpp"

namespace gnbv {

Isometry T_world_body(const ViewPose& pose) {
  Isometry T = Isometry::Identity();
  T.translate(pose.p_world_m);
  T.rotate(Eigen::AngleAxisd(pose.yaw_rad, Vec3::UnitZ()));
  return T;
}

Isometry mounted(const Vec3& p_body_m, double roll_rad, double pitch_rad, double yaw_rad) {
  Isometry T = Isometry::Identity();
  T.translate(p_body_m);
  T.rotate(Eigen::AngleAxisd(yaw_rad, Vec3::UnitZ()));
  T.rotate(Eigen::AngleAxisd(pitch_rad, Vec3::UnitY()));
  T.rotate(Eigen::AngleAxisd(roll_rad, Vec3::UnitX()));
  return T;
}

Eigen::Quaterniond turn_between(const Vec3& from, const Vec3& to) {
  const Vec3 a = from.normalized();
  const Vec3 b = to.normalized();
  const double cosine = b.dot(a);
  constexpr double kOpposite = -1.0 + 1e-12;
  Eigen::Quaterniond q(0.0, 0.0, 0.0, 0.0);
  if (cosine < kOpposite) {
    q.vec() = a.unitOrthogonal();
    return q;
  }
  const double twice_w = std::sqrt((1.0 + cosine) * 2.0);
  q.vec() = a.cross(b) * (1.0 / twice_w);
  q.w() = twice_w * 0.5;
  return q;
}

}  // namespace gnbv
