// The stops of an open tour while a search changes it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace gnbv {

/// Metres from this place to each place, the same both ways; infinite where no way leads.
using RowOf = std::function<std::span<const float>(std::uint32_t place)>;

/// Places in the order of the tour, each once, and what a further one would add. Copied, it is a
/// state to return to.
class Stops {
 public:
  /// Begins with these, the start first. Keeps a reference to the rows.
  Stops(std::vector<std::uint32_t> places, const RowOf& row_m)
      : row_m_(&row_m), places_(std::move(places)) {}

  Stops(std::vector<std::uint32_t> places, RowOf&& row_m) = delete;  // it would not live on

  const std::vector<std::uint32_t>& places() const { return places_; }
  /// Which of the tour it is; requires that it is one.
  std::size_t index_of(std::uint32_t place) const;
  bool has(std::uint32_t place) const;
  double length_m() const;
  /// What the tour would be shorter without this stop, which is not the first.
  double saved_without_m(std::uint32_t place) const;
  void remove(std::uint32_t place);

  /// What a stop at each place would add at the cheapest position: 0 where there is one. As of the
  /// last find_detours().
  std::span<const float> extra_m() const { return extra_m_; }
  void find_detours();
  /// At the cheapest position as of the last find_detours(), and finds the detours of now.
  void insert(std::uint32_t place);

  /// 2-opt and Or-opt, with `kicks` in between (short_tour.hpp).
  void shorten(int kicks = 0);

 private:
  double leg_m(std::uint32_t from, std::uint32_t to) const {
    return static_cast<double>((*row_m_)(from)[to]);
  }

  /// From the stop before to this one; 0 where no way leads.
  float known_leg_m(std::size_t stop) const {
    const float leg_m = rows_m_[stop - 1][places_[stop]];
    return std::isfinite(leg_m) ? leg_m : 0.0F;
  }
  float detour_m(std::size_t stop, std::size_t place, float known_leg_m) const {
    return rows_m_[stop - 1][place] + rows_m_[stop][place] - known_leg_m;
  }
  void find_rows();
  void find_detour(std::size_t place);
  void give_extra(std::size_t place) { extra_m_[place] = std::max(least_m_[place], 0.0F); }

  const RowOf* row_m_;
  std::vector<std::uint32_t> places_;
  std::vector<const float*> rows_m_;  // of each stop
  std::vector<float> least_m_;    // of each place, less than nothing where ways are not shortest
  std::vector<float> extra_m_;    // the same, but never less than nothing
  std::vector<std::int32_t> at_;  // of each place: where among the stops it would come
};

}  // namespace gnbv
