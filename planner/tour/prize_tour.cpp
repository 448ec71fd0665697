#include "planner/tour/prize_tour.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/tour/expected_cover.hpp"
#include "planner/tour/neighbourhood.hpp"

namespace gnbv {
namespace {

constexpr double kLeast = 1e-6;  // less is rounding
// a view is put in that brings this share of its price: the search may find it a neighbour
constexpr double kTolerance = 0.7;

/// A tour while it is changed. Copied, it is a state to return to.
class OpenTour {
 public:
  OpenTour(const PrizeTask& task, const LookTable& table)
      : task_(&task), cover_(task, table), stops_({task.start}, task.row_m) {
    stops_.find_detours();
  }

  const std::vector<std::uint32_t>& chosen() const { return chosen_; }
  const Stops& stops() const { return stops_; }

  double worth() const {
    return cover_.found() -
           task_->price_per_m *
               (stops_.length_m() + task_->metres_per_view * static_cast<double>(chosen_.size()));
  }

  PrizeTour made() const {
    PrizeTour tour{stops_.places(), chosen_, stops_.length_m(), cover_.found(), worth()};
    const auto key = [&](std::uint32_t view) {
      return std::pair(stops_.index_of(place_of(view)), view);
    };
    std::sort(tour.views.begin(), tour.views.end(),
              [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    return tour;
  }

  void remove(std::uint32_t view) {
    cover_.remove(view);
    chosen_.erase(std::find(chosen_.begin(), chosen_.end(), view));
    const std::uint32_t place = place_of(view);
    if (place != task_->start && views_at(place) == 0) stops_.remove(place);
  }

  /// At the cheapest position; not where no way leads.
  void insert(std::uint32_t view) {
    const std::uint32_t place = place_of(view);
    if (!std::isfinite(stops_.extra_m()[place])) return;
    cover_.add(view);
    chosen_.push_back(view);
    if (!stops_.has(place)) stops_.insert(place);
  }

  /// Until none is left that pays: that with the most per metre, times what it is liked.
  void complete(double metres_per_view, std::span<const double> liking) {
    stops_.find_detours();
    while (const auto view = best_bid(metres_per_view, liking)) insert(*view);
  }

  /// Views that bring less than they cost go, those first that lose the most.
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

  void shorten() { stops_.shorten(); }

 private:
  std::uint32_t place_of(std::uint32_t view) const { return task_->place[view]; }
  std::ptrdiff_t views_at(std::uint32_t place) const {
    return std::count_if(chosen_.begin(), chosen_.end(),
                         [&](std::uint32_t view) { return place_of(view) == place; });
  }
  double saved_without_m(std::uint32_t view) const {
    const std::uint32_t place = place_of(view);
    return place == task_->start || views_at(place) > 1 ? 0.0 : stops_.saved_without_m(place);
  }

  /// Of a chosen view: what it brings beyond its cost.
  double worth_of(std::uint32_t view) const {
    return cover_.loss_without(view) -
           task_->price_per_m * (task_->metres_per_view + saved_without_m(view));
  }

  std::optional<std::uint32_t> best_bid(double metres_per_view,
                                        std::span<const double> liking) const {
    const std::span<const double> gains = cover_.gains();
    const std::span<const float> extra_m = stops_.extra_m();
    double most = kTolerance * task_->price_per_m;
    std::optional<std::uint32_t> best;
    for (std::uint32_t view = 0; view < gains.size(); ++view) {
      if (cover_.has(view)) continue;
      double bid = gains[view] / (static_cast<double>(extra_m[place_of(view)]) + metres_per_view);
      if (!liking.empty()) bid *= static_cast<double>(static_cast<float>(liking[view]));
      if (bid <= most) continue;
      most = bid;
      best = view;
    }
    return best;
  }

  const PrizeTask* task_;
  ExpectedCover cover_;
  std::vector<std::uint32_t> chosen_;  // views, in the order of choice
  Stops stops_;
};

}  // namespace

PrizeTour search_prize_tour(const PrizeTask& task, std::span<const std::uint32_t> from,
                            int iterations, std::uint64_t seed) {
  constexpr double kHot_m = 0.6;
  constexpr double kCold_m = 0.01;
  const LookTable table(task);
  OpenTour current(task, table);
  for (const std::uint32_t view : from) current.insert(view);
  current.complete(1.0, {});
  current.drop_unpaid();
  current.shorten();
  OpenTour best = current;
  double current_worth = current.worth();
  double best_worth = current_worth;
  OpenTour trial = current;
  for (int i = 0; i < iterations && !current.chosen().empty(); ++i) {
    Rng rng(seed, Stream::tour_search, i);
    trial = current;
    for (const std::uint32_t view :
         views_to_remove(trial.chosen(), task.place, trial.stops(), task.row_m, rng)) {
      trial.remove(view);
    }
    const double metres_per_view = 0.1 * std::pow(20.0, rng.uniform());
    trial.complete(metres_per_view, random_likings(task.looks.size(), rng));
    trial.drop_unpaid();
    double worth = trial.worth();
    if (worth > best_worth + kLeast) {
      trial.shorten();
      worth = trial.worth();
    }
    const double heat =
        task.price_per_m * kHot_m *
        std::pow(kCold_m / kHot_m, static_cast<double>(i) / static_cast<double>(iterations));
    if (current_worth - worth >= -heat * std::log(1.0 - rng.uniform())) continue;
    std::swap(current, trial);
    current_worth = worth;
    if (current_worth <= best_worth + kLeast) continue;
    best = current;
    best_worth = current_worth;
  }
  return best.made();
}

}  // namespace gnbv
