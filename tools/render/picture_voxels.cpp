// The map as the planner believes it: occupied, predicted and unknown voxels.
#include <fmt/format.h>

#include <algorithm>

#include "sim/core/text.hpp"
#include "tools/render/picture.hpp"
#include "tools/scene/structure.hpp"
#include "tools/scene/voxels.hpp"

namespace gnbv {
namespace {

/// Heights of the structure: runs of one structure have them in common.
std::array<double, 2> height_range(RunSource& run, const PictureOptions&) {
  const Box3 box_m = bounds_m(run.world().structure);
  return {std::max(0.0, box_m.min().z()), box_m.max().z()};
}

Picture draw_voxels(RunSource& run, const PictureOptions& options, const RenderView& view) {
  const std::size_t last = run.record().views.empty() ? 0 : run.record().views.size() - 1;
  const std::size_t iteration = iteration_of(run.record(), options, last);
  const OccupancyGrid& grid = run.belief_after(iteration).grid;
  const GridGeometry& geometry = grid.geometry();
  const SortedVoxels voxels = sort_voxels(grid);

  const auto [low_m, high_m] = options.colour_range.value_or(height_range(run, options));
  std::vector<Rgb> colours;
  for (const VoxelIndex v : voxels.occupied) {
    const double z_m = geometry.center_m(geometry.key_at(v)[2]);
    colours.push_back(amount_ramp((z_m - low_m) / std::max(high_m - low_m, 1e-9)));
  }

  Picture picture{.panels = std::vector<Panel>(1)};
  RenderScene& scene = picture.panels.front().scene;
  add_ground(run, scene);
  if (!voxels.occupied.empty()) {
    scene.surfaces.push_back(voxel_cubes(geometry, voxels.occupied, colours));
  }
  const std::vector<Rgb> predicted = {looks::kPredicted.rgb()};
  scene.surfaces.push_back(voxel_cubes(geometry, voxels.predicted, predicted));
  scene.surfaces.push_back(free_faces(grid, voxels.unknown, looks::kUnknown.rgb(), 0.85F));
  scene.shading = kDataShading;
  const bool is_predicted_seen = shows_any(view, grid, scene, predicted.front());
  picture.detail =
      fmt::format("after {}: {} of {} m occupied", views_so_far(run.record(), iteration),
                  counted(voxels.occupied.size(), "voxel"), geometry.resolution_m());
  if (!voxels.predicted.empty()) {
    picture.detail += fmt::format(", {} predicted{}", grouped(voxels.predicted.size()),
                                  is_predicted_seen ? "" : ", none of these in sight");
  }
  picture.legend = {
      entry(looks::kUnknown, LegendItem::Mark::square,
            fmt::format(" beside free, near surface: {}", grouped(voxels.unknown.size())))};
  if (is_predicted_seen) picture.legend.push_back(entry(looks::kPredicted));
  picture.legend.push_back(
      bar(amount_colours(), fmt::format("occupied, by height from {:.1f}", low_m),
          fmt::format("{:.1f} m", high_m), fmt::format("{:.1f}", 0.5 * (low_m + high_m))));
  return picture;
}

}  // namespace

const PictureKind kVoxelsPicture = {.name = "voxels",
                                    .shows = "OctoMap voxels: occupied, predicted, unknown",
                                    .frame = frame_map,
                                    .colour_range = height_range,
                                    .draw = draw_voxels};

}  // namespace gnbv
