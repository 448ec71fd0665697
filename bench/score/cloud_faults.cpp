#include "bench/score/cloud_faults.hpp"

#include <algorithm>
#include <iterator>

#include "bench/score/cloud_metrics.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// Diagonal of the box that holds nine tenths of the points along each axis: a few strays do not
/// change it.
double extent_m(std::span<const Vec3f> cloud_m) {
  constexpr std::size_t kLookedAt = 10000;
  const std::size_t stride = cloud_m.size() / kLookedAt + 1;
  Vec3 size_m;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (std::size_t i = 0; i < cloud_m.size(); i += stride) {
      values.push_back(static_cast<double>(cloud_m[i][axis]));
    }
    std::sort(values.begin(), values.end());
    const std::size_t cut = values.size() / 20;
    size_m[axis] = values[values.size() - 1 - cut] - values[cut];
  }
  return size_m.norm();
}

/// What may be wrong with a cloud that is nowhere near the mesh.
std::string guess(const Vec3& cloud_centre_m, double cloud_m, double structure_m) {
  if (cloud_centre_m.norm() > 1e4 && cloud_centre_m.norm() > 4.0 * cloud_m) {
    return fmt::format("it looks like a map grid's: --offset-m={:.0f},{:.0f},0 moves the cloud",
                       -cloud_centre_m.x(), -cloud_centre_m.y());
  }
  // a third of the structure seen, or noise of three times its size, would still be told apart
  constexpr double kSlack = 3.0;
  for (const auto& [name, per_m] : {std::pair("millimetres", 1000.0), {"centimetres", 100.0}}) {
    const auto is_near = [per_m = per_m](double ratio) {
      return ratio > per_m / kSlack && ratio < per_m * kSlack;
    };
    if (is_near(cloud_m / structure_m)) {
      return fmt::format("it looks like {}: scale the cloud by {}", name, 1.0 / per_m);
    }
    if (is_near(structure_m / cloud_m)) {
      return fmt::format("the mesh looks like {}: add --set structure.file.scale={}", name,
                         1.0 / per_m);
    }
  }
  return "another frame, axis order or mesh?";
}

std::string text_of(const Box3& box_m) {
  const Vec3 lo = box_m.min();
  const Vec3 hi = box_m.max();
  return fmt::format("[{:.2f}, {:.2f}, {:.2f}] to [{:.2f}, {:.2f}, {:.2f}] m", lo.x(), lo.y(),
                     lo.z(), hi.x(), hi.y(), hi.z());
}

[[noreturn]] void refuse(const std::string& name, std::span<const Vec3f> cloud_world_m,
                         std::size_t i, std::string_view what) {
  const Vec3f& p = cloud_world_m[i];
  throw BadInput("{}: point {} (counted from 0) is ({}, {}, {}) m: {}", name, i, p.x(), p.y(),
                 p.z(), what);
}

void need_finite(const std::string& name, std::span<const Vec3f> cloud_world_m) {
  for (std::size_t i = 0; i < cloud_world_m.size(); ++i) {
    if (!cloud_world_m[i].allFinite()) refuse(name, cloud_world_m, i, "not finite");
  }
}

void need_in_range(const std::string& name, std::span<const Vec3f> cloud_world_m, std::size_t i,
                   double voxel_m) {
  constexpr double kVoxelsOut = 0x1p20;  // to each side of the origin: more have no code
  const auto farthest_m = static_cast<double>(cloud_world_m[i].cwiseAbs().maxCoeff());
  if (farthest_m < kVoxelsOut * voxel_m) return;
  refuse(name, cloud_world_m, i,
         fmt::format("too far from the origin for voxels of {} m", voxel_m));
}

void need_near(const std::string& name, std::span<const Vec3f> cloud_world_m, const RayScene& scene,
               const Box3& structure_m) {
  const auto is_near = [&](const Vec3f& p_m) {
    return scene.distance_to_structure_m(p_m.cast<double>(), kFarthest_m) < kFarthest_m;
  };
  if (std::any_of(cloud_world_m.begin(), cloud_world_m.end(), is_near)) return;
  Box3 cloud_m;
  for (const Vec3f& p_m : cloud_world_m) cloud_m.extend(p_m.cast<double>());
  throw BadInput("{}: no point within {} m of the mesh: the cloud spans {}, the mesh {}: {}", name,
                 kFarthest_m, text_of(cloud_m), text_of(structure_m),
                 guess(cloud_m.center(), extent_m(cloud_world_m), structure_m.diagonal().norm()));
}

}  // namespace

void need_voxels(const std::string& name, std::span<const Vec3f> cloud_world_m,
                 double smallest_voxel_m) {
  need_finite(name, cloud_world_m);
  for (std::size_t i = 0; i < cloud_world_m.size(); ++i) {
    need_in_range(name, cloud_world_m, i, smallest_voxel_m);
  }
}

std::vector<Vec3f> scorable_points(const std::string& name, std::span<const Vec3f> cloud_world_m,
                                   double floor_z_m, const RayScene& scene, const Box3& structure_m,
                                   double smallest_voxel_m) {
  if (cloud_world_m.empty()) throw BadInput("{}: has no points", name);
  need_finite(name, cloud_world_m);
  const auto is_below = [&](const Vec3f& p_m) {
    return static_cast<double>(p_m.z()) < floor_z_m - kCoverReach_m;
  };
  std::vector<Vec3f> points_m;
  std::remove_copy_if(cloud_world_m.begin(), cloud_world_m.end(), std::back_inserter(points_m),
                      is_below);
  if (points_m.empty()) {
    throw BadInput("{}: all {} points lie below z = {} m: nothing there is asked for", name,
                   cloud_world_m.size(), floor_z_m);
  }
  need_near(name, points_m, scene, structure_m);
  for (std::size_t i = 0; i < cloud_world_m.size(); ++i) {
    if (!is_below(cloud_world_m[i])) need_in_range(name, cloud_world_m, i, smallest_voxel_m);
  }
  return points_m;
}

}  // namespace gnbv
