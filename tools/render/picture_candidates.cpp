// One decision: the views that were sampled, why they were rejected or how they scored, and what
// the chosen one looks at (Figures 2, 5 and 6 of the paper).
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

#include "sim/core/error.hpp"
#include "sim/core/text.hpp"
#include "tools/render/picture.hpp"
#include "tools/scene/decision.hpp"
#include "tools/scene/structure.hpp"
#include "tools/scene/voxels.hpp"

namespace gnbv {
namespace {

using Mark = LegendItem::Mark;

/// The decision that a picture is about: half way, unless another is asked for. Throws BadInput for
/// the first view, which nothing chose.
std::size_t decision_asked(const RunRecord& record, const PictureOptions& options) {
  const std::size_t iteration = iteration_of(record, options, record.views.size() / 2);
  if (iteration > 0) return iteration;
  throw BadInput(
      "{}: view 1 (iteration 0) is where the mission starts: nothing chose it; --iteration asks "
      "for one from 1 on",
      record.folder.string());
}

void frame_candidates(RunSource& run, const PictureOptions& options,
                      std::vector<Vec3>& points_world_m) {
  const RunRecord& record = run.record();
  const std::size_t iteration = decision_asked(record, options);
  frame_map(run, options, points_world_m);
  for (const Candidate& candidate : run.decision(iteration).plan.candidates) {
    // those beyond the bounds lie far around everything else
    if (candidate.rejected == Rejection::out_of_bounds) continue;
    points_world_m.push_back(candidate.view.p_world_m);
  }
  points_world_m.push_back(record.views[iteration - 1].decision.view.p_world_m);
  points_world_m.push_back(record.views[iteration].decision.view.p_world_m);
}

/// What the candidates are worth that a picture from there shows: those chosen count the most, then
/// those that were valid; those out of bounds lie anywhere.
double worth_shown(const ReplayedDecision& decision, const RenderView& view) {
  double worth = 0.0;
  for (std::size_t i = 0; i < decision.plan.candidates.size(); ++i) {
    const Candidate& candidate = decision.plan.candidates[i];
    if (candidate.rejected == Rejection::out_of_bounds) continue;
    if (!shows(view, decision.belief.grid, candidate.view.p_world_m, 0.0)) continue;
    worth += decision.plan.is_chosen(i) ? 40.0 : candidate.rejected ? 1.0 : 4.0;
  }
  return worth;
}

/// Of eight directions around, the one that shows the most of the runs' candidates.
ViewAngles best_angles(std::span<RunSource* const> runs, const PictureOptions& options) {
  constexpr int kDirections = 8;
  ViewAngles best;
  double most = -1.0;
  std::vector<Vec3> points_m;
  for (RunSource* const run : runs) frame_candidates(*run, options, points_m);
  for (int i = 0; i < kDirections; ++i) {
    ViewAngles angles;
    angles.azimuth_rad = wrap_angle_rad(angles.azimuth_rad + 2.0 * kPi * i / kDirections);
    const RenderView view = frame_points(points_m, angles, 640, 480);
    double worth = 0.0;
    for (RunSource* const run : runs) {
      worth += worth_shown(run->decision(decision_asked(run->record(), options)), view);
    }
    if (worth <= most) continue;
    most = worth;
    best = angles;
  }
  return best;
}

/// "24 candidates around frontiers (0 valid), 80 of the grid (31 valid)"
std::string counts_by_sampler(const Plan& plan) {
  std::map<Sampler, std::array<std::size_t, 2>> tallies;  // all, valid
  for (const Candidate& candidate : plan.candidates) {
    ++tallies[candidate.sampler][0];
    tallies[candidate.sampler][1] += candidate.rejected ? 0 : 1;
  }
  std::string words;
  for (const auto& [sampler, tally] : tallies) {
    if (!traits_of(sampler).is_scored) continue;
    words += fmt::format("{} {} ({} valid)",
                         words.empty() ? counted(tally[0], "candidate") : ", " + grouped(tally[0]),
                         traits_of(sampler).words, grouped(tally[1]));
  }
  return words.empty() ? counted(plan.candidates.size(), "candidate") : words;
}

/// "view 3 of 7 of the burst planned at view 41, "; empty for a view that was decided alone.
std::string of_burst(const ViewRecord& view, const Plan& plan) {
  if (!plan.is_burst()) return "";
  return fmt::format("view {} of {} of the burst planned at view {}, ", view.decision.plan_view,
                     plan.chosen.size(), grouped(view.planned_at() + 1));
}

/// "0.871", "1,470"
std::string in_three_digits(double value) {
  return std::abs(value) < 999.5 ? fmt::format("{:.3g}", value) : grouped(value, 0);
}

/// A bar from the lowest worth to the highest; without one where all have one.
LegendItem legend_of_valid(const ScoreRange& scores, bool is_burst) {
  const std::string begin =
      fmt::format("valid: {}, {} {}", grouped(scores.valid),
                  is_burst ? "points covered" : "utility", in_three_digits(scores.low));
  if (scores.low == scores.high) return {begin, {score_colours().back()}, Mark::dot};
  return bar(score_colours(), begin, in_three_digits(scores.high) + ", highest",
             in_three_digits(0.5 * (scores.low + scores.high)));
}

/// What became of a decision's candidates, and what of them a picture shows.
struct Tally {
  std::array<std::size_t, kRejectionNames.size()> rejected{}, rejected_shown{};
  std::size_t unseen = 0;  // hidden or outside the picture
};

Tally tally_of(const ReplayedDecision& decision, const RenderView& view, double unit_m) {
  Tally tally;
  for (const Candidate& candidate : decision.plan.candidates) {
    const BallItem ball = ball_of(candidate, {}, unit_m);
    const bool is_shown = shows(view, decision.belief.grid, ball.centre_m.cast<double>(),
                                static_cast<double>(ball.radius_m));
    tally.unseen += is_shown ? 0 : 1;
    if (!candidate.rejected) continue;
    const auto reason = static_cast<std::size_t>(*candidate.rejected);
    ++tally.rejected[reason];
    tally.rejected_shown[reason] += is_shown ? 1 : 0;
  }
  return tally;
}

/// A row of those rejected, of which each counts those in sight ("collision: 74 of 132"), one of
/// what could be chosen and of the map, one of the chosen view. Of lines, balls and voxels nothing
/// that the picture does not show.
std::vector<LegendItem> legend_of(const ReplayedDecision& decision, const Tally& tally,
                                  const RenderScene& scene, const RenderView& view) {
  std::vector<LegendItem> legend;
  for (const RejectionLook& look : rejection_looks()) {
    const auto reason = static_cast<std::size_t>(look.rejection);
    const std::size_t all = tally.rejected[reason];
    const std::size_t shown = tally.rejected_shown[reason];
    if (all == 0) continue;
    const std::string count =
        shown == all ? grouped(all) : fmt::format("{} of {}", grouped(shown), grouped(all));
    legend.push_back({fmt::format("{}: {}", look.words, count), {look.rgb()}, Mark::dot});
  }
  if (!legend.empty()) {
    legend.front().label_before = tally.unseen == 0 ? "rejected:" : "rejected, in sight of all:";
  }
  const auto add_seen = [&](const Look& look, Mark mark) {
    if (shows_any(view, decision.belief.grid, scene, look.rgb()))
      legend.push_back(entry(look, mark));
  };
  const std::size_t second = legend.size();
  if (const ScoreRange scores = scores_of(decision.plan); scores.valid > 0) {
    legend.push_back(legend_of_valid(scores, decision.plan.is_burst()));
  }
  add_seen(looks::kOccupied, Mark::square);
  add_seen(looks::kUnknown, Mark::square);
  add_seen(looks::kFrontier, Mark::square);
  add_seen(looks::kLookedAt, Mark::square);
  add_seen(looks::kFrontierLayer, Mark::line);
  const std::size_t third = legend.size();
  legend.push_back(entry(looks::kChosen, Mark::ring));
  legend.push_back({"way there", {looks::kChosen.rgb()}, Mark::line});
  legend.push_back(entry(looks::kViewBefore, Mark::ring));
  legend.push_back({"its camera", {looks::kCamera.rgb()}, Mark::pyramid});
  add_seen(looks::kRayFree, Mark::line);
  add_seen(looks::kRayUnknown, Mark::line);
  add_seen(looks::kRayHit, Mark::dot);
  add_seen(looks::kCovered, Mark::dot);
  add_seen(looks::kNotCovered, Mark::dot);
  if (second < third) legend[second].begins_row = true;
  legend[third].begins_row = true;
  return legend;
}

Picture draw_candidates(RunSource& run, const PictureOptions& options, const RenderView& view) {
  const RunRecord& record = run.record();
  const std::size_t iteration = decision_asked(record, options);
  const ReplayedDecision& decision = run.decision(iteration);
  const OccupancyGrid& grid = decision.belief.grid;
  const double unit_m = layout_unit_m(view);
  Picture picture{.panels = std::vector<Panel>(1)};
  Panel& panel = picture.panels.front();
  RenderScene& scene = panel.scene;
  add_candidates(decision.plan, unit_m, scene);
  add_ground(run, scene);
  const std::vector<Rgb> pale = {looks::kOccupied.rgb()};
  const SortedVoxels voxels = sort_voxels(grid);
  scene.surfaces.push_back(voxel_cubes(grid.geometry(), voxels.occupied, pale, 0.94));
  // through them the points show that a burst covers
  if (decision.plan.is_burst()) scene.surfaces.back().opacity = 0.3F;
  scene.surfaces.push_back(free_faces(grid, voxels.unknown, looks::kUnknown.rgb(), 0.35F));
  if (has_frontier_views(decision.plan)) {
    add_frontiers(decision, unit_m, view, panel);
  }
  add_numbers_of_views(decision.plan, record.views[iteration].decision, panel);
  add_chosen_view(record, run.world(), decision.belief, iteration, unit_m, scene);
  // farther, rays would smear their darkness over what they pass
  scene.hollow_m = grid.geometry().resolution_m();
  panel.lines = way_to_chosen(record, iteration);
  const Tally tally = tally_of(decision, view, unit_m);
  picture.detail = fmt::format("how view {} of {} (iteration {}) was chosen: {}from {}",
                               grouped(iteration + 1), grouped(record.views.size()), iteration,
                               of_burst(record.views[iteration], decision.plan),
                               counts_by_sampler(decision.plan));
  if (decision.plan.is_burst()) {
    const Covered covered = add_points_to_cover(record.scenario, decision, unit_m, scene);
    picture.detail += fmt::format("; {} of {} are covered", grouped(covered.covered),
                                  counted(covered.points, "point"));
  }
  if (tally.unseen > 0) {
    picture.detail += fmt::format("; {} hidden or outside the picture", grouped(tally.unseen));
  }
  picture.legend = legend_of(decision, tally, scene, view);
  return picture;
}

}  // namespace

const PictureKind kCandidatesPicture = {
    .name = "candidates",
    .shows = "candidate views of one decision, and rays of the chosen one (Figs. 2, 5, 6)",
    .legend_rows = 3,
    .best_angles = best_angles,
    .frame = frame_candidates,
    .draw = draw_candidates};

}  // namespace gnbv
