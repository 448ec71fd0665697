// The structure with the flown path, as Figures 8 and 10 of the paper show it.
#include <fmt/format.h>

#include "tools/render/picture.hpp"
#include "tools/scene/flight.hpp"
#include "tools/scene/structure.hpp"

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

/// Where the first view is, and the last: over everything, or who finds the end of a tangle?
void add_ends(const RunRecord& record, Panel& panel) {
  if (record.views.empty()) return;
  const auto mark = [&](const ViewRecord& view, const Rgb& colour, const char* word) {
    const Vec3& p_m = view.decision.view.p_world_m;
    panel.lines.push_back({p_m, p_m, colour, 13.0});
    panel.labels.push_back({p_m, word});
  };
  mark(record.views.front(), path_ramp(0.0), "start");
  if (record.views.size() > 1) mark(record.views.back(), path_ramp(1.0), "end");
}

Picture draw_path(RunSource& run, const PictureOptions& options, const RenderView& view) {
  const RunRecord& record = run.record();
  Picture picture{.panels = std::vector<Panel>(1), .detail = run_detail(record)};
  if (options.surface) picture.detail += ", around the surface made of it";
  RenderScene& scene = picture.panels.front().scene;
  constexpr double kPiece_px = 2.0;
  if (options.surface) {  // what was made of the run's cloud (Fig. 8)
    add_ground(run, scene);
    scene.surfaces.push_back(options.surface(run, kPiece_px / px_per_m_at_focus(view)));
    add_surroundings(run, scene);
  } else {
    add_structure(run, view, scene);
  }
  const FlightLook look{.unit_m = layout_unit_m(view), .has_profile = options.has_profile};
  add_flight(record, look, scene);
  add_views(record, options.every, look, scene);
  add_ends(record, picture.panels.front());
  if (record.views_begin_s && options.has_profile) {
    picture.legend.push_back(entry(looks::kProfile, LegendItem::Mark::line));
  }
  for (const LegendItem& item : legend_of_surroundings(run)) picture.legend.push_back(item);
  const std::size_t step = pyramid_step(record.views.size(), options.every);
  picture.legend.push_back({step > 1 ? fmt::format("cameras, one view in {}", step) : "cameras",
                            {path_ramp(0.5)},
                            LegendItem::Mark::pyramid});
  picture.legend.push_back(bar(path_colours(), "views and way, first", "last"));
  return picture;
}

}  // namespace

const PictureKind kPathPicture = {.name = "path",
                                  .shows = "structure, flown path and views (Figs. 8, 10)",
                                  .frame = frame_path,
                                  .draw = draw_path};

}  // namespace gnbv
