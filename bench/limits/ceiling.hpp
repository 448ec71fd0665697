// The most that any legal viewpoint of a scenario can see, whatever planner chooses it, and the
// profile with it. Of exact sensors: noise can lift a mission above it.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>

#include "scenarios/scenario.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {

/// Shares of the reference voxels, by kCoverageSizes_m. No leaf share is above its like of what is
/// seen.
struct Ceiling {
  std::array<double, 3> raw{};           // of all surface: what is seen (seen_surface.hpp)
  std::array<double, 3> outside{};       // of the surface seen from outside
  std::array<double, 3> leaf_raw{};      // what of it a cloud can hold after its leaf filter
  std::array<double, 3> leaf_outside{};  // "share of the ceiling" divides by this
  std::size_t positions = 0;             // legal lattice positions that are reachable
  bool is_given = false;                 // leaf_outside[0] alone is known: somebody's yardstick
};

/// Cached by the content of everything it depends on (content_cache.hpp). Deterministic at any
/// number of threads. `start` is where the views begin: positions that no collision-free way leads
/// to from there are not legal.
Ceiling find_ceiling(const Scenario& scenario, const World& world, const RayScene& scene,
                     const ViewPose& start, int threads,
                     const std::function<void(double share_done)>& on_progress = {});

/// The same when the cache has it; nothing otherwise. Costs the search for legal viewpoints, unless
/// no ceiling at all is cached.
std::optional<Ceiling> known_ceiling(const Scenario& scenario, const World& world,
                                     const RayScene& scene, const ViewPose& start, int threads);

}  // namespace gnbv
