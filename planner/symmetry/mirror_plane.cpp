#include "planner/symmetry/mirror_plane.hpp"

#include <algorithm>

namespace gnbv {
namespace {

/// (radius normal, offset from the centre): a plane where distances are metres. Its negative is the
/// same plane.
using Metric = Eigen::Vector4d;

Metric to_metric(const MirrorPlane& plane, const Extent& extent) {
  Metric out;
  out << extent.radius_m * plane.normal_world,
      plane.offset_m - plane.normal_world.dot(extent.center_world_m);
  return out;
}

/// `metric` or its negative, whichever is nearer to `reference`.
Metric aligned(const Metric& metric, const Metric& reference) {
  return metric.dot(reference) < 0.0 ? Metric(-metric) : metric;
}

struct Mode {
  Metric metric;
  std::size_t votes;
};

/// Climbs to a mode of the planes. A step of the mean shift goes to the mean of all planes within
/// the bandwidth, and scales its normal back to the radius.
Mode climb(Metric at, std::span<const Metric> all, double radius_m, double bandwidth_m) {
  constexpr int kMaxSteps = 20;
  constexpr double kStill_m = 1e-3;
  Mode mode = {at, 0};
  for (int step = 0; step < kMaxSteps; ++step) {
    Metric sum = Metric::Zero();
    mode.votes = 0;
    for (const Metric& metric : all) {
      const Metric near = aligned(metric, at);
      if ((near - at).squaredNorm() > bandwidth_m * bandwidth_m) continue;
      sum += near;
      ++mode.votes;
    }
    mode.metric = mode.votes == 0 ? at : Metric(sum / static_cast<double>(mode.votes));
    const double length = mode.metric.head<3>().norm();
    if (length > 0.0) mode.metric.head<3>() *= radius_m / length;
    if ((mode.metric - at).norm() < kStill_m) break;
    at = mode.metric;
  }
  return mode;
}

}  // namespace

double distance_m(const MirrorPlane& a, const MirrorPlane& b, const Extent& extent) {
  const Metric metric = to_metric(a, extent);
  return (aligned(to_metric(b, extent), metric) - metric).norm();
}

std::vector<PlaneCluster> cluster_planes(std::span<const MirrorPlane> planes, const Extent& extent,
                                         double bandwidth_m) {
  constexpr std::size_t kMaxSeeds = 500;
  std::vector<Metric> all;
  for (const MirrorPlane& plane : planes) all.push_back(to_metric(plane, extent));
  std::vector<Mode> modes;
  const std::size_t stride = (all.size() + kMaxSeeds - 1) / kMaxSeeds;
  for (std::size_t i = 0; i < all.size(); i += stride) {
    modes.push_back(climb(all[i], all, extent.radius_m, bandwidth_m));
  }
  std::ranges::stable_sort(modes, std::ranges::greater{}, &Mode::votes);
  // of modes nearer to each other than half a bandwidth, the one with most votes stays
  std::vector<Mode> distinct;
  std::vector<PlaneCluster> clusters;
  for (const Mode& mode : modes) {
    const bool is_new = std::ranges::none_of(distinct, [&](const Mode& other) {
      return (aligned(mode.metric, other.metric) - other.metric).norm() < 0.5 * bandwidth_m;
    });
    if (!is_new) continue;
    distinct.push_back(mode);
    const Vec3 normal_world = mode.metric.head<3>().normalized();
    const Vec3 foot_m = extent.center_world_m + mode.metric[3] * normal_world;
    clusters.push_back({plane_through(foot_m, normal_world), mode.votes});
  }
  return clusters;
}

}  // namespace gnbv
