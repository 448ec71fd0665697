#include "planner/tour/orienteering.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/tour/tour_search.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// A tour while it is changed. Copied, it is a state to return to.
class OpenTour {
 public:
  explicit OpenTour(const OrienteeringProblem& problem)
      : problem_(&problem), cover_(problem), waypoints_({problem.start}, problem.row_m) {
    waypoints_.find_detours();
  }

  const std::vector<std::uint32_t>& chosen() const { return chosen_; }
  const Waypoints& waypoints() const { return waypoints_; }

  double worth() const {
    return cover_.found() -
           problem_->price * (waypoints_.length_m() +
                              problem_->way_per_view * static_cast<double>(chosen_.size()));
  }

  OrienteeringTour made() const {
    std::vector<std::pair<std::size_t, std::uint32_t>> keyed;
    for (const std::uint32_t view : chosen_) {
      keyed.emplace_back(waypoints_.index_of(node_of(view)), view);
    }
    std::sort(keyed.begin(), keyed.end());
    OrienteeringTour tour{.worth = worth()};
    for (const auto& [index, view] : keyed) tour.views.push_back(view);
    return tour;
  }

  void remove(std::uint32_t view) {
    cover_.set(view, false);
    chosen_.erase(std::find(chosen_.begin(), chosen_.end(), view));
    if (has_just(node_of(view), 0)) waypoints_.remove(node_of(view));
  }

  /// At the cheapest position; not at all where no way leads.
  void insert(std::uint32_t view) {
    const std::uint32_t node = node_of(view);
    if (!std::isfinite(waypoints_.extra_m()[node])) return;
    cover_.set(view, true);
    chosen_.push_back(view);
    if (!waypoints_.has(node)) waypoints_.insert(node);
  }

  /// Puts in what pays, until nothing does: each time what brings the most per metre, times its
  /// weight.
  void complete(double metres_per_view, std::span<const double> weights) {
    waypoints_.find_detours();
    while (const auto view = best_view(metres_per_view, weights)) insert(*view);
  }

  /// Takes out what brings less than it costs, the worst first.
  void drop_unpaid() {
    std::vector<std::pair<double, std::uint32_t>> unpaid;
    for (const std::uint32_t view : chosen_) {
      const double worth = worth_of(view);
      if (worth < 0.0) unpaid.emplace_back(worth, view);
    }
    std::sort(unpaid.begin(), unpaid.end());
    for (const auto& [worth, view] : unpaid) {
      if (worth_of(view) < 0.0) remove(view);  // not what has become worth more without others
    }
  }

  void shorten() { waypoints_.shorten(); }

  void remove_some(Rng& rng) {
    for (const std::uint32_t view :
         views_to_remove(chosen_, problem_->node, waypoints_, problem_->row_m, rng)) {
      remove(view);
    }
  }

 private:
  std::uint32_t node_of(std::uint32_t view) const { return problem_->node[view]; }
  /// Whether it is not the start, and so many of the views are there.
  bool has_just(std::uint32_t node, std::ptrdiff_t views) const {
    return node != problem_->start &&
           views == std::count_if(chosen_.begin(), chosen_.end(),
                                  [&](std::uint32_t view) { return node_of(view) == node; });
  }
  /// Of a chosen view: what it brings beyond its cost.
  double worth_of(std::uint32_t view) const {
    const std::uint32_t node = node_of(view);
    const double saved_m = has_just(node, 1) ? waypoints_.saved_without_m(node) : 0.0;
    return cover_.loss_without(view) - problem_->price * (problem_->way_per_view + saved_m);
  }

  std::optional<std::uint32_t> best_view(double metres_per_view,
                                         std::span<const double> weights) const {
    const std::span<const double> gains = cover_.gains();
    const std::span<const float> extra_m = waypoints_.extra_m();
    double most = kTolerance * problem_->price;
    std::optional<std::uint32_t> best;
    for (std::uint32_t view = 0; view < gains.size(); ++view) {
      if (cover_.has(view)) continue;
      double rate = gains[view] / (extra_m[node_of(view)] + metres_per_view);
      if (!weights.empty()) rate *= static_cast<float>(weights[view]);
      if (rate <= most) continue;
      most = rate;
      best = view;
    }
    return best;
  }

  const OrienteeringProblem* problem_;
  ExpectedCover cover_;
  std::vector<std::uint32_t> chosen_;  // views, in the order of choice
  Waypoints waypoints_;
};

}  // namespace

ExpectedCover::ExpectedCover(const OrienteeringProblem& problem)
    : problem_(&problem),
      observers_(std::make_shared<std::vector<std::vector<Observer>>>(problem.weight.size())),
      gain_(problem.observations.size(), 0.0),
      missed_(problem.weight.size(), 1.0),
      is_chosen_(problem.observations.size(), 0) {
  for (std::uint32_t view = 0; view < gain_.size(); ++view) {
    for (const auto& [item, success] : problem.observations[view]) {
      GNBV_CHECK(item < missed_.size() && success >= 0.0F && success < 1.0F,
                 "observation of item {} of {} with success {}", item, missed_.size(), success);
      observers_->at(item).push_back({view, success});
      gain_[view] += problem.weight[item] * success;
    }
  }
}

void ExpectedCover::set(std::uint32_t view, bool is_chosen) {
  GNBV_CHECK(has(view) != is_chosen, "view {} is set to {} twice", view, is_chosen);
  is_chosen_[view] = is_chosen ? 1 : 0;
  for (const auto& [item, success] : problem_->observations[view]) {
    const double failure = 1.0 - success;
    const double missed = is_chosen ? missed_[item] * failure : missed_[item] / failure;
    const double by = problem_->weight[item] * (missed - missed_[item]);
    for (const Observer& one : (*observers_)[item]) gain_[one.view] += by * one.success;
    found_ -= by;
    missed_[item] = missed;
  }
}

double ExpectedCover::loss_without(std::uint32_t view) const {
  double loss = 0.0;
  for (const ItemObservation& one : problem_->observations[view]) {
    const float odds = one.success / (1.0F - one.success);
    loss += double{problem_->weight[one.item] * odds} * missed_[one.item];
  }
  return loss;
}

OrienteeringTour solve(const OrienteeringProblem& problem, std::span<const std::uint32_t> from,
                       int iterations, std::uint64_t seed) {
  OpenTour tour(problem);
  for (const std::uint32_t view : from) tour.insert(view);
  tour.complete(1.0, {});
  tour.drop_unpaid();
  tour.shorten();
  return search(std::move(tour), problem.observations.size(), iterations, {.price = problem.price},
                seed)
      .made();
}

}  // namespace gnbv
