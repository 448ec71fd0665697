// What the program asks of PCL, which sits in a module of its own: linked, its libraries would cost
// every start 140 ms. The module is loaded when the first symmetry is looked for.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "planner/symmetry/mirror_plane.hpp"

namespace gnbv {

/// A surface point with the direction in which the space before it is free, of any length; zero
/// where that is not known.
struct ProfilePoint {
  Vec3f p_world_m = Vec3f::Zero();
  Vec3f outward_world = Vec3f::Zero();
  Vec3f normal_world = Vec3f::Zero();  // unit, outwards; zero where there is none
  float curvature = 0.0F;
};

/// Two keypoints, each of which looks like the other in a mirror; unit normals of the surface.
struct KeypointPair {
  Vec3f a_world_m, b_world_m;
  Vec3f a_normal_world, b_normal_world;
};

/// Fills normals and curvatures of the points [begin, end) from their neighbours among all. Calls
/// for other points may run at once.
using EstimateNormals = void(std::span<ProfilePoint> profile, std::size_t begin, std::size_t end);
/// Finds keypoints and pairs them by feature, the best matches of each. Needs the normals.
using MatchKeypoints = void(std::span<const ProfilePoint> profile,
                            std::vector<KeypointPair>& pairs);
/// Moves each plane to where the mirrored profile fits the profile best. Needs the normals; calls
/// for other planes may run at once.
using RefinePlanes = void(std::span<const ProfilePoint> profile, std::span<MirrorPlane> planes);

/// The module's functions, by these names with C linkage: gnbv_estimate_normals,
/// gnbv_match_keypoints, gnbv_refine_planes.
struct SymmetryModule {
  EstimateNormals* estimate_normals = nullptr;
  MatchKeypoints* match_keypoints = nullptr;
  RefinePlanes* refine_planes = nullptr;
};

/// Loads the module from beside the program, or from where it was built. Throws BadInput, saying
/// why, when it cannot be loaded. It stays loaded.
const SymmetryModule& symmetry_module();

}  // namespace gnbv
