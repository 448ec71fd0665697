#include "tools/render/candidate_legend.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/render/chosen_view_item.hpp"
#include "tools/render/frontier_items.hpp"
#include "tools/render/rejection_look.hpp"
#include "tools/render/voxel_items.hpp"
#include "tools/run_files/words.hpp"

namespace gnbv {

const Rgb kUnknownVoxels = srgb(0xffffff);

namespace {

bool is_around_cluster(const Candidate& candidate) { return candidate.cluster >= 0; }

// Whether a panel holds a line or a ball of that colour alone.
bool is_drawn(std::span<const Panel> panels, const Rgb& colour) {
  return std::any_of(panels.begin(), panels.end(), [&](const Panel& panel) {
    const RenderScene& scene = panel.scene;
    return std::any_of(scene.tubes.begin(), scene.tubes.end(),
                       [&](const TubeItem& tube) { return tube.colours.front() == colour; }) ||
           std::any_of(scene.balls.begin(), scene.balls.end(),
                       [&](const BallItem& ball) { return ball.colour == colour; });
  });
}

bool is_shown(const Candidate& candidate, const OccupancyGrid& grid,
              std::span<const RenderView> views) {
  const Vec3& p_m = candidate.view.p_world_m;
  return std::any_of(views.begin(), views.end(), [&](const RenderView& view) {
    return is_within(view, p_m) && !is_hidden(grid, view, p_m, 0.0);
  });
}

// "valid: 31, utility" from a bar's low end to its high end; without a bar where all have one.
LegendItem legend_of_valid(const CandidateTally& all) {
  if (all.low == all.high) {
    return {.label = fmt::format("valid: {}, utility {:.3g}", grouped(all.valid), all.high),
            .colours = {colour_of_score(all, all.high)},
            .mark = LegendItem::Mark::dot};
  }
  return {.label = fmt::format("{:.3g}, highest", all.high),
          .colours = amount_colours(),
          .label_before = fmt::format("valid: {}, utility {:.3g}", grouped(all.valid), all.low),
          .label_middle = fmt::format("{:.3g}", 0.5 * (all.low + all.high))};
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
                      {look.colour},
                      LegendItem::Mark::dot});
    if (legend.size() == 1) legend.front().label_before = "rejected:";
  }
  return legend;
}

}  // namespace

CandidateTally tally(const Plan& plan, const OccupancyGrid& grid,
                     std::span<const RenderView> views) {
  CandidateTally all{.rejected = std::vector<std::size_t>(rejection_looks().size()),
                     .rejected_unseen = std::vector<std::size_t>(rejection_looks().size())};
  for (const Candidate& candidate : plan.candidates) {
    const std::size_t unseen = is_shown(candidate, grid, views) ? 0 : 1;
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
  return amount_ramp(1.0 - (all.high - score) / std::max(all.high - all.low, 1e-12));
}

bool has_frontier_views(const Plan& plan) {
  return std::any_of(plan.candidates.begin(), plan.candidates.end(), is_around_cluster);
}

bool is_chosen_at_frontier(const Plan& plan) {
  return plan.chosen && is_around_cluster(plan.candidates[*plan.chosen]);
}

std::string note_on(const Plan& plan, const CandidateTally& all) {
  const std::string count = counted(plan.candidates.size(), "candidate");
  if (all.unseen == 0) return count;
  return fmt::format("{}, {} of them hidden or beyond the picture", count, grouped(all.unseen));
}

std::vector<LegendItem> legend_of(const Plan& plan, const CandidateTally& all,
                                  std::span<const Panel> panels, bool is_unknown_seen) {
  using Mark = LegendItem::Mark;
  std::vector<LegendItem> legend = legend_of_rejected(all);
  const auto add_drawn = [&](std::string_view words, const Rgb& colour, Mark mark) {
    if (is_drawn(panels, colour)) legend.push_back({std::string(words), {colour}, mark});
  };
  const std::size_t second = legend.size();
  if (all.valid > 0) legend.push_back(legend_of_valid(all));
  if (is_unknown_seen) legend.push_back({"unknown", {kUnknownVoxels}});
  if (has_frontier_views(plan)) {
    legend.push_back({"frontier, clusters in sight numbered as tried", {kFrontierLook.frontier}});
    add_drawn("cluster looked at", kFrontierLook.looked_at, Mark::square);
    // the balls at their clusters' centroids are of no other
    const bool has_layers = std::any_of(panels.begin(), panels.end(), [](const Panel& panel) {
      const std::vector<TubeItem>& tubes = panel.scene.tubes;
      return std::any_of(tubes.begin(), tubes.end(), [](const TubeItem& tube) {
        return tube.colours.front() == kFrontierLook.frontier;
      });
    });
    if (has_layers) legend.push_back({"views of a layer", {kFrontierLook.frontier}, Mark::line});
  }
  const std::size_t third = legend.size();
  legend.push_back({"chosen view", {kChosenLook.chosen}, Mark::ring});
  legend.push_back({"way there", {kChosenLook.chosen}, Mark::line});
  legend.push_back({"view before", {kChosenLook.before}, Mark::ring});
  legend.push_back({"pyramid", {kChosenLook.pyramid}, Mark::line});
  add_drawn("ray through free", kChosenLook.ray_free, Mark::line);
  add_drawn("through unknown", kChosenLook.ray_unknown, Mark::line);
  add_drawn("meets surface", kChosenLook.hit, Mark::dot);
  if (second < third) legend[second].begins_row = true;
  legend[third].begins_row = true;
  return legend;
}

}  // namespace gnbv
