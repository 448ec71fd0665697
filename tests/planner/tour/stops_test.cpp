#include "planner/tour/stops.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

double random(std::uint64_t seed, std::uint64_t from, std::uint64_t to) {
  return uniform01({seed, Stream::bench, from, to});
}

/// Ways of any length, some of which lead nowhere: no metric, and not the same both ways.
struct Ways {
  explicit Ways(std::uint64_t seed, std::size_t places) : rows_m(places) {
    for (std::size_t from = 0; from < places; ++from) {
      for (std::size_t to = 0; to < places; ++to) {
        const bool leads_there = random(seed, from, to) > 0.1;
        const auto length_m =
            static_cast<float>(1.0 + std::floor(8.0 * random(seed + 1, from, to)));
        rows_m[from].push_back(leads_there ? length_m : std::numeric_limits<float>::infinity());
      }
      rows_m[from][from] = 0.0F;
    }
  }
  std::vector<std::vector<float>> rows_m;
  RowOf row_m = [this](std::uint32_t place) -> std::span<const float> { return rows_m[place]; };
};

TEST(Stops, DetoursAfterAnInsertionAreThoseFoundAnew) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Ways ways(seed, 30);
    Stops stops({0}, ways.row_m);
    stops.find_detours();
    for (std::uint32_t place = 3; place < 30; place += 4) {
      if (!std::isfinite(stops.extra_m()[place])) continue;
      stops.insert(place);
      Stops anew(stops.places(), ways.row_m);
      anew.find_detours();
      const std::vector<float> extra_m(stops.extra_m().begin(), stops.extra_m().end());
      EXPECT_EQ(extra_m, std::vector<float>(anew.extra_m().begin(), anew.extra_m().end()));
      for (std::uint32_t next = 1; next < 30; ++next) {  // and a further stop goes to one position
        if (stops.has(next) || !std::isfinite(extra_m[next])) continue;
        Stops one = stops;
        Stops other = anew;
        one.insert(next);
        other.insert(next);
        EXPECT_EQ(one.places(), other.places());
      }
    }
  }
}

TEST(Stops, ShorteningEndsWhateverTheWays) {
  for (std::uint64_t seed = 100; seed < 120; ++seed) {
    const Ways ways(seed, 12);
    std::vector<std::uint32_t> places(12);
    for (std::uint32_t i = 0; i < 12; ++i) places[i] = i;
    Stops stops(places, ways.row_m);
    stops.shorten();
    EXPECT_EQ(stops.places().front(), 0U);
    EXPECT_EQ(stops.places().size(), 12U);
  }
}

}  // namespace
}  // namespace gnbv
