#include "planner/tour/unseen_space.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/parallel.hpp"

namespace gnbv {

SurfaceHull::SurfaceHull(const SurfaceCells& cells) {
  constexpr int kYaws = 8;
  for (int k = 0; k < kYaws; ++k) {
    const double yaw_rad = kPi * k / kYaws;
    for (const double up : {-1.0, 0.0, 1.0}) {
      axes_.push_back(Vec3(std::cos(yaw_rad), std::sin(yaw_rad), up).normalized());
    }
  }
  axes_.push_back(Vec3::UnitZ());
  for (std::size_t k = 0, all = axes_.size(); k < all; ++k) axes_.push_back(-axes_[k]);
  furthest_m_.assign(axes_.size(), -std::numeric_limits<double>::infinity());
  for (const SurfaceCell& cell : cells.cells()) {
    if (cell.expected == 0) continue;
    const Vec3 center_m = cells.lattice().center_m(cell.key);
    for (std::size_t k = 0; k < axes_.size(); ++k) {
      furthest_m_[k] = std::max(furthest_m_[k], axes_[k].dot(center_m));
    }
  }
}

double SurfaceHull::off_m(const Vec3& p_world_m) const {
  double off_m = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    off_m = std::max(off_m, axes_[k].dot(p_world_m) - furthest_m_[k]);
  }
  return off_m;
}

std::optional<std::size_t> most_unseen(const PlannerModel& model, const Belief& belief,
                                       std::span<const TourView> views,
                                       std::span<const double> way_m, Scratch& scratch,
                                       const SurfaceHull* within) {
  const double least = (within == nullptr ? 0.02 : 0.1) * model.view_voxels;
  constexpr double kLook_m = 4.0;  // what stopping to look costs beside the way
  std::vector<std::uint32_t> unknown(views.size(), 0);
  const std::size_t shares = scratch.marks.size();
  parallel_for(scratch.threads, shares, [&](std::size_t share) {
    for (std::size_t i = share; i < views.size(); i += shares) {
      scratch.heed_stop();
      const ViewPose& view = views[i].pose;
      const ViewRays& rays = model.rays_at(view.gimbal_pitch_rad);
      unknown[i] =
          evaluate_view(belief.grid, belief.cloud, rays, view, scratch.marks[share]).unknown_voxels;
      if (within == nullptr || unknown[i] < least) continue;
      const std::vector<VoxelIndex> seen = voxels_in_sight(belief.grid, rays, view).unknown;
      const GridGeometry& voxels = belief.grid.geometry();
      unknown[i] = static_cast<std::uint32_t>(std::ranges::count_if(seen, [&](VoxelIndex voxel) {
        return within->off_m(voxels.center_m(voxels.key_at(voxel))) <= 0.0;
      }));
    }
  });
  std::optional<std::size_t> best;
  double most = 0.0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (unknown[i] < least) continue;
    const double rate = unknown[i] / (way_m[i] + kLook_m);
    if (rate <= most) continue;
    most = rate;
    best = i;
  }
  return best;
}

}  // namespace gnbv
