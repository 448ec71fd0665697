// The profile growing, as Figure 4 of the paper shows it: what was flown of the way around the
// workspace, and what the LIDARs have seen from there.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "sim/core/text.hpp"
#include "tools/render/picture.hpp"
#include "tools/scene/flight.hpp"
#include "tools/scene/structure.hpp"
#include "tools/scene/voxels.hpp"

namespace gnbv {
namespace {

void frame_profile(RunSource& run, const PictureOptions&, std::vector<Vec3>& points_world_m) {
  frame_structure(run, points_world_m);
  const std::array<Vec3, 8> corners = corners_m(run.record().scenario.workspace_m);
  points_world_m.insert(points_world_m.end(), corners.begin(), corners.end());
  const double end_s = run.record().profile_end_s.value_or(0.0);
  for (const TrajectorySample& sample : run.record().path) {
    if (sample.time_s <= end_s) points_world_m.push_back(sample.T_world_body.translation());
  }
}

/// The twelve edges of the box.
void add_box(const Box3& box_m, double unit_m, RenderScene& scene) {
  const std::array<Vec3, 8> corners = corners_m(box_m);
  for (std::size_t i = 0; i < 8; ++i) {
    for (const std::size_t bit : {1U, 2U, 4U}) {
      if ((i & bit) != 0) continue;
      scene.add_line(corners[i], corners[i | bit], unit_m, looks::kWorkspace.rgb());
    }
  }
}

Panel panel_of(RunSource& run, const ProfileStage& stage, double unit_m) {
  const double leaf_m = run.record().scenario.planner.cloud.profile_leaf_m;
  Panel panel;
  RenderScene& scene = panel.scene;
  scene.shading = kDataShading;
  add_ghost(run, 0.6F, scene);
  DotsItem& dots =
      scene.dots.emplace_back(cloud_dots(stage.points_world_m, leaf_m, looks::kSeen.rgb()));
  dots.radius_m = static_cast<float>(std::max(0.45 * leaf_m, 1.0 * unit_m));
  scene.tubes.push_back(path_tube(stage.path_world_m, 1.5 * unit_m, looks::kProfile.rgb()));
  add_box(run.record().scenario.workspace_m, unit_m, scene);
  if (!stage.path_world_m.empty()) {
    const Vec3& start_m = stage.path_world_m.front();
    panel.labels.push_back({start_m, "S", looks::kViewBefore.rgb()});
  }
  for (std::size_t i = 0; i < stage.waypoints_world_m.size(); ++i) {
    const Vec3& p_m = stage.waypoints_world_m[i];
    scene.add_ball(p_m, 4.5 * unit_m, looks::kProfile.rgb());
    panel.labels.push_back({p_m, fmt::format("{}", i + 1), looks::kProfile.rgb()});
  }
  panel.note = fmt::format("{}: {}", counted(stage.waypoints, "waypoint"),
                           counted(stage.points_world_m.size(), "point"));
  return panel;
}

Picture draw_profile(RunSource& run, const PictureOptions& options, const RenderView& view) {
  const std::vector<ProfileStage>& stages = run.profile();
  Picture picture;
  for (const ProfileStage& stage : stages) {
    picture.panels.push_back(
        panel_of(run, stage, 0.7 * unit_px(options) / px_per_m_at_focus(view)));
  }
  const double leaf_m = run.record().scenario.planner.cloud.profile_leaf_m;
  picture.detail =
      fmt::format("profile of {}, {:.1f} s", counted(stages.back().waypoints, "waypoint"),
                  run.record().profile_end_s.value_or(0.0));
  picture.legend = {entry(looks::kProfile, LegendItem::Mark::line, " from S, waypoints numbered"),
                    entry(looks::kWorkspace, LegendItem::Mark::line),
                    entry(looks::kStructure),
                    {fmt::format("LIDAR points, thinned to one in {} m", leaf_m),
                     {looks::kSeen.rgb()},
                     LegendItem::Mark::dot}};
  return picture;
}

}  // namespace

const PictureKind kProfilePicture = {.name = "profile",
                                     .shows = "profile after 1, 3 and all waypoints (Fig. 4)",
                                     .panels = 3,
                                     // three in a row are high: seen from above, they are filled
                                     .angles = {deg_to_rad(-150.0), deg_to_rad(45.0)},
                                     .frame = frame_profile,
                                     .draw = draw_profile};

}  // namespace gnbv
