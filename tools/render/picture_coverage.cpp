// What of the true surface the cloud covers, and what it misses: as it always looks, and from where
// most of what is missing can be seen.
#include <fmt/format.h>

#include <algorithm>

#include "bench/score/voxel_set.hpp"
#include "tools/render/picture.hpp"
#include "tools/render/voxel_items.hpp"
#include "tools/run_files/words.hpp"

namespace gnbv {
namespace {

const Rgb kCovered = srgb(0xa9c3d6);
const Rgb kMissed = srgb(0xd5420a);
constexpr std::size_t kMostAsked = 2000;  // of the missed voxels, when a direction is judged

void frame_coverage(RunSource& run, const PictureOptions&, std::vector<Vec3>& points_world_m) {
  frame_structure(run, points_world_m);
}

struct Judged {
  std::vector<Rgb> colours = {};           // of all voxels
  std::vector<Vec3f> missed_world_m = {};  // surface points of those missed
};

Judged judge(const SurfaceReference& reference, const VoxelSet& seen) {
  Judged judged;
  const VoxelSet& surface = reference.outside.front();
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const bool is_seen = std::binary_search(seen.begin(), seen.end(), surface[i]);
    judged.colours.push_back(is_seen ? kCovered : kMissed);
    if (!is_seen) judged.missed_world_m.push_back(reference.points_world_m[i]);
  }
  return judged;
}

/// How many of the points nothing hides from that side.
std::size_t open_points(const RayScene& scene, std::span<const Vec3f> points_world_m,
                        const Vec3f& to_camera, double size_m) {
  const std::vector<Vec3f> directions(points_world_m.size(), to_camera);
  std::vector<std::uint8_t> is_hidden(points_world_m.size());
  scene.anything_blocks(points_world_m, directions, static_cast<float>(0.2 * size_m), kEndless,
                        is_hidden);
  return static_cast<std::size_t>(std::count(is_hidden.begin(), is_hidden.end(), 0));
}

/// Of eight directions around, from below, level, and from above: the first that sees the most, but
/// none that looks as the first picture does, from `shown` (unit, to its camera).
ViewAngles angles_to_most(RunSource& run, const std::vector<Vec3f>& missed_world_m, double size_m,
                          const Vec3& shown) {
  std::vector<Vec3f> asked;
  const std::size_t step = 1 + missed_world_m.size() / kMostAsked;
  for (std::size_t i = 0; i < missed_world_m.size(); i += step) asked.push_back(missed_world_m[i]);
  ViewAngles best{deg_to_rad(60.0), deg_to_rad(28.0)};  // with nothing missed: the other side
  std::size_t most = 0;
  for (const double elevation_deg : {28.0, -25.0, 60.0, 5.0}) {
    for (int i = 0; i < 8; ++i) {
      const ViewAngles angles{deg_to_rad(60.0 - 45.0 * i), deg_to_rad(elevation_deg)};
      const double level = std::cos(angles.elevation_rad);
      const Vec3 to_camera(level * std::cos(angles.azimuth_rad),
                           level * std::sin(angles.azimuth_rad), std::sin(angles.elevation_rad));
      constexpr double kOtherSide_rad = deg_to_rad(50.0);
      if (to_camera.dot(shown) > std::cos(kOtherSide_rad)) continue;
      const std::size_t count = open_points(run.scene(), asked, to_camera.cast<float>(), size_m);
      if (count <= most) continue;
      most = count;
      best = angles;
    }
  }
  return best;
}

std::string_view compass(double azimuth_rad) {
  constexpr std::array<std::string_view, 8> kNames = {"east", "north-east", "north", "north-west",
                                                      "west", "south-west", "south", "south-east"};
  const long eighth = std::lround(azimuth_rad / deg_to_rad(45.0));
  return kNames[static_cast<std::size_t>((eighth % 8 + 8) % 8)];
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
  const RunCloud& cloud = run.cloud();
  std::size_t count = cloud.points_world_m.size();
  std::string when;
  if (options.iteration) {
    const std::size_t iteration = iteration_of(run.record(), options, 0);
    count = cloud.view_points[iteration];
    when = " after " + views_so_far(run.record(), iteration);
  }
  const SurfaceReference& reference = run.reference();
  const VoxelSet& surface = reference.outside.front();
  const double size_m = kCoverageSizes_m.front();
  const VoxelSet seen = voxels_of(std::span(cloud.points_world_m).first(count), size_m);
  const Judged judged = judge(reference, seen);
  const std::size_t missed = judged.missed_world_m.size();
  const ViewAngles other =
      angles_to_most(run, judged.missed_world_m, size_m, -view.T_world_camera.linear().col(2));

  Picture picture{.panels = std::vector<Panel>(2)};
  RenderScene& scene = picture.panels[0].scene;
  add_ground(run, scene);
  scene.surfaces.push_back(exposed_faces(surface, size_m, judged.colours));
  picture.panels[1].scene = scene;
  picture.panels[1].view = other_view(run, other, view);
  picture.panels[1].note = fmt::format("more of it shows from the {}{}", compass(other.azimuth_rad),
                                       other.elevation_rad < 0.0 ? ", below" : "");
  picture.panels[0].note = fmt::format("{} missed", counted(missed, "voxel"));
  const double share = static_cast<double>(surface.size() - missed) /
                       static_cast<double>(std::max<std::size_t>(1, surface.size()));
  picture.detail = fmt::format("{:.1f} % of {} surface voxels of {} m covered{}", 100.0 * share,
                               grouped(surface.size()), size_m, when);
  picture.legend = {{"covered", {kCovered}}, {"missed", {kMissed}}};
  return picture;
}

}  // namespace

const PictureKind kCoveragePicture = {
    .name = "coverage",
    .shows = "true surface: covered by the cloud, or missed; from two sides",
    .panels = 2,
    .frame = frame_coverage,
    .draw = draw_coverage};

}  // namespace gnbv
