#include "bench/limits/legal_viewpoints.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

constexpr double kFinest_m = 0.01;  // half a piece of a leg that is not halved any more
constexpr double kMostSteps = 1e6;  // along an axis
constexpr std::uint32_t kNone = 0xffffffffU;

/// The whole lattice of the box, and what is known of each of its nodes.
class Lattice {
 public:
  Lattice(const Box3& box_m, double step_m) : corner_m_(box_m.min()), step_m_(step_m) {
    constexpr double kRounding = 1e-9;
    for (std::size_t a = 0; a < 3; ++a) {
      const double steps = box_m.sizes()[static_cast<Eigen::Index>(a)] / step_m;
      GNBV_CHECK(steps >= 0.0 && steps < kMostSteps, "{} steps of {} m", steps, step_m);
      size_[a] = static_cast<std::int32_t>(std::floor(steps + kRounding)) + 1;
    }
  }

  std::size_t size() const {
    return static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) *
           static_cast<std::size_t>(size_[2]);
  }
  std::array<std::int32_t, 3> cell(std::size_t node) const {
    const auto x = static_cast<std::size_t>(size_[0]);
    const auto y = static_cast<std::size_t>(size_[1]);
    return {static_cast<std::int32_t>(node % x), static_cast<std::int32_t>(node / x % y),
            static_cast<std::int32_t>(node / x / y)};
  }
  Vec3 p_world_m(std::size_t node) const {
    const auto c = cell(node);
    return corner_m_ + step_m_ * Vec3(c[0], c[1], c[2]);
  }
  /// Calls use(neighbour) for each of up to 26 in ascending order.
  template <typename Use>
  void for_each_neighbour(std::size_t node, const Use& use) const {
    const auto c = cell(node);
    for (std::int32_t dz = -1; dz <= 1; ++dz) {
      for (std::int32_t dy = -1; dy <= 1; ++dy) {
        for (std::int32_t dx = -1; dx <= 1; ++dx) {
          const std::array<std::int32_t, 3> n = {c[0] + dx, c[1] + dy, c[2] + dz};
          if (n == c || !contains(n)) continue;
          use((static_cast<std::size_t>(n[2]) * static_cast<std::size_t>(size_[1]) +
               static_cast<std::size_t>(n[1])) *
                  static_cast<std::size_t>(size_[0]) +
              static_cast<std::size_t>(n[0]));
        }
      }
    }
  }

 private:
  bool contains(const std::array<std::int32_t, 3>& c) const {
    for (std::size_t a = 0; a < 3; ++a) {
      if (c[a] < 0 || c[a] >= size_[a]) return false;
    }
    return true;
  }
  Vec3 corner_m_;
  double step_m_;
  std::array<std::int32_t, 3> size_{};
};

}  // namespace

bool is_leg_clear(const RayScene& scene, const Vec3& a_world_m, const Vec3& b_world_m,
                  double radius_m) {
  const Vec3 middle_m = 0.5 * (a_world_m + b_world_m);
  const double half_m = 0.5 * (b_world_m - a_world_m).norm();
  const double clear_m = scene.clearance_m(middle_m, radius_m + half_m);
  if (clear_m - half_m >= radius_m) return true;
  if (clear_m < radius_m || half_m <= kFinest_m) return false;
  return is_leg_clear(scene, a_world_m, middle_m, radius_m) &&
         is_leg_clear(scene, middle_m, b_world_m, radius_m);
}

double lattice_step_m(const Box3& navigation_m) {
  constexpr double kFew = 15000.0;
  constexpr double kMany = 1e6;  // half a GB with their legs while they are searched
  constexpr double kUsual_m = 1.0;
  const double volume_m3 = navigation_m.volume();
  return std::max(std::min(kUsual_m, std::cbrt(volume_m3 / kFew)), std::cbrt(volume_m3 / kMany));
}

LegalViewpoints find_legal_viewpoints(const RayScene& scene, const Box3& navigation_m,
                                      double radius_m, double step_m, const Vec3& start_world_m,
                                      int threads, const NoFly& no_fly, const HeedStop& stop) {
  GNBV_CHECK(step_m > 0.0, "a lattice step of {} m", step_m);
  const Lattice lattice(navigation_m, step_m);
  const auto for_each_node = [&](const auto& task) {
    constexpr std::size_t kChunk = 256;
    parallel_for_chunks(threads, lattice.size(), kChunk, [&](std::size_t begin, std::size_t end) {
      heed(stop);
      for (std::size_t node = begin; node < end; ++node) task(node);
    });
  };
  std::vector<double> clear_m(lattice.size());
  const double far_m = radius_m + std::sqrt(3.0) * step_m;
  for_each_node([&](std::size_t node) {
    const Vec3 p_m = lattice.p_world_m(node);
    clear_m[node] = no_fly.allows(p_m) ? scene.clearance_m(p_m, far_m) : 0.0;
  });
  std::vector<std::vector<std::size_t>> legs(lattice.size());
  for_each_node([&](std::size_t node) {
    if (clear_m[node] < radius_m) return;
    lattice.for_each_neighbour(node, [&](std::size_t other) {
      if (clear_m[other] < radius_m) return;
      // from the lower end, so that both directions get one answer
      const Vec3 p_m = lattice.p_world_m(std::min(node, other));
      const Vec3 q_m = lattice.p_world_m(std::max(node, other));
      if (!no_fly.allows_leg(p_m, q_m)) return;
      const double length_m = (q_m - p_m).norm();
      const bool is_far_off = clear_m[node] + clear_m[other] >= 2.0 * radius_m + length_m;
      if (is_far_off || is_leg_clear(scene, p_m, q_m, radius_m)) legs[node].push_back(other);
    });
  });

  std::vector<std::size_t> open;  // from here on: connected to the start
  std::vector<std::uint32_t> index(lattice.size(), kNone);
  for (std::size_t node = 0; node < lattice.size(); ++node) {
    const Vec3 p_m = lattice.p_world_m(node);
    if (clear_m[node] < radius_m || (p_m - start_world_m).norm() > 2.0 * step_m) continue;
    if (no_fly.allows_leg(start_world_m, p_m) &&
        is_leg_clear(scene, start_world_m, p_m, radius_m)) {
      open.push_back(node);
    }
  }
  const std::vector<std::size_t> near_start = open;
  std::vector<bool> is_reached(lattice.size(), false);
  for (const std::size_t node : open) is_reached[node] = true;
  while (!open.empty()) {
    const std::size_t node = open.back();
    open.pop_back();
    for (const std::size_t other : legs[node]) {
      if (is_reached[other]) continue;
      is_reached[other] = true;
      open.push_back(other);
    }
  }

  LegalViewpoints legal{.step_m = step_m, .start_world_m = start_world_m, .no_fly = no_fly};
  for (std::size_t node = 0; node < lattice.size(); ++node) {
    if (!is_reached[node]) continue;
    index[node] = static_cast<std::uint32_t>(legal.p_world_m.size());
    legal.p_world_m.push_back(lattice.p_world_m(node));
    legal.cell.push_back(lattice.cell(node));
  }
  for (std::size_t node = 0; node < lattice.size(); ++node) {
    if (!is_reached[node]) continue;
    auto& neighbours = legal.neighbours.emplace_back();
    for (const std::size_t other : legs[node]) neighbours.push_back(index[other]);
  }
  for (const std::size_t node : near_start) legal.near_start.push_back(index[node]);
  return legal;
}

LegalViewpoints find_legal_viewpoints(const Scenario& scenario, const RayScene& scene,
                                      const ViewPose& start, int threads, const HeedStop& stop) {
  const ValidityConfig& validity = scenario.planner.validity;
  const Box3 navigation_m = navigation_box_m(validity, scenario.workspace_m);
  return find_legal_viewpoints(scene, navigation_m, validity.collision_radius_m,
                               lattice_step_m(navigation_m), start.p_world_m, threads,
                               no_fly_of(scenario), stop);
}

}  // namespace gnbv
