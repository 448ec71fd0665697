#include "planner/tour/catalogue.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {

ViewCatalogue::ViewCatalogue(const TourConfig& config, std::span<const CameraModel> cameras,
                             std::span<const double> pitches_rad, const Box3& workspace_m)
    : blocks_(workspace_m, SurfaceCell::kSide * config.detail_m),
      yaws_(std::max(1, static_cast<int>(std::lround(2.0 * kPi / config.yaw_step_rad)))) {
  for (const double pitch_rad : pitches_rad) {
    pitches_.push_back({pitch_rad, turned(cameras, pitch_rad)});
  }
  for (const CameraModel& camera : cameras) reach_m_ = std::max(reach_m_, camera_reach_m(camera));
}

ViewPose ViewCatalogue::pose(const Vec3& p_world_m, int heading) const {
  const auto pitch = static_cast<std::size_t>(heading / yaws_);
  return {p_world_m, 2.0 * kPi * (heading % yaws_) / yaws_, pitches_[pitch].rad};
}

void ViewCatalogue::look(const TourScene& scene, const ViewPose& view,
                         std::span<const CellBlocks::Block* const> near, PatchViewer& viewer,
                         std::vector<SeenPatch>& seen) const {
  const Isometry T = T_world_body(view);
  const auto at_pitch = std::find_if(pitches_.begin(), pitches_.end(), [&](const Pitch& pitch) {
    return pitch.rad == view.gimbal_pitch_rad;
  });
  GNBV_CHECK(at_pitch != pitches_.end(), "pitch of {} rad", view.gimbal_pitch_rad);
  for (const CameraModel& camera : at_pitch->cameras) {
    viewer.look(scene, camera, T, near, blocks_.radius_m(), seen);
  }
  std::sort(seen.begin(), seen.end(), [](const SeenPatch& a, const SeenPatch& b) {
    return a.patch != b.patch ? a.patch < b.patch : a.incidence < b.incidence;
  });
  const auto is_same = [](const SeenPatch& a, const SeenPatch& b) { return a.patch == b.patch; };
  seen.erase(std::unique(seen.begin(), seen.end(), is_same), seen.end());
}

std::vector<SeenPatch> ViewCatalogue::look(const TourScene& scene, const ViewPose& view,
                                           int threads) {
  blocks_.follow(scene.cells, threads);
  PatchViewer viewer;
  std::vector<SeenPatch> seen;
  look(scene, view, blocks_.near(view.p_world_m, reach_m_), viewer, seen);
  return seen;
}

void ViewCatalogue::cast(const TourScene& scene, const Vec3& p_world_m, AtPlace& at,
                         PatchViewer& viewer) const {
  const auto near = blocks_.near(p_world_m, reach_m_);
  at.is_cast = true;
  at.update = scene.cells.updates();
  at.seen.resize(static_cast<std::size_t>(headings()));
  for (int heading = 0; heading < headings(); ++heading) {
    std::vector<SeenPatch>& seen = at.seen[static_cast<std::size_t>(heading)];
    seen.clear();
    look(scene, pose(p_world_m, heading), near, viewer, seen);
  }
}

std::uint32_t ViewCatalogue::changes_near(const Vec3& p_world_m, std::uint32_t since) const {
  std::uint32_t changes = 0;
  for (const CellBlocks::Block* block : blocks_.near(p_world_m, reach_m_)) {
    if (block->changed <= since) continue;
    for (const CellBlocks::Cell& cell : block->cells) {
      if (cell.changed > since) ++changes;
    }
  }
  return changes;
}

std::vector<ViewCatalogue::Place> ViewCatalogue::changed_places(const TourPlaces& places,
                                                                std::span<const Place> first,
                                                                int threads) const {
  std::vector<Place> cast_before;
  for (Place place = 1; place < places.size(); ++place) {
    if (places.is_reachable(place) && at_[place].is_cast) cast_before.push_back(place);
  }
  std::vector<std::uint32_t> changes(places.size(), 0);
  parallel_for_chunks(threads, cast_before.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Place place = cast_before[i];
      changes[place] = changes_near(places.p_world_m(place), at_[place].update);
    }
  });
  std::vector<std::uint8_t> is_first(places.size(), 0);
  for (const Place place : first) is_first[place] = 1;
  std::erase_if(cast_before, [&](Place place) { return changes[place] == 0; });
  std::stable_sort(cast_before.begin(), cast_before.end(), [&](Place a, Place b) {
    return std::pair(is_first[a], changes[a]) > std::pair(is_first[b], changes[b]);
  });
  return cast_before;
}

void ViewCatalogue::follow(const TourScene& scene, const TourPlaces& places,
                           std::span<const Place> first, int recasts, int threads) {
  blocks_.follow(scene.cells, threads);
  at_.resize(places.size());
  std::vector<Place> due;
  for (Place place = 1; place < places.size(); ++place) {
    if (places.is_reachable(place) && !at_[place].is_cast) due.push_back(place);
  }
  if (recasts > 0) {
    const std::vector<Place> again = changed_places(places, first, threads);
    const auto most = static_cast<std::size_t>(recasts);
    due.insert(due.end(), again.begin(),
               again.begin() + static_cast<std::ptrdiff_t>(std::min(again.size(), most)));
  }
  parallel_for_chunks(threads, due.size(), 4, [&](std::size_t begin, std::size_t end) {
    PatchViewer viewer;
    for (std::size_t i = begin; i < end; ++i) {
      cast(scene, places.p_world_m(due[i]), at_[due[i]], viewer);
    }
  });
}

std::span<const SeenPatch> ViewCatalogue::seen(Place place, int heading) const {
  if (place >= at_.size() || !at_[place].is_cast) return {};
  return at_[place].seen[static_cast<std::size_t>(heading)];
}

}  // namespace gnbv
