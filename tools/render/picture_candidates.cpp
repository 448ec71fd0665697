// One decision: the views that were sampled, why they were rejected or how they scored, and what
// the chosen one looks at (Figures 2, 5 and 6 of the paper).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "planner/map/frontiers.hpp"
#include "sim/core/error.hpp"
#include "tools/render/chosen_view_item.hpp"
#include "tools/render/flight_items.hpp"
#include "tools/render/picture.hpp"
#include "tools/render/voxel_items.hpp"
#include "tools/run_files/words.hpp"

namespace gnbv {
namespace {

const Rgb kMap = srgb(0xc4ccd6);
const Rgb kFrontier = srgb(0x56b4e9);
const Rgb kLookedAt = srgb(0x0b5fa5);
const Rgb kUnknownVoxels = srgb(0xffffff);
constexpr float kUnknownVoxelsOpacity = 0.35F;

struct Reason {
  Rejection rejection;
  std::string_view words;
  Rgb colour;
};

// The muted colours of Paul Tol (2021), which colour-blind people tell apart: rejected views are
// context.
constexpr std::size_t kReasons = 10;
const std::array<Reason, kReasons>& reasons() {
  static const std::array<Reason, kReasons> all = {
      {{Rejection::out_of_bounds, "out of bounds", srgb(0x9aa3ae)},
       {Rejection::not_free, "not free", srgb(0x14181e)},
       {Rejection::collision, "collision", srgb(0x882255)},
       {Rejection::path_blocked, "path blocked", srgb(0xcc6677)},
       {Rejection::recently_visited, "visited", srgb(0xddcc77)},
       {Rejection::cluster_outside_fov, "cluster outside view", srgb(0x88ccee)},
       {Rejection::cluster_hidden, "cluster hidden", srgb(0xaa4499)},
       {Rejection::sees_no_surface, "sees no surface", srgb(0x999933)},
       {Rejection::no_fly, "no-fly box", srgb(0x661100)},
       {Rejection::beyond_gimbal, "beyond the gimbal", srgb(0x332288)}}};
  return all;
}

std::size_t iteration_asked(const RunRecord& record, const PictureOptions& options) {
  const std::size_t iteration = iteration_of(record, options, record.views.size() / 2);
  if (iteration > 0) return iteration;
  throw BadInput(
      fmt::format("{}: view 0 is where the mission starts: nothing chose it; --iteration "
                  "asks for one from 1 on",
                  record.folder.string()));
}

/// The structure and what could be chosen from, not the pyramid: it reaches far beyond both.
void frame_candidates(RunSource& run, const PictureOptions& options,
                      std::vector<Vec3>& points_world_m) {
  const RunRecord& record = run.record();
  const std::size_t iteration = iteration_asked(record, options);
  frame_structure(run, points_world_m);
  for (const Candidate& candidate : run.decision(iteration).plan.candidates) {
    // those beyond the bounds lie far around everything else
    if (candidate.rejected == Rejection::out_of_bounds) continue;
    points_world_m.push_back(candidate.view.p_world_m);
  }
  points_world_m.push_back(record.views[iteration - 1].decision.view.p_world_m);
  points_world_m.push_back(record.views[iteration].decision.view.p_world_m);
}

// A pin: where it stands, and which way it looks.
void add_pin(const ViewPose& view, double length_m, double radius_m, const Rgb& colour,
             RenderScene& scene) {
  const Vec3 ahead = T_world_body(view).linear() *
                     Vec3(std::cos(view.gimbal_pitch_rad), 0.0, -std::sin(view.gimbal_pitch_rad));
  scene.tubes.push_back(
      {{view.p_world_m.cast<float>(), (view.p_world_m + length_m * ahead).cast<float>()},
       {colour},
       static_cast<float>(radius_m)});
}

// Rings through the views around a cluster that stand in one layer (Fig. 6).
void add_layers(const Plan& plan, std::span<const FrontierCluster> clusters, double unit_m,
                RenderScene& scene) {
  std::map<std::pair<int, long>, std::vector<Vec3>> layers;  // by cluster and millimetre of height
  for (const Candidate& candidate : plan.candidates) {
    const Vec3& p_m = candidate.view.p_world_m;
    if (candidate.cluster < 0) continue;
    layers[{candidate.cluster, std::lround(1000.0 * p_m.z())}].push_back(p_m);
  }
  for (auto& [layer, places] : layers) {
    const auto cluster = static_cast<std::size_t>(layer.first);
    if (cluster >= clusters.size() || places.size() < 3) continue;
    const Vec3& centre_m = clusters[cluster].centroid_world_m;
    const auto angle_rad = [&](const Vec3& p_m) {
      return std::atan2(p_m.y() - centre_m.y(), p_m.x() - centre_m.x());
    };
    std::sort(places.begin(), places.end(),
              [&](const Vec3& a, const Vec3& b) { return angle_rad(a) < angle_rad(b); });
    places.push_back(places.front());
    scene.tubes.push_back(path_tube(places, 0.35 * unit_m, kFrontier));
  }
}

// The clusters of density frontiers that an FVS decision looked at, numbered in the order in which
// they were tried; the chosen one's stands out.
void add_frontiers(const RunRecord& record, const ReplayedDecision& decision, const ViewPose& from,
                   double unit_m, Panel& panel) {
  RenderScene& scene = panel.scene;
  const Belief& belief = decision.belief;
  FrontierMarks marks(belief.grid.geometry().voxel_count());
  std::vector<FrontierCluster> clusters =
      find_frontiers(record.scenario.planner.fvs.frontier, belief.grid, belief.cloud, marks);
  std::stable_sort(clusters.begin(), clusters.end(), [&](const auto& a, const auto& b) {
    return (a.centroid_world_m - from.p_world_m).squaredNorm() <
           (b.centroid_world_m - from.p_world_m).squaredNorm();
  });
  const int chosen =
      decision.plan.chosen ? decision.plan.candidates[*decision.plan.chosen].cluster : -1;
  int tried = -1;
  for (const Candidate& candidate : decision.plan.candidates) {
    tried = std::max(tried, candidate.cluster);
  }
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const bool is_chosen = static_cast<int>(i) == chosen;
    const std::vector<Rgb> colour = {is_chosen ? kLookedAt : kFrontier};
    scene.surfaces.push_back(voxel_cubes(belief.grid.geometry(), clusters[i].voxels, colour, 1.0));
    if (static_cast<int>(i) > tried) continue;
    const Vec3& centre_m = clusters[i].centroid_world_m;
    scene.balls.push_back({centre_m.cast<float>(),
                           static_cast<float>((is_chosen ? 6.0 : 4.5) * unit_m), colour.front()});
    panel.labels.push_back({centre_m, fmt::format("{}", i + 1)});
  }
  add_layers(decision.plan, clusters, unit_m, scene);
}

// "24 around frontiers (0 valid), 80 of the grid (31 valid)"
std::string counts_by_sampler(const Plan& plan) {
  std::string words;
  for (const auto& [sampler, name] :
       {std::pair<std::string_view, std::string_view>{"fvs", "around frontiers"},
        {"agvs", "of the grid"}}) {
    std::size_t all = 0;
    std::size_t valid = 0;
    for (const Candidate& candidate : plan.candidates) {
      if (candidate.sampler != sampler) continue;
      ++all;
      valid += candidate.rejected ? 0 : 1;
    }
    if (all == 0) continue;
    words += fmt::format("{}{} {} ({} valid)", words.empty() ? "" : ", ", grouped(all), name,
                         grouped(valid));
  }
  return words.empty() ? counted(plan.candidates.size(), "candidate") : words;
}

struct Tally {
  std::array<std::size_t, kReasons> rejected{};
  std::size_t valid = 0;
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

Tally tally(const Plan& plan) {
  Tally all;
  for (const Candidate& candidate : plan.candidates) {
    if (candidate.rejected) {
      ++all.rejected[static_cast<std::size_t>(*candidate.rejected)];
      continue;
    }
    ++all.valid;
    all.low = std::min(all.low, candidate.score.value);
    all.high = std::max(all.high, candidate.score.value);
  }
  return all;
}

void add_candidates(const Plan& plan, const Tally& all, double unit_m, RenderScene& scene) {
  const double span = std::max(all.high - all.low, 1e-12);
  for (const Candidate& candidate : plan.candidates) {
    if (candidate.rejected) {
      const Reason& reason = reasons()[static_cast<std::size_t>(*candidate.rejected)];
      add_pin(candidate.view, 12.0 * unit_m, 1.3 * unit_m, reason.colour, scene);
    } else {
      const Rgb colour = amount_ramp((candidate.score.value - all.low) / span);
      add_pin(candidate.view, 20.0 * unit_m, 2.4 * unit_m, colour, scene);
      scene.balls.push_back(
          {candidate.view.p_world_m.cast<float>(), static_cast<float>(5.0 * unit_m), colour});
    }
  }
}

std::vector<LegendItem> legend_of(const Tally& all, bool is_fvs) {
  std::vector<LegendItem> legend;
  for (const Reason& reason : reasons()) {
    const std::size_t count = all.rejected[static_cast<std::size_t>(reason.rejection)];
    if (count == 0) continue;
    legend.push_back(
        {fmt::format("{}: {}", reason.words, count), {reason.colour}, LegendItem::Mark::line});
  }
  if (all.valid > 0) {
    legend.push_back(
        {.label = fmt::format("{:.3g}, highest", all.high),
         .colours = amount_colours(),
         .label_before = fmt::format("valid: {}, utility {:.3g}", all.valid, all.low)});
  }
  if (is_fvs) {
    legend.push_back({"frontier", {kFrontier}});
    legend.push_back({"cluster looked at", {kLookedAt}});
  }
  legend.push_back({"unknown", {kUnknownVoxels}});
  legend.push_back({"way to the chosen view", {kChosenLook.chosen}, LegendItem::Mark::line});
  legend.push_back({"its pyramid", {kChosenLook.pyramid}, LegendItem::Mark::line});
  legend.push_back({"ray through free", {kChosenLook.ray_free}, LegendItem::Mark::line});
  legend.push_back({"through unknown", {kChosenLook.ray_unknown}, LegendItem::Mark::line});
  legend.push_back({"meets surface", {kChosenLook.chosen}, LegendItem::Mark::dot});
  return legend;
}

Picture draw_candidates(RunSource& run, const PictureOptions& options, const RenderView& view) {
  const RunRecord& record = run.record();
  const std::size_t iteration = iteration_asked(record, options);
  const ReplayedDecision& decision = run.decision(iteration);
  const double unit_m = layout_unit_m(view);
  const bool is_fvs = record.views[iteration].decision.sampler == "fvs";
  const Tally all = tally(decision.plan);
  Picture picture{.panels = std::vector<Panel>(1)};
  RenderScene& scene = picture.panels.front().scene;
  add_ground(run, scene);
  const std::vector<Rgb> grey = {kMap};
  const OccupancyGrid& grid = decision.belief.grid;
  const SortedVoxels voxels = sort_voxels(grid);
  scene.surfaces.push_back(voxel_cubes(grid.geometry(), voxels.occupied, grey, 0.94));
  scene.surfaces.push_back(free_faces(grid, voxels.unknown, kUnknownVoxels, kUnknownVoxelsOpacity));
  add_candidates(decision.plan, all, unit_m, scene);
  add_chosen_view(record, run.world(), decision.belief, iteration, unit_m, scene);
  if (is_fvs) {
    add_frontiers(record, decision, record.views[iteration - 1].decision.view, unit_m,
                  picture.panels.front());
  }
  picture.detail = fmt::format("how iteration {} was chosen: candidates {}", iteration,
                               counts_by_sampler(decision.plan));
  picture.legend = legend_of(all, is_fvs);
  return picture;
}

}  // namespace

const PictureKind kCandidatesPicture = {
    .name = "candidates",
    .shows = "candidate views of one decision, and rays of the chosen one (Figs. 2, 5, 6)",
    .legend_rows = 3,
    .frame = frame_candidates,
    .draw = draw_candidates};

}  // namespace gnbv
