// Screened Poisson reconstruction (Kazhdan and Hoppe 2013) by PCL, which sits in a module of its
// own: linked, its libraries would cost every start of every command 24 ms and more. The module is
// loaded with the first surface.
#pragma once

#include <span>

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

struct PoissonSettings {
  int depth = 8;              // the octree's: cells of extent / 2^depth
  float point_weight = 4.0F;  // how strongly the surface is drawn through the points
};

/// The extent PCL gives the octree, as a multiple of the longest side of the points' box.
constexpr double kPoissonScale = 1.1;

/// A surface through the points, closed where nothing was seen, too. Normals are unit vectors out
/// of the structure, as many as points; the mesh's faces are counter-clockwise seen from there. No
/// face without points. Deterministic: PCL's own threads, which make it neither faster nor
/// repeatable, are off. Use from one thread; stdout is not heard meanwhile, since PCL writes there.
using PoissonSurface = void(std::span<const Vec3f> points_m, std::span<const Vec3f> normals,
                            const PoissonSettings& settings, TriangleMesh& mesh);

/// The module's function gnbv_poisson_surface. Throws BadInput, saying why, when the module cannot
/// be loaded.
PoissonSurface& poisson_module();

}  // namespace gnbv
