#include "bench/reference/octomap_twin.hpp"

#include "bench/reference/octomap_copy.hpp"
#include "sim/core/error.hpp"

namespace gnbv {

double probability(const OccupancyGrid& grid, VoxelIndex v) {
  return octomap::probability(static_cast<double>(grid.log_odds(v)));
}

struct OctomapTwin::Tree {
  explicit Tree(double resolution_m) : octree(resolution_m) {}
  octomap::OcTree octree;
  octomap::KeyRay ray;  // large: reused from ray to ray
};

OctomapTwin::OctomapTwin(std::unique_ptr<Tree> tree) : tree_(std::move(tree)) {}
OctomapTwin::~OctomapTwin() = default;
OctomapTwin::OctomapTwin(OctomapTwin&&) noexcept = default;
OctomapTwin& OctomapTwin::operator=(OctomapTwin&&) noexcept = default;

OctomapTwin::OctomapTwin(const OccupancyConfig& config)
    : tree_(std::make_unique<Tree>(config.resolution_m)) {
  octomap::OcTree& octree = tree_->octree;
  octree.setProbHit(config.prob_hit);
  octree.setProbMiss(config.prob_miss);
  octree.setClampingThresMin(config.clamp_min);
  octree.setClampingThresMax(config.clamp_max);
  octree.setOccupancyThres(config.occupied_min);
}

OctomapTwin OctomapTwin::read(const std::filesystem::path& path) {
  auto tree = std::make_unique<Tree>(0.1);
  if (path.extension() == ".bt") {
    if (!tree->octree.readBinary(path.string())) {
      throw BadInput("{}: OctoMap cannot read it", path.string());
    }
    return OctomapTwin(std::move(tree));
  }
  const std::unique_ptr<octomap::AbstractOcTree> read(octomap::AbstractOcTree::read(path.string()));
  auto* octree = dynamic_cast<octomap::OcTree*>(read.get());
  if (octree == nullptr) throw BadInput("{}: OctoMap cannot read it", path.string());
  tree->octree.swapContent(*octree);
  tree->octree.setResolution(octree->getResolution());
  return OctomapTwin(std::move(tree));
}

void OctomapTwin::insert(const Vec3f& origin_world_m, std::span<const ScanRay> rays) {
  octomap::OcTree& octree = tree_->octree;
  octomap::KeySet free;
  octomap::KeySet occupied;
  octomap::KeyRay ray_keys;
  for (const ScanRay& ray : rays) {
    const octomap::point3d end = octomap_point(ray.end_world_m);
    if (octree.computeRayKeys(octomap_point(origin_world_m), end, ray_keys)) {
      free.insert(ray_keys.begin(), ray_keys.end());
    }
    octomap::OcTreeKey key;
    if (ray.hit && octree.coordToKeyChecked(end, key)) occupied.insert(key);
  }
  for (const octomap::OcTreeKey& key : free) {
    if (occupied.find(key) == occupied.end()) octree.updateNode(key, false);
  }
  for (const octomap::OcTreeKey& key : occupied) octree.updateNode(key, true);
}

struct OctomapScan::Cloud {
  octomap::point3d origin;
  octomap::Pointcloud ends;
};

OctomapScan::OctomapScan(const Vec3f& origin_world_m, std::span<const Vec3f> ends_world_m)
    : cloud_(std::make_unique<Cloud>()) {
  cloud_->origin = octomap_point(origin_world_m);
  cloud_->ends.reserve(ends_world_m.size());
  for (const Vec3f& end_m : ends_world_m) cloud_->ends.push_back(octomap_point(end_m));
}
OctomapScan::~OctomapScan() = default;

void OctomapTwin::insert_point_cloud(const OctomapScan& scan, bool lazy, bool discretize) {
  constexpr double kNoMaximumRange = -1.0;
  tree_->octree.insertPointCloud(scan.cloud_->ends, scan.cloud_->origin, kNoMaximumRange, lazy,
                                 discretize);
}

std::vector<Key> OctomapTwin::ray_keys(const Vec3f& origin_m, const Vec3f& end_m) const {
  std::vector<Key> keys;
  if (!tree_->octree.computeRayKeys(octomap_point(origin_m), octomap_point(end_m), tree_->ray)) {
    return keys;
  }
  for (const octomap::OcTreeKey& key : tree_->ray) keys.push_back(our_key(key));
  return keys;
}

std::optional<float> OctomapTwin::log_odds(const Key& key) const {
  const octomap::OcTreeNode* node = tree_->octree.search(octomap_key(key));
  if (node == nullptr) return std::nullopt;
  return node->getLogOdds();
}

std::optional<bool> OctomapTwin::is_occupied(const Key& key) const {
  const octomap::OcTreeNode* node = tree_->octree.search(octomap_key(key));
  if (node == nullptr) return std::nullopt;
  return tree_->octree.isNodeOccupied(node);
}

double OctomapTwin::resolution_m() const { return tree_->octree.getResolution(); }

std::size_t OctomapTwin::voxel_count() const {
  std::size_t voxels = 0;
  const octomap::OcTree& octree = tree_->octree;
  for (auto leaf = octree.begin_leafs(); leaf != octree.end_leafs(); ++leaf) {
    voxels += std::size_t{1} << (3 * (octree.getTreeDepth() - leaf.getDepth()));
  }
  return voxels;
}

std::size_t OctomapTwin::node_count() const { return tree_->octree.size(); }

}  // namespace gnbv
