#include "sensors/exact_faces.hpp"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

namespace gnbv {
namespace {

/// A face as seen from where a ray begins. Differences of floats, and what shares an edge computes
/// the same product with the other sign: a ray is never outside both.
struct SeenFace {
  Vec3 a, b, c;
  Vec3 bc, ca, ab;  // b x c and so on
};

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
          a.x() * b.y() - a.y() * b.x()};
}
double dot(const Vec3& a, const Vec3& b) { return a.x() * b.x() + a.y() * b.y() + a.z() * b.z(); }

SeenFace seen_from(const Vec3& p_world_m, const FaceCorners& corners) {
  const Vec3 a = corners[0].cast<double>() - p_world_m;
  const Vec3 b = corners[1].cast<double>() - p_world_m;
  const Vec3 c = corners[2].cast<double>() - p_world_m;
  return {a, b, c, cross(b, c), cross(c, a), cross(a, b)};
}

/// Where the ray meets the face, in lengths of its direction; NaN where it does not. The place is a
/// mean of the corners, so that it lies on the face even where that is a sliver.
float meets(const SeenFace& face, const Vec3& direction) {
  const double u = dot(direction, face.bc);
  const double v = dot(direction, face.ca);
  const double w = dot(direction, face.ab);
  const double sum = u + v + w;
  const bool is_met = (std::min({u, v, w}) >= 0.0 || std::max({u, v, w}) <= 0.0) && sum != 0.0;
  if (!is_met) return std::numeric_limits<float>::quiet_NaN();
  const double along =
      u * dot(direction, face.a) + v * dot(direction, face.b) + w * dot(direction, face.c);
  return static_cast<float>(along / (sum * dot(direction, direction)));
}

const FaceCorners& face_of(const void* faces, unsigned index) {
  return static_cast<const FaceCorners*>(faces)[index];
}

/// Calls met(lane, distance) for the rays that meet the face after their near end.
template <typename Arguments, typename Met>
void for_each_met(const Arguments& arguments, RTCRayN* rays, const Met& met) {
  const FaceCorners& corners = face_of(arguments.geometryUserPtr, arguments.primID);
  const unsigned n = arguments.N;
  Vec3 origin_world_m = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  SeenFace face;
  for (unsigned lane = 0; lane < n; ++lane) {
    if (arguments.valid[lane] == 0) continue;
    const Vec3 origin(RTCRayN_org_x(rays, n, lane), RTCRayN_org_y(rays, n, lane),
                      RTCRayN_org_z(rays, n, lane));
    if (origin != origin_world_m) {  // most rays begin where their neighbours do
      face = seen_from(origin, corners);
      origin_world_m = origin;
    }
    const float distance = meets(face, {RTCRayN_dir_x(rays, n, lane), RTCRayN_dir_y(rays, n, lane),
                                        RTCRayN_dir_z(rays, n, lane)});
    if (distance > RTCRayN_tnear(rays, n, lane)) met(lane, distance);
  }
}

void find_first(const RTCIntersectFunctionNArguments* arguments) {
  const unsigned n = arguments->N;
  RTCRayN* const rays = RTCRayHitN_RayN(arguments->rayhit, n);
  RTCHitN* const hits = RTCRayHitN_HitN(arguments->rayhit, n);
  const std::pair face(arguments->geomID, arguments->primID);
  for_each_met(*arguments, rays, [&](unsigned lane, float distance) {
    float& far = RTCRayN_tfar(rays, n, lane);
    unsigned& geometry = RTCHitN_geomID(hits, n, lane);  // the last of all where nothing was hit
    unsigned& index = RTCHitN_primID(hits, n, lane);
    if (distance > far || (distance == far && face >= std::pair(geometry, index))) return;
    far = distance;
    std::tie(geometry, index) = face;
  });
}

void find_any(const RTCOccludedFunctionNArguments* arguments) {
  const unsigned n = arguments->N;
  for_each_met(*arguments, arguments->ray, [&](unsigned lane, float distance) {
    float& far = RTCRayN_tfar(arguments->ray, n, lane);
    if (distance <= far) far = -std::numeric_limits<float>::infinity();
  });
}

/// Far wider than Embree's rounding, which differs by instruction set.
void bound(const RTCBoundsFunctionArguments* arguments) {
  const auto& [a, b, c] = face_of(arguments->geometryUserPtr, arguments->primID);
  const Vec3f lower = a.cwiseMin(b).cwiseMin(c);
  const Vec3f upper = a.cwiseMax(b).cwiseMax(c);
  const float margin_m = 1e-3F + 1e-6F * lower.cwiseAbs().cwiseMax(upper.cwiseAbs()).maxCoeff();
  RTCBounds& box = *arguments->bounds_o;
  box.lower_x = lower.x() - margin_m;
  box.lower_y = lower.y() - margin_m;
  box.lower_z = lower.z() - margin_m;
  box.upper_x = upper.x() + margin_m;
  box.upper_y = upper.y() + margin_m;
  box.upper_z = upper.z() + margin_m;
}

}  // namespace

void set_exact_faces(RTCGeometry geometry, std::span<const FaceCorners> faces) {
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(faces.size()));
  // Embree hands the pointer on; nothing writes through it
  rtcSetGeometryUserData(geometry, const_cast<FaceCorners*>(faces.data()));
  rtcSetGeometryBoundsFunction(
      geometry, [](const RTCBoundsFunctionArguments* a) { bound(a); }, nullptr);
  rtcSetGeometryIntersectFunction(geometry, find_first);
  rtcSetGeometryOccludedFunction(geometry, find_any);
}

}  // namespace gnbv
