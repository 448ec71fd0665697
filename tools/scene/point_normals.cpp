#include "tools/scene/point_normals.hpp"

#include <Eigen/Eigenvalues>
#include <unordered_map>

#include "bench/score/voxel_set.hpp"

namespace gnbv {
namespace {

/// Sums over points, about one place for all.
struct Moments {
  double count = 0.0;
  Vec3 sum = Vec3::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();

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
  std::unordered_map<std::uint64_t, Moments> cells;
  for (const Vec3f& p_m : points_world_m) {
    const Vec3 away_m = (p_m - points_world_m.front()).cast<double>();
    Moments& cell = cells[voxel_code(p_m, cell_m)];
    cell.count += 1.0;
    cell.sum += away_m;
    cell.products += away_m * away_m.transpose();
  }
  std::unordered_map<std::uint64_t, Vec3f> normal_of;
  for (const auto& [code, own] : cells) {
    const Vec3 centre_m = voxel_centre_m(code, cell_m);
    Moments around;
    for (int k = 0; k < 27; ++k) {
      const Vec3 by_m = cell_m * Vec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
      const auto cell = cells.find(voxel_code((centre_m + by_m).cast<float>(), cell_m));
      if (cell == cells.end()) continue;
      around.count += cell->second.count;
      around.sum += cell->second.sum;
      around.products += cell->second.products;
    }
    normal_of[code] = around.normal();
  }
  std::vector<Vec3f> normals;
  for (const Vec3f& p_m : points_world_m) normals.push_back(normal_of[voxel_code(p_m, cell_m)]);
  return normals;
}

}  // namespace gnbv
