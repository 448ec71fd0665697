// Which of the true surface any legal viewpoint sees, and what a cloud can keep of it.
#pragma once

#include <functional>
#include <vector>

#include "bench/limits/legal_viewpoints.hpp"
#include "bench/score/surface_reference.hpp"
#include "scenarios/scenario.hpp"

namespace gnbv {

struct SeenSurface {
  /// The finest voxels of which some sample is seen, one that lies in the voxel or, for those of
  /// the reference, one that covers it (covered_by()): by one of the cameras at some yaw from a
  /// legal viewpoint (sight_search.hpp), or by a LIDAR on the profile's way (lidar_sight.hpp), with
  /// nothing of the structure in between. A lower bound that is near: where the lattice of
  /// positions shows nothing, places between them are looked for.
  VoxelSet voxels;
  /// One point for each of these voxels, where the cloud's leaf filter may put it: so that it
  /// covers the voxel if some sample that is seen is in a leaf that lies in the voxel, or in one of
  /// which the voxel has a quarter of the surface; else in the leaf's neighbouring voxel. So a size
  /// that leaves divide loses nothing.
  std::vector<Vec3f> kept_world_m;
};

/// By cameras without noise. Searched closest are the voxels of the reference. `on_progress` is
/// called with the share that is done, by one thread at a time. Deterministic at any number of
/// threads.
SeenSurface find_seen_surface(const Scenario& scenario, const World& world, const RayScene& scene,
                              const LegalViewpoints& legal, const SurfaceReference& reference,
                              int threads, const std::function<void(double)>& on_progress);

}  // namespace gnbv
