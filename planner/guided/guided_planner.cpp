#include "planner/guided/guided_planner.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

/// One decision under way.
struct Decider {
  const GuidedConfig& config;
  const UserScores& user_scores;
  const PlannerModel& model;
  const Belief& belief;
  const History& history;
  const ViewPose& current;
  Scratch& scratch;
  BurstMemory& bursts;
  std::span<const Decision> recorded = {};           // what was decided when it was flown first
  const ValidityConfig* validity = &model.validity;  // but for the last way out
  std::vector<ViewPose> recent = recent_views(history, model.validity.recent_poses);
  Plan plan = {};

  Plan decide() {
    const FvsConfig& fvs = config.fvs;
    const bool is_stuck =
        fvs.enabled &&
        is_entropy_still(fvs.entropy_threshold_nat, fvs.entropy_window, fvs.entropy_lag, history,
                         voxels_in_view(fvs.voxels_in_view, model));
    if (is_stuck && (try_fvs(Resort::first) || !fvs.agvs_when_stuck)) return std::move(plan);
    if (try_agvs() || !fvs.enabled || !fvs.when_grid_finds_nothing) return std::move(plan);
    // bursts look at no cluster twice: theirs lead around what blocks the way at once
    const bool is_single = fvs.mode == FvsMode::single;
    if (is_single && !is_stuck && try_fvs(Resort::last)) return std::move(plan);
    const bool may_go_around = model.validity.path == PathCheck::straight;
    if (may_go_around) validity = &model.validity_around;
    if (may_go_around || !is_single) try_fvs(Resort::last);
    return std::move(plan);
  }

  /// Whether FVS is asked before the grid, or after the grid had nothing.
  enum class Resort { first, last };

  bool try_fvs(Resort resort) {
    return config.fvs.mode == FvsMode::burst ? try_bursts(resort) : try_clusters();
  }

  /// The first burst that has a view. As a first resort, one more is tried for each retry that the
  /// mission has left; as the last one, as many as there are clusters.
  bool try_bursts(Resort resort) {
    const FvsConfig& fvs = config.fvs;
    if (bursts.clusters == 0) bursts.clusters = fvs.clusters;
    const BurstTask task = {fvs, model, *validity, belief, recent, current, scratch};
    while (true) {
      const std::size_t tried = plan.clusters.size();
      if (add_burst(task, bursts, plan)) break;
      const bool are_left = plan.clusters.size() > tried;
      if (!are_left || (resort == Resort::first && bursts.retries >= fvs.retries)) return false;
      if (resort == Resort::first) ++bursts.retries;
      bursts.clusters += fvs.clusters_growth;
    }
    const std::size_t known = std::min(recorded.size(), plan.chosen.size());
    score_all(plan.candidates, std::span(plan.chosen).subspan(known), MayRefuse::no);
    for (const std::size_t kept : plan.chosen) {
      plan.views.push_back(decision_of(plan.candidates[kept]));
    }
    return true;
  }

  /// A view of the burst, whose scale of the grid stays what it was.
  Decision decision_of(const Candidate& kept) const {
    const auto valid = std::ranges::count_if(
        plan.candidates, [](const Candidate& candidate) { return !candidate.rejected; });
    return {.view = kept.view,
            .sampler = kept.sampler,
            .scale = history.decisions.empty() ? 1.0 : history.decisions.back().scale,
            .candidates = static_cast<int>(plan.candidates.size()),
            .valid = static_cast<int>(valid),
            .score = kept.score,
            .via_world_m = kept.via_world_m};
  }

  /// The first cluster that has a valid view, or all of them together. Once the first ones had
  /// none, several are looked at at a time: mostly there is none, and threads have nothing else to
  /// do.
  bool try_clusters() {
    const FvsConfig& fvs = config.fvs;
    find_clusters_to_try(fvs, belief, history.decisions, current.p_world_m, scratch.frontier_marks,
                         plan);
    const std::size_t count = plan.clusters.size();
    const std::size_t most =
        scratch.threads == 1 ? 1 : 4 * static_cast<std::size_t>(scratch.threads);
    std::vector<Candidate> pool;
    for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
      scratch.heed_stop();
      end = std::min({2 * begin + 1, begin + most, count});
      std::vector<std::vector<Candidate>> views(end - begin);
      parallel_for(scratch.threads, views.size(), [&](std::size_t i) {
        views[i] = views_of(plan.clusters[begin + i], static_cast<int>(begin + i));
      });
      for (std::size_t i = 0; i < views.size(); ++i) {
        std::move(views[i].begin(), views[i].end(), std::back_inserter(pool));
        if (fvs.pool_clusters && begin + i + 1 < count) continue;
        if (choose_among(std::exchange(pool, {}))) return true;
      }
    }
    return false;
  }

  std::vector<Candidate> views_of(const FrontierCluster& cluster, int rank) const {
    const FvsConfig& fvs = config.fvs;
    std::vector<Candidate> views =
        checked(sample_fvs(fvs, cluster.centroid_world_m, model.pitches_rad),
                {.view = {}, .sampler = Sampler::fvs, .cluster = rank});
    for (Candidate& candidate : views) {
      if (candidate.rejected) continue;
      candidate.rejected = cluster_rejection(model.sights, belief.grid, cluster, candidate.view,
                                             fvs.needs_visible_cluster);
    }
    return views;
  }

  /// A scale without any valid view is grown as at a local minimum; last comes the finest.
  bool try_agvs() {
    if (!recorded.empty()) return take_recorded(Sampler::agvs);
    const AgvsConfig& agvs = config.agvs;
    const double first_scale = next_agvs_scale(agvs, history, model.view_voxels);
    for (double scale = first_scale;; scale = std::min(scale * agvs.scale_factor, agvs.scale_max)) {
      if (try_agvs_at(scale)) return true;
      if (!agvs.scales || scale >= agvs.scale_max) break;
    }
    return first_scale > 1.0 && try_agvs_at(1.0);
  }

  /// Whether the recorded view is the sampler's; it is the plan then.
  bool take_recorded(Sampler sampler) {
    if (recorded.front().sampler != sampler) return false;
    plan.views = {recorded.front()};
    return true;
  }

  bool try_agvs_at(double scale) {
    scratch.heed_stop();
    const Candidate here = {.view = current, .sampler = Sampler::agvs, .scale = scale};
    std::vector<Candidate> views =
        checked(sample_agvs(config.agvs, current, scale, model.pitches_rad), here);
    const auto sampled = static_cast<int>(views.size());
    const bool has_valid =
        std::ranges::any_of(views, [](const Candidate& candidate) { return !candidate.rejected; });
    if (choose_among(std::move(views))) return true;
    if (!config.agvs.look_again || !has_valid) return false;
    plan.candidates.push_back(here);
    choose(plan, plan.candidates.size() - 1, sampled + 1, 1);
    return true;
  }

  /// Candidates like `as` that have these views. In pieces, since neighbours often share their
  /// position and what is known of it.
  std::vector<Candidate> checked(std::span<const ViewPose> views, const Candidate& as) const {
    constexpr std::size_t kPiece = 32;
    std::vector<Candidate> candidates(views.size(), as);
    parallel_for_chunks(scratch.threads, views.size(), kPiece, [&](auto begin, auto end) {
      ViewChecker checker(*validity, model.navigation_m, model.no_fly, belief.grid, recent, current,
                          [this] { scratch.heed_stop(); });
      for (std::size_t i = begin; i < end; ++i) {
        candidates[i].view = views[i];
        check(checker, model, candidates[i]);
      }
    });
    return candidates;
  }

  /// Whether a utility may reject the views that it scores.
  enum class MayRefuse { yes, no };

  /// Scores the candidates of these indices, each alone: which thread did it leaves no trace. The
  /// user's function gets all of them at once: it sees a decision, never a share of it.
  void score_all(std::span<Candidate> candidates, std::span<const std::size_t> valid,
                 MayRefuse may_refuse) {
    const double frontier_density = config.fvs.frontier.density_share * belief.cloud.density_max();
    const ViewOptions options = view_options(config.utility, belief.shadow, frontier_density);
    const std::size_t iteration = history.decisions.size();
    std::vector<UserCandidate> rows(user_scores ? valid.size() : 0);
    std::atomic<std::size_t> next{0};
    parallel_for(scratch.threads, scratch.marks.size(), [&](std::size_t share) {
      for (std::size_t i = next++; i < valid.size(); i = next++) {
        Candidate& candidate = candidates[valid[i]];
        const auto& [p_m, yaw_rad, pitch_rad] = candidate.view;
        ViewStats stats = evaluate_view(belief.grid, belief.cloud, model.rays_at(pitch_rad),
                                        candidate.view, scratch.marks[share], options);
        stats.density_max = belief.cloud.density_max();
        stats.path_m = config.utility.distance == DistanceAlong::path
                           ? candidate.path_m
                           : (p_m - current.p_world_m).norm();
        if (user_scores) {
          rows[i] = {stats, p_m.x(), p_m.y(), p_m.z(), yaw_rad, pitch_rad};
          continue;
        }
        const std::optional<Score> worth =
            score(config.utility, stats, {model.seed, iteration, valid[i]});
        if (worth) candidate.score = *worth;
        if (!worth && may_refuse == MayRefuse::yes) candidate.rejected = Rejection::sees_no_surface;
      }
    });
    if (rows.empty()) return;
    const std::vector<double> scores =
        user_scores({.iteration = iteration, .rows = rows, .indices = valid});
    GNBV_CHECK(scores.size() == valid.size(), "{} scores of {} views", scores.size(), valid.size());
    for (std::size_t i = 0; i < valid.size(); ++i) {
      candidates[valid[i]].score = {.value = scores[i], .information = scores[i]};
    }
  }

  /// Takes the candidate of the highest utility, the first of equals, and keeps the record.
  bool choose_among(std::vector<Candidate> candidates) {
    std::vector<std::size_t> not_rejected;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (!candidates[i].rejected) not_rejected.push_back(i);
    }
    score_all(candidates, not_rejected, MayRefuse::yes);
    std::optional<std::size_t> best;
    int valid = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (candidates[i].rejected) continue;
      ++valid;
      const double value = candidates[i].score.value;
      if (config.agvs.look_again && value <= 0.0) continue;
      if (!best || value > candidates[*best].score.value) best = i;
    }
    const std::size_t first = plan.candidates.size();
    std::move(candidates.begin(), candidates.end(), std::back_inserter(plan.candidates));
    if (best) choose(plan, first + *best, static_cast<int>(candidates.size()), valid);
    return best.has_value();
  }
};

}  // namespace

GuidedPlanner::GuidedPlanner(GuidedConfig config, const PlannerModel& model, UserScores user_scores)
    : config_(std::move(config)), model_(model), user_scores_(std::move(user_scores)) {}

Plan GuidedPlanner::next(const Belief& belief, const History& history, const ViewPose& current,
                         Scratch& scratch) {
  return Decider{config_, user_scores_, model_, belief, history, current, scratch, bursts_}
      .decide();
}

Plan GuidedPlanner::replay(std::span<const Decision> recorded, const Belief& belief,
                           const History& history, const ViewPose& current, Scratch& scratch) {
  if (config_.fvs.mode == FvsMode::single) {
    return Planner::replay(recorded, belief, history, current, scratch);
  }
  Plan plan =
      Decider{config_, user_scores_, model_, belief, history, current, scratch, bursts_, recorded}
          .decide();
  need_as_recorded(plan, recorded, history.decisions.size());
  std::ranges::copy_n(recorded.begin(),
                      static_cast<std::ptrdiff_t>(std::min(recorded.size(), plan.views.size())),
                      plan.views.begin());
  return plan;
}

}  // namespace gnbv
