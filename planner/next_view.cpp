#include "planner/next_view.hpp"

#include <algorithm>
#include <atomic>

#include "planner/belief.hpp"
#include "planner/frontier_order.hpp"
#include "planner/history.hpp"
#include "planner/model.hpp"
#include "planner/workbench.hpp"
#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

/// One decision under way.
class Decider {
 public:
  Decider(const PlannerModel& model, const Belief& belief, const History& history,
          const ViewPose& current, Workbench& bench)
      : model_(model),
        belief_(belief),
        history_(history),
        current_(current),
        bench_(bench),
        validity_(model.config.validity),
        recent_(recent_views(history, model.config.validity.recent_poses)),
        progress_(progress()),
        frontier_density_(model.config.fvs.frontier.density_share * belief.cloud.density_max()) {}

  Plan decide() {
    const FvsConfig& fvs = model_.config.fvs;
    const bool is_stuck =
        fvs.enabled && is_entropy_still(fvs.entropy_threshold_nat, fvs.entropy_window, progress_);
    if (is_stuck && (try_fvs() || !fvs.agvs_when_stuck)) return std::move(plan_);
    if (try_agvs() || !fvs.enabled || !fvs.when_grid_finds_nothing) return std::move(plan_);
    if (!is_stuck && try_fvs()) return std::move(plan_);
    if (validity_.path == PathCheck::straight) {
      validity_.path = PathCheck::astar;
      try_fvs();
    }
    return std::move(plan_);
  }

 private:
  Progress progress() const {
    Progress made{.utilities = {},
                  .positions_m = positions_of(history_),
                  .entropies_nat = history_.entropies_nat,
                  .view_voxels = model_.view_voxels};
    for (const Decision& decision : history_.decisions) {
      if (decision.sampler != "start") made.utilities.push_back(decision.score.value);
    }
    return made;
  }

  /// The first cluster that has a valid view, or all of them together.
  bool try_fvs() {
    const FvsConfig& fvs = model_.config.fvs;
    plan_.clusters = clusters_to_try(fvs, belief_, history_.decisions, current_.p_world_m,
                                     bench_.frontier_marks);
    const std::span<const FrontierCluster> clusters = plan_.clusters;
    std::vector<std::vector<Candidate>> views;
    std::vector<Candidate> pool;
    for (std::size_t rank = 0; rank < clusters.size(); ++rank) {
      if (rank == views.size()) look_at_next(clusters, views);
      std::move(views[rank].begin(), views[rank].end(), std::back_inserter(pool));
      const bool is_last = rank + 1 == clusters.size();
      if (fvs.pool_clusters && !is_last) continue;
      if (choose_among(std::move(pool))) return true;
      pool.clear();
    }
    return false;
  }

  /// Appends the views of the next cluster, and, once the first ones had none that is valid, of
  /// those after it: mostly there is none, and threads have nothing else to do.
  void look_at_next(std::span<const FrontierCluster> clusters,
                    std::vector<std::vector<Candidate>>& views) const {
    constexpr std::size_t kMostEach = 4;
    const auto threads = static_cast<std::size_t>(std::max(bench_.threads, 1));
    const std::size_t begin = views.size();
    const std::size_t most = threads == 1 ? 1 : kMostEach * threads;
    views.resize(std::min({2 * begin + 1, begin + most, clusters.size()}));
    parallel_for(bench_.threads, views.size() - begin, [&](std::size_t i) {
      views[begin + i] = views_of(clusters[begin + i], static_cast<int>(begin + i));
    });
  }

  std::vector<Candidate> views_of(const FrontierCluster& cluster, int rank) const {
    const FvsConfig& fvs = model_.config.fvs;
    std::vector<Candidate> views;
    for (const ViewPose& view : sample_fvs(fvs, cluster.centroid_world_m, model_.pitches_rad)) {
      views.push_back({.view = view, .sampler = "fvs", .cluster = rank});
    }
    check_all(views);
    for (Candidate& candidate : views) {
      if (candidate.rejected) continue;
      candidate.rejected = cluster_rejection(model_.cameras, belief_.grid, cluster, candidate.view,
                                             fvs.needs_visible_cluster);
    }
    return views;
  }

  /// A scale without any valid view is grown as at a local minimum; last comes the finest.
  bool try_agvs() {
    const AgvsConfig& agvs = model_.config.agvs;
    const double last_scale = history_.decisions.empty() ? 1.0 : history_.decisions.back().scale;
    const double first_scale = next_agvs_scale(agvs, last_scale, progress_);
    for (double scale = first_scale;; scale = std::min(scale * agvs.scale_factor, agvs.scale_max)) {
      if (try_agvs_at(scale)) return true;
      if (!agvs.scales || scale >= agvs.scale_max) break;
    }
    return first_scale > 1.0 && try_agvs_at(1.0);
  }

  bool try_agvs_at(double scale) {
    std::vector<Candidate> candidates;
    for (const ViewPose& view :
         sample_agvs(model_.config.agvs, current_, scale, model_.pitches_rad)) {
      candidates.push_back({.view = view, .sampler = "agvs", .scale = scale});
    }
    check_all(candidates);
    return choose_among(std::move(candidates));
  }

  /// In pieces, since neighbours often share their position and what is known of it.
  void check_all(std::span<Candidate> candidates) const {
    constexpr std::size_t kPiece = 32;
    parallel_for_chunks(bench_.threads, candidates.size(), kPiece, [&](auto begin, auto end) {
      ViewChecker checker(validity_, model_.navigation_m, model_.no_fly, belief_.grid, recent_,
                          current_);
      for (Candidate& candidate : candidates.subspan(begin, end - begin)) checker.check(candidate);
    });
  }

  /// Scores the candidates not rejected, each alone: which thread did it leaves no trace.
  void score_all(std::span<Candidate> candidates) {
    std::vector<std::size_t> valid;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (!candidates[i].rejected) valid.push_back(i);
    }
    std::vector<OwnCandidate> own(model_.own_scores ? valid.size() : 0);
    std::atomic<std::size_t> next{0};
    parallel_for(bench_.threads, bench_.marks.size(), [&](std::size_t share) {
      for (std::size_t i = next++; i < valid.size(); i = next++) {
        Candidate& candidate = candidates[valid[i]];
        ViewStats stats = evaluate_view(
            belief_.grid, belief_.cloud, model_.rays_at(candidate.view.gimbal_pitch_rad),
            candidate.view, bench_.marks[share],
            view_options(model_.config.utility, belief_.shadow, frontier_density_));
        stats.density_max = belief_.cloud.density_max();
        stats.path_m = model_.config.utility.distance == DistanceAlong::path
                           ? candidate.path_m
                           : (candidate.view.p_world_m - current_.p_world_m).norm();
        if (model_.own_scores) {
          const Vec3& p_m = candidate.view.p_world_m;
          own[i] = {stats,
                    p_m.x(),
                    p_m.y(),
                    p_m.z(),
                    candidate.view.yaw_rad,
                    candidate.view.gimbal_pitch_rad};
          continue;
        }
        const ScoreContext context = {
            .seed = model_.seed, .iteration = history_.decisions.size(), .candidate = valid[i]};
        const std::optional<Score> utility = score(model_.config.utility, stats, context);
        if (utility) {
          candidate.score = *utility;
        } else {
          candidate.rejected = Rejection::sees_no_surface;
        }
      }
    });
    if (model_.own_scores) take_own_scores(candidates, valid, own);
  }

  /// All at once: the function sees a decision, never a share of it.
  void take_own_scores(std::span<Candidate> candidates, std::span<const std::size_t> valid,
                       std::span<const OwnCandidate> own) {
    if (valid.empty()) return;
    const std::vector<double> scores =
        model_.own_scores({.iteration = history_.decisions.size(), .rows = own, .indices = valid});
    GNBV_CHECK(scores.size() == valid.size(), "{} scores of {} views", scores.size(), valid.size());
    for (std::size_t i = 0; i < valid.size(); ++i) {
      candidates[valid[i]].score = {.value = scores[i], .information = scores[i]};
    }
  }

  /// Takes the candidate of the highest utility, the first of equals, and keeps the record.
  bool choose_among(std::vector<Candidate> candidates) {
    score_all(candidates);
    const Candidate* best = nullptr;
    int valid = 0;
    for (const Candidate& candidate : candidates) {
      if (candidate.rejected) continue;
      ++valid;
      if (best == nullptr || candidate.score.value > best->score.value) best = &candidate;
    }
    if (best != nullptr) {
      plan_.next = Decision{.view = best->view,
                            .sampler = best->sampler,
                            .scale = best->scale,
                            .candidates = static_cast<int>(candidates.size()),
                            .valid = valid,
                            .score = best->score,
                            .via_world_m = best->via_world_m};
      plan_.chosen = plan_.candidates.size() + static_cast<std::size_t>(best - candidates.data());
    }
    std::move(candidates.begin(), candidates.end(), std::back_inserter(plan_.candidates));
    return plan_.next.has_value();
  }

  const PlannerModel& model_;
  const Belief& belief_;
  const History& history_;
  const ViewPose& current_;
  Workbench& bench_;
  ValidityConfig validity_;  // the configured one, but for the last way out
  const std::vector<ViewPose> recent_;
  const Progress progress_;
  const double frontier_density_;
  Plan plan_;
};

}  // namespace

Plan plan_next_view(const PlannerModel& model, const Belief& belief, const History& history,
                    const ViewPose& current, Workbench& bench) {
  return Decider(model, belief, history, current, bench).decide();
}

}  // namespace gnbv
