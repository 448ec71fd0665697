// Several structures on one site, and what lies about between them.
#include <algorithm>
#include <array>
#include <cmath>

#include "assets/random/parts.hpp"

namespace gnbv::random_parts {
namespace {

Box3 box_around(const Parts& parts) {
  Box3 box_m;
  for (const Part& part : parts)
    for (const Vec3& p : part.points_m) box_m.extend(p);
  return box_m;
}

void shift(Parts& parts, const Vec3& by_m) {
  for (Part& part : parts)
    for (Vec3& p : part.points_m) p += by_m;
}

/// One small thing on the ground: a crate, a container, a tank, pipes, a wall or a lamp.
Parts clutter(Rng& draws, const Vec3& at_m) {
  const double yaw_rad = draws.real(0.0, kPi), size_m = draws.real(0.6, 2.2);
  const Isometry T_world_thing = T_world_body({at_m, yaw_rad});
  switch (draws.whole(0, 5)) {
    case 0:
      return {box(T_world_thing, {size_m, 0.8 * size_m, 0.9 * size_m}, kWood)};
    case 1:
      return {box(T_world_thing, {2.4 * size_m, size_m, 1.1 * size_m},
                  draws.chance(0.5) ? kContainerRed : kContainerBlue)};
    case 2:
      return {drum(at_m, 0.5 * size_m, 1.3 * size_m, 16, kGalvanised)};
    case 3: {
      Parts pipes;
      const double r = 0.16 * size_m;
      for (const auto& [y, z] :
           {std::array{-2.05, 1.0}, std::array{0.0, 1.0}, std::array{2.05, 1.0},
            std::array{-1.03, 2.7}, std::array{1.03, 2.7}})
        pipes += bent_pipe({T_world_thing * Vec3(-2.0 * size_m, y * r, z * r),
                            T_world_thing * Vec3(2.0 * size_m, y * r, z * r)},
                           r, 8, kConcrete);
      return pipes;
    }
    case 4:
      return {box(T_world_thing, {3.0 * size_m, 0.22, 0.8 * size_m}, kBrick)};
    default:
      return {bent_pipe({at_m, at_m + Vec3(0, 0, 3.5 * size_m)}, 0.07, 8, kGalvanised),
              box(T_world_thing * Eigen::Translation3d(0.3, 0.0, 3.45 * size_m), {0.8, 0.2, 0.12},
                  kWhite)};
  }
}

}  // namespace

Parts mixed(Rng& draws, double size_m) {
  const int count = draws.whole(2, 4);
  Parts site;
  double x_m = 0.0, row_m = 0.0, depth_m = 0.0;
  for (int i = 0; i < count; ++i) {
    Parts parts = one_of(draws, size_m * draws.real(0.3, 0.55),
                         {hall, tower, mast, truss, bridge, hull, crane});
    const Box3 box_m = box_around(parts);
    if (i == 2) {  // the second row
      row_m += depth_m;
      x_m = 0.0;
    }
    const double gap_m = size_m * draws.real(-0.01, 0.05);  // some stand into each other
    shift(parts, Vec3(x_m, row_m, 0.0) - Vec3(box_m.min().x(), box_m.min().y(), 0.0));
    x_m += box_m.sizes().x() + gap_m;
    depth_m = std::max(depth_m, box_m.sizes().y() + gap_m);
    site += std::move(parts);
  }
  const Box3 site_m = box_around(site);
  const int things = draws.whole(4, 14);
  for (int i = 0; i < things; ++i) {
    const double across = draws.real(0.0, 1.0), along = draws.real(0.0, 1.0);
    site += clutter(draws, {site_m.min().x() + along * site_m.sizes().x(),
                            site_m.min().y() + across * site_m.sizes().y(), 0.0});
  }
  return site;
}

}  // namespace gnbv::random_parts
