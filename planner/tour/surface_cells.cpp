#include "planner/tour/surface_cells.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <bit>
#include <optional>

#include "planner/tour/plane_section.hpp"
#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

/// Calls use(neighbour) for the cell itself and the 26 around it, x fastest.
template <typename Use>
void for_each_neighbour(const Key& key, const Use& use) {
  for (std::int32_t dz = -1; dz <= 1; ++dz) {
    for (std::int32_t dy = -1; dy <= 1; ++dy) {
      for (std::int32_t dx = -1; dx <= 1; ++dx) use(Key{key[0] + dx, key[1] + dy, key[2] + dz});
    }
  }
}

struct Fit {
  Vec3 mean_m;  // relative to where the moments are
  Vec3 normal;
  std::optional<Vec3> axis;  // of a bar
};

/// What the points lie on. The eigenvalues of their covariance are the squares of how far they
/// spread along its eigenvectors, the least first. Two that are large: the plane of least squares.
/// Only the last: a bar along its eigenvector; it faces all that is about it, and its normal is the
/// level one. None: nothing.
std::optional<Fit> fit_points(const PointMoments& moments, double least_spread_m) {
  if (moments.count < 3.0) return std::nullopt;
  const Vec3 mean_m = moments.sum_m / moments.count;
  const Eigen::Matrix3d covariance =
      moments.squares_m2 / moments.count - mean_m * mean_m.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const double least_m2 = least_spread_m * least_spread_m;
  if (solver.eigenvalues()[1] >= least_m2) return Fit{mean_m, solver.eigenvectors().col(0), {}};
  constexpr double kBarSpreads2 = 4.0;  // a bar is at least twice as long as a plane is wide
  if (solver.eigenvalues()[2] < kBarSpreads2 * least_m2) return std::nullopt;
  const Vec3 axis = solver.eigenvectors().col(2);
  const Vec3 level = axis.cross(Vec3::UnitZ());
  return Fit{mean_m, level.norm() > 0.1 ? Vec3(level.normalized()) : Vec3::UnitX(), axis};
}

GridGeometry lattice_of(const Box3& workspace_m, double detail_m) {
  constexpr double kMostCells = 2147483648.0;  // numbers of 31 bits
  const double cell_m = SurfaceCell::kSide * detail_m;
  const double cells = (workspace_m.sizes() / cell_m + Vec3::Constant(2.0)).prod();
  if (cells > kMostCells) {
    throw BadInput(
        fmt::format("planner.tour.detail_m: {} m makes {:.2g} cells of the surface in "
                    "this workspace; at most {:.0g} can be numbered",
                    detail_m, cells, kMostCells));
  }
  return {workspace_m, cell_m};
}

}  // namespace

void PointMoments::add(const Vec3& p_m) {
  count += 1.0;
  sum_m += p_m;
  squares_m2 += p_m * p_m.transpose();
}

void PointMoments::add(const PointMoments& other, const Vec3& offset_m) {
  if (other.count == 0.0) return;
  count += other.count;
  sum_m += other.sum_m + other.count * offset_m;
  squares_m2 += other.squares_m2 + other.sum_m * offset_m.transpose() +
                offset_m * other.sum_m.transpose() +
                other.count * (offset_m * offset_m.transpose());
}

SurfaceCells::SurfaceCells(const Box3& workspace_m, double detail_m)
    : detail_m_(detail_m),
      lattice_(lattice_of(workspace_m, detail_m)),
      at_(lattice_.voxel_count()) {}

std::uint32_t SurfaceCells::cell_at(const Key& key) {
  std::uint32_t& at = at_[lattice_.index_of(key)];
  if (at == 0) {
    cells_.emplace_back();
    cells_.back().key = key;
    at = static_cast<std::uint32_t>(cells_.size());
  }
  return at - 1;
}

const SurfaceCell* SurfaceCells::find(const Key& key) const {
  if (!lattice_.contains(key)) return nullptr;
  const std::uint32_t at = at_[lattice_.index_of(key)];
  return at == 0 ? nullptr : &cells_[at - 1];
}

Vec3 SurfaceCells::voxel_center_m(const SurfaceCell& cell, int bit) const {
  constexpr int kSide = SurfaceCell::kSide;
  const Vec3 at(bit % kSide, bit / kSide % kSide, bit / (kSide * kSide));
  return lattice_.center_m(cell.key) - Vec3::Constant(0.5 * edge_m()) +
         detail_m_ * (at + Vec3::Constant(0.5));
}

int SurfaceCells::bit_at(const Vec3& from_center_m) const {
  int bit = 0;
  for (int axis = 2; axis >= 0; --axis) {
    const double at = (from_center_m[axis] + 0.5 * edge_m()) / detail_m_;
    bit = bit * SurfaceCell::kSide + std::clamp(static_cast<int>(at), 0, SurfaceCell::kSide - 1);
  }
  return bit;
}

void SurfaceCells::count_observation(std::uint32_t cell, std::size_t side) {
  std::uint8_t& observations = cells_[cell].observations[side];
  if (observations < 0xff) ++observations;
}

PointMoments SurfaceCells::moments_around(const Key& key) const {
  PointMoments sum;
  for_each_neighbour(key, [&](const Key& other) {
    const SurfaceCell* const cell = find(other);
    if (cell == nullptr) return;
    sum.add(cell->moments,
            edge_m() * Vec3(other[0] - key[0], other[1] - key[1], other[2] - key[2]));
  });
  return sum;
}

/// Own points say best where the surface is, if they spread; else those around.
void SurfaceCells::fit(SurfaceCell& cell, const OccupancyGrid& grid) const {
  constexpr double kEnoughPoints = 12.0;
  const double least_spread_m = 0.15 * edge_m();
  std::optional<Fit> found;
  if (cell.moments.count >= kEnoughPoints) found = fit_points(cell.moments, 1.3 * least_spread_m);
  if (!found || found->axis) found = fit_points(moments_around(cell.key), least_spread_m);
  const std::uint64_t expected_before = cell.expected;
  cell.expected = 0;
  cell.has_plane = found.has_value();
  cell.is_bar = found && found->axis;
  if (found) {
    const bool had_normal = cell.normal != Vec3f::Zero();
    const bool is_turned = had_normal && cell.normal.dot(found->normal.cast<float>()) < 0.0F;
    const Vec3 center_m = lattice_.center_m(cell.key);
    cell.normal = ((is_turned ? -1.0 : 1.0) * found->normal).cast<float>();
    // with own points few, the plane has to go through them
    const Vec3 mean_m =
        cell.moments.count > 0.0 ? Vec3(cell.moments.sum_m / cell.moments.count) : found->mean_m;
    cell.on_plane_m = (center_m + mean_m).cast<float>();
    if (found->axis) {
      expect_bar(cell, *found->axis);
    } else {
      expect_section(cell);
    }
    const Vec3 middle_m = cell.on_plane_m.cast<double>();
    if (cell.is_extrapolated() && grid.state_at(middle_m) == VoxelState::free) cell.expected = 0;
  }
  if (cell.expected == 0) cell.has_plane = false;
  if (cell.expected != expected_before) cell.changed = updates_;
  place_discs(cell);
}

void SurfaceCells::expect_section(SurfaceCell& cell) const {
  const Vec3 normal = cell.normal.cast<double>();
  const Vec3 on_plane_m = cell.on_plane_m.cast<double>();
  const double least_m2 = kExpectedFaceShare * detail_m_ * detail_m_;
  Vec3 sum_m = Vec3::Zero();
  for (int bit = 0; bit < 64; ++bit) {
    const Vec3 center_m = voxel_center_m(cell, bit);
    const double distance_m = normal.dot(center_m - on_plane_m);
    if (plane_section_area(normal, distance_m, detail_m_) < least_m2) continue;
    cell.expected |= std::uint64_t{1} << bit;
    sum_m += center_m - distance_m * normal;
  }
  if (cell.expected != 0) {
    cell.on_plane_m = (sum_m / std::popcount(cell.expected)).cast<float>();
  }
}

/// The voxels that the axis crosses. Where one that holds a point lies beside it, as the bar's own
/// surface does, that one stands for it.
void SurfaceCells::expect_bar(SurfaceCell& cell, const Vec3& axis) const {
  constexpr double kBeside = 1.2;  // voxels from the axis
  const Vec3 center_m = lattice_.center_m(cell.key);
  const Vec3 on_axis_m = cell.on_plane_m.cast<double>() - center_m;
  const double step_m = 0.25 * detail_m_;
  const auto steps = static_cast<int>(std::ceil(2.0 * edge_m() / step_m));
  for (int i = -steps; i <= steps; ++i) {
    const Vec3 p_m = on_axis_m + i * step_m * axis;
    if (p_m.cwiseAbs().maxCoeff() >= 0.5 * edge_m()) continue;
    std::uint64_t beside = 0;
    for (std::uint64_t left = cell.covered; left != 0; left &= left - 1) {
      const int bit = std::countr_zero(left);
      const double off_m = (voxel_center_m(cell, bit) - center_m - p_m).norm();
      if (off_m <= kBeside * detail_m_) beside |= std::uint64_t{1} << bit;
    }
    cell.expected |= beside != 0 ? beside : std::uint64_t{1} << bit_at(p_m);
  }
}

/// One for each eighth of the cell that has surface, where that is.
void SurfaceCells::place_discs(SurfaceCell& cell) const {
  constexpr int kHalf = SurfaceCell::kSide / 2;
  std::array<Vec3, 8> sum_m;
  sum_m.fill(Vec3::Zero());
  std::array<int, 8> count{};
  for (std::uint64_t left = cell.expected | cell.covered; left != 0; left &= left - 1) {
    const int bit = std::countr_zero(left);
    const int x = bit % 4 / kHalf;
    const int y = bit / 4 % 4 / kHalf;
    const int z = bit / 16 / kHalf;
    const auto part = static_cast<std::size_t>(x + 2 * y + 4 * z);
    Vec3 center_m = voxel_center_m(cell, bit);
    if (cell.has_plane && !cell.is_bar) {
      const Vec3 normal = cell.normal.cast<double>();
      const double off_m = normal.dot(center_m - cell.on_plane_m.cast<double>());
      if (std::fabs(off_m) < detail_m_) center_m -= off_m * normal;
    }
    sum_m[part] += center_m;
    ++count[part];
  }
  cell.discs_m.clear();
  for (std::size_t part = 0; part < 8; ++part) {
    if (count[part] > 0) cell.discs_m.push_back((sum_m[part] / count[part]).cast<float>());
  }
}

void SurfaceCells::add(std::span<const Vec3f> points_world_m, const OccupancyGrid& grid,
                       int threads) {
  ++updates_;
  ++version_;
  std::vector<std::uint32_t> touched;
  for (const Vec3f& point_m : points_world_m) {
    const Key key = lattice_.key_of(point_m);
    if (!lattice_.contains(key)) continue;
    const std::uint32_t index = cell_at(key);
    SurfaceCell& cell = cells_[index];
    const Vec3 from_center_m = point_m.cast<double>() - lattice_.center_m(key);
    cell.moments.add(from_center_m);
    cell.covered |= std::uint64_t{1} << bit_at(from_center_m);
    if (touched.empty() || touched.back() != index) touched.push_back(index);
  }
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  std::vector<std::uint32_t> to_fit;
  for (const std::uint32_t index : touched) {
    for_each_neighbour(Key(cells_[index].key), [&](const Key& key) {
      if (lattice_.contains(key)) to_fit.push_back(cell_at(key));
    });
  }
  std::sort(to_fit.begin(), to_fit.end());
  to_fit.erase(std::unique(to_fit.begin(), to_fit.end()), to_fit.end());
  parallel_for_chunks(threads, to_fit.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) fit(cells_[to_fit[i]], grid);
  });
}

void SurfaceCells::follow_map(const OccupancyGrid& grid) {
  ++version_;
  for (SurfaceCell& cell : cells_) {
    cell.is_boundary = false;
    if (!cell.is_extrapolated() || !cell.has_plane) continue;
    if (grid.state_at(cell.on_plane_m.cast<double>()) != VoxelState::free) continue;
    cell.has_plane = false;
    cell.expected = 0;
    cell.discs_m.clear();
  }
  const GridGeometry& geometry = grid.geometry();
  const std::span<const VoxelWord> words = grid.words();
  for (std::size_t v = 0; v < words.size(); ++v) {
    if (state_of(words[v]) != VoxelState::occupied) continue;
    for_each_neighbour(geometry.key_at(static_cast<VoxelIndex>(v)), [&](const Key& key) {
      if (!geometry.contains(key)) return;
      if (grid.state(geometry.index_of(key)) == VoxelState::unknown) mark_boundary(grid, key);
    });
  }
}

void SurfaceCells::mark_boundary(const OccupancyGrid& grid, const Key& voxel) {
  const GridGeometry& geometry = grid.geometry();
  Vec3 outwards = Vec3::Zero();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const std::int32_t step : {-1, 1}) {
      Key beside = voxel;
      beside[axis] += step;
      if (!geometry.contains(beside)) continue;
      if (grid.state(geometry.index_of(beside)) != VoxelState::free) continue;
      outwards[static_cast<Eigen::Index>(axis)] += step;
    }
  }
  const Vec3 center_m = geometry.center_m(voxel);
  const Key key = lattice_.key_of(center_m);
  if (outwards.isZero() || !lattice_.contains(key)) return;
  SurfaceCell& cell = cells_[cell_at(key)];
  if (cell.has_plane || cell.moments.count > 0.0 || cell.is_boundary) return;
  if (cell.normal.isZero()) cell.changed = updates_;
  cell.is_boundary = true;
  cell.normal = outwards.normalized().cast<float>();
  cell.on_plane_m = center_m.cast<float>();
}

}  // namespace gnbv
