#include "planner/tour/surface_cells.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

constexpr int kSide = SurfaceCell::kSide;

/// A section counts as a voxel of the surface from this share of a face on, as it does in the
/// reference (a tenth) with a margin for the plane's error.
constexpr double kExpectedFaceShare = 0.3;

void sort_unique(std::vector<std::uint32_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

struct Fit {
  Vec3 mean_m;  // relative to where the moments are
  Vec3 normal;
  std::optional<Vec3> axis;  // of a bar
};

/// What the points lie on. The eigenvalues of their covariance, the least first, are the squares of
/// how far they spread along its eigenvectors.
/// - Two are large: the plane of least squares.
/// - Only the last is: a bar along that eigenvector. It faces all sides; its normal is a level one.
/// - None is: nothing.
std::optional<Fit> fit_points(const PointMoments& moments, double least_spread_m) {
  if (moments.count < 3.0) return std::nullopt;
  const Vec3 mean_m = moments.mean_m();
  const Eigen::Matrix3d covariance =
      moments.squares_m2 / moments.weight - mean_m * mean_m.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const double least_m2 = least_spread_m * least_spread_m;
  if (solver.eigenvalues()[1] >= least_m2) return Fit{mean_m, solver.eigenvectors().col(0), {}};
  constexpr double kBarSpreads2 = 4.0;  // a bar is at least twice as long as a plane is wide
  if (solver.eigenvalues()[2] < kBarSpreads2 * least_m2) return std::nullopt;
  const Vec3 axis = solver.eigenvectors().col(2);
  const Vec3 level = axis.cross(Vec3::UnitZ());
  return Fit{mean_m, level.norm() > 0.1 ? Vec3(level.normalized()) : Vec3::UnitX(), axis};
}

/// Of points of this certainty, that share: which ones, their coordinates decide.
bool is_near(double share, const Vec3f& p_m) {
  const auto bits = [&](int axis) -> std::uint64_t {
    return std::bit_cast<std::uint32_t>(p_m[axis]);
  };
  return uniform01({bits(0), Stream::near_point, bits(1), bits(2)}) < share;
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

double plane_section_area(const Vec3& normal, double distance, double edge) {
  constexpr double kLeast = 0.01;
  const Vec3 n = normal.cwiseAbs().cwiseMax(kLeast);
  const double t = 0.5 * n.sum() - std::fabs(distance) / edge;
  if (t <= 0.0) return 0.0;
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    double along = t;
    double sign = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      if (((corner >> axis) & 1) == 0) continue;
      along -= n[axis];
      sign = -sign;
    }
    if (along > 0.0) sum += sign * along * along;
  }
  return edge * edge * std::max(0.0, sum / (2.0 * n.prod()));
}

void PointMoments::add(const Vec3& p_m, double point_weight) {
  count += 1.0;
  weight += point_weight;
  sum_m += point_weight * p_m;
  squares_m2 += point_weight * (p_m * p_m.transpose());
}

void PointMoments::add(const PointMoments& other, const Vec3& offset_m) {
  if (other.count == 0.0) return;
  count += other.count;
  weight += other.weight;
  sum_m += other.sum_m + other.weight * offset_m;
  squares_m2 += other.squares_m2 + other.sum_m * offset_m.transpose() +
                offset_m * other.sum_m.transpose() +
                other.weight * (offset_m * offset_m.transpose());
}

SurfaceCells::SurfaceCells(const Box3& workspace_m, double detail_m)
    : detail_m_(detail_m),
      lattice_(lattice_of(workspace_m, detail_m)),
      at_(lattice_.voxel_count()) {}

std::uint32_t SurfaceCells::cell_at(const Key& key) {
  std::uint32_t& at = at_[lattice_.index_of(key)];
  if (at == 0) {
    cells_.emplace_back().key = key;
    at = static_cast<std::uint32_t>(cells_.size());
  }
  return at - 1;
}

Vec3 SurfaceCells::voxel_center_m(const SurfaceCell& cell, int bit) const {
  const Vec3 at(bit % kSide, bit / kSide % kSide, bit / (kSide * kSide));
  return lattice_.center_m(cell.key) - Vec3::Constant(0.5 * edge_m()) +
         detail_m_ * (at + Vec3::Constant(0.5));
}

int SurfaceCells::bit_at(const Vec3& from_center_m) const {
  int bit = 0;
  for (int axis = 2; axis >= 0; --axis) {
    const double at = (from_center_m[axis] + 0.5 * edge_m()) / detail_m_;
    bit = bit * kSide + std::clamp(static_cast<int>(at), 0, kSide - 1);
  }
  return bit;
}

PointMoments SurfaceCells::moments_around(const Key& key) const {
  PointMoments sum;
  for_each_key(keys_about(key), [&](const Key& other) {
    const std::uint32_t at = lattice_.contains(other) ? at_[lattice_.index_of(other)] : 0;
    if (at == 0) return;
    sum.add(cells_[at - 1].moments,
            edge_m() * Vec3(other[0] - key[0], other[1] - key[1], other[2] - key[2]));
  });
  return sum;
}

/// Standard deviation of the noise of the cell's points, from the share of them that lies near the
/// surface: of a Gaussian error that is sqrt(2 / pi) near / sigma, where it is small. 0: they are
/// as good as exact.
double SurfaceCells::noise_m(const SurfaceCell& cell) const {
  if (cell.is_extrapolated()) return 0.0;
  const double share = std::sqrt(cell.moments.weight / cell.moments.count);
  return share > 0.6 ? 0.0 : kNear * detail_m_ * std::sqrt(2.0 / kPi) / share;
}

/// Own points say best where the surface is, if they spread; else those around.
void SurfaceCells::fit(SurfaceCell& cell, const OccupancyGrid& grid) const {
  constexpr double kEnoughPoints = 12.0;
  const double least_spread_m = 0.15 * edge_m();
  std::optional<Fit> found;
  if (cell.moments.count >= kEnoughPoints) found = fit_points(cell.moments, 1.3 * least_spread_m);
  const double within_m = 2.0 * noise_m(cell);
  if (!found || found->axis || within_m > 0.0) {
    found = fit_points(moments_around(cell.key), least_spread_m);
  }
  const std::uint64_t expected_before = cell.expected;
  cell.expected = 0;
  cell.is_bar = found && found->axis;
  if (found) {
    const bool is_turned = cell.normal.dot(found->normal.cast<float>()) < 0.0F;
    cell.normal = ((is_turned ? -1.0 : 1.0) * found->normal).cast<float>();
    // with own points few, the plane has to go through them
    Vec3 mean_m = cell.is_extrapolated() ? found->mean_m : cell.moments.mean_m();
    // points that may be noise of the surface around are
    if (std::fabs(found->normal.dot(mean_m - found->mean_m)) < within_m) mean_m = found->mean_m;
    cell.on_plane_m = (lattice_.center_m(cell.key) + mean_m).cast<float>();
    cell.is_bar ? expect_bar(cell, *found->axis) : expect_section(cell);
    const Vec3 middle_m = cell.on_plane_m.cast<double>();
    if (cell.is_extrapolated() && grid.state_at(middle_m) == VoxelState::free) cell.expected = 0;
  }
  if (cell.expected != expected_before) cell.changed = version_;
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
    for_each_voxel(cell.covered, [&](int bit) {
      const double off_m = (voxel_center_m(cell, bit) - center_m - p_m).norm();
      if (off_m <= kBeside * detail_m_) beside |= std::uint64_t{1} << bit;
    });
    cell.expected |= beside != 0 ? beside : std::uint64_t{1} << bit_at(p_m);
  }
}

/// One for each eighth of the cell that has surface, where that is.
void SurfaceCells::place_discs(SurfaceCell& cell) const {
  constexpr int kHalf = kSide / 2;
  std::array<Vec3, 8> sum_m;
  sum_m.fill(Vec3::Zero());
  std::array<int, 8> count{};
  for_each_voxel(cell.expected | cell.covered, [&](int bit) {
    const int part = bit % kSide / kHalf + 2 * (bit / kSide % kSide / kHalf) +
                     4 * (bit / (kSide * kSide) / kHalf);
    Vec3 center_m = voxel_center_m(cell, bit);
    const double off_m = cell.off_plane_m(center_m);
    const bool is_on_plane = cell.has_plane() && !cell.is_bar && std::fabs(off_m) < detail_m_;
    if (is_on_plane) center_m -= off_m * cell.normal.cast<double>();
    sum_m[part] += center_m;
    ++count[part];
  });
  cell.discs_m.clear();
  for (int part = 0; part < 8; ++part) {
    if (count[part] > 0) cell.discs_m.push_back((sum_m[part] / count[part]).cast<float>());
  }
}

void SurfaceCells::add(std::span<const Vec3f> points_world_m, const OccupancyGrid& grid,
                       int threads, const HeedStop& stop, bool covers,
                       std::span<const float> certainty) {
  ++version_;
  std::vector<std::uint32_t> touched;
  for (std::size_t i = 0; i < points_world_m.size(); ++i) {
    const Vec3f& point_m = points_world_m[i];
    const Key key = lattice_.key_of(point_m);
    if (!lattice_.contains(key)) continue;
    const std::uint32_t index = cell_at(key);
    SurfaceCell& cell = cells_[index];
    const Vec3 from_center_m = point_m.cast<double>() - lattice_.center_m(key);
    const double share = certainty.empty() ? 1.0 : certainty[i];
    cell.moments.add(from_center_m, share * share);
    if (covers && is_near(share, point_m)) {
      cell.covered |= std::uint64_t{1} << bit_at(from_center_m);
    }
    if (touched.empty() || touched.back() != index) touched.push_back(index);
  }
  sort_unique(touched);
  for (const std::uint32_t index : touched) {
    for_each_key(keys_about(cells_[index].key), [&](const Key& key) {
      if (lattice_.contains(key)) to_fit_.push_back(cell_at(key));
    });
  }
  sort_unique(to_fit_);
  parallel_for_chunks(threads, to_fit_.size(), 256, [&](std::size_t begin, std::size_t end) {
    heed(stop);
    for (std::size_t i = begin; i < end; ++i) fit(cells_[to_fit_[i]], grid);
  });
  to_fit_.clear();
}

void SurfaceCells::follow_map(const OccupancyGrid& grid) {
  ++version_;
  for (SurfaceCell& cell : cells_) {
    cell.is_boundary = false;
    if (!cell.is_extrapolated() || !cell.has_plane()) continue;
    if (grid.state_at(cell.on_plane_m.cast<double>()) != VoxelState::free) continue;
    cell.expected = 0;
    cell.discs_m.clear();
  }
  const GridGeometry& geometry = grid.geometry();
  const std::span<const VoxelWord> words = grid.words();
  for (std::size_t v = 0; v < words.size(); ++v) {
    if (state_of(words[v]) != VoxelState::occupied) continue;
    for_each_key(keys_about(geometry.key_at(static_cast<VoxelIndex>(v))), [&](const Key& key) {
      if (!geometry.contains(key)) return;
      if (grid.state(geometry.index_of(key)) == VoxelState::unknown) mark_boundary(grid, key);
    });
  }
}

void SurfaceCells::mark_boundary(const OccupancyGrid& grid, const Key& voxel) {
  const GridGeometry& geometry = grid.geometry();
  Vec3 outwards = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    for (const int step : {-1, 1}) {
      Key beside = voxel;
      beside[axis] += step;
      if (!geometry.contains(beside)) continue;
      if (grid.state(geometry.index_of(beside)) == VoxelState::free) outwards[axis] += step;
    }
  }
  const Vec3 center_m = geometry.center_m(voxel);
  const Key key = lattice_.key_of(center_m);
  if (outwards.isZero() || !lattice_.contains(key)) return;
  SurfaceCell& cell = cells_[cell_at(key)];
  if (cell.has_plane() || !cell.is_extrapolated() || cell.is_boundary) return;
  if (cell.normal.isZero()) cell.changed = version_;
  cell.is_boundary = true;
  cell.normal = outwards.normalized().cast<float>();
  cell.on_plane_m = center_m.cast<float>();
}

}  // namespace gnbv
