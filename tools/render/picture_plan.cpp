// What a tour means to do after a view, and what for: the views still to come on their line, among
// the places that can be expected to bring new voxels.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "sim/core/error.hpp"
#include "sim/core/text.hpp"
#include "tools/render/picture.hpp"
#include "tools/scene/flight.hpp"
#include "tools/scene/structure.hpp"
#include "tools/scene/voxels.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kSoonViews = 5;

std::size_t iteration_left(const RunRecord& record, const PictureOptions& options) {
  return iteration_of(record, options, record.views.size() / 2);
}

StandingPlan plan_after(RunSource& run, std::size_t iteration) {
  const auto standing = standing_plan(run.plans(), run.record(), iteration);
  if (standing) return *standing;
  throw BadInput("{}: made no plan by view {} (iteration {}): the mission ended there",
                 run.record().folder.string(), iteration + 1, iteration);
}

void frame_plan(RunSource& run, const PictureOptions& options, std::vector<Vec3>& points_world_m) {
  const StandingPlan standing = plan_after(run, iteration_left(run.record(), options));
  frame_structure(run, points_world_m);
  for (const ViewRecord& view : run.record().views) {
    points_world_m.push_back(view.decision.view.p_world_m);
  }
  for (const ViewPose& view : standing.views()) points_world_m.push_back(view.p_world_m);
}

/// What most cubes bring less than: the few heaviest would leave all others in one colour.
double top_of(std::span<const PatchCube> cubes) {
  std::vector<double> sorted;
  for (const PatchCube& cube : cubes) sorted.push_back(cube.expected);
  std::sort(sorted.begin(), sorted.end());
  return sorted.empty() ? 1.0 : std::max(1.0, sorted[sorted.size() * 95 / 100]);
}

/// A cube of each gathering, the heavier the larger.
void add_cubes(const TourPlan& plan, double top, double unit_m, RenderScene& scene) {
  SurfaceItem all;
  for (const PatchCube& cube : plan.cubes) {
    const double share = std::min(1.0, cube.expected / top);
    const double edge_m = std::max(0.7 * plan.cube_m * std::sqrt(share), 2.0 * unit_m);
    const Vec3 half_m = Vec3::Constant(0.5 * edge_m);
    append(all.mesh, box_mesh(Box3(cube.p_world_m - half_m, cube.p_world_m + half_m)));
    all.vertex_colours.resize(all.mesh.vertices_m.size(), amount_ramp(share));
  }
  if (!plan.cubes.empty()) scene.surfaces.push_back(std::move(all));
}

/// The line through the views: the first of them strong, with what their cameras will see.
void add_tour(const RunRecord& record, const Vec3& here_m, std::span<const ViewPose> views,
              int every, double unit_m, RenderScene& scene) {
  std::vector<Vec3> soon_m = {here_m};
  std::vector<Vec3> later_m;
  const std::size_t step = pyramid_step(views.size(), every);
  const Rgb colour = looks::kPlan.rgb();
  for (std::size_t i = 0; i < views.size(); ++i) {
    const bool is_soon = i < kSoonViews;
    (is_soon ? soon_m : later_m).push_back(views[i].p_world_m);
    const ViewSize soon{3.6 * unit_m, 34.0 * unit_m, 0.9 * unit_m, 0.25F};
    const ViewSize later{2.2 * unit_m, i % step == 0 ? 16.0 * unit_m : 0.0, 0.5 * unit_m};
    add_view(sights_of(record.scenario), views[i], is_soon ? soon : later, colour, scene);
  }
  if (!later_m.empty()) {
    later_m.insert(later_m.begin(), soon_m.back());
    scene.tubes.push_back(path_tube(later_m, 0.5 * unit_m, colour));
  }
  if (soon_m.size() > 1) scene.tubes.push_back(path_tube(soon_m, 1.3 * unit_m, colour));
}

/// "312 voxels to be had, 77 % frontier" of the source that has most.
std::string prospects_of(const TourPlan& plan) {
  std::array<double, kPatchSources> sums{};
  for (const PatchCube& cube : plan.cubes) {
    sums.at(static_cast<std::size_t>(cube.source)) += cube.expected;
  }
  const double all = std::accumulate(sums.begin(), sums.end(), 0.0);
  if (all <= 0.0) return "no voxels to be had";
  const auto most =
      static_cast<std::size_t>(std::max_element(sums.begin(), sums.end()) - sums.begin());
  return fmt::format("{:.0f} voxels to be had, {:.0f} % {}", all, 100.0 * sums.at(most) / all,
                     name_of(static_cast<PatchSource>(most)));
}

std::string plan_detail(const RunRecord& record, const StandingPlan& standing,
                        std::size_t iteration) {
  double metres = 0.0;
  Vec3 at_m = record.views[iteration].decision.view.p_world_m;
  for (const ViewPose& view : standing.views()) {
    metres += (view.p_world_m - at_m).norm();
    at_m = view.p_world_m;
  }
  const std::size_t count = standing.views().size();
  const std::string to_go = count == 0
                                ? "the tour is over"
                                : fmt::format("{}, {:.1f} m to go", counted(count, "view"), metres);
  return fmt::format("after {}: {}; {}", views_so_far(record, iteration), to_go,
                     prospects_of(standing.made->plan));
}

Picture draw_plan(RunSource& run, const PictureOptions& options, const RenderView& view) {
  const RunRecord& record = run.record();
  const std::size_t iteration = iteration_left(record, options);
  const StandingPlan standing = plan_after(run, iteration);
  const TourPlan& plan = standing.made->plan;
  const double unit_m = layout_unit_m(view);
  const double top = top_of(plan.cubes);
  Picture picture{.panels = std::vector<Panel>(1)};
  RenderScene& scene = picture.panels.front().scene;
  add_ground(run, scene);
  const auto seen = std::span(run.cloud().points_world_m).first(run.cloud().view_points[iteration]);
  scene.dots.push_back(
      cloud_dots(seen, record.scenario.planner.cloud.leaf_m, looks::kStructure.rgb()));
  add_cubes(plan, top, unit_m, scene);
  add_flight(record,
             {.unit_m = unit_m,
              .has_profile = false,
              .until_s = record.views[iteration].time_s,
              .thickness = 0.9},
             scene);
  const Vec3& here_m = record.views[iteration].decision.view.p_world_m;
  scene.add_ball(here_m, 6.0 * unit_m, looks::kHull.rgb());
  add_tour(record, here_m, standing.views(), options.every, unit_m, scene);
  picture.detail = plan_detail(record, standing, iteration);
  picture.legend = {bar(path_colours(), "flown, from the first", "last view"),
                    entry(looks::kHull, LegendItem::Mark::dot)};
  if (!standing.views().empty()) {
    const std::size_t thick = std::min(kSoonViews, standing.views().size());
    picture.legend.push_back(
        entry(looks::kPlan, LegendItem::Mark::line, fmt::format(", the next {} thick", thick)));
  }
  if (!plan.cubes.empty()) {
    picture.legend.push_back(
        bar(amount_colours(), "0",
            fmt::format("{:.0f} or more voxels to be had in {} m, when view {} was planned", top,
                        plan.cube_m, standing.made->iteration + 1),
            fmt::format("{:.3g}", 0.5 * top)));
  }
  return picture;
}

}  // namespace

const PictureKind kPlanPicture = {
    .name = "plan",
    .shows = "of a tour: the views to come, and where they can be expected to bring new voxels",
    .legend_rows = 2,
    .frame = frame_plan,
    .draw = draw_plan};

}  // namespace gnbv
