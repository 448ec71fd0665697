// The structure with the flown path, as Figures 8 and 10 of the paper show it.
#include "tools/render/flight_items.hpp"
#include "tools/render/picture.hpp"

namespace gnbv {
namespace {

void frame_path(RunSource& run, const PictureOptions& options, std::vector<Vec3>& points_world_m) {
  frame_structure(run, points_world_m);
  const RunRecord& record = run.record();
  const double begin_s = options.has_profile ? 0.0 : record.views_begin_s.value_or(0.0);
  for (const TrajectorySample& sample : record.path) {
    if (sample.time_s >= begin_s) points_world_m.push_back(sample.T_world_body.translation());
  }
  for (const ViewRecord& view : record.views)
    points_world_m.push_back(view.decision.view.p_world_m);
}

Picture draw_path(RunSource& run, const PictureOptions& options, const RenderView& view) {
  const RunRecord& record = run.record();
  Picture picture{.panels = std::vector<Panel>(1), .detail = run_detail(record)};
  RenderScene& scene = picture.panels.front().scene;
  add_structure(run, scene);
  const FlightLook look{.unit_m = layout_unit_m(view), .has_profile = options.has_profile};
  add_flight(record, look, scene);
  add_views(record, record.views.size(), options.every, look, scene);
  if (record.views_begin_s && options.has_profile) {
    picture.legend.push_back({"profile", {kProfileColour}, LegendItem::Mark::line});
  }
  for (const LegendItem& item : legend_of_surroundings(run)) picture.legend.push_back(item);
  picture.legend.push_back(
      {.label = "last", .colours = path_colours(), .label_before = "first view"});
  return picture;
}

}  // namespace

const PictureKind kPathPicture = {.name = "path",
                                  .shows = "structure, flown path and views (Figs. 8, 10)",
                                  .frame = frame_path,
                                  .draw = draw_path};

}  // namespace gnbv
