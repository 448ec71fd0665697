// ViewStats by the names of its numbers, for utilities that are written elsewhere.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "planner/view/view_stats.hpp"

namespace gnbv {

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

/// All fields of ViewStats, in their order.
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
