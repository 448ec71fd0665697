// The point cloud, coloured by how densely its points lie.
#include <fmt/format.h>

#include <algorithm>

#include "bench/score/voxel_set.hpp"
#include "tools/render/picture.hpp"
#include "tools/render/point_normals.hpp"

namespace gnbv {
namespace {

void frame_cloud(RunSource& run, const PictureOptions&, std::vector<Vec3>& points_world_m) {
  frame_structure(run, points_world_m);
}

// Points of each point's voxel.
std::vector<std::uint32_t> densities(std::span<const Vec3f> points_world_m, double voxel_m) {
  std::vector<std::uint64_t> codes(points_world_m.size());
  for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = voxel_code(points_world_m[i], voxel_m);
  std::vector<std::uint64_t> sorted = codes;
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::uint32_t> counts(codes.size());
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const auto [first, last] = std::equal_range(sorted.begin(), sorted.end(), codes[i]);
    counts[i] = static_cast<std::uint32_t>(last - first);
  }
  return counts;
}

Picture draw_cloud(RunSource& run, const PictureOptions& options, const RenderView&) {
  const RunRecord& record = run.record();
  const RunCloud& cloud = run.cloud();
  std::size_t count = cloud.points_world_m.size();
  std::string when;
  if (options.iteration) {
    const std::size_t iteration = iteration_of(record, options, 0);
    count = cloud.view_points[iteration];
    when = fmt::format(" after view {}", iteration);
  }
  const double voxel_m = record.scenario.planner.map.resolution_m;
  const auto points = std::span(cloud.points_world_m).first(count);
  DotsItem dots{.points_m = {points.begin(), points.end()},
                .normals = point_normals(points, 2.5 * record.scenario.planner.cloud.leaf_m),
                .colours = {},
                .radius_m = static_cast<float>(0.75 * record.scenario.planner.cloud.leaf_m)};
  const std::vector<std::uint32_t> counts = densities(points, voxel_m);
  // the few densest voxels would leave everything else in one colour
  std::vector<std::uint32_t> sorted = counts;
  std::sort(sorted.begin(), sorted.end());
  const std::uint32_t top = sorted.empty() ? 1 : sorted[sorted.size() * 95 / 100];
  for (const std::uint32_t density : counts) {
    dots.colours.push_back(amount_ramp((density - 1.0) / std::max(1.0, top - 1.0)));
  }
  Picture picture{.panels = std::vector<Panel>(1)};
  RenderScene& scene = picture.panels.front().scene;
  add_ground(run, scene);
  scene.dots.push_back(std::move(dots));
  picture.detail = fmt::format("{} points{}", count, when);
  picture.legend = {{.label = fmt::format("{} or more points a voxel of {} m", top, voxel_m),
                     .colours = amount_colours(),
                     .label_before = "1"}};
  return picture;
}

}  // namespace

const PictureKind kCloudPicture = {.name = "cloud",
                                   .shows = "point cloud coloured by density",
                                   .frame = frame_cloud,
                                   .draw = draw_cloud};

}  // namespace gnbv
