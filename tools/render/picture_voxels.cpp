// The map as the planner believes it: occupied, predicted and unknown voxels.
#include <fmt/format.h>

#include <algorithm>

#include "tools/render/picture.hpp"
#include "tools/render/voxel_items.hpp"

namespace gnbv {
namespace {

const Rgb kPredicted = srgb(0xd5309c);
const Rgb kUnknown = srgb(0xffffff);

void frame_voxels(RunSource& run, const PictureOptions&, std::vector<Vec3>& points_world_m) {
  frame_structure(run, points_world_m);
}

Picture draw_voxels(RunSource& run, const PictureOptions& options, const RenderView&) {
  const std::size_t last = run.record().views.empty() ? 0 : run.record().views.size() - 1;
  const std::size_t iteration = iteration_of(run.record(), options, last);
  const OccupancyGrid& grid = run.belief_after(iteration).grid;
  const GridGeometry& geometry = grid.geometry();
  const SortedVoxels voxels = sort_voxels(grid);

  double low_m = 0.0;
  double high_m = 1.0;
  std::vector<double> heights_m;
  for (const VoxelIndex v : voxels.occupied) {
    heights_m.push_back(geometry.center_m(geometry.key_at(v)[2]));
  }
  if (!heights_m.empty()) {
    const auto [low, high] = std::minmax_element(heights_m.begin(), heights_m.end());
    low_m = *low;
    high_m = std::max(*high, low_m + geometry.resolution_m());
  }
  std::vector<Rgb> colours;
  for (const double z_m : heights_m)
    colours.push_back(amount_ramp((z_m - low_m) / (high_m - low_m)));

  Picture picture{.panels = std::vector<Panel>(1)};
  RenderScene& scene = picture.panels.front().scene;
  add_ground(run, scene);
  if (!voxels.occupied.empty()) {
    scene.surfaces.push_back(voxel_cubes(geometry, voxels.occupied, colours));
  }
  const std::vector<Rgb> predicted = {kPredicted};
  scene.surfaces.push_back(voxel_cubes(geometry, voxels.predicted, predicted));
  scene.surfaces.push_back(free_faces(grid, voxels.unknown, kUnknown, 0.55F));
  picture.detail =
      fmt::format("after view {}: {} voxels of {} m occupied, {} predicted", iteration,
                  voxels.occupied.size(), geometry.resolution_m(), voxels.predicted.size());
  picture.legend = {{"unknown beside free, near surface", {kUnknown}},
                    {"predicted by symmetry", {kPredicted}},
                    {.label = fmt::format("{:.1f} m", high_m),
                     .colours = amount_colours(),
                     .label_before = fmt::format("occupied, height {:.1f}", low_m)}};
  return picture;
}

}  // namespace

const PictureKind kVoxelsPicture = {.name = "voxels",
                                    .shows = "OctoMap voxels: occupied, predicted, unknown",
                                    .frame = frame_voxels,
                                    .draw = draw_voxels};

}  // namespace gnbv
