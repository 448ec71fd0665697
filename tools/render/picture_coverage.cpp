// What of the true surface the cloud covers, and what it misses.
#include <fmt/format.h>

#include <algorithm>

#include "bench/score/voxel_set.hpp"
#include "tools/render/picture.hpp"
#include "tools/render/point_normals.hpp"

namespace gnbv {
namespace {

const Rgb kCovered = srgb(0x8fb4cf);
const Rgb kMissed = srgb(0xd5420a);

void frame_coverage(RunSource& run, const PictureOptions&, std::vector<Vec3>& points_world_m) {
  frame_structure(run, points_world_m);
}

Picture draw_coverage(RunSource& run, const PictureOptions& options, const RenderView&) {
  const RunCloud& cloud = run.cloud();
  std::size_t count = cloud.points_world_m.size();
  std::string when;
  if (options.iteration) {
    const std::size_t iteration = iteration_of(run.record(), options, 0);
    count = cloud.view_points[iteration];
    when = fmt::format(" after view {}", iteration);
  }
  const SurfaceReference& reference = run.reference();
  const VoxelSet& surface = reference.outside.front();
  const double size_m = kCoverageSizes_m.front();
  const VoxelSet seen = voxels_of(std::span(cloud.points_world_m).first(count), size_m);
  // a point a voxel, in the order of the voxels; dots as wide as the voxels close the surface
  const std::vector<Vec3f> normals = point_normals(reference.points_world_m, size_m);
  DotsItem covered{.colours = {kCovered}, .radius_m = static_cast<float>(0.75 * size_m)};
  DotsItem missed{.colours = {kMissed}, .radius_m = static_cast<float>(0.8 * size_m)};
  for (std::size_t i = 0; i < surface.size(); ++i) {
    DotsItem& dots = std::binary_search(seen.begin(), seen.end(), surface[i]) ? covered : missed;
    dots.points_m.push_back(reference.points_world_m[i]);
    dots.normals.push_back(normals[i]);
  }
  Picture picture{.panels = std::vector<Panel>(1)};
  const double share = static_cast<double>(covered.points_m.size()) /
                       static_cast<double>(std::max<std::size_t>(1, surface.size()));
  picture.detail = fmt::format("{:.1f} % of {} surface voxels of {} m covered{}", 100.0 * share,
                               surface.size(), size_m, when);
  picture.legend = {{fmt::format("covered {}", covered.points_m.size()), {kCovered}},
                    {fmt::format("missed {}", missed.points_m.size()), {kMissed}}};
  RenderScene& scene = picture.panels.front().scene;
  add_ground(run, scene);
  scene.dots.push_back(std::move(covered));
  scene.dots.push_back(std::move(missed));
  return picture;
}

}  // namespace

const PictureKind kCoveragePicture = {.name = "coverage",
                                      .shows = "true surface: covered by the cloud, or missed",
                                      .frame = frame_coverage,
                                      .draw = draw_coverage};

}  // namespace gnbv
