// The most that any legal viewpoint of a scenario can see, whatever planner chooses it, and the
// profile with it. Of exact sensors: noise can lift a mission above it.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "bench/limits/legal_viewpoints.hpp"
#include "bench/score/surface_reference.hpp"
#include "scenarios/scenario.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {

/// What of the structure the scenario scores, and what coverage counts.
ReferenceConfig reference_config(const Scenario& scenario);

/// Shares of the reference voxels, by kCoverageSizes_m. No leaf share is above its like of what is
/// seen.
struct Ceiling {
  std::array<double, 3> raw{};           // of all surface: what is seen (seen_surface.hpp)
  std::array<double, 3> counted{};       // of what coverage counts
  std::array<double, 3> leaf_raw{};      // what of it a cloud can hold after its leaf filter
  std::array<double, 3> leaf_counted{};  // "share of the ceiling" divides by this
  std::size_t area_samples = 0;          // of the reference
  std::size_t positions = 0;             // legal lattice positions that are reachable
  bool is_given = false;                 // leaf_counted[0] alone is known: somebody's yardstick
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

/// A scenario with all that ceiling and survey depend on - structure, surroundings and ground,
/// reference and region, no_fly boxes, cameras and LIDARs (without their noise), profile and the
/// start it is flown from, workspace and voxels, floor, leaf, collision radius, navigation box -
/// and the defaults elsewhere: scenarios of which this is the same have one ceiling.
Scenario what_a_ceiling_depends_on(const Scenario& scenario);

/// SHA-256 over the same, with the meshes in the place of their names, and the legal positions with
/// their cells in that of the seed.
std::string ceiling_key(const Scenario& scenario, const World& world, const LegalViewpoints& legal);

/// A ceiling as people and programs read it; it took `wall_s` to find.
std::string ceiling_text(const Ceiling& ceiling, double wall_s);
std::string ceiling_json(const Scenario& scenario, const Ceiling& ceiling, double wall_s);

}  // namespace gnbv
