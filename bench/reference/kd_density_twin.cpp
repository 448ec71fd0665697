#include "bench/reference/kd_density_twin.hpp"

#include <nanoflann.hpp>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "planner/map/surface_cloud.hpp"

namespace gnbv {
namespace {

/// What nanoflann asks of a point set.
struct GrowingPoints {
  std::vector<Vec3f> points_m;
  std::size_t kdtree_get_point_count() const { return points_m.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points_m[i][static_cast<Eigen::Index>(axis)];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;  // let it look itself
  }
};

using DynamicTree =
    nanoflann::KDTreeSingleIndexDynamicAdaptor<nanoflann::L2_Simple_Adaptor<float, GrowingPoints>,
                                               GrowingPoints, 3>;

struct LeafSum {
  Vec3 sum_m = Vec3::Zero();
  double count = 0.0;
};

std::uint64_t code_of(const LeafKey& leaf) {
  std::uint64_t code = 0;
  for (const std::int32_t k : leaf)
    code = code << 21U | (static_cast<std::uint32_t>(k) & 0x1fffffU);
  return code;
}

}  // namespace

struct KdDensityTwin::State {
  State(double leaf_m, double radius_m, const GridGeometry& grid)
      : leaves(leaf_m),
        radius2_m2(static_cast<float>(radius_m * radius_m)),
        voxels(grid),
        voxel_points(grid.voxel_count(), 0),
        neighbours(grid.voxel_count(), 0) {}

  /// Appends the centroids of the leaves that this batch is the first to reach.
  void filter(std::span<const Vec3f> batch_m) {
    order.clear();
    sums.clear();
    for (const Vec3f& p_m : batch_m) {
      if (!voxels.contains(voxels.key_of(p_m))) continue;
      const std::uint64_t leaf = code_of(leaves.key_of(p_m));
      if (taken.contains(leaf)) continue;
      const auto [sum, is_new] = sums.try_emplace(leaf);
      if (is_new) order.push_back(leaf);
      sum->second.sum_m += p_m.cast<double>();
      sum->second.count += 1.0;
    }
    for (const std::uint64_t leaf : order) {
      taken.insert(leaf);
      const LeafSum& sum = sums.at(leaf);
      points.points_m.push_back((sum.sum_m / sum.count).cast<float>());
    }
  }

  /// Counts the points from `first` on, which the tree does not know yet.
  void count(std::size_t first) {
    const std::size_t end = points.points_m.size();
    if (first == end) return;
    tree.addPoints(static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end - 1));
    for (std::size_t i = first; i < end; ++i) {
      voxel_of.push_back(voxels.index_of(voxels.key_of(points.points_m[i])));
    }
    for (std::size_t i = first; i < end; ++i) {
      // a little more: nanoflann leaves out the border, and rounds where it cuts off branches
      nanoflann::RadiusResultSet<float, std::uint32_t> set(radius2_m2 * 1.00001F, found);
      tree.findNeighbors(set, points.points_m[i].data(), {});
      std::uint64_t near = 0;
      for (const auto& [point, distance2_m2] : found) {
        if (distance2_m2 > radius2_m2) continue;
        ++near;
        if (point < first) ++neighbours[voxel_of[point]];
      }
      ++voxel_points[voxel_of[i]];
      neighbours[voxel_of[i]] += near;
    }
  }

  LeafLattice leaves;
  float radius2_m2;
  GridGeometry voxels;
  GrowingPoints points;
  DynamicTree tree{3, points, nanoflann::KDTreeSingleIndexAdaptorParams(16)};
  std::unordered_set<std::uint64_t> taken;
  std::unordered_map<std::uint64_t, LeafSum> sums;  // of a batch
  std::vector<std::uint64_t> order;                 // its new leaves
  std::vector<VoxelIndex> voxel_of;                 // of each point
  // of a search: pairs, or since nanoflann 1.5 a struct of the same names
  std::remove_reference_t<
      decltype(nanoflann::RadiusResultSet<float, std::uint32_t>::m_indices_dists)>
      found;
  std::vector<std::uint32_t> voxel_points;
  std::vector<std::uint64_t> neighbours;
};

KdDensityTwin::KdDensityTwin(double leaf_m, double radius_m, const GridGeometry& voxels)
    : state_(std::make_unique<State>(leaf_m, radius_m, voxels)) {}
KdDensityTwin::~KdDensityTwin() = default;

void KdDensityTwin::add(std::span<const Vec3f> points_world_m) {
  const std::size_t first = state_->points.points_m.size();
  state_->filter(points_world_m);
  state_->count(first);
}

std::span<const Vec3f> KdDensityTwin::points_world_m() const { return state_->points.points_m; }
std::uint32_t KdDensityTwin::point_count(VoxelIndex v) const { return state_->voxel_points[v]; }
std::uint64_t KdDensityTwin::neighbour_sum(VoxelIndex v) const { return state_->neighbours[v]; }

}  // namespace gnbv
