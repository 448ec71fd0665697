#include "assets/random/random_structure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "assets/random/parts.hpp"
#include "sim/core/error.hpp"
#include "sim/core/sha256.hpp"

namespace gnbv {
namespace {

struct RandomKind {
  std::string_view name;
  random_parts::Parts (*make)(Rng&, double size_m);
  double smallest_m, largest_m;  // extent along an axis
};

constexpr std::array kKinds = {
    RandomKind{"hall", random_parts::hall, 8.0, 48.0},
    RandomKind{"tower", random_parts::tower, 10.0, 56.0},
    RandomKind{"mast", random_parts::mast, 12.0, 58.0},
    RandomKind{"truss", random_parts::truss, 8.0, 45.0},
    RandomKind{"bridge", random_parts::bridge, 10.0, 58.0},
    RandomKind{"hull", random_parts::hull, 8.0, 56.0},
    RandomKind{"crane", random_parts::crane, 12.0, 55.0},
    RandomKind{"mixed", random_parts::mixed, 18.0, 58.0},
};
static_assert(std::ranges::equal(kKinds, kRandomKinds, {}, &RandomKind::name));

/// About the z axis, on the ground, its largest extent `size_m`, turned by `yaw_rad`.
void stand(random_parts::Parts& parts, double yaw_rad, double size_m) {
  const Eigen::AngleAxisd turn(yaw_rad, Vec3::UnitZ());
  Box3 box_m;
  for (Part& part : parts)
    for (Vec3& p : part.points_m) box_m.extend(p = turn * p);
  const double scale = size_m / box_m.sizes().maxCoeff();
  const Vec3 foot_m(box_m.center().x(), box_m.center().y(), box_m.min().z());
  for (Part& part : parts)
    for (Vec3& p : part.points_m) p = scale * (p - foot_m);
}

/// Those that no face has are left out.
void keep_used_materials(TriangleMesh& mesh) {
  std::vector<int> number(mesh.materials.size(), -1);
  for (const std::uint16_t m : mesh.face_material) number[m] = 0;
  std::vector<Material> kept;
  for (std::size_t m = 0; m < number.size(); ++m) {
    if (number[m] < 0) continue;
    number[m] = static_cast<int>(kept.size());
    kept.push_back(mesh.materials[m]);
  }
  for (std::uint16_t& m : mesh.face_material) m = static_cast<std::uint16_t>(number[m]);
  mesh.materials = std::move(kept);
}

}  // namespace

std::string_view random_kind(std::uint64_t seed) {
  const std::uint64_t bits = random_bits({seed, Stream::random_structure, ~std::uint64_t{0}, 0});
  return kRandomKinds[bits % kRandomKinds.size()];
}

std::uint64_t drawn_seed(std::string_view text, std::string_view kind, int draw) {
  const std::string digits = sha256_of(fmt::format("{} {} {}", text, kind, draw));
  return std::stoull(digits.substr(0, 8), nullptr, 16);
}

TriangleMesh make_random_structure(std::uint64_t seed, std::string_view kind) {
  const auto* const found = std::ranges::find(kKinds, kind, &RandomKind::name);
  GNBV_CHECK(found != kKinds.end(), "no random structure is called '{}'", kind);
  Rng draws(seed, Stream::random_structure, static_cast<int>(found - kKinds.begin()));
  const double size_m = draws.real(found->smallest_m, found->largest_m);
  const double yaw_rad = draws.real(0.0, 2.0 * kPi);
  random_parts::Parts parts = found->make(draws, size_m);
  stand(parts, yaw_rad, size_m);
  TriangleMesh mesh;
  mesh.materials = random_parts::materials();
  for (const Part& part : parts) append(mesh, part);
  keep_used_materials(mesh);
  return mesh;
}

}  // namespace gnbv
