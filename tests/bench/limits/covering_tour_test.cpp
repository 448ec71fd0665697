#include "bench/limits/covering_tour.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "sim/core/pose.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

double random(std::uint64_t seed, std::uint64_t frame, std::uint64_t index) {
  return uniform01({seed, Stream::bench, frame, index});
}

/// Views at places in a plane, two to a place, and what each finds: items near it.
class RandomTask {
 public:
  RandomTask(std::uint64_t seed, std::size_t views, std::size_t items)
      : finds_(made_finds(seed, views, items)), sets_(finds_, items) {
    const std::size_t places = (views + 1) / 2 + 1;
    std::vector<Vec3> p_m;
    for (std::size_t p = 0; p < places; ++p) {
      p_m.emplace_back(10.0 * random(seed, 1, p), 10.0 * random(seed, 2, p), 0.0);
    }
    for (const Vec3& from_m : p_m) {
      rows_m_.emplace_back();
      for (const Vec3& to_m : p_m) {
        rows_m_.back().push_back(static_cast<float>((to_m - from_m).norm()));
      }
    }
  }
  CoverTask task() const {
    CoverTask task{
        .views = sets_,
        .place = {},
        .start = static_cast<std::uint32_t>(rows_m_.size() - 1),
        .given = {0, 1},
        .row_m = [this](std::uint32_t place) -> std::span<const float> { return rows_m_[place]; }};
    for (std::uint32_t view = 0; view < sets_.size(); ++view) task.place.push_back(view / 2);
    return task;
  }
  const CoverSets& sets() const { return sets_; }
  std::size_t most() const { return covered((std::uint64_t{1} << sets_.size()) - 1); }

  /// What the views of a mask find, counted plainly.
  std::size_t covered(std::uint64_t mask) const {
    std::vector<bool> is_covered(sets_.items(), false);
    is_covered[0] = is_covered[1] = true;
    for (std::size_t view = 0; view < finds_.size(); ++view) {
      if ((mask >> view & 1U) == 0) continue;
      for (const std::uint32_t item : finds_[view]) is_covered[item] = true;
    }
    return static_cast<std::size_t>(std::count(is_covered.begin(), is_covered.end(), true));
  }

 private:
  using Finds = std::vector<std::vector<std::uint32_t>>;
  static Finds made_finds(std::uint64_t seed, std::size_t views, std::size_t items) {
    Finds finds(views);
    for (std::size_t view = 0; view < views; ++view) {
      for (std::uint32_t item = 0; item < items; ++item) {
        if (random(seed, 10 + view, item) < 0.3) finds[view].push_back(item);
      }
    }
    return finds;
  }
  Finds finds_;
  CoverSets sets_;
  std::vector<std::vector<float>> rows_m_;
};

std::uint64_t mask_of(std::span<const std::uint32_t> views) {
  std::uint64_t mask = 0;
  for (const std::uint32_t view : views) mask |= std::uint64_t{1} << view;
  return mask;
}

/// Of the shortest way from the start by all places of each mask, ending anywhere (Held, Karp
/// 1962).
std::vector<double> shortest_m(const CoverTask& task) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const std::uint32_t places = task.start;
  const std::size_t masks = std::size_t{1} << places;
  std::vector<std::vector<double>> to_m(masks, std::vector<double>(places, kFar));
  std::vector<double> out(masks, kFar);
  out[0] = 0.0;
  for (std::size_t mask = 1; mask < masks; ++mask) {
    for (std::uint32_t last = 0; last < places; ++last) {
      if ((mask >> last & 1U) == 0) continue;
      const std::size_t before = mask & ~(std::size_t{1} << last);
      const std::span<const float> row_m = task.row_m(last);
      if (before == 0) to_m[mask][last] = static_cast<double>(row_m[task.start]);
      for (std::uint32_t from = 0; from < places; ++from) {
        to_m[mask][last] =
            std::min(to_m[mask][last], to_m[before][from] + static_cast<double>(row_m[from]));
      }
      out[mask] = std::min(out[mask], to_m[mask][last]);
    }
  }
  return out;
}

/// Over all sets of views that find enough.
double least_cost_m(const RandomTask& random_task, const CoverAim& aim) {
  const CoverTask task = random_task.task();
  const std::vector<double> way_m = shortest_m(task);
  double best_m = std::numeric_limits<double>::infinity();
  for (std::uint64_t mask = 0; mask >> task.views.size() == 0; ++mask) {
    if (random_task.covered(mask) < aim.wanted) continue;
    std::size_t places = 0;
    for (std::size_t view = 0; view < task.views.size(); ++view) {
      if ((mask >> view & 1U) != 0) places |= std::size_t{1} << task.place[view];
    }
    best_m = std::min(best_m, way_m[places] + aim.metres_per_view * std::popcount(mask));
  }
  return best_m;
}

TEST(CoverCounts, AreThoseOfCountingAnewWhateverCameAndWent) {
  const RandomTask random_task(5, 20, 60);
  const CoverSets& sets = random_task.sets();
  CoverCounts counts(sets, std::vector<std::uint32_t>{0, 1});
  std::uint64_t mask = 0;
  for (std::uint64_t step = 0; step < 300; ++step) {
    const auto view = static_cast<std::uint32_t>(random_bits({7, Stream::bench, step, 0}) % 20);
    const std::uint64_t bit = std::uint64_t{1} << view;
    if (counts.is_chosen(view)) {
      counts.remove(view);
    } else {
      EXPECT_EQ(counts.add(view), random_task.covered(mask | bit) - random_task.covered(mask));
    }
    mask ^= bit;
    ASSERT_EQ(counts.covered(), random_task.covered(mask));
    for (std::uint32_t other = 0; other < sets.size(); ++other) {
      const std::uint64_t with = mask | std::uint64_t{1} << other;
      const std::uint64_t without = mask & ~(std::uint64_t{1} << other);
      ASSERT_EQ(counts.gains()[other], random_task.covered(with) - random_task.covered(mask));
      ASSERT_EQ(counts.alone(other), random_task.covered(mask) - random_task.covered(without));
    }
  }
}

TEST(CoveringTour, CostsWhatTheCheapestOfAllDoesForEightViews) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const RandomTask random_task(seed, 8, 24);
    const CoverTask task = random_task.task();
    for (const double metres_per_view : {0.0, 1.0, 1000.0}) {
      const CoverAim aim{random_task.most() * 9 / 10, metres_per_view};
      const CoveringTour found = cheaper_tour(task, aim, greedy_tour(task, aim), 300);
      const double least_m = least_cost_m(random_task, aim);
      EXPECT_NEAR(cost_m(found, aim), least_m, 1e-4) << seed << ", " << metres_per_view;
    }
  }
}

TEST(CoveringTour, CoversEnoughAndIsNoLongerThanTheGreedyOne) {
  double greedy_m = 0.0;
  double searched_m = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const RandomTask random_task(seed, 50, 400);
    const CoverTask task = random_task.task();
    const CoverAim aim{random_task.most() * 95 / 100, 0.0};
    const CoveringTour greedy = greedy_tour(task, {aim.wanted, 1.0});
    const CoveringTour found = cheaper_tour(task, aim, greedy, 200);
    EXPECT_GE(greedy.covered, aim.wanted);
    EXPECT_GE(found.covered, aim.wanted);
    EXPECT_EQ(found.covered, random_task.covered(mask_of(found.views)));
    EXPECT_LE(found.length_m, greedy.length_m + 1e-5);
    greedy_m += greedy.length_m;
    searched_m += found.length_m;
  }
  EXPECT_LT(searched_m, 0.95 * greedy_m);
}

TEST(CoveringTour, StopsOnceAtThePlacesOfItsViewsAndNowhereElse) {
  const RandomTask random_task(3, 40, 300);
  const CoverTask task = random_task.task();
  const CoverAim aim{random_task.most(), 0.3};
  const CoveringTour found = cheaper_tour(task, aim, greedy_tour(task, aim), 200);
  std::vector<std::uint32_t> places = {task.start};
  for (const std::uint32_t view : found.views) places.push_back(task.place[view]);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::vector<std::uint32_t> stops = found.places;
  EXPECT_EQ(stops.front(), task.start);
  double length_m = 0.0;
  for (std::size_t i = 1; i < stops.size(); ++i) {
    length_m += static_cast<double>(task.row_m(stops[i - 1])[stops[i]]);
  }
  EXPECT_DOUBLE_EQ(found.length_m, length_m);
  std::sort(stops.begin(), stops.end());
  EXPECT_EQ(stops, places);
}

TEST(CoveringTour, OfOneThatFindsTooLittleIsCompleted) {
  const RandomTask random_task(4, 40, 300);
  const CoverTask task = random_task.task();
  const CoverAim little{random_task.most() / 2, 0.3};
  const CoverAim much{random_task.most() * 98 / 100, 0.3};
  EXPECT_GE(cheaper_tour(task, much, greedy_tour(task, little), 0).covered, much.wanted);
  const CoverAim too_much{random_task.sets().items() + 1, 0.3};
  EXPECT_EQ(cheaper_tour(task, too_much, greedy_tour(task, little), 20).covered,
            random_task.most());
}

}  // namespace
}  // namespace gnbv
