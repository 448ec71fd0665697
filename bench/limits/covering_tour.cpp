#include "bench/limits/covering_tour.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "planner/tour/short_tour.hpp"
#include "sim/core/error.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

constexpr double kLeast_m = 1e-6;  // less is rounding

/// What a stop at each place would add to a tour at the cheapest position, and which that is.
struct Detours {
  std::vector<float> extra_m;
  std::vector<std::uint32_t> at;
  std::vector<double> liking = {};  // of each view: what its finds are multiplied by; empty: 1
};

/// A tour while it is changed. Copied, it is a state to return to.
class OpenTour {
 public:
  OpenTour(const CoverTask& task)
      : task_(&task), counts_(task.views, task.given), stops_{task.start} {}
  OpenTour(const CoverTask& task, const CoveringTour& tour) : OpenTour(task) {
    stops_ = tour.places;
    for (const std::uint32_t view : tour.views) take(view);
  }

  const CoverCounts& counts() const { return counts_; }
  const std::vector<std::uint32_t>& chosen() const { return chosen_; }
  const std::vector<std::uint32_t>& stops() const { return stops_; }
  std::uint32_t place_of(std::uint32_t view) const { return task_->place[view]; }

  double length_m() const {
    double length_m = 0.0;
    for (std::size_t i = 1; i < stops_.size(); ++i) length_m += leg_m(stops_[i - 1], stops_[i]);
    return length_m;
  }
  double cost_m(const CoverAim& aim) const {
    return length_m() + aim.metres_per_view * static_cast<double>(chosen_.size());
  }
  CoveringTour made() const {
    CoveringTour tour{stops_, chosen_, length_m(), counts_.covered()};
    std::sort(tour.views.begin(), tour.views.end());
    return tour;
  }

  void remove(std::uint32_t view) {
    counts_.remove(view);
    chosen_.erase(std::find(chosen_.begin(), chosen_.end(), view));
    const std::uint32_t place = place_of(view);
    if (place != task_->start && views_at(place) == 0) {
      stops_.erase(std::find(stops_.begin(), stops_.end(), place));
    }
  }

  /// Whether there was one to add: that with the most items per metre, of at most those missing.
  bool add_best(const CoverAim& aim, double metres_per_view, Detours& detours) {
    const auto missing = static_cast<double>(aim.wanted - counts_.covered());
    const std::span<const std::uint32_t> gains = counts_.gains();
    double most = 0.0;
    std::uint32_t best = 0;
    for (std::uint32_t view = 0; view < gains.size(); ++view) {
      if (gains[view] == 0) continue;
      const double liking = detours.liking.empty() ? 1.0 : detours.liking[view];
      const double score = liking * std::min(static_cast<double>(gains[view]), missing) /
                           (static_cast<double>(detours.extra_m[place_of(view)]) + metres_per_view);
      if (score <= most) continue;
      most = score;
      best = view;
    }
    if (most <= 0.0) return false;
    take(best);
    const std::uint32_t place = place_of(best);
    if (std::find(stops_.begin(), stops_.end(), place) == stops_.end()) {
      stops_.insert(stops_.begin() + detours.at[place], place);
      find_detours(detours);
    }
    return true;
  }

  void find_detours(Detours& detours) const {
    const std::span<const float> last_m = task_->row_m(stops_.back());
    detours.extra_m.assign(last_m.begin(), last_m.end());
    detours.at.assign(last_m.size(), static_cast<std::uint32_t>(stops_.size()));
    float* const extra_m = detours.extra_m.data();
    std::uint32_t* const at = detours.at.data();
    for (std::uint32_t i = 1; i < stops_.size(); ++i) {
      const std::span<const float> from_m = task_->row_m(stops_[i - 1]);
      const std::span<const float> to_m = task_->row_m(stops_[i]);
      const float leg = from_m[stops_[i]];
      for (std::size_t p = 0; p < from_m.size(); ++p) {
        const float e = from_m[p] + to_m[p] - leg;
        at[p] = e < extra_m[p] ? i : at[p];
        extra_m[p] = std::min(e, extra_m[p]);
      }
    }
    for (float& e : detours.extra_m) e = std::max(e, 0.0F);
    for (const std::uint32_t stop : stops_) detours.extra_m[stop] = 0.0F;
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

  void shorten(int kicks = 0) {
    Distances distance_m(stops_.size(), std::vector<double>(stops_.size()));
    for (std::size_t i = 0; i < stops_.size(); ++i) {
      const std::span<const float> row_m = task_->row_m(stops_[i]);
      for (std::size_t j = 0; j < stops_.size(); ++j) {
        distance_m[i][j] = static_cast<double>(row_m[stops_[j]]);
      }
    }
    std::vector<std::size_t> order(stops_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    improve_tour_with_kicks(distance_m, order, kicks);
    std::vector<std::uint32_t> stops;
    for (const std::size_t stop : order) stops.push_back(stops_[stop]);
    stops_ = std::move(stops);
  }

 private:
  double leg_m(std::uint32_t from, std::uint32_t to) const {
    return static_cast<double>(task_->row_m(from)[to]);
  }
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
    if (place == task_->start || views_at(place) > 1) return 0.0;
    const auto at =
        static_cast<std::size_t>(std::find(stops_.begin(), stops_.end(), place) - stops_.begin());
    const double to_m = leg_m(stops_[at - 1], place);
    if (at + 1 == stops_.size()) return to_m;
    return to_m + leg_m(place, stops_[at + 1]) - leg_m(stops_[at - 1], stops_[at + 1]);
  }

  const CoverTask* task_;
  CoverCounts counts_;
  std::vector<std::uint32_t> chosen_;  // views, in the order of choice
  std::vector<std::uint32_t> stops_;
};

/// Numbers of one iteration.
class Dice {
 public:
  explicit Dice(int iteration) : iteration_(static_cast<std::uint64_t>(iteration)) {}
  double uniform() { return uniform01({0, Stream::cover_search, iteration_, drawn_++}); }
  /// In [0, count).
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(random_bits({0, Stream::cover_search, iteration_, drawn_++}) %
                                    count);
  }

 private:
  std::uint64_t iteration_;
  std::uint64_t drawn_ = 0;
};

/// Some of the tour's views, by one of the three ways.
std::vector<std::uint32_t> to_remove(const CoverTask& task, const OpenTour& tour, Dice& dice) {
  constexpr std::size_t kFewest = 2;
  constexpr std::size_t kMost = 15;
  const std::size_t count =
      std::min(tour.chosen().size(), kFewest + dice.below(kMost - kFewest + 1));
  std::vector<std::uint32_t> views = tour.chosen();
  const std::uint32_t seed = views[dice.below(views.size())];
  std::vector<double> key(task.place.size(), 0.0);
  switch (dice.below(3)) {
    case 0: {  // in a row: the stops from the seed's on, then from the start
      std::vector<std::size_t> order(task.row_m(task.start).size(), 0);
      const std::vector<std::uint32_t>& stops = tour.stops();
      for (std::size_t i = 0; i < stops.size(); ++i) order[stops[i]] = i;
      const std::size_t first = order[task.place[seed]];
      for (const std::uint32_t view : views) {
        const std::size_t at = order[task.place[view]];
        key[view] = static_cast<double>((at + stops.size() - first) % stops.size());
      }
      break;
    }
    case 1: {
      const std::span<const float> row_m = task.row_m(task.place[seed]);
      for (const std::uint32_t view : views) {
        key[view] = static_cast<double>(row_m[task.place[view]]);
      }
      break;
    }
    default:
      for (const std::uint32_t view : views) key[view] = dice.uniform();
  }
  std::sort(views.begin(), views.end(), [&](std::uint32_t a, std::uint32_t b) {
    return key[a] != key[b] ? key[a] < key[b] : a < b;
  });
  views.resize(count);
  return views;
}

/// Without it the best bid always wins, and a tour of two views that a third one outbids is never
/// found. Every other iteration does without.
std::vector<double> random_likings(std::size_t views, Dice& dice) {
  const double most_off = std::max(0.0, 2.0 * dice.uniform() - 1.0);
  std::vector<double> likings;
  if (most_off == 0.0) return likings;
  for (std::size_t view = 0; view < views; ++view) {
    likings.push_back(1.0 - most_off * dice.uniform());
  }
  return likings;
}

void complete(OpenTour& tour, const CoverAim& aim, double metres_per_view, Detours& detours) {
  tour.find_detours(detours);
  while (tour.counts().covered() < aim.wanted) {
    if (!tour.add_best(aim, metres_per_view, detours)) return;
  }
}

}  // namespace

double cost_m(const CoveringTour& tour, const CoverAim& aim) {
  return tour.length_m + aim.metres_per_view * static_cast<double>(tour.views.size());
}

CoveringTour greedy_tour(const CoverTask& task, const CoverAim& aim) {
  OpenTour tour(task);
  Detours detours;
  tour.find_detours(detours);
  while (tour.counts().covered() < aim.wanted && tour.add_best(aim, aim.metres_per_view, detours)) {
    tour.shorten();
    tour.find_detours(detours);
  }
  return tour.made();
}

CoveringTour cheaper_tour(const CoverTask& task, const CoverAim& aim, const CoveringTour& from,
                          int iterations) {
  constexpr double kCold_m = 0.01;
  const double degree_m = std::max(1.0, aim.metres_per_view);
  const double hot_m = 0.6 * degree_m;
  Detours detours;
  OpenTour current(task, from);
  if (from.covered < aim.wanted) complete(current, aim, aim.metres_per_view, detours);
  OpenTour best = current;
  double current_m = current.cost_m(aim);
  double best_m = current_m;
  OpenTour trial = current;
  for (int i = 0; i < iterations && !current.chosen().empty(); ++i) {
    Dice dice(i);
    trial = current;
    for (const std::uint32_t view : to_remove(task, trial, dice)) trial.remove(view);
    const double price_m = 0.1 * std::pow(20.0 * degree_m, dice.uniform());
    detours.liking = random_likings(task.views.size(), dice);
    complete(trial, aim, price_m, detours);
    trial.drop_needless(aim);
    if (trial.counts().covered() < std::min(aim.wanted, current.counts().covered())) continue;
    double trial_m = trial.cost_m(aim);
    if (trial_m < best_m - kLeast_m) {
      trial.shorten();
      trial_m = trial.cost_m(aim);
    }
    const double heat_m =
        hot_m * std::pow(kCold_m / hot_m, static_cast<double>(i) / static_cast<double>(iterations));
    if (trial_m - current_m >= -heat_m * std::log(1.0 - dice.uniform())) continue;
    std::swap(current, trial);
    current_m = trial_m;
    if (current_m >= best_m - kLeast_m) continue;
    best = current;
    best_m = current_m;
  }
  best.shorten(iterations / 40);
  return best.made();
}

}  // namespace gnbv
