// What each view would see: worked out once, and again where the surface nearby has changed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner/tour/patch_view.hpp"
#include "planner/tour/places.hpp"

namespace gnbv {

class ViewCatalogue {
 public:
  using Place = TourPlaces::Place;

  /// `pitches_rad`: of the cameras' gimbal; one, whatever it is, without.
  ViewCatalogue(const TourConfig& config, std::span<const CameraModel> cameras,
                std::span<const double> pitches_rad, const Box3& workspace_m);

  /// Ways to look from a place: each yaw with each pitch.
  int headings() const { return yaws_ * static_cast<int>(pitches_.size()); }
  ViewPose pose(const Vec3& p_world_m, int heading) const;

  /// Looks from every reachable place that never was, and from so many of those around which the
  /// surface changed most since they were; `first` come before all others.
  void follow(const TourScene& scene, const TourPlaces& places, std::span<const Place> first,
              int recasts, int threads);

  /// What the last look from there saw at that heading, in ascending order.
  std::span<const SeenPatch> seen(Place place, int heading) const;

  /// What all cameras see from a pose, now.
  std::vector<SeenPatch> look(const TourScene& scene, const ViewPose& view, int threads);

 private:
  struct AtPlace {
    bool is_cast = false;
    std::uint32_t update = 0;                  // of the cells, at the last look
    std::vector<std::vector<SeenPatch>> seen;  // by heading
  };
  struct Pitch {
    double rad = 0.0;
    std::vector<CameraModel> cameras;
  };
  std::uint32_t changes_near(const Vec3& p_world_m, std::uint32_t since) const;
  /// Of the places that were looked from, those around which something changed, most urgent first.
  std::vector<Place> changed_places(const TourPlaces& places, std::span<const Place> first,
                                    int threads) const;
  void cast(const TourScene& scene, const Vec3& p_world_m, AtPlace& at, PatchViewer& viewer) const;
  void look(const TourScene& scene, const ViewPose& view,
            std::span<const CellBlocks::Block* const> near, PatchViewer& viewer,
            std::vector<SeenPatch>& seen) const;

  std::vector<Pitch> pitches_;
  CellBlocks blocks_;
  double reach_m_ = 0.0;
  int yaws_ = 1;
  std::vector<AtPlace> at_;
};

}  // namespace gnbv
