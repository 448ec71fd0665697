#include "planner/tour/short_tour.hpp"

#include <algorithm>
#include <array>

#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

constexpr double kWorthwhile_m = 1e-9;  // less is rounding, and might go on for ever

using Tour = std::vector<std::size_t>;

auto at(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }

class Improver {
 public:
  Improver(const Distances& distances_m, Tour& tour) : d_(distances_m), tour_(tour) {}

  void run() {
    while (reverse_a_part() || move_a_part()) {
    }
  }

 private:
  double leg(std::size_t i, std::size_t j) const { return d_[tour_[i]][tour_[j]]; }
  /// From the stop at i to the next; nothing after the last.
  double onward(std::size_t i) const { return i + 1 < tour_.size() ? leg(i, i + 1) : 0.0; }
  double onward_to(std::size_t from, std::size_t i) const {
    return i < tour_.size() ? leg(from, i) : 0.0;
  }

  /// 2-opt: turns round stops i to j.
  bool reverse_a_part() {
    for (std::size_t i = 1; i < tour_.size(); ++i) {
      for (std::size_t j = i + 1; j < tour_.size(); ++j) {
        const double before_m = leg(i - 1, i) + onward(j);
        const double after_m = leg(i - 1, j) + onward_to(i, j + 1);
        if (before_m - after_m <= kWorthwhile_m) continue;
        std::reverse(tour_.begin() + at(i), tour_.begin() + at(j + 1));
        return true;
      }
    }
    return false;
  }

  /// Or-opt: puts stops i to i + length - 1 between two others, either way round.
  bool move_a_part() {
    for (std::size_t length = 1; length <= 3; ++length) {
      for (std::size_t i = 1; i + length <= tour_.size(); ++i) {
        const std::size_t last = i + length - 1;
        const double saved_m = leg(i - 1, i) + onward(last) - onward_to(i - 1, last + 1);
        for (std::size_t k = 0; k < tour_.size(); ++k) {  // behind stop k
          if (k + 1 >= i && k <= last) continue;
          const double gap_m = onward(k);
          const double same_m = leg(k, i) + onward_to(last, k + 1) - gap_m;
          const double turned_m = leg(k, last) + onward_to(i, k + 1) - gap_m;
          if (saved_m - std::min(same_m, turned_m) <= kWorthwhile_m) continue;
          move(i, length, k, turned_m < same_m);
          return true;
        }
      }
    }
    return false;
  }

  void move(std::size_t i, std::size_t length, std::size_t behind, bool is_turned) {
    const auto first = tour_.begin() + at(i);
    const auto end = first + at(length);
    if (is_turned) std::reverse(first, end);
    if (behind < i) {
      std::rotate(tour_.begin() + at(behind + 1), first, end);
    } else {
      std::rotate(first, end, tour_.begin() + at(behind + 1));
    }
  }

  const Distances& d_;
  Tour& tour_;
};

/// Swaps two neighbouring parts of the tour.
Tour kicked(const Tour& tour, std::uint64_t kick) {
  std::array<std::size_t, 3> cuts{};
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    const std::uint64_t bits = random_bits({0, Stream::bench, kick, c});
    cuts[c] = 1 + static_cast<std::size_t>(bits % tour.size());
  }
  std::sort(cuts.begin(), cuts.end());
  Tour other = tour;
  std::rotate(other.begin() + at(cuts[0]), other.begin() + at(cuts[1]),
              other.begin() + at(cuts[2]));
  return other;
}

}  // namespace

double tour_length_m(const Distances& distances_m, const Tour& tour) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < tour.size(); ++i) length_m += distances_m[tour[i - 1]][tour[i]];
  return length_m;
}

void improve_tour(const Distances& distances_m, Tour& tour) { Improver(distances_m, tour).run(); }

void improve_tour_with_kicks(const Distances& distances_m, Tour& tour, int kicks) {
  improve_tour(distances_m, tour);
  if (tour.size() < 4) return;  // the first of them stays: two others are both ways round alike
  double length_m = tour_length_m(distances_m, tour);
  for (int kick = 0; kick < kicks; ++kick) {
    Tour other = kicked(tour, static_cast<std::uint64_t>(kick));
    improve_tour(distances_m, other);
    const double other_m = tour_length_m(distances_m, other);
    if (length_m - other_m <= kWorthwhile_m) continue;
    tour = std::move(other);
    length_m = other_m;
  }
}

}  // namespace gnbv
