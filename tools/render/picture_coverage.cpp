// What of the true surface the cloud covers, and what it misses: as it always looks, and from where
// most of what is missing can be seen.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "bench/score/voxel_set.hpp"
#include "sim/core/error.hpp"
#include "tools/render/picture.hpp"
#include "tools/render/voxel_items.hpp"
#include "tools/run/words.hpp"

namespace gnbv {
namespace {

const Rgb kCovered = srgb(0xa9c3d6);
const Rgb kMissed = srgb(0xd5420a);
constexpr std::size_t kMostAsked = 2000;  // of the missed voxels, when a direction is judged

void frame_coverage(RunSource& run, const PictureOptions&, std::vector<Vec3>& points_world_m) {
  frame_structure(run, points_world_m);
}

/// Points of the cloud that a picture is about.
std::span<const Vec3f> points_seen(RunSource& run, const PictureOptions& options) {
  const std::span<const Vec3f> all = run.cloud().points_world_m;
  if (!options.iteration) return all;
  return all.first(run.cloud().view_points[iteration_of(run.record(), options, 0)]);
}

struct Judged {
  std::vector<bool> is_missed = {};        // of all voxels
  std::vector<Vec3f> missed_world_m = {};  // surface points of those missed
};

Judged judge(RunSource& run, const PictureOptions& options) {
  const SurfaceReference& reference = run.reference();
  const VoxelSet seen = voxels_of(points_seen(run, options), kCoverageSizes_m.front());
  Judged judged;
  const VoxelSet& surface = reference.outside.front();
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
  const std::array<Rgb, 2> ends = {kCovered, kMissed};
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
                                     std::span<const Vec3f> directions, double size_m) {
  std::vector<std::uint8_t> is_hidden(points_world_m.size());
  scene.find_blocked(kMeshParts, points_world_m, directions, static_cast<float>(0.2 * size_m),
                     kEndless, is_hidden);
  return is_hidden;
}

Vec3 to_camera(const ViewAngles& angles) {
  const double level = std::cos(angles.elevation_rad);
  return {level * std::cos(angles.azimuth_rad), level * std::sin(angles.azimuth_rad),
          std::sin(angles.elevation_rad)};
}

/// Eight directions around, from above, from below, steeply from above, and level.
std::vector<ViewAngles> directions() {
  std::vector<ViewAngles> all;
  for (const double elevation_deg : {28.0, -25.0, 60.0, 5.0}) {
    for (int i = 0; i < 8; ++i) {
      all.push_back({deg_to_rad(60.0 - 45.0 * i), deg_to_rad(elevation_deg)});
    }
  }
  return all;
}

/// Of each direction: the share of the missed points that it shows.
std::vector<double> shares_shown(RunSource& run, const std::vector<Vec3f>& missed_world_m) {
  std::vector<Vec3f> asked;
  const std::size_t step = 1 + missed_world_m.size() / kMostAsked;
  for (std::size_t i = 0; i < missed_world_m.size(); i += step) asked.push_back(missed_world_m[i]);
  std::vector<double> shares;
  for (const ViewAngles& angles : directions()) {
    const std::vector<Vec3f> directions(asked.size(), to_camera(angles).cast<float>());
    const std::vector<std::uint8_t> is_hidden =
        are_hidden(run.scene(), asked, directions, kCoverageSizes_m.front());
    const auto open = std::count(is_hidden.begin(), is_hidden.end(), 0);
    shares.push_back(static_cast<double>(open) /
                     static_cast<double>(std::max<std::size_t>(1, asked.size())));
  }
  return shares;
}

/// The first direction that shows the most, but none that looks as the first panel does.
ViewAngles angles_to_most(std::span<const double> shares, const RenderView& first) {
  constexpr double kOtherSide_rad = deg_to_rad(50.0);
  const Vec3 shown = -first.T_world_camera.linear().col(2);
  ViewAngles best{deg_to_rad(60.0), deg_to_rad(28.0)};  // with nothing missed: the other side
  double most = 0.0;
  const std::vector<ViewAngles> all = directions();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (to_camera(all[i]).dot(shown) > std::cos(kOtherSide_rad) || shares[i] <= most) continue;
    most = shares[i];
    best = all[i];
  }
  return best;
}

/// The direction that shows the most of what the runs miss together.
std::optional<ViewAngles> angles_for_all(std::span<RunSource* const> runs,
                                         const PictureOptions& options, const RenderView& view) {
  std::vector<double> sums(directions().size(), 0.0);
  for (RunSource* const run : runs) {
    try {
      const std::vector<double> own = shares_shown(*run, judge(*run, options).missed_world_m);
      std::transform(own.begin(), own.end(), sums.begin(), sums.begin(), std::plus<>());
    } catch (const BadInput&) {  // of what the run lacks; its picture will say so
    }
    run->forget();
  }
  return angles_to_most(sums, view);
}

/// Where a camera stands as seen by who looks along the first panel: "the right", "below, behind".
std::string side_of(const ViewAngles& angles, const RenderView& first) {
  const Vec3 shown = -first.T_world_camera.linear().col(2);
  const double turn_deg =
      rad_to_deg(wrap_angle_rad(angles.azimuth_rad - std::atan2(shown.y(), shown.x())));
  const std::string_view hand = turn_deg > 0.0 ? "the right" : "the left";
  const double size_deg = std::abs(turn_deg);
  std::string side = size_deg < 22.5    ? "the same side"
                     : size_deg < 112.5 ? std::string(hand)
                     : size_deg < 157.5 ? fmt::format("behind on {}", hand)
                                        : "behind";
  return (angles.elevation_rad < 0.0                ? "below, "
          : angles.elevation_rad > deg_to_rad(45.0) ? "above, "
                                                    : "") +
         side;
}

/// Which of the points a picture shows (n).
std::vector<bool> in_sight(RunSource& run, std::span<const Vec3f> points_world_m,
                           const RenderView& view) {
  const Vec3f eye = view.T_world_camera.translation().cast<float>();
  std::vector<Vec3f> directions;
  for (const Vec3f& p_m : points_world_m) directions.push_back((eye - p_m).normalized());
  const std::vector<std::uint8_t> is_hidden =
      are_hidden(run.scene(), points_world_m, directions, kCoverageSizes_m.front());
  std::vector<bool> is_shown;
  for (std::size_t i = 0; i < points_world_m.size(); ++i) {
    is_shown.push_back(is_hidden[i] == 0 && is_within(view, points_world_m[i].cast<double>()));
  }
  return is_shown;
}

/// What each panel shows of the points, and what neither does.
struct InSight {
  std::size_t first = 0, second = 0, neither = 0;
};

InSight count_in_sight(RunSource& run, std::span<const Vec3f> points_world_m,
                       const RenderView& first, const RenderView& second) {
  const std::vector<bool> in_first = in_sight(run, points_world_m, first);
  const std::vector<bool> in_second = in_sight(run, points_world_m, second);
  InSight counts;
  for (std::size_t i = 0; i < points_world_m.size(); ++i) {
    counts.first += in_first[i] ? 1 : 0;
    counts.second += in_second[i] ? 1 : 0;
    counts.neither += in_first[i] || in_second[i] ? 0 : 1;
  }
  return counts;
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
  const VoxelSet& surface = run.reference().outside.front();
  const double size_m = kCoverageSizes_m.front();
  const Judged judged = judge(run, options);
  const std::size_t missed = judged.missed_world_m.size();
  const ViewAngles other = options.second_angles
                               ? *options.second_angles
                               : angles_to_most(shares_shown(run, judged.missed_world_m), view);
  const int factor = factor_of(view);
  Picture picture{.panels = std::vector<Panel>(2)};
  RenderScene& scene = picture.panels[0].scene;
  add_ground(run, scene);
  scene.surfaces.push_back(faces_of(surface, judged.is_missed, factor));
  scene.shading = kDataShading;
  picture.panels[1].scene = scene;
  picture.panels[1].view = other_view(run, other, view);
  const InSight counts = count_in_sight(run, judged.missed_world_m, view, *picture.panels[1].view);
  picture.panels[0].note = fmt::format("{} missed, {} of them in sight", counted(missed, "voxel"),
                                       grouped(counts.first));
  picture.panels[1].note = fmt::format("{} in sight from {}; {} in neither", grouped(counts.second),
                                       side_of(other, view), grouped(counts.neither));
  const double share = static_cast<double>(surface.size() - missed) /
                       static_cast<double>(std::max<std::size_t>(1, surface.size()));
  picture.detail = fmt::format("{:.1f} % of {} surface voxels of {} m covered", 100.0 * share,
                               grouped(surface.size()), size_m);
  if (options.iteration) {
    picture.detail +=
        " after " + views_so_far(run.record(), iteration_of(run.record(), options, 0));
  }
  if (factor > 1) {
    picture.detail += fmt::format("; drawn in voxels of {:.2f} m, colours mixed", factor * size_m);
  }
  picture.legend = {{"covered", {kCovered}}, {"missed", {kMissed}}};
  return picture;
}

}  // namespace

const PictureKind kCoveragePicture = {
    .name = "coverage",
    .shows = "true surface: covered by the cloud, or missed; from two sides",
    .panels = 2,
    .frame = frame_coverage,
    .second_angles = angles_for_all,
    .draw = draw_coverage};

}  // namespace gnbv
