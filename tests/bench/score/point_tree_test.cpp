#include "bench/score/point_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "bench/score/escape_search.hpp"

namespace gnbv {
namespace {

TEST(PointTree, FindsWhatASearchOfAllFindsNearestFirst) {
  const std::vector<Vec3f> points = spread_directions(500);
  const PointTree tree(points);
  for (const Vec3f& query : {Vec3f(0, 0, 0.9F), Vec3f(2, 1, 0), Vec3f(-0.3F, 0.2F, 0.1F)}) {
    std::array<Neighbour, 7> found{};
    ASSERT_EQ(tree.nearest(query, found).size(), found.size());
    std::vector<float> all_m;
    for (const Vec3f& p : points) all_m.push_back((p - query).norm());
    std::sort(all_m.begin(), all_m.end());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i].distance_m, all_m[i], 1e-6F);
      EXPECT_NEAR((points[found[i].point] - query).norm(), all_m[i], 1e-6F);
    }
  }
  std::array<Neighbour, 3> found{};
  EXPECT_EQ(PointTree(std::span(points).first(2)).nearest(Vec3f::Zero(), found).size(), 2U);
}

TEST(PointTree, WithABoundItFindsWhatLiesNearerAndNothingElse) {
  const std::vector<Vec3f> points = {Vec3f(1, 0, 0), Vec3f(0, 2, 0), Vec3f(0, 0, 3)};
  const PointTree tree(points);
  std::array<Neighbour, 3> found{};
  const auto count_below = [&](float below_m) {
    return tree.nearest(Vec3f::Zero(), found, below_m).size();
  };
  EXPECT_EQ(count_below(0.5F), 0U);
  EXPECT_EQ(count_below(1.0F), 0U) << "nearer, not as near";
  EXPECT_EQ(count_below(2.5F), 2U);
  EXPECT_EQ(found[1].point, 1U);
  EXPECT_EQ(count_below(100.0F), 3U);
}

TEST(PointTree, OfPointsEquallyFarItFindsTheFirstOnes) {
  std::vector<Vec3f> grid;
  for (int i = 0; i < 1000; ++i) {  // the lower index is not always the one the tree meets first
    const int j = (i * 387) % 1000;
    grid.emplace_back(j % 10, j / 10 % 10, j / 100);
  }
  const PointTree tree(grid);
  for (std::uint32_t i = 0; i < grid.size(); i += 7) {
    const Vec3f query = grid[i] + Vec3f(i % 2 == 0 ? 0.0F : 0.5F, 0.0F, 0.0F);
    std::array<Neighbour, 9> found{};
    ASSERT_EQ(tree.nearest(query, found).size(), found.size());
    std::vector<std::pair<float, std::uint32_t>> all;
    for (std::uint32_t k = 0; k < grid.size(); ++k) {
      all.emplace_back((grid[k] - query).squaredNorm(), k);
    }
    std::sort(all.begin(), all.end());
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(found[k].point, all[k].second) << i;
  }
}

}  // namespace
}  // namespace gnbv
