// The map as the paper's code keeps it: a plain octomap::OcTree, ray by ray. Slow, and trusted.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "planner/map/scan_rays.hpp"

namespace gnbv {

/// octomap::probability of the voxel: 0.5 while unmeasured.
double probability(const OccupancyGrid& grid, VoxelIndex v);

/// Ends of rays from one place as OctoMap wants them: made ahead, so that nobody times the copy.
class OctomapScan {
 public:
  OctomapScan(const Vec3f& origin_world_m, std::span<const Vec3f> ends_world_m);
  ~OctomapScan();

 private:
  friend class OctomapTwin;
  struct Cloud;
  std::unique_ptr<Cloud> cloud_;
};

class OctomapTwin {
 public:
  explicit OctomapTwin(const OccupancyConfig& config);
  ~OctomapTwin();
  OctomapTwin(OctomapTwin&&) noexcept;
  OctomapTwin& operator=(OctomapTwin&&) noexcept;

  /// A tree from a .ot or .bt file. Throws BadInput naming the path when OctoMap cannot read it.
  static OctomapTwin read(const std::filesystem::path& path);

  /// computeRayKeys of every ray, ends of hits, occupied before free, updateNode once a voxel.
  void insert(const Vec3f& origin_world_m, std::span<const ScanRay> rays);
  /// octomap's own insertPointCloud, for which every ray is a hit; `lazy` and `discretize` as
  /// there: inner nodes are left for later, and rays go to the centres of the voxels that were hit,
  /// one to each.
  void insert_point_cloud(const OctomapScan& scan, bool lazy, bool discretize);

  /// computeRayKeys. Keys are ours (OctoMap's minus 32768).
  std::vector<Key> ray_keys(const Vec3f& origin_m, const Vec3f& end_m) const;
  /// Nothing where no node exists.
  std::optional<float> log_odds(const Key& key) const;
  /// Whether the node is at or above the tree's occupancy threshold; nothing without a node.
  std::optional<bool> is_occupied(const Key& key) const;
  double resolution_m() const;
  /// Nodes at the finest level, pruned ones counted as what they stand for.
  std::size_t voxel_count() const;
  /// Nodes as stored.
  std::size_t node_count() const;

 private:
  struct Tree;
  explicit OctomapTwin(std::unique_ptr<Tree> tree);
  std::unique_ptr<Tree> tree_;
};

}  // namespace gnbv
