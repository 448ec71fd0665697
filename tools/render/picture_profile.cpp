// The profile growing, as Figure 4 of the paper shows it.
#include <fmt/format.h>

#include "tools/render/flight_items.hpp"
#include "tools/render/picture.hpp"
#include "tools/render/point_normals.hpp"

namespace gnbv {
namespace {

const Rgb kPoints = srgb(0x0b6fa8);

void frame_profile(RunSource& run, const PictureOptions&, std::vector<Vec3>& points_world_m) {
  frame_structure(run, points_world_m);  // the flight runs wide around it
}

Picture draw_profile(RunSource& run, const PictureOptions&, const RenderView& view) {
  const std::vector<ProfileStage>& stages = run.profile();
  const double unit_m = layout_unit_m(view);
  const double leaf_m = run.record().scenario.planner.cloud.profile_leaf_m;
  Picture picture;
  for (const ProfileStage& stage : stages) {
    Panel panel;
    add_ghost(run, 0.45F, panel.scene);
    panel.scene.dots.push_back(
        {.points_m = stage.points_world_m,
         .normals = point_normals(stage.points_world_m, 2.5 * leaf_m),
         .colours = {kPoints},
         .radius_m = static_cast<float>(std::max(0.45 * leaf_m, 0.8 * unit_m))});
    panel.scene.tubes.push_back(path_tube(stage.path_world_m, unit_m, path_ramp(0.75)));
    const Vec3& end = stage.path_world_m.back();
    panel.scene.balls.push_back(
        {end.cast<float>(), static_cast<float>(4.0 * unit_m), path_ramp(0.75)});
    panel.note = fmt::format("{} waypoint{}: {} points", stage.waypoints,
                             stage.waypoints == 1 ? "" : "s", stage.points_world_m.size());
    picture.panels.push_back(std::move(panel));
  }
  picture.detail = fmt::format("profile of {} waypoint{}, {:.1f} s", stages.back().waypoints,
                               stages.back().waypoints == 1 ? "" : "s",
                               run.record().profile_end_s.value_or(0.0));
  picture.legend = {
      {"flown", {path_ramp(0.75)}, LegendItem::Mark::line},
      {fmt::format("LIDAR points, one a leaf of {} m", leaf_m), {kPoints}, LegendItem::Mark::dot}};
  return picture;
}

}  // namespace

const PictureKind kProfilePicture = {.name = "profile",
                                     .shows = "profile after 1, 3 and all waypoints (Fig. 4)",
                                     .panels = 3,
                                     .frame = frame_profile,
                                     .draw = draw_profile};

}  // namespace gnbv
