// The stops of an open tour while a search changes it.
#pragma once

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
  /// At the cheapest position of the last find_detours(), which it calls again.
  void insert(std::uint32_t place);

  /// 2-opt and Or-opt, with `kicks` in between (short_tour.hpp).
  void shorten(int kicks = 0);

 private:
  double leg_m(std::uint32_t from, std::uint32_t to) const {
    return static_cast<double>((*row_m_)(from)[to]);
  }

  const RowOf* row_m_;
  std::vector<std::uint32_t> places_;
  std::vector<float> extra_m_;    // of each place
  std::vector<std::int32_t> at_;  // of each place: where among the stops it would come
};

}  // namespace gnbv
