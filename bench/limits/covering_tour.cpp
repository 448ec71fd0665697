#include "bench/limits/covering_tour.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr double kLeast_m = 1e-6;  // less is rounding

/// A tour while it is changed. Copied, it is a state to return to.
class OpenTour {
 public:
  OpenTour(const CoverTask& task)
      : task_(&task), counts_(task.views, task.given), waypoints_({task.start}, task.row_m) {}
  OpenTour(const CoverTask& task, const CoveringTour& tour)
      : task_(&task), counts_(task.views, task.given), waypoints_(tour.places, task.row_m) {
    for (const std::uint32_t view : tour.views) take(view);
  }

  const CoverCounts& counts() const { return counts_; }
  const std::vector<std::uint32_t>& chosen() const { return chosen_; }
  Waypoints& waypoints() { return waypoints_; }

  double cost_m(const CoverAim& aim) const {
    return waypoints_.length_m() + aim.metres_per_view * static_cast<double>(chosen_.size());
  }
  CoveringTour made() const {
    CoveringTour tour{waypoints_.nodes(), chosen_, waypoints_.length_m(), counts_.covered()};
    std::sort(tour.views.begin(), tour.views.end());
    return tour;
  }

  void remove(std::uint32_t view) {
    counts_.remove(view);
    chosen_.erase(std::find(chosen_.begin(), chosen_.end(), view));
    const std::uint32_t place = place_of(view);
    if (place != task_->start && views_at(place) == 0) waypoints_.remove(place);
  }

  /// Whether there was one to add: that with the most items per metre, of at most those missing,
  /// times its weight.
  bool add_best(const CoverAim& aim, double metres_per_view, std::span<const double> weights) {
    const auto missing = static_cast<double>(aim.wanted - counts_.covered());
    const std::span<const std::uint32_t> gains = counts_.gains();
    double most = 0.0;
    std::uint32_t best = 0;
    for (std::uint32_t view = 0; view < gains.size(); ++view) {
      if (gains[view] == 0) continue;
      const double weight = weights.empty() ? 1.0 : weights[view];
      const double score =
          weight * std::min(static_cast<double>(gains[view]), missing) /
          (static_cast<double>(waypoints_.extra_m()[place_of(view)]) + metres_per_view);
      if (score <= most) continue;
      most = score;
      best = view;
    }
    if (most <= 0.0) return false;
    take(best);
    if (!waypoints_.has(place_of(best))) waypoints_.insert(place_of(best));
    return true;
  }

  /// Views that what is wanted can do without go, those first that save the most.
  void drop_needless(const CoverAim& aim) {
    while (counts_.covered() >= aim.wanted) {
      const std::size_t spare = counts_.covered() - aim.wanted;
      double most_m = 0.0;
      std::optional<std::uint32_t> worst;
      for (const std::uint32_t view : chosen_) {
        if (counts_.alone(view) > spare) continue;
        const double saved_m = aim.metres_per_view + saved_without_m(view);
        if (worst && saved_m <= most_m) continue;
        most_m = saved_m;
        worst = view;
      }
      if (!worst) return;
      remove(*worst);
    }
  }

 private:
  std::uint32_t place_of(std::uint32_t view) const { return task_->place[view]; }
  std::ptrdiff_t views_at(std::uint32_t place) const {
    return std::count_if(chosen_.begin(), chosen_.end(),
                         [&](std::uint32_t view) { return place_of(view) == place; });
  }
  void take(std::uint32_t view) {
    counts_.add(view);
    chosen_.push_back(view);
  }
  double saved_without_m(std::uint32_t view) const {
    const std::uint32_t place = place_of(view);
    return place == task_->start || views_at(place) > 1 ? 0.0 : waypoints_.saved_without_m(place);
  }

  const CoverTask* task_;
  CoverCounts counts_;
  std::vector<std::uint32_t> chosen_;  // views, in the order of choice
  Waypoints waypoints_;
};

void complete(OpenTour& tour, const CoverAim& aim, double metres_per_view,
              std::span<const double> weights) {
  tour.waypoints().find_detours();
  while (tour.counts().covered() < aim.wanted) {
    if (!tour.add_best(aim, metres_per_view, weights)) return;
  }
}

}  // namespace

double cost_m(const CoveringTour& tour, const CoverAim& aim) {
  return tour.length_m + aim.metres_per_view * static_cast<double>(tour.views.size());
}

CoveringTour greedy_tour(const CoverTask& task, const CoverAim& aim) {
  OpenTour tour(task);
  tour.waypoints().find_detours();
  while (tour.counts().covered() < aim.wanted && tour.add_best(aim, aim.metres_per_view, {})) {
    heed(task.stop);
    tour.waypoints().shorten();
    tour.waypoints().find_detours();
  }
  return tour.made();
}

CoveringTour cheaper_tour(const CoverTask& task, const CoverAim& aim, const CoveringTour& from,
                          int iterations) {
  constexpr double kCold_m = 0.01;
  const double degree_m = std::max(1.0, aim.metres_per_view);
  const double hot_m = 0.6 * degree_m;
  OpenTour current(task, from);
  if (from.covered < aim.wanted) complete(current, aim, aim.metres_per_view, {});
  OpenTour best = current;
  double current_m = current.cost_m(aim);
  double best_m = current_m;
  OpenTour trial = current;
  for (int i = 0; i < iterations && !current.chosen().empty(); ++i) {
    heed(task.stop);
    Rng rng(task.seed, Stream::cover_search, i);
    trial = current;
    for (const std::uint32_t view :
         views_to_remove(trial.chosen(), task.place, trial.waypoints(), task.row_m, rng)) {
      trial.remove(view);
    }
    const double price_m = 0.1 * std::pow(20.0 * degree_m, rng.uniform());
    complete(trial, aim, price_m, perturbation_weights(task.views.size(), rng));
    trial.drop_needless(aim);
    if (trial.counts().covered() < std::min(aim.wanted, current.counts().covered())) continue;
    double trial_m = trial.cost_m(aim);
    if (trial_m < best_m - kLeast_m) {
      trial.waypoints().shorten();
      trial_m = trial.cost_m(aim);
    }
    const double heat_m =
        hot_m * std::pow(kCold_m / hot_m, static_cast<double>(i) / static_cast<double>(iterations));
    if (trial_m - current_m >= -heat_m * std::log(1.0 - rng.uniform())) continue;
    std::swap(current, trial);
    current_m = trial_m;
    if (current_m >= best_m - kLeast_m) continue;
    best = current;
    best_m = current_m;
  }
  best.waypoints().shorten(iterations / 40);
  return best.made();
}

}  // namespace gnbv
