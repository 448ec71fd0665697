#include "planner/tour/tour_state.hpp"

#include <algorithm>
#include <cmath>

#include "planner/core/belief.hpp"

namespace gnbv {
namespace {

double step_m(const TourConfig& config, const PlannerModel& model) {
  if (config.lattice_step_m > 0.0) return config.lattice_step_m;
  return automatic_step_m(model.cameras, model.navigation_m);
}

std::vector<CameraModel> at_all_pitches(std::span<const CameraModel> cameras) {
  std::vector<CameraModel> all;
  for (const CameraModel& camera : cameras) {
    for (CameraModel& fixed : at_all_pitches(camera)) all.push_back(std::move(fixed));
  }
  return all;
}

}  // namespace

TourState::TourState(const TourConfig& config, const PlannerModel& model)
    : cells(model.workspace_m, config.detail_m),
      calibration(config.detail_m),
      space(model.geometry(), model.navigation_m, model.no_fly, model.validity.collision_radius_m),
      roadmap(model.geometry(), model.navigation_m, step_m(config, model)),
      visibility(config, model.cameras, model.pitches_rad, model.workspace_m),
      cameras(at_all_pitches(std::span(model.cameras))) {}

double automatic_step_m(std::span<const CameraModel> cameras, const Box3& navigation_m) {
  double range_m = 0.0;
  for (const CameraModel& camera : cameras) range_m = std::max(range_m, camera.config.range_max_m);
  const Vec3 size_m = navigation_m.sizes();
  const double wanted_m = std::min(0.25 * range_m, size_m.head<2>().minCoeff() / 8.0);
  double step_m = wanted_m;
  while ((size_m / step_m + Vec3::Ones()).prod() > kMostAutomaticNodes) step_m *= 1.1;
  return step_m;
}

double tour_bytes(const TourConfig& config, const Box3& workspace_m, double resolution_m) {
  const auto count = [&](double edge_m) {
    return (workspace_m.sizes() / edge_m + Vec3::Ones()).prod();
  };
  constexpr double kVoxel_bytes = 5.0;  // OpenSpace
  constexpr double kCell_bytes = 4.0;   // SurfaceCells
  return kVoxel_bytes * count(resolution_m) +
         kCell_bytes * count(SurfaceCell::kSide * config.detail_m);
}

}  // namespace gnbv
