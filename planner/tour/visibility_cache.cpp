#include "planner/tour/visibility_cache.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "planner/core/belief.hpp"
#include "planner/map/ray_walk.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

constexpr std::array<double, 4> kDistances = {0.25, 0.45, 0.65, 0.85};  // of the range
constexpr std::array<double, 5> kAcross = {-0.8, -0.4, 0.0, 0.4, 0.8};  // of the half opening
constexpr int kBearings = 16;
constexpr double kMostOff_rad = deg_to_rad(60.0);  // of the bearing, from the normal's
constexpr double kLeastCosine = 0.26;              // 75 deg of incidence
constexpr int kFound = -1;                         // SearchedCubes

/// Whether the line from the origin meets no occupied voxel but the target's and its neighbours.
bool is_hit_first(const OccupancyGrid& grid, const Vec3& origin_world_m,
                  const Vec3& target_world_m) {
  const GridGeometry& geometry = grid.geometry();
  const KeyBox about_target = keys_about(geometry.key_of(target_world_m));
  return all_along_ray(geometry, origin_world_m.cast<float>(), target_world_m.cast<float>(),
                       [&](const Key& key) {
                         return about_target.contains(key) || !geometry.contains(key) ||
                                grid.state(geometry.index_of(key)) != VoxelState::occupied;
                       });
}

/// Directions from a patch to vehicles whose camera has it in the image. A camera that looks down
/// by some angle sees what lies by that angle below it, give or take half its opening. The vehicle
/// turns to any bearing.
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
      const double up_rad =
          down_rad + 0.5 * across * camera.sight_rad.sizes().y() + camera.sight_rad.center().y();
      const Vec3 direction(std::cos(up_rad) * std::cos(bearing_rad),
                           std::cos(up_rad) * std::sin(bearing_rad), std::sin(up_rad));
      if (direction.dot(normal) >= kLeastCosine) use(direction);
    }
  }
}

/// Of each patch the surest observation, of these the one of the best incidence, by patch.
void keep_best(std::vector<SeenPatch>& seen) {
  std::sort(seen.begin(), seen.end(), [](const SeenPatch& a, const SeenPatch& b) {
    return std::tie(a.patch, a.certainty, a.incidence) <
           std::tie(b.patch, b.certainty, b.incidence);
  });
  const auto is_same = [](const SeenPatch& a, const SeenPatch& b) { return a.patch == b.patch; };
  seen.erase(std::unique(seen.begin(), seen.end(), is_same), seen.end());
}

}  // namespace

VisibilityCache::VisibilityCache(const TourConfig& config, std::span<const CameraModel> cameras,
                                 std::span<const double> pitches_rad, const Box3& workspace_m)
    : cameras_(cameras.begin(), cameras.end()),
      pitches_rad_(pitches_rad.begin(), pitches_rad.end()),
      blocks_(workspace_m, SurfaceCell::kSide * config.detail_m),
      yaws_(std::max(1, static_cast<int>(std::lround(2.0 * kPi / config.yaw_step_rad)))) {
  for (const CameraModel& camera : cameras) reach_m_ = std::max(reach_m_, camera_reach_m(camera));
}

ViewPose VisibilityCache::pose(const Vec3& p_world_m, int heading) const {
  return {p_world_m, 2.0 * kPi * (heading % yaws_) / yaws_, pitches_rad_[heading / yaws_]};
}

int VisibilityCache::heading_near(const ViewPose& pose) const {
  const auto yaw = static_cast<int>(std::lround(pose.yaw_rad * yaws_ / (2.0 * kPi)));
  const auto nearest =
      std::min_element(pitches_rad_.begin(), pitches_rad_.end(), [&](double a, double b) {
        return std::abs(a - pose.gimbal_pitch_rad) < std::abs(b - pose.gimbal_pitch_rad);
      });
  return (yaw % yaws_ + yaws_) % yaws_ + yaws_ * static_cast<int>(nearest - pitches_rad_.begin());
}

std::vector<SeenPatch> VisibilityCache::observe(const TourScene& scene, const ViewPose& view,
                                                const Blocks& near, PatchViewer& viewer) const {
  std::vector<SeenPatch> seen;
  for (const CameraModel& camera : turned(cameras_, view.gimbal_pitch_rad)) {
    viewer.observe(scene, camera, T_world_body(view), near, blocks_.radius_m(), seen);
  }
  keep_best(seen);
  return seen;
}

std::vector<SeenPatch> VisibilityCache::observe(const TourScene& scene, const ViewPose& view,
                                                int threads) {
  blocks_.follow(scene.cells, threads);
  PatchViewer viewer;
  return observe(scene, view, blocks_.near(view.p_world_m, reach_m_), viewer);
}

std::vector<SeenPatch> VisibilityCache::observe(const TourScene& scene,
                                                std::span<const FramePose> looks, int threads) {
  blocks_.follow(scene.cells, threads);
  std::vector<std::vector<SeenPatch>> seen_by(looks.size());
  parallel_for_chunks(threads, looks.size(), 1, [&](std::size_t begin, std::size_t end) {
    PatchViewer viewer;
    for (std::size_t i = begin; i < end; ++i) {
      const Isometry& T_world_camera = looks[i].T_world_camera;
      CameraModel camera = cameras_[static_cast<std::size_t>(looks[i].camera)];
      camera.T_body_camera = Isometry::Identity();
      viewer.observe(scene, camera, T_world_camera,
                     blocks_.near(T_world_camera.translation(), reach_m_), blocks_.radius_m(),
                     seen_by[i]);
    }
  });
  std::vector<SeenPatch> seen;
  for (const auto& one : seen_by) seen.insert(seen.end(), one.begin(), one.end());
  keep_best(seen);
  return seen;
}

std::uint32_t VisibilityCache::changes_near(const Vec3& p_world_m, std::uint32_t since) const {
  std::uint32_t changes = 0;
  for (const CellBlocks::Block* block : blocks_.near(p_world_m, reach_m_)) {
    if (block->changed <= since) continue;
    for (const CellBlocks::Cell& cell : block->cells) {
      if (cell.changed > since) ++changes;
    }
  }
  return changes;
}

void VisibilityCache::follow(const TourScene& scene, const Roadmap& roadmap,
                             std::span<const Node> first, std::size_t most_again, int threads,
                             const HeedStop& stop) {
  blocks_.follow(scene.cells, threads);
  at_.resize(roadmap.size());
  std::vector<Node> due, again;
  for (const Node node : roadmap.reachable()) {
    (at_[node].seen.empty() ? due : again).push_back(node);
  }
  if (most_again > 0) {
    std::vector<std::pair<bool, std::uint32_t>> urgency(roadmap.size());  // first?, changes
    parallel_for_chunks(threads, again.size(), 16, [&](std::size_t begin, std::size_t end) {
      heed(stop);
      for (std::size_t i = begin; i < end; ++i) {
        const Node node = again[i];
        urgency[node].second = changes_near(roadmap.p_world_m(node), at_[node].version);
      }
    });
    for (const Node node : first) urgency[node].first = true;
    std::erase_if(again, [&](Node node) { return urgency[node].second == 0; });
    std::stable_sort(again.begin(), again.end(),
                     [&](Node a, Node b) { return urgency[a] > urgency[b]; });
    again.resize(std::min(again.size(), most_again));
    due.insert(due.end(), again.begin(), again.end());
  }
  parallel_for_chunks(threads, due.size(), 4, [&](std::size_t begin, std::size_t end) {
    PatchViewer viewer;
    for (std::size_t i = begin; i < end; ++i) {
      heed(stop);
      const Vec3& p_m = roadmap.p_world_m(due[i]);
      const Blocks near = blocks_.near(p_m, reach_m_);
      AtNode at{.version = scene.cells.version()};
      for (int heading = 0; heading < headings(); ++heading) {
        at.seen.push_back(observe(scene, pose(p_m, heading), near, viewer));
      }
      at_[due[i]] = std::move(at);
    }
  });
}

std::span<const SeenPatch> VisibilityCache::seen(Node node, int heading) const {
  if (node >= at_.size() || at_[node].seen.empty()) return {};
  return at_[node].seen[heading];
}

std::vector<Vec3> points_to_see(const NodeSearch& search, const Patch& patch, std::size_t most) {
  const Vec3 target_m = patch.target_m.cast<double>();
  const Vec3 normal = patch.normal.cast<double>();
  const GridGeometry& geometry = search.grid.geometry();
  std::vector<std::pair<double, Vec3>> found;  // with their scores
  const auto look_back = [&](const CameraModel& camera) {
    for_each_direction(camera, normal, [&](const Vec3& direction) {
      for (const double share : kDistances) {
        const Key key =
            geometry.key_of(Vec3(target_m + share * return_end_m(camera.config) * direction));
        const Vec3 center_m = geometry.center_m(key);
        if (!search.space.is_open(search.grid, key)) continue;
        if (!is_hit_first(search.grid, center_m, target_m)) continue;
        found.emplace_back(direction.dot(normal) * (1.2 - share), center_m);
      }
    });
  };
  for (const CameraModel& camera : search.cameras) {
    for (const CameraModel& fixed : at_all_pitches(camera)) look_back(fixed);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Vec3> points_m;
  for (const auto& one : found) {
    if (points_m.size() == most) break;
    const bool is_taken = std::any_of(points_m.begin(), points_m.end(), [&](const Vec3& other) {
      return (other - one.second).norm() < 1.0;
    });
    if (!is_taken) points_m.push_back(one.second);
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
    Cube& cube = cubes[cube_of(patch.target_m.cast<double>(), 1.0)];
    if (cube.missing == 0.0F || patch.missing > patches[cube.heaviest].missing) cube.heaviest = id;
    cube.missing += patch.missing;
  }
  std::vector<std::tuple<int, float, Key>> order;  // the least searched first, then the heaviest
  for (const auto& [key, cube] : cubes) {
    const int times = searched[key];
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
