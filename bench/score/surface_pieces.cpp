#include "bench/score/surface_pieces.hpp"

#include <algorithm>
#include <cmath>

#include "bench/score/voxel_set.hpp"
#include "sim/core/error.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

constexpr double kVoxelsPerMetre = 20.0;
constexpr std::int64_t kVoxelsPerSlab = 10;
constexpr std::int64_t kAll = std::int64_t{1} << 40;  // farther than any cell
static_assert(kCoverageSizes_m[0] * kVoxelsPerMetre == 1.0);
static_assert(kCoverageSizes_m[2] == kSlab_m && kSlab_m * kVoxelsPerMetre == kVoxelsPerSlab);

/// A convex polygon: a triangle that planes have cut, seven of a voxel and the floor, six of a
/// leaf.
class Polygon {
 public:
  std::span<const Vec3> corners() const { return {p_.data(), size_}; }
  void add(const Vec3& p) {
    GNBV_CHECK(size_ < p_.size(), "a polygon of more than {} corners", p_.size());
    p_[size_++] = p;
  }

  /// Lowest and highest coordinate.
  std::pair<double, double> span(Eigen::Index axis) const {
    const auto [low, high] =
        std::minmax_element(p_.begin(), p_.begin() + static_cast<std::ptrdiff_t>(size_),
                            [&](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; });
    return {(*low)[axis], (*high)[axis]};
  }

  /// The part with sign * (p[axis] - at) >= 0.
  Polygon cut(Eigen::Index axis, double at, double sign) const {
    Polygon out;
    for (std::size_t i = 0; i < size_; ++i) {
      const Vec3& a = p_[i];
      const Vec3& b = p_[(i + 1) % size_];
      const double over_a = sign * (a[axis] - at);
      const double over_b = sign * (b[axis] - at);
      if (over_a >= 0.0) out.add(a);
      if ((over_a > 0.0 && over_b < 0.0) || (over_a < 0.0 && over_b > 0.0)) {
        Vec3 p = a + over_a / (over_a - over_b) * (b - a);
        p[axis] = at;
        out.add(p);
      }
    }
    return out;
  }

  double area_m2() const {
    Vec3 twice = Vec3::Zero();
    for (std::size_t i = 2; i < size_; ++i) {
      twice += (p_[i - 1] - p_[0]).cross(p_[i] - p_[0]);
    }
    return 0.5 * twice.norm();
  }

 private:
  std::array<Vec3, 20> p_;  // rounding may add a few
  std::size_t size_ = 0;
};

std::int64_t cell_of(double x_m, double cells_per_metre = kVoxelsPerMetre) {
  return static_cast<std::int64_t>(std::floor(x_m * cells_per_metre));
}

/// Calls use(cell, part) for each cell along the axis that the polygon has a part in.
template <typename Use>
void for_each_cell(const Polygon& polygon, double cells_per_metre, Eigen::Index axis,
                   std::int64_t from, std::int64_t to, const Use& use) {
  if (polygon.corners().size() < 3) return;
  const auto [low_m, high_m] = polygon.span(axis);
  const std::int64_t first = cell_of(low_m, cells_per_metre);
  const std::int64_t last = cell_of(high_m, cells_per_metre);
  Polygon rest = polygon;
  for (std::int64_t cell = std::max(first, from); cell <= std::min(last, to); ++cell) {
    if (cell > first && cell == from) {
      rest = rest.cut(axis, static_cast<double>(cell) / cells_per_metre, 1.0);
    }
    if (cell == last) {
      use(cell, rest);
      return;
    }
    const double end_m = static_cast<double>(cell + 1) / cells_per_metre;
    use(cell, rest.cut(axis, end_m, -1.0));
    rest = rest.cut(axis, end_m, 1.0);
    if (rest.corners().size() < 3) return;
  }
}

/// Calls use({x, y, z}, part) for each cube that the polygon has a part in, x within bounds.
template <typename Use>
void for_each_cube(const Polygon& polygon, double cells_per_metre, std::int64_t from_x,
                   std::int64_t to_x, const Use& use) {
  const auto along = [&](const Polygon& part, Eigen::Index axis, const auto& use_cell) {
    for_each_cell(part, cells_per_metre, axis, -kAll, kAll, use_cell);
  };
  for_each_cell(polygon, cells_per_metre, 0, from_x, to_x,
                [&](std::int64_t x, const Polygon& slice) {
                  along(slice, 1, [&](std::int64_t y, const Polygon& bar) {
                    along(bar, 2, [&](std::int64_t z, const Polygon& part) {
                      if (part.corners().size() >= 3)
                        use(std::array<std::int64_t, 3>{x, y, z}, part);
                    });
                  });
                });
}

Polygon above_floor(const TriangleMesh& mesh, std::uint32_t face, double floor_z_m) {
  Polygon polygon;
  bool is_above = true;
  for (const std::uint32_t v : mesh.faces[face]) {
    polygon.add(mesh.vertices_m[v].cast<double>());
    is_above = is_above && polygon.corners().back().z() >= floor_z_m;
  }
  return is_above ? polygon : polygon.cut(2, floor_z_m, 1.0);
}

/// The point of a convex polygon at u and v in [0, 1), of which equal areas make equal areas.
Vec3 point_at(std::span<const Vec3> p, double area_m2, double u, double v) {
  std::size_t apex = 2;  // of the fan's triangle that holds the u-th part of the area
  double left_m2 = u * area_m2;
  for (; apex + 1 < p.size(); ++apex) {
    const double part_m2 = 0.5 * (p[apex - 1] - p[0]).cross(p[apex] - p[0]).norm();
    if (left_m2 < part_m2) break;
    left_m2 -= part_m2;
  }
  const double part_m2 = 0.5 * (p[apex - 1] - p[0]).cross(p[apex] - p[0]).norm();
  const double out = std::sqrt(part_m2 > 0.0 ? std::clamp(left_m2 / part_m2, 0.0, 1.0) : 0.5);
  return p[0] + out * ((1.0 - v) * (p[apex - 1] - p[0]) + v * (p[apex] - p[0]));
}

/// The float nearest to p that lies in [cell, cell + 1) voxels.
float into_cell(double p_m, std::int64_t cell) {
  auto p = static_cast<float>(p_m);
  while (cell_of(static_cast<double>(p)) > cell) p = std::nextafter(p, -1e9F);
  while (cell_of(static_cast<double>(p)) < cell) p = std::nextafter(p, 1e9F);
  return p;
}

}  // namespace

Slabs make_slabs(const TriangleMesh& mesh, double floor_z_m) {
  const auto slab_of = [](float x_m) {
    return static_cast<std::int64_t>(std::floor(static_cast<double>(x_m) / kSlab_m));
  };
  const Box3 box = bounds_m(mesh);
  Slabs slabs;
  if (box.isEmpty()) return slabs;
  // throws for what has no voxel
  voxel_code(box.min().cast<float>(), kCoverageSizes_m[0]);
  voxel_code(box.max().cast<float>(), kCoverageSizes_m[0]);
  slabs.first = slab_of(static_cast<float>(box.min().x()));
  const std::int64_t last = slab_of(static_cast<float>(box.max().x()));
  slabs.faces.resize(static_cast<std::size_t>(last - slabs.first + 1));
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    Eigen::AlignedBox3f face;
    for (const std::uint32_t v : mesh.faces[f]) face.extend(mesh.vertices_m[v]);
    if (static_cast<double>(face.max().z()) < floor_z_m) continue;
    for (std::int64_t s = slab_of(face.min().x()); s <= slab_of(face.max().x()); ++s) {
      slabs.faces[static_cast<std::size_t>(s - slabs.first)].push_back(f);
    }
  }
  return slabs;
}

void for_each_piece(const TriangleMesh& mesh, std::uint32_t face, std::int64_t slab,
                    double floor_z_m, const std::function<void(const SurfacePiece&)>& use) {
  const std::int64_t first = slab * kVoxelsPerSlab;
  for_each_cube(above_floor(mesh, face, floor_z_m), kVoxelsPerMetre, first,
                first + kVoxelsPerSlab - 1,
                [&](const std::array<std::int64_t, 3>& cell, const Polygon& part) {
                  const double area_m2 = part.area_m2();
                  if (area_m2 <= 0.0) return;
                  use({.voxel = code_of(cell),
                       .face = face,
                       .area_m2 = area_m2,
                       .corners_world_m = part.corners()});
                });
}

void for_each_part(const SurfacePiece& piece, double cell_m,
                   const std::function<void(const std::array<std::int64_t, 3>&, double)>& use) {
  Polygon whole;
  for (const Vec3& corner_m : piece.corners_world_m) whole.add(corner_m);
  for_each_cube(whole, 1.0 / cell_m, -kAll, kAll,
                [&](const std::array<std::int64_t, 3>& cell, const Polygon& part) {
                  use(cell, part.area_m2());
                });
}

std::size_t points_on(const SurfacePiece& piece, double spacing_m) {
  GNBV_CHECK(spacing_m > 0.0, "sample spacing {} m", spacing_m);
  const auto count = std::llround(piece.area_m2 / (spacing_m * spacing_m));
  return static_cast<std::size_t>(std::max<long long>(count, 1));
}

Vec3f point_on(const SurfacePiece& piece, std::size_t k) {
  // of the plastic number, the root of x^3 = x + 1
  constexpr double kStep1 = 0.7548776662466927;
  constexpr double kStep2 = 0.5698402909980532;
  const std::uint64_t hash = mix_bits(piece.voxel + 0x9e3779b97f4a7c15ULL * piece.face);
  const auto shifted = [&](double step, std::uint64_t bits) {
    const double x = static_cast<double>(bits) / 4294967296.0 + static_cast<double>(k) * step;
    return x - std::floor(x);
  };
  const Vec3 point_m = point_at(piece.corners_world_m, piece.area_m2, shifted(kStep1, hash >> 32),
                                shifted(kStep2, hash & 0xffffffffULL));
  const std::array<std::int64_t, 3> cell = index_of(piece.voxel);
  return {into_cell(point_m.x(), cell[0]), into_cell(point_m.y(), cell[1]),
          into_cell(point_m.z(), cell[2])};
}

std::vector<Vec3f> drawn_by_area(const TriangleMesh& mesh, double floor_z_m, std::size_t count) {
  std::vector<double> until_m2;  // of the faces up to each one
  double all_m2 = 0.0;
  for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
    until_m2.push_back(all_m2 += above_floor(mesh, face, floor_z_m).area_m2());
  }
  std::vector<Vec3f> points_m;
  for (std::uint64_t i = 0; all_m2 > 0.0 && i < count; ++i) {
    const auto draw = [&](std::uint64_t which) {
      return uniform01({0, Stream::area_sample, which, i});
    };
    const double at_m2 = std::min(draw(0) * all_m2, std::nextafter(all_m2, 0.0));
    const auto face = std::ranges::upper_bound(until_m2, at_m2) - until_m2.begin();
    const Polygon part = above_floor(mesh, static_cast<std::uint32_t>(face), floor_z_m);
    points_m.push_back(point_at(part.corners(), part.area_m2(), draw(1), draw(2)).cast<float>());
  }
  return points_m;
}

}  // namespace gnbv
