#include "tools/render/candidate_legend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/render/chosen_view_item.hpp"
#include "tools/render/frontier_items.hpp"
#include "tools/render/voxel_items.hpp"
#include "tools/run/words.hpp"
#include "tools/scene/looks.hpp"

namespace gnbv {

const Rgb kOccupiedVoxels = srgb(0xc4ccd6);
const Rgb kUnknownVoxels = srgb(0xffffff);

namespace {

bool is_around_cluster(const Candidate& candidate) { return candidate.cluster >= 0; }

// Whether a panel shows the middle of a line, a ball or a voxel's cube of that colour: these may
// lie in the surface, but not behind it.
bool is_in_sight(std::span<const Panel> panels, const Sight& sight, const Rgb& colour) {
  const double beside_m = 0.9 * sight.grid.geometry().resolution_m();
  const auto is_shown_at = [&](const RenderView& view, const Vec3f& p_m) {
    return shows(view, sight.grid, p_m.cast<double>(), beside_m);
  };
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const RenderScene& scene = panels[i].scene;
    const RenderView& view = sight.panels[i].view;
    for (const TubeItem& tube : scene.tubes) {
      const Vec3f middle_m = 0.5F * (tube.points_m.front() + tube.points_m.back());
      if (tube.colours.front() == colour && is_shown_at(view, middle_m)) return true;
    }
    for (const BallItem& ball : scene.balls) {
      if (ball.colour == colour && is_shown_at(view, ball.centre_m)) return true;
    }
    for (const SurfaceItem& surface : scene.surfaces) {
      const std::vector<Vec3f>& corners_m = surface.mesh.vertices_m;
      if (surface.vertex_colours.empty() || surface.vertex_colours.front() != colour) continue;
      for (std::size_t k = 0; k + 7 < corners_m.size(); k += 8) {
        if (is_shown_at(view, 0.5F * (corners_m[k] + corners_m[k + 7]))) return true;
      }
    }
  }
  return false;
}

// "0.871", "1,470"
std::string in_three_digits(double value) {
  return std::abs(value) < 999.5 ? fmt::format("{:.3g}", value) : grouped(value, 0);
}

// "valid: 31, utility" from a bar's low end to its high end; without a bar where all have one.
LegendItem legend_of_valid(const CandidateTally& all) {
  if (all.low == all.high) {
    return {.label =
                fmt::format("valid: {}, utility {}", grouped(all.valid), in_three_digits(all.high)),
            .colours = {colour_of_score(all, all.high)},
            .mark = LegendItem::Mark::dot};
  }
  return {.label = in_three_digits(all.high) + ", highest",
          .colours = score_colours(),
          .label_before =
              fmt::format("valid: {}, utility {}", grouped(all.valid), in_three_digits(all.low)),
          .label_middle = in_three_digits(0.5 * (all.low + all.high))};
}

// Each with how many of it the picture shows, of how many.
std::vector<LegendItem> legend_of_rejected(const CandidateTally& all) {
  std::vector<LegendItem> legend;
  for (const RejectionLook& look : rejection_looks()) {
    const auto reason = static_cast<std::size_t>(look.rejection);
    const std::size_t unseen = all.rejected_unseen[reason];
    if (all.rejected[reason] == 0) continue;
    const std::string seen =
        unseen == 0 ? "" : fmt::format("{} of ", grouped(all.rejected[reason] - unseen));
    legend.push_back({fmt::format("{}: {}{}", look.words, seen, grouped(all.rejected[reason])),
                      {look.rgb()},
                      LegendItem::Mark::dot});
    if (legend.size() == 1)
      legend.front().label_before = all.unseen == 0 ? "rejected:" : "rejected, in sight of all:";
  }
  return legend;
}

}  // namespace

Vec3 pin_end(const ViewPose& view, double length_m) {
  const Vec3 ahead(std::cos(view.gimbal_pitch_rad), 0.0, -std::sin(view.gimbal_pitch_rad));
  return view.p_world_m + length_m * (T_world_body(view).linear() * ahead);
}

bool is_shown(const Candidate& candidate, const OccupancyGrid& grid,
              std::span<const PanelView> panels) {
  return std::any_of(panels.begin(), panels.end(), [&](const PanelView& panel) {
    const Vec3 ball_m = candidate.rejected ? pin_end(candidate.view, kRejectedPin * panel.unit_m)
                                           : candidate.view.p_world_m;
    const double radius_m = (candidate.rejected ? kRejectedBall : kValidBall) * panel.unit_m;
    return shows(panel.view, grid, ball_m, radius_m);
  });
}

CandidateTally tally(const Plan& plan, const OccupancyGrid& grid,
                     std::span<const PanelView> panels) {
  CandidateTally all{.rejected = std::vector<std::size_t>(rejection_looks().size()),
                     .rejected_unseen = std::vector<std::size_t>(rejection_looks().size())};
  for (const Candidate& candidate : plan.candidates) {
    const std::size_t unseen = is_shown(candidate, grid, panels) ? 0 : 1;
    all.unseen += unseen;
    if (candidate.rejected) {
      const auto reason = static_cast<std::size_t>(*candidate.rejected);
      ++all.rejected[reason];
      all.rejected_unseen[reason] += unseen;
      continue;
    }
    ++all.valid;
    all.low = std::min(all.low, candidate.score.value);
    all.high = std::max(all.high, candidate.score.value);
  }
  return all;
}

Rgb colour_of_score(const CandidateTally& all, double score) {
  return ramp(score_colours(), 1.0 - (all.high - score) / std::max(all.high - all.low, 1e-12));
}

bool has_frontier_views(const Plan& plan) {
  return std::any_of(plan.candidates.begin(), plan.candidates.end(), is_around_cluster);
}

bool is_chosen_at_frontier(const Plan& plan) {
  return !plan.chosen.empty() && is_around_cluster(plan.candidates[plan.chosen.front()]);
}

std::string note_on(const Plan& plan, const CandidateTally& all) {
  const std::string count = counted(plan.candidates.size(), "candidate") + " as pins";
  return all.unseen == 0
             ? count
             : fmt::format("{}, {} hidden or outside the picture", count, grouped(all.unseen));
}

std::vector<LegendItem> legend_of(const Plan& plan, const CandidateTally& all,
                                  std::span<const Panel> panels, const Sight& sight,
                                  bool is_unknown_seen) {
  using Mark = LegendItem::Mark;
  std::vector<LegendItem> legend = legend_of_rejected(all);
  const auto add_seen = [&](std::string_view words, const Rgb& colour, Mark mark) {
    if (is_in_sight(panels, sight, colour)) legend.push_back({std::string(words), {colour}, mark});
  };
  const std::size_t second = legend.size();
  if (all.valid > 0) legend.push_back(legend_of_valid(all));
  legend.push_back({"occupied", {kOccupiedVoxels}});
  if (is_unknown_seen) legend.push_back({"unknown", {kUnknownVoxels}});
  if (has_frontier_views(plan)) {
    const bool is_any_seen =
        is_in_sight(panels, sight, kFrontierLook.frontier) ||
        std::any_of(panels.begin(), panels.end(), [](const Panel& p) { return !p.labels.empty(); });
    legend.push_back(
        {is_any_seen ? "frontier, clusters numbered as tried" : "frontier (none in sight)",
         {kFrontierLook.frontier}});
    add_seen("cluster looked at", kFrontierLook.looked_at, Mark::square);
    add_seen("views of a layer", kFrontierLook.layer, Mark::line);
  }
  const std::size_t third = legend.size();
  legend.push_back({"chosen view", {kChosenLook.chosen}, Mark::ring});
  legend.push_back({"way there", {kChosenLook.chosen}, Mark::line});
  legend.push_back({"view before", {kChosenLook.before}, Mark::ring});
  legend.push_back({"its camera", {kChosenLook.pyramid}, Mark::pyramid});
  add_seen("ray through free", kChosenLook.ray_free, Mark::line);
  add_seen("through unknown", kChosenLook.ray_unknown, Mark::line);
  add_seen("meets surface", kChosenLook.hit, Mark::dot);
  if (second < third) legend[second].begins_row = true;
  legend[third].begins_row = true;
  return legend;
}

}  // namespace gnbv
