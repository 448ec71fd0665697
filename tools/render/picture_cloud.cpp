// The point cloud, coloured by how densely its points lie.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/score/voxel_set.hpp"
#include "sim/core/text.hpp"
#include "tools/render/picture.hpp"
#include "tools/scene/structure.hpp"
#include "tools/scene/voxels.hpp"

namespace gnbv {
namespace {

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

/// Of each point: whether its voxel holds points of the profile alone, the first ones.
std::vector<bool> are_of_profile_alone(std::span<const Vec3f> points_world_m, std::size_t profile,
                                       double voxel_m) {
  const std::size_t first = std::min(profile, points_world_m.size());
  const VoxelSet looked_at = voxels_of(points_world_m.subspan(first), voxel_m);
  std::vector<bool> are_alone(points_world_m.size(), false);
  for (std::size_t i = 0; i < first; ++i) {
    are_alone[i] = !std::binary_search(looked_at.begin(), looked_at.end(),
                                       voxel_code(points_world_m[i], voxel_m));
  }
  return are_alone;
}

/// From 1 to what 95 % of the points stay under, in two digits: the few densest voxels would leave
/// everything else in one colour.
std::array<double, 2> range_of(std::vector<std::uint32_t> counts) {
  if (counts.empty()) return {1.0, 1.0};
  std::sort(counts.begin(), counts.end());
  const double most = counts[counts.size() * 95 / 100];
  const double digit = std::pow(10.0, std::max(0.0, std::floor(std::log10(most)) - 1.0));
  return {1.0, digit * std::ceil(most / digit)};
}

std::array<double, 2> density_range(RunSource& run, const PictureOptions& options) {
  const double voxel_m = run.record().scenario.planner.map.resolution_m;
  return range_of(densities(points_by(run, options), voxel_m));
}

Picture draw_cloud(RunSource& run, const PictureOptions& options, const RenderView&) {
  const RunRecord& record = run.record();
  const double voxel_m = record.scenario.planner.map.resolution_m;
  const std::span<const Vec3f> points = points_by(run, options);
  DotsItem dots = cloud_dots(points, record.scenario.planner.cloud.leaf_m, {});
  dots.colours.clear();
  const std::vector<std::uint32_t> counts = densities(points, voxel_m);
  const double top = options.colour_range.value_or(range_of(counts))[1];
  const std::vector<bool> are_alone =
      are_of_profile_alone(points, run.cloud().profile_points, voxel_m);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const Rgb colour = amount_ramp((counts[i] - 1.0) / std::max(1.0, top - 1.0));
    dots.colours.push_back(are_alone[i] ? looks::kProfilePoints.rgb() : colour);
  }
  Picture picture{.panels = std::vector<Panel>(1)};
  RenderScene& scene = picture.panels.front().scene;
  add_ground(run, scene);
  scene.dots.push_back(std::move(dots));
  scene.shading = kDataShading;
  picture.detail = counted(points.size(), "point") + words_on_iteration(record, options);
  const auto alone = static_cast<std::size_t>(std::count(are_alone.begin(), are_alone.end(), true));
  if (alone > 0) {
    picture.legend.push_back(
        entry(looks::kProfilePoints, LegendItem::Mark::dot, ": " + counted(alone, "point")));
  }
  picture.legend.push_back(
      bar(amount_colours(), fmt::format("points in their voxel of {} m, from 1", voxel_m),
          fmt::format("{:.0f} or more", top), fmt::format("{:.0f}", 0.5 * (1.0 + top))));
  return picture;
}

}  // namespace

const PictureKind kCloudPicture = {.name = "cloud",
                                   .shows = "point cloud coloured by density",
                                   .colour_range = density_range,
                                   .draw = draw_cloud};

}  // namespace gnbv
