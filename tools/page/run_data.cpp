// Names, figures and views of a run.
#include <fmt/format.h>

#include <algorithm>

#include "bench/compare/paper_figures.hpp"
#include "scenarios/load.hpp"
#include "sim/core/file.hpp"
#include "sim/core/text.hpp"
#include "tools/page/packs.hpp"
#include "tools/run/file_names.hpp"

namespace gnbv {
namespace {

page::Vec3d vec(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

/// Column by column, as three.js has them.
std::vector<double> matrix(const Isometry& T) {
  return std::vector<double>(T.data(), T.data() + 16);
}

/// `columns` numbers a view.
template <std::size_t columns = 1, typename Values>
auto column(const RunRecord& record, page::Arrays& arrays, const Values& values_of) {
  std::vector<typename decltype(values_of(record.views[0]))::value_type> values;
  for (const ViewRecord& view : record.views) {
    for (const auto value : values_of(view)) values.push_back(value);
  }
  return arrays.add<columns>(values);
}

page::Views views_of(const RunRecord& record, page::Arrays& arrays) {
  const double begin_s = record.views.empty() ? 0.0 : record.views.front().time_s;
  using V = const ViewRecord&;
  const auto one = [&](const auto& value_of) {
    using T = decltype(value_of(record.views[0]));
    return column(record, arrays, [&](V v) { return std::array<T, 1>{value_of(v)}; });
  };
  page::Views views{
      .pose = column<4>(
          record, arrays,
          [](V v) {
            const ViewPose& p = v.decision.view;
            return std::array{p.p_world_m.x(), p.p_world_m.y(), p.p_world_m.z(), p.yaw_rad};
          }),
      .time = one([](V v) { return v.time_s; }),
      .seconds = one([&](V v) { return v.time_s - begin_s; }),
      .metres = one([](V v) { return v.straight_m; }),
      .candidates = one([](V v) { return static_cast<std::uint32_t>(v.decision.candidates); }),
      .valid = one([](V v) { return static_cast<std::uint32_t>(v.decision.valid); }),
      .plan_view = one([](V v) { return static_cast<std::uint32_t>(v.decision.plan_view); })};
  for (const Effort effort : kEfforts) {
    if (!record.figures || !is_from_take_off(effort)) continue;
    const CoverageCurve& curve = record.figures->curve;
    std::vector<double> spent;
    for (std::size_t n = 0; is_known(curve, effort) && n < curve.coverage.size(); ++n) {
      spent.push_back(effort_at(curve, record.figures->before, effort, n));
    }
    views.from_take_off.push_back(arrays.add(spent));
  }
  for (const ViewRecord& view : record.views) {
    views.sampler.emplace_back(traits_of(view.decision.sampler).name);
  }
  if (!gimbal_of(record.scenario.cameras)) return views;
  std::vector<double> mountings;  // of all cameras, as the gimbal had them
  for (const ViewRecord& v : record.views) {
    for (const CameraConfig& camera : record.scenario.cameras) {
      const double pitch_rad = v.decision.view.gimbal_pitch_rad;
      const auto T = matrix(turned(make_camera_model(camera), pitch_rad).T_body_camera);
      mountings.insert(mountings.end(), T.begin(), T.end());
    }
  }
  views.T_body_camera = arrays.add<16>(mountings);
  return views;
}

/// A pyramid's that the page can draw: around all that the camera sees, if that is no more.
double shown_fov_rad(const CameraConfig& config, int axis) {
  constexpr double kWidest_rad = deg_to_rad(150.0);
  return std::min(kWidest_rad, make_camera_model(config).sight_rad.sizes()[axis]);
}

page::Figures figures_of(const RunFigures& f, page::Arrays& arrays) {
  std::vector<double> curve;
  for (const auto& sizes : f.curve.coverage) curve.push_back(sizes[0]);
  return {.termination = f.termination,
          .version = f.version,
          .result_sha256 = f.result_sha256,
          .curve = arrays.add(curve)};
}

/// The paper's mission of the same utility, in its setting; none where it has none.
const PaperRow* papers_row(const RunRecord& record) {
  if (!record.figures || !has_papers_setting(record.scenario)) return nullptr;
  const PaperTable* const paper = find_paper_table(record.scenario.name);
  if (paper == nullptr || !is_papers_structure(*paper, record.figures->structure)) return nullptr;
  return find_row(*paper, record.scenario.planner.utility.name);
}

std::vector<page::KeyFigure> key_figures(const RunRecord& record) {
  const PaperRow* const paper = papers_row(record);
  const PaperRow beside = paper == nullptr ? PaperRow{} : *paper;
  std::vector<page::KeyFigure> all;
  const auto add = [&](const char* name, double value, int decimals, const char* unit,
                       std::optional<double> papers = {}, const char* mark = "") {
    all.push_back(
        {name, grouped(value, decimals), unit, papers ? grouped(*papers, decimals) + mark : ""});
  };
  if (const auto& f = record.figures) {
    const auto& covered = beside.coverage_percent;
    add(f->area_samples == 0 ? "Coverage, 0.05 m" : "Coverage of area samples, 0.05 m",
        100.0 * f->coverage_final[0], 1, "%", covered ? std::optional((*covered)[0]) : std::nullopt,
        is_doubtful(beside) ? "†" : "");
    if (f->ceiling) add("Of the ceiling", 100.0 * f->coverage_final[0] / *f->ceiling, 1, "%");
    add("F at 0.05 m", 100.0 * f->distances.at[1].f, 1, "%");
  }
  add("Views", static_cast<double>(record.views.size()), 0, "", beside.iterations);
  const double flown_m = record.views.empty() ? 0.0 : record.views.back().straight_m;
  add("View to view", record.figures ? record.figures->straight_m : flown_m, 1, "m",
      beside.distance_m);
  if (const auto& f = record.figures) {
    add("Profile flight", f->before.profile_m, 1, "m");
    add("Density", f->density_points_per_voxel, 1, "a voxel", beside.density_points_per_voxel);
    add("Flight with profile", f->flight_time_s / 60.0, 1, "min");
    add("Energy", f->energy_wh, 1, "Wh");
    const auto reached =
        f->ceiling ? entry_that_covers(f->curve, 0.95 * *f->ceiling) : std::nullopt;
    if (reached) {
      const auto spent = [&](Effort effort, int decimals) {
        return grouped(effort_at(f->curve, f->before, effort, *reached), decimals);
      };
      std::string more = fmt::format("s, {} m", spent(Effort::metres_with_profile, 0));
      if (is_known(f->curve, Effort::wh_with_profile)) {
        more += fmt::format(", {} Wh, {}on one battery", spent(Effort::wh_with_profile, 1),
                            f->curve.on_one_battery[*reached] ? "" : "not ");
      }
      all.push_back({"Take-off to 95 % of ceiling", spent(Effort::seconds_with_profile, 0), more});
    }
  }
  return all;
}

}  // namespace

page::RunData run_data(const RunRecord& record, page::Arrays& arrays) {
  const Scenario& scenario = record.scenario;
  page::RunData run;
  run.structure = structure_name(scenario.structure);
  run.preset = scenario.planner.preset;
  run.seed = scenario.seed;
  run.yaml = read_file(record.folder / kScenarioFile);
  run.missing = record.missing;
  run.workspace_min = vec(scenario.workspace_m.min());
  run.workspace_max = vec(scenario.workspace_m.max());
  const Vec3 extent_m = scenario.workspace_m.sizes();
  run.grid_m = rounded_down_125(std::max(extent_m.x(), extent_m.y()) / 8.0);
  run.has_ground = has_flat_ground(scenario);
  run.profile_end_s = record.profile_end_s;
  run.views_begin_s = record.views_begin_s;
  for (const CameraConfig& config : sights_of(scenario)) {
    run.cameras.push_back({.name = config.name,
                           .fov_x = shown_fov_rad(config, 0),
                           .fov_y = shown_fov_rad(config, 1),
                           .range_m = config.range_max_m,
                           .T_body_camera = matrix(make_camera_model(config).T_body_camera)});
  }
  for (const RotorMount& rotor : scenario.vehicle.airframe.rotors) {
    run.rotors.push_back(vec(rotor.p_body_m));
  }
  run.radius_m = scenario.vehicle.airframe.hull_radius_m;
  run.views = views_of(record, arrays);
  if (record.figures) run.figures = figures_of(*record.figures, arrays);
  run.key_figures = key_figures(record);
  return run;
}

}  // namespace gnbv
