// Where a vehicle of the scenario may take views from: the room that every planner has.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planner/motion/config.hpp"
#include "scenarios/scenario.hpp"
#include "sensors/ray_scene.hpp"

namespace gnbv {

/// Whether every point of the straight leg keeps `radius_m` from the structure and what else is in
/// the way (RayScene::clearance_m()). The distance to it
/// changes by at most a metre a metre, so a clear middle clears its surroundings; halves that this
/// does not decide are asked again, down to 1 cm. What is then still open counts as not clear: a
/// true answer is certain, a false one may be 1 cm too strict.
bool is_leg_clear(const RayScene& scene, const Vec3& a_world_m, const Vec3& b_world_m,
                  double radius_m);

/// Step of the lattice of positions: 1 m, but less in a navigation box of less than 15,000 m3, so
/// that a small room has about 15,000 positions, too, and more in one of more than a million.
double lattice_step_m(const Box3& navigation_m);

/// A regular lattice from the lowest corner of the navigation box up, without the positions that
/// are nearer to the structure, an obstacle or a no_fly box than the collision radius, and without
/// those that no clear way leads to. Ordered by z, then y, then x.
struct LegalViewpoints {
  double step_m = 0.0;
  Vec3 start_world_m = Vec3::Zero();
  std::vector<Vec3> p_world_m = {};
  std::vector<std::array<std::int32_t, 3>> cell = {};  // steps from the corner, of each position
  std::vector<std::vector<std::uint32_t>> neighbours =
      {};                                      // of each: where clear straight legs lead
  std::vector<std::uint32_t> near_start = {};  // where clear legs from the start lead
  NoFly no_fly = {};                           // that was kept clear of, too

  std::size_t size() const { return p_world_m.size(); }
};

/// The legal positions that are connected to `start` by clear straight legs between neighbours (26
/// to a position); from the start itself legs of up to two steps count. Empty when there are none.
/// The same at any number of threads. `stop` is called several times a second, by any thread,
/// and may throw.
LegalViewpoints find_legal_viewpoints(const RayScene& scene, const Box3& navigation_m,
                                      double radius_m, double step_m, const Vec3& start_world_m,
                                      int threads, const NoFly& no_fly = {},
                                      const HeedStop& stop = {});

/// Those of a scenario: its navigation box, its collision radius, its no_fly boxes,
/// lattice_step_m().
LegalViewpoints find_legal_viewpoints(const Scenario& scenario, const RayScene& scene,
                                      const ViewPose& start, int threads,
                                      const HeedStop& stop = {});

}  // namespace gnbv
