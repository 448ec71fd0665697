// What is counted of a candidate view: one ViewStats, scored by every utility.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace gnbv {

/// How much of ViewStats a utility needs; `rays` costs more.
enum class ViewDetail { voxels, rays };

/// Counts and sums over the voxels that the rays of all cameras cross, up to and with the first
/// occupied voxel of each ray. A ray that leaves the workspace ends there. Sums are exact or of
/// integers, so that neither the order of the rays nor the width of the vectors changes them.
struct ViewStats {
  // each voxel once
  std::uint32_t free_voxels = 0;
  std::uint32_t unknown_voxels = 0;
  std::uint32_t occupied_voxels = 0;
  std::uint32_t predicted_voxels = 0;  // first predicted voxels of the rays, Eq. (3)'s N_pred
  std::uint32_t sparse_voxels = 0;     // occupied, with points, less dense than the frontier bound
  double entropy_nat = 0.0;            // sum of Eq. (1), clamped voxels 0
  double density_sum = 0.0;            // over the visible occupied voxels
  // a voxel once per ray that crosses it
  double entropy_per_ray_nat = 0.0;
  double voxel_m3 = 0.0;  // volume of one
  // ---- ViewDetail::rays only; definitions: Delmerico et al. 2018 and their released code. P_v,
  // the chance to see voxel k of a ray, is the product of (1 - P_j) over the voxels j before it
  // (legacy: of P_j), P is 0.5 where unmeasured
  std::uint32_t rays = 0;                 // that see at least one voxel
  std::uint32_t rays_occupied = 0;        // that end at an occupied voxel
  double occlusion_aware_nat = 0.0;       // sum of P_v H, to 2^-25 nat a ray
  double unobserved_nat = 0.0;            // the same over unknown voxels
  std::uint32_t rear_side_rays = 0;       // whose occupied end is entered from an unknown voxel
  double rear_side_nat = 0.0;             // of those: sum of P_v H over the unknown run and the end
  std::uint64_t crossed_by_occupied = 0;  // voxels of the rays that end occupied, ends included
  double entropy_of_occupied_nat = 0.0;   // sum of H over the same
  double unknown_volume_m3 = 0.0;         // of the pyramids around the rays (AEP's quadrature)
  double proximity_sum = 0.0;             // of delta_max - delta over the shadow voxels, each once
  // votes for the area factor (Vasquez-Gomez et al. 2014): one a ray, the first that fits
  std::uint32_t shadow_rays = 0;  // that cross a shadow voxel: "occplane"
  std::uint32_t front_rays = 0;   // that enter an occupied voxel from a free one: "occupied"
  // ---- filled in by the planner: what the view is measured against
  double density_max = 0.0;  // SurfaceCloud::density_max()
  double path_m = 0.0;       // distance from the current position, as UtilityConfig::distance says
};

/// What has to be computed for a field to hold anything.
enum class ViewFieldNeeds { voxels, rays, shadow };

struct ViewField {
  std::string_view name;
  std::string_view format;  // NumPy's: u4, u8, f8
  std::size_t offset;       // bytes, into ViewStats
  ViewFieldNeeds needs;
};

#define GNBV_VIEW_FIELD(name, format, needs) \
  ViewField { #name, format, offsetof(ViewStats, name), ViewFieldNeeds::needs }

/// All fields of ViewStats by name and in their order, for utilities that are written elsewhere.
inline constexpr std::array kViewFields = {
    GNBV_VIEW_FIELD(free_voxels, "<u4", voxels),
    GNBV_VIEW_FIELD(unknown_voxels, "<u4", voxels),
    GNBV_VIEW_FIELD(occupied_voxels, "<u4", voxels),
    GNBV_VIEW_FIELD(predicted_voxels, "<u4", voxels),
    GNBV_VIEW_FIELD(sparse_voxels, "<u4", voxels),
    GNBV_VIEW_FIELD(entropy_nat, "<f8", voxels),
    GNBV_VIEW_FIELD(density_sum, "<f8", voxels),
    GNBV_VIEW_FIELD(entropy_per_ray_nat, "<f8", voxels),
    GNBV_VIEW_FIELD(voxel_m3, "<f8", voxels),
    GNBV_VIEW_FIELD(rays, "<u4", rays),
    GNBV_VIEW_FIELD(rays_occupied, "<u4", rays),
    GNBV_VIEW_FIELD(occlusion_aware_nat, "<f8", rays),
    GNBV_VIEW_FIELD(unobserved_nat, "<f8", rays),
    GNBV_VIEW_FIELD(rear_side_rays, "<u4", rays),
    GNBV_VIEW_FIELD(rear_side_nat, "<f8", rays),
    GNBV_VIEW_FIELD(crossed_by_occupied, "<u8", rays),
    GNBV_VIEW_FIELD(entropy_of_occupied_nat, "<f8", rays),
    GNBV_VIEW_FIELD(unknown_volume_m3, "<f8", rays),
    GNBV_VIEW_FIELD(proximity_sum, "<f8", shadow),
    GNBV_VIEW_FIELD(shadow_rays, "<u4", shadow),
    GNBV_VIEW_FIELD(front_rays, "<u4", rays),
    GNBV_VIEW_FIELD(density_max, "<f8", voxels),
    GNBV_VIEW_FIELD(path_m, "<f8", voxels),
};
#undef GNBV_VIEW_FIELD

}  // namespace gnbv
