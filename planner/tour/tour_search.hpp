// Large-neighbourhood search over tours (Shaw 1998; Ropke, Pisinger 2006), whatever a tour costs.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>

#include "planner/tour/waypoints.hpp"

namespace gnbv {

/// A view that brings this share of its cost may be put in: the search may find it a neighbour.
constexpr double kTolerance = 0.7;

/// How a search is cooled, in units of what its tours cost: metres or seconds.
struct Cooling {
  double hot = 0.6;
  double cold = 0.01;
  double price = 0.0;  // of a unit, in what a tour is worth
};

/// The best tour met from `current` on. Each iteration takes views out, puts others in by what they
/// bring for their detour at a random price of a view, drops those that do not pay, and accepts the
/// result as annealing does. Deterministic by the seed. A Tour is copied; it has chosen(), worth(),
/// remove_some(), complete(), drop_unpaid() and shorten().
template <typename Tour>
Tour search(Tour current, std::size_t views, int iterations, const Cooling& cooling,
            std::uint64_t seed) {
  constexpr double kLeast = 1e-6;  // less is rounding
  Tour best = current;
  double current_worth = current.worth();
  double best_worth = current_worth;
  Tour trial = current;
  for (int i = 0; i < iterations && !current.chosen().empty(); ++i) {
    Rng rng(seed, Stream::tour_search, i);
    trial = current;
    trial.remove_some(rng);
    const double price_of_view = 0.1 * std::pow(20.0, rng.uniform());
    trial.complete(price_of_view, perturbation_weights(views, rng));
    trial.drop_unpaid();
    double worth = trial.worth();
    if (worth > best_worth + kLeast) {
      trial.shorten();
      worth = trial.worth();
    }
    const double heat = cooling.price * cooling.hot *
                        std::pow(cooling.cold / cooling.hot, i / static_cast<double>(iterations));
    if (current_worth - worth >= -heat * std::log(1.0 - rng.uniform())) continue;
    std::swap(current, trial);
    current_worth = worth;
    if (current_worth <= best_worth + kLeast) continue;
    best = current;
    best_worth = current_worth;
  }
  return best;
}

}  // namespace gnbv
