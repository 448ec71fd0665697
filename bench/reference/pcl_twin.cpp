#include "bench/reference/pcl_twin.hpp"

#include <pcl/filters/voxel_grid.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>
#include <limits>

namespace gnbv {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

Cloud::Ptr pcl_cloud(std::span<const Vec3f> points_m) {
  Cloud::Ptr cloud(new Cloud);
  cloud->reserve(points_m.size());
  for (const Vec3f& p_m : points_m) cloud->push_back({p_m.x(), p_m.y(), p_m.z()});
  return cloud;
}

}  // namespace

std::vector<Vec3f> pcl_leaf_filter(std::span<const Vec3f> points_m, double leaf_m) {
  pcl::VoxelGrid<pcl::PointXYZ> filter;
  filter.setInputCloud(pcl_cloud(points_m));
  const auto leaf = static_cast<float>(leaf_m);
  filter.setLeafSize(leaf, leaf, leaf);
  Cloud filtered;
  filter.filter(filtered);
  std::vector<Vec3f> centroids_m;
  centroids_m.reserve(filtered.size());
  for (const pcl::PointXYZ& p : filtered) centroids_m.emplace_back(p.x, p.y, p.z);
  return centroids_m;
}

std::vector<std::uint32_t> pcl_neighbour_counts(std::span<const Vec3f> points_m, double radius_m) {
  const Cloud::Ptr cloud = pcl_cloud(points_m);
  pcl::KdTreeFLANN<pcl::PointXYZ> tree(false);
  if (!cloud->empty()) tree.setInputCloud(cloud);
  // PCL squares the radius to float32; the next float32 up turns FLANN's < into <=
  const float above = std::nextafter(static_cast<float>(radius_m * radius_m),
                                     std::numeric_limits<float>::infinity());
  const double radius_up_m = std::sqrt(static_cast<double>(above));
  std::vector<std::uint32_t> counts;
  counts.reserve(points_m.size());
  pcl::Indices indices;
  std::vector<float> distances2;
  for (const pcl::PointXYZ& p : *cloud) {
    counts.push_back(
        static_cast<std::uint32_t>(tree.radiusSearch(p, radius_up_m, indices, distances2)));
  }
  return counts;
}

}  // namespace gnbv
