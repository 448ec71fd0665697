#include "planner/tour/visibility_cache.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {

VisibilityCache::VisibilityCache(const TourConfig& config, std::span<const CameraModel> cameras,
                                 std::span<const double> pitches_rad, const Box3& workspace_m)
    : blocks_(workspace_m, SurfaceCell::kSide * config.detail_m),
      yaws_(std::max(1, static_cast<int>(std::lround(2.0 * kPi / config.yaw_step_rad)))) {
  for (const double pitch_rad : pitches_rad) {
    pitches_.push_back({pitch_rad, turned(cameras, pitch_rad)});
  }
  for (const CameraModel& camera : cameras) reach_m_ = std::max(reach_m_, camera_reach_m(camera));
}

ViewPose VisibilityCache::pose(const Vec3& p_world_m, int heading) const {
  const auto pitch = static_cast<std::size_t>(heading / yaws_);
  return {p_world_m, 2.0 * kPi * (heading % yaws_) / yaws_, pitches_[pitch].rad};
}

void VisibilityCache::observe(const TourScene& scene, const ViewPose& view,
                              std::span<const CellBlocks::Block* const> near, PatchViewer& viewer,
                              std::vector<SeenPatch>& seen) const {
  const Isometry T = T_world_body(view);
  const auto at_pitch = std::find_if(pitches_.begin(), pitches_.end(), [&](const Pitch& pitch) {
    return pitch.rad == view.gimbal_pitch_rad;
  });
  GNBV_CHECK(at_pitch != pitches_.end(), "pitch of {} rad", view.gimbal_pitch_rad);
  for (const CameraModel& camera : at_pitch->cameras) {
    viewer.observe(scene, camera, T, near, blocks_.radius_m(), seen);
  }
  std::sort(seen.begin(), seen.end(), [](const SeenPatch& a, const SeenPatch& b) {
    return a.patch != b.patch ? a.patch < b.patch : a.incidence < b.incidence;
  });
  const auto is_same = [](const SeenPatch& a, const SeenPatch& b) { return a.patch == b.patch; };
  seen.erase(std::unique(seen.begin(), seen.end(), is_same), seen.end());
}

std::vector<SeenPatch> VisibilityCache::observe(const TourScene& scene, const ViewPose& view,
                                                int threads) {
  blocks_.follow(scene.cells, threads);
  PatchViewer viewer;
  std::vector<SeenPatch> seen;
  observe(scene, view, blocks_.near(view.p_world_m, reach_m_), viewer, seen);
  return seen;
}

void VisibilityCache::observe_around(const TourScene& scene, const Vec3& p_world_m, AtNode& at,
                                     PatchViewer& viewer) const {
  const auto near = blocks_.near(p_world_m, reach_m_);
  at.is_known = true;
  at.update = scene.cells.updates();
  at.seen.resize(static_cast<std::size_t>(headings()));
  for (int heading = 0; heading < headings(); ++heading) {
    std::vector<SeenPatch>& seen = at.seen[static_cast<std::size_t>(heading)];
    seen.clear();
    observe(scene, pose(p_world_m, heading), near, viewer, seen);
  }
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

/// Of the nodes that were observed from, those around which something changed, most urgent first.
std::vector<VisibilityCache::Node> VisibilityCache::changed_nodes(const Roadmap& roadmap,
                                                                  std::span<const Node> first,
                                                                  int threads) const {
  std::vector<Node> changed;
  for (Node node = 1; node < roadmap.size(); ++node) {
    if (roadmap.is_reachable(node) && at_[node].is_known) changed.push_back(node);
  }
  std::vector<std::uint32_t> changes(roadmap.size(), 0);
  parallel_for_chunks(threads, changed.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      changes[changed[i]] = changes_near(roadmap.p_world_m(changed[i]), at_[changed[i]].update);
    }
  });
  std::vector<std::uint8_t> is_first(roadmap.size(), 0);
  for (const Node node : first) is_first[node] = 1;
  std::erase_if(changed, [&](Node node) { return changes[node] == 0; });
  std::stable_sort(changed.begin(), changed.end(), [&](Node a, Node b) {
    return std::pair(is_first[a], changes[a]) > std::pair(is_first[b], changes[b]);
  });
  return changed;
}

void VisibilityCache::follow(const TourScene& scene, const Roadmap& roadmap,
                             std::span<const Node> first, std::size_t most_again, int threads,
                             const std::function<void()>& heed_stop) {
  blocks_.follow(scene.cells, threads);
  at_.resize(roadmap.size());
  std::vector<Node> due;
  for (Node node = 1; node < roadmap.size(); ++node) {
    if (roadmap.is_reachable(node) && !at_[node].is_known) due.push_back(node);
  }
  if (most_again > 0) {
    const std::vector<Node> again = changed_nodes(roadmap, first, threads);
    const std::size_t count = std::min(again.size(), most_again);
    due.insert(due.end(), again.begin(), again.begin() + static_cast<std::ptrdiff_t>(count));
  }
  parallel_for_chunks(threads, due.size(), 4, [&](std::size_t begin, std::size_t end) {
    PatchViewer viewer;
    for (std::size_t i = begin; i < end; ++i) {
      if (heed_stop) heed_stop();
      observe_around(scene, roadmap.p_world_m(due[i]), at_[due[i]], viewer);
    }
  });
}

std::span<const SeenPatch> VisibilityCache::seen(Node node, int heading) const {
  if (node >= at_.size() || !at_[node].is_known) return {};
  return at_[node].seen[static_cast<std::size_t>(heading)];
}

}  // namespace gnbv
