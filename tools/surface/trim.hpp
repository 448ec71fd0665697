// What of a closed surface the points bear out, in fewer faces.
#pragma once

#include <span>

#include "sim/mesh/triangle_mesh.hpp"
#include "tools/surface/oriented_cloud.hpp"

namespace gnbv {

struct TrimSettings {
  double reach_m = 0.0;      // of every point; 0: by the spacing of the points there
  double reach_max_m = 0.3;  // at most, by spacing
};

/// The surface within reach of the points: each vertex's distance to the points around, off their
/// planes counted twice, over their reach of 2 spacings (or plain, over a given one), is smoothed
/// along the edges (as Kazhdan's SurfaceTrimmer does with its densities, so that the rim is smooth)
/// and faces are cut where it is 1. Without faces that have no area, and without unused vertices.
/// Deterministic at any number of threads.
TriangleMesh trimmed(const TriangleMesh& closed, const OrientedCloud& cloud,
                     const TrimSettings& settings, int threads);

/// The same faces below a level of a field on the vertices, those across it cut along it.
TriangleMesh cut_at_level(const TriangleMesh& mesh, std::span<const float> field, float level);

/// Without faces that have no area, parts (joined by vertices) of less than `part_min_m2`, and
/// vertices that no face uses. The order of faces and vertices stays.
TriangleMesh without_scraps(const TriangleMesh& mesh, double part_min_m2);

/// Edges collapsed by quadric error (Garland and Heckbert 1997) while the surface stays within
/// about `tolerance_m` of what it was: flat parts become few faces, edges stay. Vertices are some
/// of those given; none is left that no face uses. Deterministic.
TriangleMesh decimated(const TriangleMesh& mesh, double tolerance_m);

}  // namespace gnbv
