#include "planner/guided/guided_planner.hpp"

#include <algorithm>
#include <atomic>

#include "planner/core/belief.hpp"
#include "planner/core/history.hpp"
#include "planner/core/model.hpp"
#include "planner/core/scratch.hpp"
#include "planner/guided/frontier_clusters.hpp"
#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

/// One decision under way.
class Decider {
 public:
  Decider(const GuidedConfig& config, const UserScores& user_scores, const PlannerModel& model,
          const Belief& belief, const History& history, const ViewPose& current, Scratch& scratch)
      : config_(config),
        user_scores_(user_scores),
        model_(model),
        belief_(belief),
        history_(history),
        current_(current),
        scratch_(scratch),
        validity_(model.validity),
        recent_(recent_views(history, model.validity.recent_poses)),
        progress_(progress()),
        frontier_density_(config.fvs.frontier.density_share * belief.cloud.density_max()) {}

  Plan decide() {
    const FvsConfig& fvs = config_.fvs;
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
      if (traits_of(decision.sampler).is_scored) made.utilities.push_back(decision.score.value);
    }
    return made;
  }

  /// The first cluster that has a valid view, or all of them together.
  bool try_fvs() {
    const FvsConfig& fvs = config_.fvs;
    plan_.clusters = clusters_to_try(fvs, belief_, history_.decisions, current_.p_world_m,
                                     scratch_.frontier_marks);
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
    scratch_.heed_stop();
    constexpr std::size_t kMostEach = 4;
    const auto threads = static_cast<std::size_t>(std::max(scratch_.threads, 1));
    const std::size_t begin = views.size();
    const std::size_t most = threads == 1 ? 1 : kMostEach * threads;
    views.resize(std::min({2 * begin + 1, begin + most, clusters.size()}));
    parallel_for(scratch_.threads, views.size() - begin, [&](std::size_t i) {
      views[begin + i] = views_of(clusters[begin + i], static_cast<int>(begin + i));
    });
  }

  std::vector<Candidate> views_of(const FrontierCluster& cluster, int rank) const {
    const FvsConfig& fvs = config_.fvs;
    std::vector<Candidate> views;
    for (const ViewPose& view : sample_fvs(fvs, cluster.centroid_world_m, model_.pitches_rad)) {
      views.push_back({.view = view, .sampler = Sampler::fvs, .cluster = rank});
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
    const AgvsConfig& agvs = config_.agvs;
    const double last_scale = history_.decisions.empty() ? 1.0 : history_.decisions.back().scale;
    const double first_scale = next_agvs_scale(agvs, last_scale, progress_);
    for (double scale = first_scale;; scale = std::min(scale * agvs.scale_factor, agvs.scale_max)) {
      if (try_agvs_at(scale)) return true;
      if (!agvs.scales || scale >= agvs.scale_max) break;
    }
    return first_scale > 1.0 && try_agvs_at(1.0);
  }

  bool try_agvs_at(double scale) {
    scratch_.heed_stop();
    std::vector<Candidate> candidates;
    for (const ViewPose& view : sample_agvs(config_.agvs, current_, scale, model_.pitches_rad)) {
      candidates.push_back({.view = view, .sampler = Sampler::agvs, .scale = scale});
    }
    check_all(candidates);
    return choose_among(std::move(candidates));
  }

  /// In pieces, since neighbours often share their position and what is known of it.
  void check_all(std::span<Candidate> candidates) const {
    constexpr std::size_t kPiece = 32;
    parallel_for_chunks(scratch_.threads, candidates.size(), kPiece, [&](auto begin, auto end) {
      ViewChecker checker(validity_, model_.navigation_m, model_.no_fly, belief_.grid, recent_,
                          current_, [this] { scratch_.heed_stop(); });
      for (Candidate& candidate : candidates.subspan(begin, end - begin)) check(checker, candidate);
    });
  }

  /// Scores the candidates not rejected, each alone: which thread did it leaves no trace.
  void score_all(std::span<Candidate> candidates) {
    std::vector<std::size_t> valid;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (!candidates[i].rejected) valid.push_back(i);
    }
    std::vector<UserCandidate> own(user_scores_ ? valid.size() : 0);
    std::atomic<std::size_t> next{0};
    parallel_for(scratch_.threads, scratch_.marks.size(), [&](std::size_t share) {
      for (std::size_t i = next++; i < valid.size(); i = next++) {
        Candidate& candidate = candidates[valid[i]];
        ViewStats stats = evaluate_view(
            belief_.grid, belief_.cloud, model_.rays_at(candidate.view.gimbal_pitch_rad),
            candidate.view, scratch_.marks[share],
            view_options(config_.utility, belief_.shadow, frontier_density_));
        stats.density_max = belief_.cloud.density_max();
        stats.path_m = config_.utility.distance == DistanceAlong::path
                           ? candidate.path_m
                           : (candidate.view.p_world_m - current_.p_world_m).norm();
        if (user_scores_) {
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
        const std::optional<Score> utility = score(config_.utility, stats, context);
        if (utility) {
          candidate.score = *utility;
        } else {
          candidate.rejected = Rejection::sees_no_surface;
        }
      }
    });
    if (user_scores_) take_user_scores(candidates, valid, own);
  }

  /// All at once: the function sees a decision, never a share of it.
  void take_user_scores(std::span<Candidate> candidates, std::span<const std::size_t> valid,
                        std::span<const UserCandidate> own) {
    if (valid.empty()) return;
    const std::vector<double> scores =
        user_scores_({.iteration = history_.decisions.size(), .rows = own, .indices = valid});
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
    const std::size_t first = plan_.candidates.size();
    const std::size_t chosen =
        best == nullptr ? 0 : static_cast<std::size_t>(best - candidates.data());
    const int sampled = static_cast<int>(candidates.size());
    const bool is_found = best != nullptr;
    std::move(candidates.begin(), candidates.end(), std::back_inserter(plan_.candidates));
    if (is_found) choose(plan_, first + chosen, sampled, valid);
    return is_found;
  }

  const GuidedConfig& config_;
  const UserScores& user_scores_;
  const PlannerModel& model_;
  const Belief& belief_;
  const History& history_;
  const ViewPose& current_;
  Scratch& scratch_;
  ValidityConfig validity_;  // the configured one, but for the last way out
  const std::vector<ViewPose> recent_;
  const Progress progress_;
  const double frontier_density_;
  Plan plan_;
};

}  // namespace

GuidedPlanner::GuidedPlanner(GuidedConfig config, const PlannerModel& model, UserScores user_scores)
    : config_(std::move(config)), model_(model), user_scores_(std::move(user_scores)) {}

Plan GuidedPlanner::next(const Belief& belief, const History& history, const ViewPose& current,
                         Scratch& scratch) {
  return Decider(config_, user_scores_, model_, belief, history, current, scratch).decide();
}

}  // namespace gnbv
