#include "planner/tour/stops.hpp"

#include <algorithm>
#include <numeric>

#include "planner/tour/short_tour.hpp"

namespace gnbv {

std::size_t Stops::index_of(std::uint32_t place) const {
  return static_cast<std::size_t>(std::find(places_.begin(), places_.end(), place) -
                                  places_.begin());
}

bool Stops::has(std::uint32_t place) const { return index_of(place) < places_.size(); }

double Stops::length_m() const {
  double length_m = 0.0;
  for (std::size_t i = 1; i < places_.size(); ++i) length_m += leg_m(places_[i - 1], places_[i]);
  return length_m;
}

double Stops::saved_without_m(std::uint32_t place) const {
  const std::size_t at = index_of(place);
  const double to_m = leg_m(places_[at - 1], place);
  if (at + 1 == places_.size()) return to_m;
  return to_m + leg_m(place, places_[at + 1]) - leg_m(places_[at - 1], places_[at + 1]);
}

void Stops::remove(std::uint32_t place) {
  places_.erase(places_.begin() + static_cast<std::ptrdiff_t>(index_of(place)));
}

void Stops::find_detours() {
  const std::span<const float> last_m = (*row_m_)(places_.back());
  extra_m_.assign(last_m.begin(), last_m.end());
  at_.assign(last_m.size(), static_cast<std::int32_t>(places_.size()));
  float* const extra_m = extra_m_.data();
  std::int32_t* const at = at_.data();
  for (std::size_t i = 1; i < places_.size(); ++i) {
    const std::span<const float> from_m = (*row_m_)(places_[i - 1]);
    const std::span<const float> to_m = (*row_m_)(places_[i]);
    const float leg = from_m[places_[i]];
    for (std::size_t p = 0; p < from_m.size(); ++p) {
      const float extra = from_m[p] + to_m[p] - leg;
      at[p] = extra < extra_m[p] ? static_cast<std::int32_t>(i) : at[p];
      extra_m[p] = std::min(extra, extra_m[p]);
    }
  }
  for (float& extra : extra_m_) extra = std::max(extra, 0.0F);
  for (const std::uint32_t place : places_) extra_m_[place] = 0.0F;
}

void Stops::insert(std::uint32_t place) {
  places_.insert(places_.begin() + at_[place], place);
  find_detours();
}

void Stops::shorten(int kicks) {
  Distances distance_m(places_.size(), std::vector<double>(places_.size()));
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const std::span<const float> row_m = (*row_m_)(places_[i]);
    for (std::size_t j = 0; j < places_.size(); ++j) {
      distance_m[i][j] = static_cast<double>(row_m[places_[j]]);
    }
  }
  std::vector<std::size_t> order(places_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  improve_tour_with_kicks(distance_m, order, kicks);
  std::vector<std::uint32_t> places;
  for (const std::size_t stop : order) places.push_back(places_[stop]);
  places_ = std::move(places);
}

}  // namespace gnbv
