// Towers: a bell tower, a water tower on legs, silos, a chimney, a control tower.
#include <algorithm>
#include <cmath>

#include "assets/random/parts.hpp"

namespace gnbv::random_parts {
namespace {

Part tapering(const Ring& foot, const Ring& head, Paint paint) {
  return loft({foot, head}, {}, {}, uniform(paint));
}

/// Square, with a belfry that one can see through, and a nave beside it.
Parts bell_tower(Rng& draws, double height_m) {
  const double width_m = height_m * draws.real(0.14, 0.22);
  const double shaft_m = height_m * draws.real(0.5, 0.6),
               belfry_m = height_m * draws.real(0.12, 0.18);
  const double post_m = 0.2 * width_m, reach_m = 0.5 * (width_m - post_m) - 0.02;
  const Paint wall = draws.chance(0.5) ? kBrick : kPlaster;
  Parts parts = {tapering(square(0, 0, 0, width_m), square(0, 0, shaft_m, 0.94 * width_m), wall),
                 tapering(square(0, 0, shaft_m - 0.1, 1.05 * width_m),
                          square(0, 0, shaft_m + 0.3, 1.05 * width_m), kConcrete)};
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      parts += post({0.9 * x * reach_m, 0.9 * y * reach_m, shaft_m + 0.25},
                    {0.9 * x * reach_m, 0.9 * y * reach_m, shaft_m + belfry_m}, post_m, wall);
  const double bell_m = 0.45 * belfry_m, eaves_m = shaft_m + belfry_m - 0.05;
  parts += upright(revolve({{0.0, 0.0},
                            {0.0, 0.5 * bell_m},
                            {0.35 * bell_m, 0.36 * bell_m},
                            {0.9 * bell_m, 0.24 * bell_m},
                            {bell_m, 0.0}},
                           14, uniform(kBronze)),
                   {0.0, 0.0, eaves_m - 1.15 * bell_m});
  parts += bent_pipe({{0, 0, eaves_m - 0.2 * bell_m}, {0, 0, eaves_m + 0.2}}, 0.06, 6, kWood);
  parts += tapering(square(0, 0, eaves_m, 1.12 * width_m),
                    square(0, 0, eaves_m + 0.25, 1.12 * width_m), kConcrete);
  parts += loft({square(0, 0, eaves_m + 0.2, 1.02 * width_m)}, {Vec3(0, 0, eaves_m + 0.2)},
                {Vec3(0, 0, height_m)}, uniform(kTiles));
  for (const double side : {-1.0, 1.0})  // a clock to the east and the west
    parts += lying_along_x(
        revolve({{0.0, 0.0}, {0.0, 0.25 * width_m}, {0.16, 0.25 * width_m}, {0.16, 0.0}}, 20,
                uniform(kWhite)),
        {side * 0.475 * width_m - 0.08, 0.0, 0.85 * shaft_m});
  const double nave_m = height_m * draws.real(0.35, 0.6), y_m = width_m * draws.real(0.55, 0.8);
  const double wall_m = 0.35 * shaft_m, ridge_m = wall_m + y_m * draws.real(0.7, 1.1);
  const Ring section = {{0.4 * width_m, -y_m, 0.0},
                        {0.4 * width_m, y_m, 0.0},
                        {0.4 * width_m, y_m, wall_m},
                        {0.4 * width_m, 0.0, ridge_m},
                        {0.4 * width_m, -y_m, wall_m}};
  parts += prism(section, {nave_m, 0.0, 0.0}, [=](std::size_t, std::size_t side) {
    return side == 2 || side == 3 ? kTiles : wall;
  });
  return parts;
}

/// A tank in the air on braced legs.
Parts water_tower(Rng& draws, double height_m) {
  const int legs = draws.whole(4, 8);
  const double radius_m = height_m * draws.real(0.12, 0.2), spread = draws.real(1.0, 1.25);
  const double tank_m = height_m * draws.real(0.22, 0.32), roof_m = 0.5 * radius_m;
  const double bottom_m = height_m - tank_m - roof_m;
  const int bays = draws.whole(2, 4);
  const auto sections = stepped(bays, [&](int i) {
    const double out_m = radius_m * (1.04 * (1.0 - 1.0 * i / bays) * spread + 1.01 * i / bays);
    return polygon(legs, out_m, (bottom_m + 0.22 * radius_m) * i / bays);
  });
  Parts parts = lattice(sections, {.chord_m = 0.14 + 0.008 * height_m,
                                   .brace_m = 0.07 + 0.002 * height_m,
                                   .bracing = Bracing::crosses,
                                   .paint = kPaintedSteel});
  for (const Vec3& foot : sections.front()) parts += drum(foot, 0.5, 0.3, 10, kConcrete);
  const double b = bottom_m, t = bottom_m + tank_m;
  parts += upright(revolve({{b - 0.4 * radius_m, 0.0},
                            {b - 0.3 * radius_m, 0.45 * radius_m},
                            {b, 0.85 * radius_m},
                            {b + 0.2 * radius_m, radius_m},
                            {t, radius_m},
                            {t + 0.06, 1.06 * radius_m},
                            {t + 0.8 * roof_m, 0.2 * radius_m},
                            {t + roof_m, 0.0}},
                           24, uniform(kWhite)));
  parts += drum(Vec3::Zero(), 0.12 * radius_m + 0.15, b, 12, kGalvanised);
  const double deck_m = b + 0.25 * radius_m;
  parts += gallery(deck_m, 0.97 * radius_m, radius_m + 0.9, 0.1, 24);
  return parts;
}

/// A row of cylinders, an elevator at its end and a gallery on top.
Parts silos(Rng& draws, double height_m) {
  const int count = draws.whole(2, 5);
  const double radius_m = height_m * draws.real(0.09, 0.14),
               body_m = height_m * draws.real(0.6, 0.72);
  const double pitch_m = 2.0 * radius_m * draws.real(1.02, 1.2), from_m = -0.5 * pitch_m * count;
  const Paint wall = draws.chance(0.5) ? kGalvanised : kConcrete;
  Parts parts;
  for (int i = 0; i < count; ++i)
    parts += upright(revolve({{0.0, 0.0},
                              {0.0, radius_m},
                              {body_m, radius_m},
                              {body_m + 0.5 * radius_m, 0.15 * radius_m},
                              {body_m + 0.52 * radius_m, 0.0}},
                             20, uniform(wall)),
                     {from_m + (i + 1) * pitch_m, 0.0, 0.0});
  const double w = 1.3 * radius_m, top_m = body_m + 0.55 * radius_m;
  parts += pad({from_m, 0.5 * w, 0.0, 0.5 * w, 0.0, height_m}, kCladding);
  parts += block({from_m, from_m + count * pitch_m + 0.3, -0.35 * w, 0.35 * w, top_m - 0.3,
                  top_m + std::max(1.2, 0.06 * height_m)},
                 kCladding);
  parts +=
      block({from_m - 0.46 * w, from_m + 0.4 * w, -0.5 * w - 0.05, -0.4 * w, 0.02, 2.2}, kDoor);
  return parts;
}

/// Hollow from top to bottom, galleries around it, a house at its foot.
Parts chimney(Rng& draws, double height_m) {
  const double foot_m = height_m * draws.real(0.06, 0.09), head_m = foot_m * draws.real(0.5, 0.7);
  const double lip_m = head_m * 1.12;
  Parts parts = {upright(revolve_loop({{0.0, foot_m},
                                       {0.4 * height_m, 0.5 * (foot_m + head_m)},
                                       {0.97 * height_m, head_m},
                                       {0.98 * height_m, lip_m},
                                       {height_m, lip_m},
                                       {height_m, 0.75 * head_m},
                                       {0.0, 0.7 * foot_m}},
                                      18, [](std::size_t segment, std::size_t) {
                                        return segment == 1 ? kMastStripes : kConcrete;
                                      }))};
  const int galleries = draws.whole(1, 3);
  for (int i = 1; i <= galleries; ++i) {
    const double z_m = height_m * (0.4 + 0.55 * i / galleries);
    const double at_m =
        0.5 * (foot_m + head_m) + (head_m - foot_m) * 0.5 * (z_m / height_m - 0.4) / 0.57;
    parts += gallery(z_m, at_m - 0.1, at_m + 0.9, 0.12, 18);
  }
  const double house_m = height_m * draws.real(0.12, 0.25);
  parts += parapet_block({0.6 * foot_m, 0.6 * foot_m + house_m, -0.7 * house_m, 0.5 * house_m, 0.0,
                          std::max(2.4, 0.5 * house_m)},
                         0.3, {kBrick, kConcrete, kRoofing});
  return parts;
}

/// A shaft of eight sides that flares into a cabin of glass.
Parts control_tower(Rng& draws, double height_m) {
  const double shaft_m = height_m * draws.real(0.05, 0.08),
               cabin_m = shaft_m * draws.real(2.0, 3.0);
  const double neck_m = height_m * draws.real(0.66, 0.74),
               floor_m = neck_m + 0.6 * (cabin_m - shaft_m);
  const double roof_m = floor_m + height_m * draws.real(0.07, 0.1);
  Parts parts = {
      upright(revolve({{0.0, 0.0},
                       {0.0, 1.25 * shaft_m},
                       {neck_m, shaft_m},
                       {floor_m, cabin_m},
                       {roof_m, 1.12 * cabin_m},
                       {roof_m + 0.02, 1.25 * cabin_m},
                       {roof_m + 0.5, 1.2 * cabin_m},
                       {roof_m + 0.7, 0.0}},
                      8,
                      [](std::size_t segment, std::size_t) {
                        return segment == 3 ? kGlass : segment > 3 ? kRoofing : kConcrete;
                      })),
      bent_pipe({{0.3, 0.0, roof_m + 0.5}, {0.3, 0.0, height_m}}, 0.09, 8, kMastStripes)};
  for (int i = 0; i < 3; ++i) {
    const double angle_rad = 2.0 * kPi * i / 3.0 + 0.4;
    const Vec3 at(0.8 * cabin_m * std::cos(angle_rad), 0.8 * cabin_m * std::sin(angle_rad),
                  roof_m + 0.4);
    parts += bent_pipe({at, at + Vec3(0.0, 0.0, draws.real(1.0, 0.7 * (height_m - roof_m) + 1.0))},
                       0.05, 6, kGalvanised);
  }
  const double hall_m = height_m * draws.real(0.2, 0.4);
  parts += parapet_block({-0.4 * hall_m, 0.6 * hall_m, 0.5 * shaft_m, 0.5 * shaft_m + 0.5 * hall_m,
                          0.0, std::max(2.6, 0.09 * height_m)},
                         0.35, {kPlaster, kConcrete, kRoofing});
  return parts;
}

}  // namespace

Parts tower(Rng& draws, double size_m) {
  return one_of(draws, size_m, {bell_tower, water_tower, silos, chimney, control_tower});
}

}  // namespace gnbv::random_parts
