#include "planner/symmetry/symmetry.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/module.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

// of pairs of keypoints
constexpr double kMinDistance_m = 1.0;  // nearer ones say little about the direction
constexpr double kMaxTilt_rad = deg_to_rad(10.0);
constexpr double kMaxNormalError_rad = deg_to_rad(30.0);
// of planes
constexpr double kBandwidth_m = 0.6;
constexpr std::size_t kMaxRefined = 5;
constexpr double kRefineReach_m = 1.5;
constexpr double kMaxGainOfRefining = 0.3;  // of support, with room: 0.15 on the aircraft
constexpr double kMinMoved = 0.25;  // below that the plane leaves nearly all points in place
constexpr std::size_t kMaxInliers = 4000;
// A wandering estimate lays a profile layer upon layer; an exact airliner has 55 thousand points.
constexpr std::size_t kMaxProfile = 100000;

/// (radius normal, offset from the centre): a plane where distances are metres. Its negative is the
/// same plane.
using Metric = Eigen::Vector4d;

Metric to_metric(const MirrorPlane& plane, const Extent& extent) {
  const double offset_m = plane.offset_m - plane.normal_world.dot(extent.center_world_m);
  return (Metric() << extent.radius_m * plane.normal_world, offset_m).finished();
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

/// Outside the grid unknown.
VoxelState state_at(const OccupancyGrid& grid, const Key& key) {
  const GridGeometry& geometry = grid.geometry();
  return geometry.contains(key) ? grid.state(geometry.index_of(key)) : VoxelState::unknown;
}

/// What is known of the voxel and the 26 around it: occupied if any is, free if all are. Beyond the
/// grid counts as free.
VoxelState state_around(const OccupancyGrid& grid, const Key& key) {
  if (!grid.geometry().contains(key)) return VoxelState::free;
  VoxelState around = VoxelState::free;
  for_each_key(keys_about(key), [&](const Key& near) {
    if (around == VoxelState::occupied) return;
    const VoxelState state = state_at(grid, near);
    if (state != VoxelState::free) around = state;
  });
  return around;
}

/// The direction from the point to the free voxels around it, two voxels each way; zero where none
/// is free.
Vec3f outward(const OccupancyGrid& grid, const Vec3f& p_world_m) {
  const Key key = grid.geometry().key_of(p_world_m);
  Eigen::Vector3i sum = Eigen::Vector3i::Zero();
  for_each_key(keys_about(key, 2), [&](const Key& near) {
    if (state_at(grid, near) != VoxelState::free) return;
    sum += Eigen::Vector3i(near[0] - key[0], near[1] - key[1], near[2] - key[2]);
  });
  return sum.cast<float>();
}

std::vector<ProfilePoint> oriented(std::span<const Vec3f> profile_world_m,
                                   const OccupancyGrid& grid, int threads) {
  std::vector<ProfilePoint> out;
  for (const Vec3f& p : profile_world_m) {
    if (p.allFinite()) out.push_back({.p_world_m = p});
  }
  out = evenly(std::move(out), kMaxProfile);
  for (ProfilePoint& point : out) point.outward_world = outward(grid, point.p_world_m);
  // a call of the module builds an index of all points, so the pieces are few and large
  const std::size_t piece = out.size() / std::max(threads, 1) + 1;
  parallel_for_chunks(threads, out.size(), piece, [&](std::size_t begin, std::size_t end) {
    symmetry_module().estimate_normals(out, begin, end);
  });
  return out;
}

/// Points that lie in occupied voxels, at most kMaxInliers of them, evenly chosen. (On thin wings a
/// quarter of a profile's points lie in voxels that other rays have cleared.)
std::vector<Vec3f> inliers(std::span<const Vec3f> profile_world_m, const OccupancyGrid& grid) {
  std::vector<Vec3f> all;
  for (const Vec3f& p : profile_world_m) {
    if (grid.state_at(p.cast<double>()) == VoxelState::occupied) all.push_back(p);
  }
  return evenly(std::move(all), kMaxInliers);
}

/// The centroid, and the root mean square distance from it.
Extent extent_of(std::span<const Vec3f> points_world_m) {
  const auto count = static_cast<double>(points_world_m.size());
  Extent extent;
  for (const Vec3f& p : points_world_m) extent.center_world_m += p.cast<double>() / count;
  double sum_m2 = 0.0;
  for (const Vec3f& p : points_world_m) {
    sum_m2 += (p.cast<double>() - extent.center_world_m).squaredNorm();
  }
  return {extent.center_world_m, std::sqrt(sum_m2 / count)};
}

bool is_upright(const MirrorPlane& plane) {
  return std::fabs(plane.normal_world.z()) <= std::sin(kMaxTilt_rad);
}

/// Clusters of the planes in the middle of pairs of keypoints whose normals mirror each other, too.
std::vector<MirrorPlane> rough_planes(std::span<const ProfilePoint> profile, const Extent& extent) {
  std::vector<KeypointPair> pairs;
  symmetry_module().match_keypoints(profile, pairs);
  std::vector<MirrorPlane> middles;
  for (const KeypointPair& pair : pairs) {
    const Vec3 a_m = pair.a_world_m.cast<double>();
    const Vec3 b_m = pair.b_world_m.cast<double>();
    if ((b_m - a_m).norm() < kMinDistance_m) continue;
    const MirrorPlane plane = plane_through(0.5 * (a_m + b_m), b_m - a_m);
    const Vec3 image = mirrored({plane.normal_world, 0.0}, pair.a_normal_world.cast<double>());
    if (image.dot(pair.b_normal_world.cast<double>()) < std::cos(kMaxNormalError_rad)) continue;
    if (is_upright(plane)) middles.push_back(plane);
  }
  std::vector<MirrorPlane> planes;
  for (const auto& [plane, votes] : cluster_planes(middles, extent, kBandwidth_m)) {
    planes.push_back(plane);
  }
  return planes;
}

struct Candidate {
  MirrorPlane plane;
  MirrorSupport support;
};

/// The planes that mirror enough of the profile onto measured surface, and do not just leave it in
/// place. The best supported comes first.
std::vector<Candidate> judged(std::span<const MirrorPlane> planes,
                              std::span<const Vec3f> inliers_world_m, const OccupancyGrid& grid,
                              double min_confirmed) {
  std::vector<Candidate> out;
  for (const MirrorPlane& plane : planes) {
    if (!is_upright(plane)) continue;
    const MirrorSupport support = mirror_support(grid, inliers_world_m, plane);
    if (support.moved < kMinMoved || support.confirmed < min_confirmed) continue;
    out.push_back({plane, support});
  }
  std::ranges::stable_sort(out, std::ranges::greater{},
                           [](const Candidate& c) { return c.support.support; });
  return out;
}

}  // namespace

const SymmetryModule& symmetry_module() {
  static auto* const module = reinterpret_cast<const SymmetryModule& (*)()>(function_in_module(
      {GNBV_SYMMETRY_MODULE, GNBV_SYMMETRY_MODULE_AS_BUILT, "PCL, Debian package libpcl-dev"},
      "gnbv_symmetry"));
  return module();
}

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

MirrorSupport mirror_support(const OccupancyGrid& grid, std::span<const Vec3f> points_world_m,
                             const MirrorPlane& plane) {
  constexpr double kMovedVoxels = 4.0;
  const double moved_min_m = kMovedVoxels * grid.geometry().resolution_m();
  std::size_t moved = 0, contradicted = 0, confirmed = 0;
  for (const Vec3f& point : points_world_m) {
    const Vec3 p_world_m = point.cast<double>();
    const Vec3 image_world_m = mirrored(plane, p_world_m);
    if ((image_world_m - p_world_m).norm() < moved_min_m) continue;
    ++moved;
    const VoxelState state = state_around(grid, grid.geometry().key_of(image_world_m));
    contradicted += state == VoxelState::free;
    confirmed += state == VoxelState::occupied;
  }
  if (moved == 0) return {};
  const auto total = static_cast<double>(moved);
  return {1.0 - static_cast<double>(contradicted) / total, static_cast<double>(confirmed) / total,
          total / static_cast<double>(points_world_m.size())};
}

Symmetry find_symmetry(const SymmetryConfig& config, std::span<const Vec3f> profile_world_m,
                       const OccupancyGrid& grid, int threads) {
  Symmetry symmetry;
  if (!config.enabled) return symmetry;
  const std::vector<Vec3f> inliers_world_m = inliers(profile_world_m, grid);
  if (inliers_world_m.empty()) return symmetry;
  const std::vector<ProfilePoint> profile = oriented(profile_world_m, grid, threads);
  const Extent extent = extent_of(inliers_world_m);
  // a rough plane misses thin wings, so it needs less confirmation
  const std::vector<Candidate> rough =
      judged(rough_planes(profile, extent), inliers_world_m, grid, 0.5 * config.min_confirmed);
  if (rough.empty()) return symmetry;
  // the best candidates that lie farther apart than refining moves them
  std::vector<MirrorPlane> planes;
  for (const auto& [plane, support] : rough) {
    const bool is_hopeless = support.support < config.min_support - kMaxGainOfRefining;
    if (is_hopeless || planes.size() == kMaxRefined) break;
    const bool is_new = std::ranges::none_of(planes, [&, &at = plane](const MirrorPlane& other) {
      return distance_m(at, other, extent) < kRefineReach_m;
    });
    if (is_new) planes.push_back(plane);
  }
  parallel_for(threads, planes.size(),
               [&](std::size_t i) { symmetry_module().refine_plane(profile, planes[i]); });
  const std::vector<Candidate> refined =
      judged(planes, inliers_world_m, grid, config.min_confirmed);
  const Candidate& best = refined.empty() ? rough.front() : refined.front();
  symmetry.support = best.support.support;
  symmetry.confirmed = best.support.confirmed;
  if (refined.empty() || symmetry.support < config.min_support) return symmetry;
  symmetry.plane = best.plane;
  for (const Vec3f& p : profile_world_m) {
    symmetry.mirrored_world_m.push_back(mirrored(best.plane, p.cast<double>()).cast<float>());
  }
  return symmetry;
}

std::size_t predict_surface(const Symmetry& symmetry, OccupancyGrid& grid) {
  for (const Vec3f& p : symmetry.mirrored_world_m) {
    const Key key = grid.geometry().key_of(p);
    if (grid.geometry().contains(key)) grid.predict(grid.geometry().index_of(key));
  }
  return grid.predicted_count();
}

}  // namespace gnbv
