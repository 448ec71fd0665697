#include "tools/render/point_normals.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "bench/score/voxel_set.hpp"

namespace gnbv {
namespace {

/// Sums over the points of a cell, about its centre.
struct Moments {
  double count = 0.0;
  Vec3 sum = Vec3::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();

  void add(const Vec3& p) {
    count += 1.0;
    sum += p;
    products += p * p.transpose();
  }
  /// The moments of a cell whose centre lies `by` from ours.
  void add(const Moments& other, const Vec3& by) {
    count += other.count;
    sum += other.sum + other.count * by;
    products += other.products + other.sum * by.transpose() + by * other.sum.transpose() +
                other.count * by * by.transpose();
  }
  Vec3f normal() const {
    if (count < 3.0) return Vec3f::Zero();
    const Vec3 mean = sum / count;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(products / count -
                                                                mean * mean.transpose());
    // points along a line have no normal
    if (solver.eigenvalues()[1] < 1e-9) return Vec3f::Zero();
    return solver.eigenvectors().col(0).cast<float>();
  }
};

}  // namespace

std::vector<Vec3f> point_normals(std::span<const Vec3f> points_world_m, double cell_m) {
  const VoxelSet cells = voxels_of(points_world_m, cell_m);
  const auto find = [&](const Vec3& p) {
    const std::uint64_t code = voxel_code(p.cast<float>(), cell_m);
    const auto at = std::lower_bound(cells.begin(), cells.end(), code);
    return static_cast<std::size_t>(at - cells.begin()) +
           (at != cells.end() && *at == code ? 0 : cells.size());
  };
  std::vector<std::size_t> cell_of(points_world_m.size());
  std::vector<Moments> own(cells.size());
  for (std::size_t i = 0; i < points_world_m.size(); ++i) {
    const std::uint64_t code = voxel_code(points_world_m[i], cell_m);
    cell_of[i] = static_cast<std::size_t>(std::lower_bound(cells.begin(), cells.end(), code) -
                                          cells.begin());
    own[cell_of[i]].add(points_world_m[i].cast<double>() - voxel_centre_m(code, cell_m));
  }
  std::vector<Vec3f> normal_of(cells.size());
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const Vec3 centre = voxel_centre_m(cells[cell], cell_m);
    Moments around;
    for (int k = 0; k < 27; ++k) {
      const Vec3 by = cell_m * Vec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
      const std::size_t neighbour = find(centre + by);
      if (neighbour < cells.size()) around.add(own[neighbour], by);
    }
    normal_of[cell] = around.normal();
  }
  std::vector<Vec3f> normals(points_world_m.size());
  for (std::size_t i = 0; i < normals.size(); ++i) normals[i] = normal_of[cell_of[i]];
  return normals;
}

}  // namespace gnbv
