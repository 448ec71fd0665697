#include "planner/symmetry/mirror_plane.hpp"

#include <algorithm>

namespace gnbv {
namespace {

using Vec4 = Eigen::Vector4d;

/// (radius normal, offset from the centre): a plane where distances are metres. Its negative is the
/// same plane.
Vec4 to_metric(const MirrorPlane& plane, const Extent& extent) {
  Vec4 out;
  out << extent.radius_m * plane.normal_world,
      plane.offset_m - plane.normal_world.dot(extent.center_world_m);
  return out;
}

MirrorPlane from_metric(const Vec4& metric, const Extent& extent) {
  const Vec3 normal_world = metric.head<3>().normalized();
  return plane_through(extent.center_world_m + metric[3] * normal_world, normal_world);
}

/// `metric` or its negative, whichever is nearer to `reference`.
Vec4 aligned(const Vec4& metric, const Vec4& reference) {
  return metric.dot(reference) < 0.0 ? Vec4(-metric) : metric;
}

struct Mode {
  Vec4 metric;
  std::size_t votes;
};

/// One step of the mean shift: the mean of all planes within the bandwidth, with its normal scaled
/// back to the radius.
Mode shifted(const Vec4& at, std::span<const Vec4> all, const Extent& extent, double bandwidth_m) {
  Vec4 sum = Vec4::Zero();
  std::size_t votes = 0;
  for (const Vec4& metric : all) {
    const Vec4 near = aligned(metric, at);
    if ((near - at).squaredNorm() > bandwidth_m * bandwidth_m) continue;
    sum += near;
    ++votes;
  }
  Vec4 mean = votes == 0 ? at : Vec4(sum / static_cast<double>(votes));
  const double length = mean.head<3>().norm();
  if (length > 0.0) mean.head<3>() *= extent.radius_m / length;
  return {mean, votes};
}

Mode climb(Vec4 at, std::span<const Vec4> all, const Extent& extent, double bandwidth_m) {
  constexpr int kMaxSteps = 20;
  constexpr double kStill_m = 1e-3;
  Mode mode = {at, 0};
  for (int step = 0; step < kMaxSteps; ++step) {
    mode = shifted(at, all, extent, bandwidth_m);
    if ((mode.metric - at).norm() < kStill_m) break;
    at = mode.metric;
  }
  return mode;
}

}  // namespace

Vec3 mirrored(const MirrorPlane& plane, const Vec3& p_world_m) {
  return p_world_m -
         2.0 * (plane.normal_world.dot(p_world_m) - plane.offset_m) * plane.normal_world;
}

MirrorPlane plane_through(const Vec3& p_world_m, const Vec3& normal_world) {
  Vec3 n = normal_world.normalized();
  const bool is_folded = n.x() != 0.0 ? n.x() < 0.0 : (n.y() != 0.0 ? n.y() < 0.0 : n.z() < 0.0);
  if (is_folded) n = -n;
  return {n, n.dot(p_world_m)};
}

double distance_m(const MirrorPlane& a, const MirrorPlane& b, const Extent& extent) {
  const Vec4 metric = to_metric(a, extent);
  return (aligned(to_metric(b, extent), metric) - metric).norm();
}

std::vector<PlaneCluster> cluster_planes(std::span<const MirrorPlane> planes, const Extent& extent,
                                         double bandwidth_m) {
  constexpr std::size_t kMaxSeeds = 500;
  std::vector<Vec4> all;
  for (const MirrorPlane& plane : planes) all.push_back(to_metric(plane, extent));

  std::vector<Mode> modes;
  const std::size_t stride = (all.size() + kMaxSeeds - 1) / kMaxSeeds;
  for (std::size_t i = 0; i < all.size(); i += stride) {
    modes.push_back(climb(all[i], all, extent, bandwidth_m));
  }
  std::stable_sort(modes.begin(), modes.end(),
                   [](const Mode& a, const Mode& b) { return a.votes > b.votes; });
  // of modes nearer to each other than half a bandwidth, the one with most votes stays
  std::vector<Mode> distinct;
  for (const Mode& mode : modes) {
    const bool is_new = std::none_of(distinct.begin(), distinct.end(), [&](const Mode& other) {
      return (aligned(mode.metric, other.metric) - other.metric).norm() < 0.5 * bandwidth_m;
    });
    if (is_new) distinct.push_back(mode);
  }
  std::vector<PlaneCluster> clusters;
  for (const Mode& mode : distinct) {
    clusters.push_back({from_metric(mode.metric, extent), mode.votes});
  }
  return clusters;
}

}  // namespace gnbv
