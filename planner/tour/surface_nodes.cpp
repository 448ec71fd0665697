#include "planner/tour/surface_nodes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "planner/map/ray_walk.hpp"

namespace gnbv {
namespace {

constexpr std::array<double, 4> kDistances = {0.25, 0.45, 0.65, 0.85};  // of the range
constexpr std::array<double, 5> kAcross = {-0.8, -0.4, 0.0, 0.4, 0.8};  // of the half opening
constexpr int kBearings = 16;
constexpr double kMostOff_rad = deg_to_rad(60.0);  // of the bearing, from the normal's
constexpr double kLeastCosine = 0.26;              // 75 deg of incidence
constexpr int kFound = -1;                         // SearchedCubes

struct Found {
  double score;
  Vec3 p_world_m;
};

/// Whether the line from the origin meets no occupied voxel but the target's and its neighbours.
bool is_hit_first(const OccupancyGrid& grid, const Vec3& origin_world_m,
                  const Vec3& target_world_m) {
  const GridGeometry& geometry = grid.geometry();
  const Key target = geometry.key_of(target_world_m);
  bool is_clear = true;
  walk_ray(geometry, origin_world_m.cast<float>(), target_world_m.cast<float>(),
           [&](const Key& key) {
             if (!geometry.contains(key)) return true;
             if (grid.state(geometry.index_of(key)) != VoxelState::occupied) return true;
             for (std::size_t a = 0; a < 3; ++a) {
               is_clear = is_clear && std::abs(key[a] - target[a]) <= 1;
             }
             return false;
           });
  return is_clear;
}

/// Directions from the target back to the vehicle: a camera that looks `down` below the horizon has
/// the target in its image when it lies that much above the vehicle, give or take half its opening;
/// the vehicle turns to any bearing.
template <typename Use>
void for_each_direction(const CameraModel& camera, const Vec3& normal, const Use& use) {
  const Vec3 axis = camera.T_body_camera.linear().col(2);  // where it looks
  const double down_rad = -std::asin(std::clamp(axis.z(), -1.0, 1.0));
  const bool has_bearing = normal.head<2>().norm() > 0.3;
  const double normal_bearing_rad = std::atan2(normal.y(), normal.x());
  for (int b = 0; b < kBearings; ++b) {
    const double bearing_rad = 2.0 * kPi * b / kBearings;
    const double off_rad = std::fabs(wrap_angle_rad(bearing_rad - normal_bearing_rad));
    if (has_bearing && off_rad > kMostOff_rad) continue;
    for (const double across : kAcross) {
      const double up_rad = down_rad + 0.5 * across * camera.config.fov_y_rad;
      const Vec3 direction(std::cos(up_rad) * std::cos(bearing_rad),
                           std::cos(up_rad) * std::sin(bearing_rad), std::sin(up_rad));
      if (direction.dot(normal) >= kLeastCosine) use(direction);
    }
  }
}

}  // namespace

std::vector<Vec3> points_to_see(const NodeSearch& search, const Patch& patch, std::size_t most) {
  const Vec3 target_m = patch.target_m.cast<double>();
  const Vec3 normal = patch.normal.cast<double>();
  const GridGeometry& geometry = search.grid.geometry();
  std::vector<Found> found;
  for (const CameraModel& camera : search.cameras) {
    for_each_direction(camera, normal, [&](const Vec3& direction) {
      for (const double share : kDistances) {
        const Vec3 p_m = target_m + share * camera.config.range_max_m * direction;
        const Key key = geometry.key_of(p_m);
        if (!search.space.is_open(search.grid, key)) continue;
        const Vec3 center_m = geometry.center_m(key);
        if (!is_hit_first(search.grid, center_m, target_m)) continue;
        found.push_back({direction.dot(normal) * (1.2 - share), center_m});
      }
    });
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Found& a, const Found& b) { return a.score > b.score; });
  std::vector<Vec3> points_m;
  for (const Found& one : found) {
    if (points_m.size() == most) break;
    const bool is_taken = std::any_of(points_m.begin(), points_m.end(), [&](const Vec3& other) {
      return (other - one.p_world_m).norm() < 1.0;
    });
    if (!is_taken) points_m.push_back(one.p_world_m);
  }
  return points_m;
}

std::vector<Vec3> points_for_unseen(const NodeSearch& search, std::span<const Patch> patches,
                                    std::span<const std::uint8_t> is_seen,
                                    SearchedCubes& searched) {
  constexpr std::size_t kCubes = 24;
  constexpr std::size_t kPoints = 2;  // for each
  constexpr float kLeast = 8.0F;      // voxels that a cube lacks
  struct Cube {
    float missing = 0.0F;
    PatchId heaviest = 0;
  };
  std::map<Key, Cube> cubes;
  for (PatchId id = 0; id < patches.size(); ++id) {
    const Patch& patch = patches[id];
    if (patch.missing <= 0.0F || is_seen[id] != 0) continue;
    const Eigen::Vector3i at = patch.target_m.array().floor().cast<int>();
    Cube& cube = cubes[{at.x(), at.y(), at.z()}];
    if (cube.missing == 0.0F || patch.missing > patches[cube.heaviest].missing) cube.heaviest = id;
    cube.missing += patch.missing;
  }
  std::vector<std::tuple<int, float, Key>> order;  // the least searched first, then the heaviest
  for (const auto& [key, cube] : cubes) {
    const auto before = searched.find(key);
    const int times = before == searched.end() ? 0 : before->second;
    if (cube.missing >= kLeast && times != kFound) order.emplace_back(times, -cube.missing, key);
  }
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), kCubes));
  std::vector<Vec3> points_m;
  for (const auto& [times, missing, key] : order) {
    const auto found_m = points_to_see(search, patches[cubes[key].heaviest], kPoints);
    searched[key] = found_m.empty() ? times + 1 : kFound;
    points_m.insert(points_m.end(), found_m.begin(), found_m.end());
  }
  return points_m;
}

}  // namespace gnbv
