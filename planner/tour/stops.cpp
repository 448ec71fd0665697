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

void Stops::find_rows() {
  rows_m_.clear();
  for (const std::uint32_t place : places_) rows_m_.push_back((*row_m_)(place).data());
}

void Stops::find_detours() {
  find_rows();
  const std::size_t places = (*row_m_)(places_.back()).size();
  least_m_.assign(rows_m_.back(), rows_m_.back() + places);
  at_.assign(places, static_cast<std::int32_t>(places_.size()));
  float* const least_m = least_m_.data();
  std::int32_t* const at = at_.data();
  for (std::size_t i = 1; i < places_.size(); ++i) {
    const float leg_m = known_leg_m(i);
    const float* const from_m = rows_m_[i - 1];
    const float* const to_m = rows_m_[i];
    for (std::size_t p = 0; p < places; ++p) {
      const float extra = from_m[p] + to_m[p] - leg_m;
      at[p] = extra < least_m[p] ? static_cast<std::int32_t>(i) : at[p];
      least_m[p] = std::min(extra, least_m[p]);
    }
  }
  extra_m_.resize(places);
  for (std::size_t p = 0; p < places; ++p) give_extra(p);
  for (const std::uint32_t place : places_) extra_m_[place] = 0.0F;
}

/// Of one place, as find_detours() does of all.
void Stops::find_detour(std::size_t place) {
  least_m_[place] = rows_m_.back()[place];
  at_[place] = static_cast<std::int32_t>(places_.size());
  for (std::size_t i = 1; i < places_.size(); ++i) {
    const float extra = detour_m(i, place, known_leg_m(i));
    if (extra >= least_m_[place]) continue;
    least_m_[place] = extra;
    at_[place] = static_cast<std::int32_t>(i);
  }
}

/// Where the leg that the new stop breaks was the best, all are asked again; elsewhere the two that
/// it makes.
void Stops::insert(std::uint32_t place) {
  const std::int32_t broken = at_[place];
  places_.insert(places_.begin() + broken, place);
  find_rows();
  const auto end = static_cast<std::int32_t>(places_.size());
  for (std::size_t p = 0; p < least_m_.size(); ++p) {
    if (at_[p] == broken) {
      find_detour(p);
    } else {
      if (at_[p] > broken) ++at_[p];
      for (std::int32_t i = broken; i <= std::min(broken + 1, end - 1); ++i) {
        const auto stop = static_cast<std::size_t>(i);
        const float extra = detour_m(stop, p, known_leg_m(stop));
        const bool is_first_of_equals = extra == least_m_[p] && at_[p] != end && i < at_[p];
        if (extra >= least_m_[p] && !is_first_of_equals) continue;
        least_m_[p] = extra;
        at_[p] = i;
      }
      if (broken + 1 == end && rows_m_.back()[p] <= least_m_[p]) {  // behind the new stop
        least_m_[p] = rows_m_.back()[p];
        at_[p] = end;
      }
    }
    give_extra(p);
  }
  for (const std::uint32_t stop : places_) extra_m_[stop] = 0.0F;
}

/// The improvement needs ways that are as long both ways round, and that lead somewhere.
void Stops::shorten(int kicks) {
  constexpr float kNoWay_m = 1e6F;
  find_rows();
  Distances distance_m(places_.size(), std::vector<double>(places_.size()));
  for (std::size_t i = 0; i < places_.size(); ++i) {
    for (std::size_t j = 0; j < places_.size(); ++j) {
      const float way_m = std::min(rows_m_[i][places_[j]], rows_m_[j][places_[i]]);
      distance_m[i][j] = static_cast<double>(std::min(way_m, kNoWay_m));
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
