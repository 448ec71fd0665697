// Bodies that both lab structures are put together from: boxes, boards and tubes in any attitude.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "assets/mesh_builder.hpp"

namespace gnbv {

/// Box of `size_m` whose bottom's middle is the frame's origin.
Part box(const Isometry& T_world_box, const Vec3& size_m, std::uint16_t material);

/// The same with a pit of `depth_m` from the top, walls of `wall_m`, a floor of another material.
Part open_box(const Isometry& T_world_box, const Vec3& size_m, double wall_m, double depth_m,
              std::uint16_t material, std::uint16_t inside);

struct TubePoint {
  Vec3 centre_m;
  double radius_m = 0.0;
};

/// Circles across the mean direction of the path at each of its points, at least two.
std::vector<Ring> tube_rings(const std::vector<TubePoint>& path, std::size_t sides);

/// A solid rod along the path, ends flat.
Part rod(const std::vector<TubePoint>& path, std::size_t sides, std::uint16_t material);

/// A rod whose last end is open: a bore of `depth_m` that leaves `wall_m`.
Part pipe(const std::vector<TubePoint>& path, std::size_t sides, double wall_m, double depth_m,
          std::uint16_t material, std::uint16_t inside);

}  // namespace gnbv
