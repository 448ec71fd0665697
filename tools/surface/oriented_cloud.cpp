#include "tools/surface/oriented_cloud.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <queue>
#include <tuple>

#include "bench/score/point_tree.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kNeighbours = 16;
constexpr float kSureCosine = 0.15F;  // below it, a normal is nearly square to the line of sight

struct Normal {
  Vec3f unit = Vec3f::Zero();  // zero: none
  float spacing_m = 0.0F;
  float cosine = 0.0F;  // to the line of sight
};

/// Of a plane with n points in a circle of radius r around one of them, r sqrt(pi / n) apart.
float spacing_of(std::span<const Neighbour> found) {
  const auto n = static_cast<float>(found.size());
  return found.back().distance_m * std::sqrt(static_cast<float>(kPi) / n);
}

/// Those of the neighbours that were seen from the same side as the point itself: the other face of
/// a thin wing has a normal of its own. All of them where too few are.
std::size_t keep_same_side(const SeenPoints& seen, std::size_t point, std::span<Neighbour> found) {
  constexpr std::ptrdiff_t kFewest = 6;
  const auto to_sensor = [&](std::size_t i) {
    return Vec3f(seen.sensors_world_m[i] - seen.points_world_m[i]);
  };
  const Vec3f own = to_sensor(point);
  const auto end = std::stable_partition(found.begin(), found.end(), [&](const Neighbour& other) {
    return own.dot(to_sensor(other.point)) > 0.0F;
  });
  const std::ptrdiff_t kept = end - found.begin();
  return kept >= kFewest ? static_cast<std::size_t>(kept) : found.size();
}

Normal normal_at(std::span<const Vec3f> points_m, std::span<const Neighbour> found) {
  Normal normal;
  if (found.size() < 3) return normal;
  Vec3f mean_m = Vec3f::Zero();
  for (const Neighbour& neighbour : found) mean_m += points_m[neighbour.point];
  mean_m /= static_cast<float>(found.size());
  Eigen::Matrix3f covariance_m2 = Eigen::Matrix3f::Zero();
  for (const Neighbour& neighbour : found) {
    const Vec3f d_m = points_m[neighbour.point] - mean_m;
    covariance_m2 += d_m * d_m.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
  solver.computeDirect(covariance_m2);
  const Vec3f& spread_m2 = solver.eigenvalues();              // ascending
  if (!(spread_m2[1] > 1e-4F * spread_m2[2])) return normal;  // one line has no normal
  normal.unit = solver.eigenvectors().col(0);
  return normal;
}

/// Turns a normal that is nearly square to its line of sight to the side of its sure neighbours.
Vec3f settled(const std::vector<Normal>& normals, std::size_t point,
              std::span<const Neighbour> found) {
  const Normal& own = normals[point];
  float votes = 0.0F;
  for (const Neighbour& neighbour : found) {
    const Normal& other = normals[neighbour.point];
    if (other.cosine >= kSureCosine) votes += other.cosine * own.unit.dot(other.unit);
  }
  return votes < 0.0F ? Vec3f(-own.unit) : own.unit;
}

/// Turns normals over until neighbours agree, as a minimum spanning tree of their turning leads
/// from the highest point of each part.
void agree(std::span<const Vec3f> points_m,
           std::span<const std::array<Neighbour, kNeighbours>> near, std::vector<Normal>& normals) {
  struct Step {
    float turning;
    std::uint32_t from, to;
    auto key() const { return std::tuple(turning, to, from); }
    bool operator<(const Step& other) const { return key() > other.key(); }  // the least on top
  };
  std::vector<std::uint32_t> by_height(points_m.size());
  std::iota(by_height.begin(), by_height.end(), 0U);
  std::sort(by_height.begin(), by_height.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(-points_m[a].z(), a) < std::pair(-points_m[b].z(), b);
  });
  std::vector<std::uint8_t> is_done(points_m.size());
  std::priority_queue<Step> open;
  const auto take = [&](std::uint32_t i) {
    is_done[i] = 1;
    for (const Neighbour& n : near[i]) {
      if (is_done[n.point] != 0 || normals[n.point].unit.isZero()) continue;
      open.push({1.0F - std::abs(normals[i].unit.dot(normals[n.point].unit)), i, n.point});
    }
  };
  for (const std::uint32_t seed : by_height) {
    if (is_done[seed] != 0 || normals[seed].unit.isZero()) continue;
    if (normals[seed].unit.z() < 0.0F) normals[seed].unit *= -1.0F;
    take(seed);
    for (; !open.empty();) {
      const Step step = open.top();
      open.pop();
      if (is_done[step.to] != 0) continue;
      Vec3f& unit = normals[step.to].unit;
      if (unit.dot(normals[step.from].unit) < 0.0F) unit *= -1.0F;
      take(step.to);
    }
  }
}

OrientedCloud with_normals(std::span<const Vec3f> points_m, const std::vector<Normal>& normals) {
  OrientedCloud cloud;
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    if (normals[i].unit.isZero()) continue;
    cloud.points_world_m.push_back(points_m[i]);
    cloud.normals_world.push_back(normals[i].unit);
    cloud.spacing_m.push_back(normals[i].spacing_m);
  }
  return cloud;
}

}  // namespace

OrientedCloud oriented_by_neighbours(std::span<const Vec3f> points_m, int threads) {
  if (points_m.size() < kNeighbours) return {};
  const PointTree tree(points_m);
  std::vector<Normal> normals(points_m.size());
  std::vector<std::array<Neighbour, kNeighbours>> near(points_m.size());
  for_each_point(threads, points_m.size(), [&](std::size_t i) {
    const auto found = tree.nearest(points_m[i], near[i]);
    normals[i] = normal_at(points_m, found);
    normals[i].spacing_m = spacing_of(found);
  });
  agree(points_m, near, normals);
  return with_normals(points_m, normals);
}

OrientedCloud oriented(const SeenPoints& seen, int threads) {
  const std::span<const Vec3f> points_m = seen.points_world_m;
  GNBV_CHECK(points_m.size() == seen.sensors_world_m.size(), "{} points, {} sensors",
             points_m.size(), seen.sensors_world_m.size());
  const PointTree tree(points_m);
  std::vector<Normal> normals(points_m.size());
  for_each_point(threads, points_m.size(), [&](std::size_t i) {
    std::array<Neighbour, kNeighbours> neighbours{};
    const std::size_t count = tree.nearest(points_m[i], neighbours).size();
    const std::span<Neighbour> found = std::span(neighbours).first(count);
    const float spacing_m = spacing_of(found);
    Normal normal = normal_at(points_m, found.first(keep_same_side(seen, i, found)));
    normal.spacing_m = spacing_m;
    const Vec3f to_sensor = (seen.sensors_world_m[i] - points_m[i]).normalized();
    normal.cosine = normal.unit.dot(to_sensor);
    if (normal.cosine < 0.0F) {
      normal.unit = -normal.unit;
      normal.cosine = -normal.cosine;
    }
    normals[i] = normal;
  });

  std::vector<Normal> settled_normals = normals;
  for_each_point(threads, points_m.size(), [&](std::size_t i) {
    if (normals[i].unit.isZero() || normals[i].cosine >= kSureCosine) return;
    std::array<Neighbour, kNeighbours> neighbours{};
    settled_normals[i].unit = settled(normals, i, tree.nearest(points_m[i], neighbours));
  });
  return with_normals(points_m, settled_normals);
}

}  // namespace gnbv
