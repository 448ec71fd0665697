#include "planner/tour/prize_tour.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "planner/tour/expected_cover.hpp"
#include "planner/tour/short_tour.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

constexpr double kLeast = 1e-6;  // less is rounding
// a view is put in that brings this share of its price: the search may find it a neighbour
constexpr double kTolerance = 0.7;

/// A tour while it is changed. Copied, it is a state to return to.
class OpenTour {
 public:
  OpenTour(const PrizeTask& task, const LookTable& table)
      : task_(&task), cover_(task, table), stops_{task.start} {
    find_detours();
  }

  const std::vector<std::uint32_t>& chosen() const { return chosen_; }
  const std::vector<std::uint32_t>& stops() const { return stops_; }
  std::uint32_t place_of(std::uint32_t view) const { return task_->place[view]; }

  double length_m() const {
    double length_m = 0.0;
    for (std::size_t i = 1; i < stops_.size(); ++i) length_m += leg_m(stops_[i - 1], stops_[i]);
    return length_m;
  }
  double worth() const {
    return cover_.found() -
           task_->price_per_m *
               (length_m() + task_->metres_per_view * static_cast<double>(chosen_.size()));
  }

  PrizeTour made() const {
    std::vector<std::size_t> order(extra_m_.size(), 0);
    for (std::size_t i = 0; i < stops_.size(); ++i) order[stops_[i]] = i;
    PrizeTour tour{stops_, chosen_, length_m(), cover_.found(), worth()};
    std::sort(tour.views.begin(), tour.views.end(), [&](std::uint32_t a, std::uint32_t b) {
      const auto key = [&](std::uint32_t view) { return std::pair(order[place_of(view)], view); };
      return key(a) < key(b);
    });
    return tour;
  }

  void remove(std::uint32_t view) {
    cover_.remove(view);
    chosen_.erase(std::find(chosen_.begin(), chosen_.end(), view));
    const std::uint32_t place = place_of(view);
    if (place != task_->start && views_at(place) == 0) {
      stops_.erase(std::find(stops_.begin(), stops_.end(), place));
    }
  }

  /// At the cheapest position; false where there is no way.
  bool insert(std::uint32_t view) {
    const std::uint32_t place = place_of(view);
    if (!std::isfinite(extra_m_[place])) return false;
    cover_.add(view);
    chosen_.push_back(view);
    if (std::find(stops_.begin(), stops_.end(), place) == stops_.end()) {
      stops_.insert(stops_.begin() + at_[place], place);
      find_detours();
    }
    return true;
  }

  /// Whether there was one that pays: that with the most per metre, times what it is liked.
  bool insert_best(double metres_per_view, std::span<const float> liking) {
    const std::span<const double> gains = cover_.gains();
    double most = kTolerance * task_->price_per_m;
    std::optional<std::uint32_t> best;
    for (std::uint32_t view = 0; view < gains.size(); ++view) {
      if (cover_.has(view)) continue;
      double bid = gains[view] / (static_cast<double>(extra_m_[place_of(view)]) + metres_per_view);
      if (!liking.empty()) bid *= static_cast<double>(liking[view]);
      if (bid <= most) continue;
      most = bid;
      best = view;
    }
    return best && insert(*best);
  }

  /// What a stop at each place would add to the tour at the cheapest position, and which that is.
  void find_detours() {
    const std::span<const float> last_m = task_->row_m(stops_.back());
    extra_m_.assign(last_m.begin(), last_m.end());
    at_.assign(last_m.size(), static_cast<std::int32_t>(stops_.size()));
    for (std::size_t i = 1; i < stops_.size(); ++i) {
      const std::span<const float> from_m = task_->row_m(stops_[i - 1]);
      const std::span<const float> to_m = task_->row_m(stops_[i]);
      const float leg = from_m[stops_[i]];
      for (std::size_t p = 0; p < from_m.size(); ++p) {
        const float extra = from_m[p] + to_m[p] - leg;
        at_[p] = extra < extra_m_[p] ? static_cast<std::int32_t>(i) : at_[p];
        extra_m_[p] = std::min(extra, extra_m_[p]);
      }
    }
    for (float& extra : extra_m_) extra = std::max(extra, 0.0F);
    for (const std::uint32_t stop : stops_) extra_m_[stop] = 0.0F;
  }

  /// Views that bring less than they cost go, those first that lose the most.
  void drop_unpaid() {
    while (true) {
      double worst = 0.0;
      std::optional<std::uint32_t> unpaid;
      for (const std::uint32_t view : chosen_) {
        const double cost = task_->price_per_m * (task_->metres_per_view + saved_without_m(view));
        const double gain = cover_.loss_without(view) - cost;
        if (gain >= worst) continue;
        worst = gain;
        unpaid = view;
      }
      if (!unpaid) return;
      remove(*unpaid);
    }
  }

  void shorten() {
    Distances distance_m(stops_.size(), std::vector<double>(stops_.size()));
    for (std::size_t i = 0; i < stops_.size(); ++i) {
      const std::span<const float> row_m = task_->row_m(stops_[i]);
      for (std::size_t j = 0; j < stops_.size(); ++j) {
        distance_m[i][j] = static_cast<double>(row_m[stops_[j]]);
      }
    }
    std::vector<std::size_t> order(stops_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    improve_tour(distance_m, order);
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
  double saved_without_m(std::uint32_t view) const {
    const std::uint32_t place = place_of(view);
    if (place == task_->start || views_at(place) > 1) return 0.0;
    const auto at =
        static_cast<std::size_t>(std::find(stops_.begin(), stops_.end(), place) - stops_.begin());
    const double to_m = leg_m(stops_[at - 1], place);
    if (at + 1 == stops_.size()) return to_m;
    return to_m + leg_m(place, stops_[at + 1]) - leg_m(stops_[at - 1], stops_[at + 1]);
  }

  const PrizeTask* task_;
  ExpectedCover cover_;
  std::vector<std::uint32_t> chosen_;  // views, in the order of choice
  std::vector<std::uint32_t> stops_;
  std::vector<float> extra_m_;    // of each place
  std::vector<std::int32_t> at_;  // of each place: where among the stops
};

/// Numbers of one iteration.
class Dice {
 public:
  Dice(std::uint64_t seed, int iteration)
      : seed_(seed), iteration_(static_cast<std::uint64_t>(iteration)) {}
  double uniform() { return uniform01({seed_, Stream::tour_search, iteration_, drawn_++}); }
  /// In [0, count).
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(
        random_bits({seed_, Stream::tour_search, iteration_, drawn_++}) % count);
  }

 private:
  std::uint64_t seed_, iteration_;
  std::uint64_t drawn_ = 0;
};

/// Some of the tour's views, by one of the three ways.
std::vector<std::uint32_t> to_remove(const PrizeTask& task, const OpenTour& tour, Dice& dice) {
  constexpr std::size_t kFewest = 2;
  constexpr std::size_t kMost = 15;
  std::vector<std::uint32_t> views = tour.chosen();
  const std::size_t count = std::min(views.size(), kFewest + dice.below(kMost - kFewest + 1));
  const std::uint32_t seed = views[dice.below(views.size())];
  const std::size_t way = dice.below(3);
  std::vector<std::pair<double, std::uint32_t>> keyed;
  const std::span<const float> row_m = task.row_m(task.place[seed]);
  const std::vector<std::uint32_t>& stops = tour.stops();
  const auto stop_of = [&](std::uint32_t view) {
    return static_cast<std::size_t>(std::find(stops.begin(), stops.end(), task.place[view]) -
                                    stops.begin());
  };
  const std::size_t first = stop_of(seed);
  for (const std::uint32_t view : views) {
    double key = 0.0;
    if (way == 0) {  // in a row: the stops from the seed's on, then from the start
      key = static_cast<double>((stop_of(view) + stops.size() - first) % stops.size());
    } else if (way == 1) {
      key = static_cast<double>(row_m[task.place[view]]);
    } else {
      key = dice.uniform();
    }
    keyed.emplace_back(key, view);
  }
  std::sort(keyed.begin(), keyed.end());
  views.clear();
  for (std::size_t i = 0; i < count; ++i) views.push_back(keyed[i].second);
  return views;
}

/// Without it the best bid always wins, and a tour of two views that a third one outbids is never
/// found. Every other iteration does without.
void draw_likings(std::size_t views, Dice& dice, std::vector<float>& likings) {
  likings.clear();
  const double most_off = std::max(0.0, 2.0 * dice.uniform() - 1.0);
  if (most_off == 0.0) return;
  for (std::size_t view = 0; view < views; ++view) {
    likings.push_back(static_cast<float>(1.0 - most_off * dice.uniform()));
  }
}

void complete(OpenTour& tour, double metres_per_view, std::span<const float> liking) {
  tour.find_detours();
  while (tour.insert_best(metres_per_view, liking)) {
  }
}

}  // namespace

PrizeTour search_prize_tour(const PrizeTask& task, std::span<const std::uint32_t> from,
                            int iterations, std::uint64_t seed) {
  constexpr double kHot_m = 0.6;
  constexpr double kCold_m = 0.01;
  const LookTable table(task);
  OpenTour current(task, table);
  for (const std::uint32_t view : from) current.insert(view);
  complete(current, 1.0, {});
  current.drop_unpaid();
  current.shorten();
  OpenTour best = current;
  double current_worth = current.worth();
  double best_worth = current_worth;
  OpenTour trial = current;
  std::vector<float> likings;
  for (int i = 0; i < iterations && !current.chosen().empty(); ++i) {
    Dice dice(seed, i);
    trial = current;
    for (const std::uint32_t view : to_remove(task, trial, dice)) trial.remove(view);
    const double metres_per_view = 0.1 * std::pow(20.0, dice.uniform());
    draw_likings(task.looks.size(), dice, likings);
    complete(trial, metres_per_view, likings);
    trial.drop_unpaid();
    double worth = trial.worth();
    if (worth > best_worth + kLeast) {
      trial.shorten();
      worth = trial.worth();
    }
    const double heat =
        task.price_per_m * kHot_m *
        std::pow(kCold_m / kHot_m, static_cast<double>(i) / static_cast<double>(iterations));
    if (current_worth - worth >= -heat * std::log(1.0 - dice.uniform())) continue;
    std::swap(current, trial);
    current_worth = worth;
    if (current_worth <= best_worth + kLeast) continue;
    best = current;
    best_worth = current_worth;
  }
  return best.made();
}

}  // namespace gnbv
