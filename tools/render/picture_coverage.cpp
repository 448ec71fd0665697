// What of the true surface the cloud covers, and what it misses: as it always looks, and from where
// most of what is missing can be seen.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "bench/score/voxel_set.hpp"
#include "sim/core/error.hpp"
#include "sim/core/text.hpp"
#include "tools/render/picture.hpp"
#include "tools/scene/structure.hpp"
#include "tools/scene/voxels.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kMostAsked = 2000;  // of the missed voxels, when a direction is judged

struct Judged {
  std::vector<bool> is_missed = {};        // of all voxels
  std::vector<Vec3f> missed_world_m = {};  // surface points of those missed
};

Judged judge(RunSource& run, const PictureOptions& options) {
  const SurfaceReference& reference = run.reference();
  const VoxelSet seen = covered_voxels(points_by(run, options), 0);
  Judged judged;
  const VoxelSet& surface = reference.counted.front();
  for (std::size_t i = 0; i < surface.size(); ++i) {
    judged.is_missed.push_back(!std::binary_search(seen.begin(), seen.end(), surface[i]));
    if (judged.is_missed.back()) judged.missed_world_m.push_back(reference.points_world_m[i]);
  }
  return judged;
}

/// Of voxels so many times as large, each of a colour between, by the share of it that is missed: a
/// voxel that is smaller than a pixel would flicker.
SurfaceItem faces_of(const VoxelSet& surface, const std::vector<bool>& is_missed, int factor) {
  std::map<std::uint64_t, std::array<float, 2>> counts;  // missed, all
  for (std::size_t i = 0; i < surface.size(); ++i) {
    std::array<float, 2>& count = counts[coarser_code(surface[i], factor)];
    count[0] += is_missed[i] ? 1.0F : 0.0F;
    count[1] += 1.0F;
  }
  const std::array<Rgb, 2> ends = {looks::kFound.rgb(), looks::kMissed.rgb()};
  VoxelSet voxels;
  std::vector<Rgb> colours;
  for (const auto& [code, count] : counts) {
    voxels.push_back(code);
    colours.push_back(ramp(ends, count[0] / count[1]));
  }
  return exposed_faces(voxels, factor * kCoverageSizes_m.front(), colours);
}

/// How many voxels make one that is at least so many pixels wide.
int factor_of(const RenderView& view) {
  constexpr double kLeast_px = 1.5;
  const double voxel_px = kCoverageSizes_m.front() * px_per_m_at_focus(view);
  return std::max(1, static_cast<int>(std::ceil(kLeast_px / voxel_px - 1e-9)));
}

/// Which of the points something hides in those directions (n).
std::vector<std::uint8_t> are_hidden(const RayScene& scene, std::span<const Vec3f> points_world_m,
                                     std::span<const Vec3f> directions) {
  constexpr auto kBeside_m = static_cast<float>(0.2 * kCoverageSizes_m.front());
  std::vector<std::uint8_t> is_hidden(points_world_m.size());
  scene.find_blocked(kMeshParts, points_world_m, directions, kBeside_m, kEndless, is_hidden);
  return is_hidden;
}

/// Of eight directions around, from above, from below, steeply from above, and level, the first
/// that shows the most of what the runs miss together, but none that looks as the first panel does.
std::optional<ViewAngles> angles_to_most(std::span<RunSource* const> runs,
                                         const PictureOptions& options, const RenderView& first) {
  constexpr double kOtherSide_rad = deg_to_rad(50.0);
  const Vec3 shown = -first.T_world_camera.linear().col(2);
  std::vector<ViewAngles> all;
  for (const double elevation_deg : {28.0, -25.0, 60.0, 5.0}) {
    for (int i = 0; i < 8; ++i) {
      const ViewAngles angles{deg_to_rad(60.0 - 45.0 * i), deg_to_rad(elevation_deg)};
      if (to_camera(angles).dot(shown) <= std::cos(kOtherSide_rad)) all.push_back(angles);
    }
  }
  std::vector<double> shares(all.size(), 0.0);  // of what is missed, summed over the runs
  for (RunSource* const run : runs) {
    try {
      const std::vector<Vec3f> missed_m = judge(*run, options).missed_world_m;
      const std::size_t step = 1 + missed_m.size() / kMostAsked;
      std::vector<Vec3f> asked_m;
      for (std::size_t i = 0; i < missed_m.size(); i += step) asked_m.push_back(missed_m[i]);
      for (std::size_t i = 0; i < all.size() && !asked_m.empty(); ++i) {
        const std::vector<Vec3f> directions(asked_m.size(), to_camera(all[i]).cast<float>());
        const std::vector<std::uint8_t> is_hidden = are_hidden(run->scene(), asked_m, directions);
        const auto open = std::count(is_hidden.begin(), is_hidden.end(), 0);
        shares[i] += static_cast<double>(open) / static_cast<double>(asked_m.size());
      }
    } catch (const BadInput&) {  // of what the run lacks; its picture will say so
    }
    if (runs.size() > 1) run->forget();
  }
  const auto most = std::max_element(shares.begin(), shares.end());
  if (most == shares.end() || *most == 0.0) return ViewAngles{deg_to_rad(60.0), deg_to_rad(28.0)};
  return all[static_cast<std::size_t>(most - shares.begin())];
}

/// Where a camera stands: "the north-east, below".
std::string side_of(const ViewAngles& angles) {
  constexpr std::array<std::string_view, 8> kSides = {"east", "north-east", "north", "north-west",
                                                      "west", "south-west", "south", "south-east"};
  const auto side = static_cast<std::size_t>(std::lround(angles.azimuth_rad / (0.25 * kPi)) + 16);
  const char* const height = angles.elevation_rad < 0.0                ? ", below"
                             : angles.elevation_rad > deg_to_rad(45.0) ? ", above"
                                                                       : "";
  return fmt::format("the {}{}", kSides[side % 8], height);
}

/// Which of the points a picture shows (n).
std::vector<bool> in_sight(RunSource& run, std::span<const Vec3f> points_world_m,
                           const RenderView& view) {
  const Vec3f eye = view.T_world_camera.translation().cast<float>();
  std::vector<Vec3f> directions;
  for (const Vec3f& p_m : points_world_m) directions.push_back((eye - p_m).normalized());
  const std::vector<std::uint8_t> is_hidden = are_hidden(run.scene(), points_world_m, directions);
  std::vector<bool> is_shown;
  for (std::size_t i = 0; i < points_world_m.size(); ++i) {
    is_shown.push_back(is_hidden[i] == 0 && is_within(view, points_world_m[i].cast<double>()));
  }
  return is_shown;
}

RenderView other_view(RunSource& run, const ViewAngles& angles, const RenderView& view) {
  std::vector<Vec3> points;
  frame_structure(run, points);
  const FrameMargins margins{.left = 0.05, .right = 0.05, .top = 0.05, .bottom = 0.08};
  RenderView other = frame_points(points, angles, view.width_px, view.height_px, margins);
  if (angles.elevation_rad < 0.0) other.to_light_world.z() *= -1.0;  // the side that is seen
  return other;
}

Picture draw_coverage(RunSource& run, const PictureOptions& options, const RenderView& view) {
  const VoxelSet& surface = run.reference().counted.front();
  const double size_m = kCoverageSizes_m.front();
  const Judged judged = judge(run, options);
  const std::size_t missed = judged.missed_world_m.size();
  RunSource* const alone[] = {&run};
  const ViewAngles other =
      options.second_angles ? *options.second_angles : *angles_to_most(alone, options, view);
  const int factor = factor_of(view);
  Picture picture{.panels = std::vector<Panel>(2)};
  RenderScene& scene = picture.panels[0].scene;
  add_ground(run, scene);
  scene.surfaces.push_back(faces_of(surface, judged.is_missed, factor));
  scene.shading = kDataShading;
  picture.panels[1].scene = scene;
  picture.panels[1].view = other_view(run, other, view);
  const std::vector<bool> in_first = in_sight(run, judged.missed_world_m, view);
  const std::vector<bool> in_second = in_sight(run, judged.missed_world_m, *picture.panels[1].view);
  std::size_t neither = 0;
  for (std::size_t i = 0; i < missed; ++i) neither += in_first[i] || in_second[i] ? 0 : 1;
  const auto count = [](const std::vector<bool>& is_seen) {
    return grouped(static_cast<std::size_t>(std::count(is_seen.begin(), is_seen.end(), true)));
  };
  picture.panels[0].note =
      fmt::format("{} missed, {} of them in sight", counted(missed, "voxel"), count(in_first));
  picture.panels[1].note = fmt::format("{} in sight from {}; {} in neither", count(in_second),
                                       side_of(other), grouped(neither));
  const double share = static_cast<double>(surface.size() - missed) /
                       static_cast<double>(std::max<std::size_t>(1, surface.size()));
  picture.detail = fmt::format(
      "{:.1f} % of {} {} voxels of {} m covered", 100.0 * share, grouped(surface.size()),
      run.reference().area_samples == 0 ? "surface" : "area-sample", size_m);
  picture.detail += words_on_iteration(run.record(), options);
  if (factor > 1) {
    picture.detail += fmt::format("; drawn in voxels of {:.2f} m, colours mixed", factor * size_m);
  }
  picture.legend = {entry(looks::kFound), entry(looks::kMissed)};
  return picture;
}

}  // namespace

const PictureKind kCoveragePicture = {
    .name = "coverage",
    .shows = "true surface: covered by the cloud, or missed; from two sides",
    .panels = 2,
    .second_angles = angles_to_most,
    .draw = draw_coverage};

}  // namespace gnbv
