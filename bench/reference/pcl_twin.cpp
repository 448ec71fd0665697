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

struct PclNeighbours::State {
  Cloud::Ptr cloud{new Cloud};
  pcl::KdTreeFLANN<pcl::PointXYZ> tree{false};
  double radius_m = 0.0;
  pcl::Indices indices;
  std::vector<float> distances2;
};

PclNeighbours::PclNeighbours(double radius_m) : state_(std::make_unique<State>()) {
  // PCL squares the radius to float32; the next float32 up turns FLANN's < into <=
  const float above = std::nextafter(static_cast<float>(radius_m * radius_m),
                                     std::numeric_limits<float>::infinity());
  state_->radius_m = std::sqrt(static_cast<double>(above));
}

PclNeighbours::~PclNeighbours() = default;

void PclNeighbours::append(std::span<const Vec3f> points_m) {
  *state_->cloud += *pcl_cloud(points_m);
}

std::size_t PclNeighbours::size() const { return state_->cloud->size(); }

void PclNeighbours::build() {
  if (!state_->cloud->empty()) state_->tree.setInputCloud(state_->cloud);
}

std::uint32_t PclNeighbours::count(std::size_t point) {
  return static_cast<std::uint32_t>(state_->tree.radiusSearch(
      (*state_->cloud)[point], state_->radius_m, state_->indices, state_->distances2));
}

std::span<const int> PclNeighbours::near(std::size_t point) {
  count(point);
  return state_->indices;
}

std::vector<std::uint32_t> pcl_neighbour_counts(std::span<const Vec3f> points_m, double radius_m) {
  PclNeighbours neighbours(radius_m);
  neighbours.append(points_m);
  neighbours.build();
  std::vector<std::uint32_t> counts;
  counts.reserve(points_m.size());
  for (std::size_t i = 0; i < points_m.size(); ++i) counts.push_back(neighbours.count(i));
  return counts;
}

}  // namespace gnbv
