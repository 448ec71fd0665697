#include "planner/tour/surface_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "planner/tour/patch_view.hpp"

namespace gnbv {
namespace {

constexpr std::array<double, 4> kDistances = {0.25, 0.45, 0.65, 0.85};  // of the range
constexpr std::array<double, 5> kAcross = {-0.8, -0.4, 0.0, 0.4, 0.8};  // of the half opening
constexpr int kBearings = 16;
constexpr double kMostOff_rad = deg_to_rad(60.0);  // of the bearing, from the normal's
constexpr double kLeastCosine = 0.26;              // 75 deg of incidence

struct Found {
  double score;
  Vec3 p_world_m;
};

}  // namespace

std::vector<Vec3> places_to_see(const PlaceSearch& search, const Patch& patch, std::size_t most) {
  const Vec3 target_m = patch.target_m.cast<double>();
  const Vec3 normal = patch.normal.cast<double>();
  const double level = normal.head<2>().norm();
  const double normal_bearing_rad = std::atan2(normal.y(), normal.x());
  const GridGeometry& geometry = search.grid.geometry();
  std::vector<Found> found;
  for (const CameraModel& camera : search.cameras) {
    const Vec3 axis = camera.T_body_camera.linear().col(2);  // where it looks
    const double down_rad = -std::asin(std::clamp(axis.z(), -1.0, 1.0));
    for (int b = 0; b < kBearings; ++b) {
      const double bearing_rad = 2.0 * kPi * b / kBearings;  // from the patch to the vehicle
      const bool is_off =
          std::fabs(wrap_angle_rad(bearing_rad - normal_bearing_rad)) > kMostOff_rad;
      if (level > 0.3 && is_off) continue;
      for (const double across : kAcross) {
        const double up_rad = down_rad + 0.5 * across * camera.config.fov_y_rad;
        const Vec3 direction(std::cos(up_rad) * std::cos(bearing_rad),
                             std::cos(up_rad) * std::sin(bearing_rad), std::sin(up_rad));
        const double cosine = direction.dot(normal);
        if (cosine < kLeastCosine) continue;
        for (const double share : kDistances) {
          const Vec3 p_m = target_m + share * camera.config.range_max_m * direction;
          const Key key = geometry.key_of(p_m);
          if (!search.space.is_open(search.grid, key)) continue;
          const Vec3 center_m = geometry.center_m(key);
          if (!is_hit_first(search.grid, center_m, target_m)) continue;
          found.push_back({cosine * (1.2 - share), center_m});
        }
      }
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Found& a, const Found& b) { return a.score > b.score; });
  std::vector<Vec3> places;
  for (const Found& place : found) {
    if (places.size() == most) break;
    const bool is_taken = std::any_of(places.begin(), places.end(), [&](const Vec3& other) {
      return (other - place.p_world_m).norm() < 1.0;
    });
    if (!is_taken) places.push_back(place.p_world_m);
  }
  return places;
}

std::vector<Vec3> places_for_unseen(const PlaceSearch& search, std::span<const Patch> patches,
                                    std::span<const std::uint8_t> is_seen, std::set<Key>& tried) {
  constexpr std::size_t kCubes = 24;
  constexpr std::size_t kPlaces = 2;  // for each
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
  std::vector<std::pair<float, Key>> order;  // the heaviest first
  for (const auto& [key, cube] : cubes) {
    if (cube.missing >= kLeast && !tried.contains(key)) order.emplace_back(-cube.missing, key);
  }
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), kCubes));
  std::vector<Vec3> places_m;
  for (const auto& [missing, key] : order) {
    tried.insert(key);
    const auto found_m = places_to_see(search, patches[cubes[key].heaviest], kPlaces);
    places_m.insert(places_m.end(), found_m.begin(), found_m.end());
  }
  return places_m;
}

}  // namespace gnbv
