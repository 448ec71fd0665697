#include "bench/cloud_faults.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bench/voxel_set.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

// Codes have room for 2^20 voxels to each side of the origin.
const double kFarthestCoordinate_m = 0x1p20 * kCoverageSizes_m[0];

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

struct Unit {
  const char* name;
  double per_m;
};

void need_metres(const std::string& name, double cloud_m, double structure_m) {
  // a third of the structure seen, or noise of three times its size, would still be told apart
  constexpr double kSlack = 3.0;
  for (const Unit& unit : {Unit{"millimetres", 1000.0}, Unit{"centimetres", 100.0}}) {
    const auto is_near = [&](double ratio) {
      return ratio > unit.per_m / kSlack && ratio < unit.per_m * kSlack;
    };
    if (is_near(cloud_m / structure_m)) {
      throw BadInput(
          fmt::format("{}: looks like {}: its extent is {:.1f} m against the mesh's {:.1f} m; "
                      "scale the cloud by {}",
                      name, unit.name, cloud_m, structure_m, 1.0 / unit.per_m));
    }
    if (is_near(structure_m / cloud_m)) {
      throw BadInput(
          fmt::format("{}: the mesh looks like {}: its extent is {:.1f} m against the cloud's "
                      "{:.1f} m; add --set structure.file.scale={}",
                      name, unit.name, structure_m, cloud_m, 1.0 / unit.per_m));
    }
  }
}

std::string text_of(const Box3& box_m) {
  const Vec3 lo = box_m.min();
  const Vec3 hi = box_m.max();
  return fmt::format("[{:.2f}, {:.2f}, {:.2f}] to [{:.2f}, {:.2f}, {:.2f}] m", lo.x(), lo.y(),
                     lo.z(), hi.x(), hi.y(), hi.z());
}

}  // namespace

void need_scorable(const std::string& name, std::span<const Vec3f> cloud_world_m,
                   const Box3& structure_m) {
  if (cloud_world_m.empty()) throw BadInput(fmt::format("{}: has no points", name));
  const auto refuse = [&](std::size_t i, const char* what) {
    const Vec3f& p = cloud_world_m[i];
    throw BadInput(fmt::format("{}: point {} (counted from 0) is ({}, {}, {}) m: {}", name, i,
                               p.x(), p.y(), p.z(), what));
  };
  for (std::size_t i = 0; i < cloud_world_m.size(); ++i) {
    if (!cloud_world_m[i].allFinite()) refuse(i, "not finite");
  }
  need_metres(name, extent_m(cloud_world_m), structure_m.diagonal().norm());
  for (std::size_t i = 0; i < cloud_world_m.size(); ++i) {
    const auto farthest_m = static_cast<double>(cloud_world_m[i].cwiseAbs().maxCoeff());
    if (!(farthest_m < kFarthestCoordinate_m)) refuse(i, "too far from the origin");
  }
}

void need_near(const std::string& name, std::span<const Vec3f> cloud_world_m,
               const CloudDistances& distances, const Box3& structure_m) {
  if (distances.accuracy_m < kFarthest_m) return;
  Box3 cloud_m;
  for (const Vec3f& p_m : cloud_world_m) cloud_m.extend(p_m.cast<double>());
  throw BadInput(
      fmt::format("{}: no point within {} m of the mesh: the cloud spans {}, the mesh {}: another "
                  "frame, axis order or mesh?",
                  name, kFarthest_m, text_of(cloud_m), text_of(structure_m)));
}

}  // namespace gnbv
