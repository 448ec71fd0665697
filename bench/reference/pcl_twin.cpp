#include "bench/reference/pcl_twin.hpp"

#include <pcl/filters/voxel_grid.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/extract_clusters.h>

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

struct PclCloud::Points {
  Cloud::Ptr cloud;
};

PclCloud::PclCloud(std::unique_ptr<Points> points) : points_(std::move(points)) {}
PclCloud::PclCloud(std::span<const Vec3f> points_m)
    : points_(std::make_unique<Points>(Points{pcl_cloud(points_m)})) {}
PclCloud::~PclCloud() = default;
PclCloud::PclCloud(PclCloud&&) noexcept = default;
PclCloud& PclCloud::operator=(PclCloud&&) noexcept = default;

std::size_t PclCloud::size() const { return points_->cloud->size(); }

std::vector<Vec3f> PclCloud::points_m() const {
  std::vector<Vec3f> points;
  points.reserve(size());
  for (const pcl::PointXYZ& p : *points_->cloud) points.emplace_back(p.x, p.y, p.z);
  return points;
}

PclCloud PclCloud::filtered(double leaf_m) const {
  pcl::VoxelGrid<pcl::PointXYZ> filter;
  filter.setInputCloud(points_->cloud);
  const auto leaf = static_cast<float>(leaf_m);
  filter.setLeafSize(leaf, leaf, leaf);
  Cloud::Ptr centroids(new Cloud);
  filter.filter(*centroids);
  return PclCloud(std::make_unique<Points>(Points{std::move(centroids)}));
}

std::vector<Vec3f> pcl_leaf_filter(std::span<const Vec3f> points_m, double leaf_m) {
  return PclCloud(points_m).filtered(leaf_m).points_m();
}

std::vector<std::vector<int>> pcl_clusters(std::span<const Vec3f> points_m, double tolerance_m,
                                           int min_points, int max_points) {
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setClusterTolerance(tolerance_m);
  extraction.setMinClusterSize(min_points);
  extraction.setMaxClusterSize(max_points);
  extraction.setInputCloud(pcl_cloud(points_m));
  std::vector<pcl::PointIndices> found;
  extraction.extract(found);
  std::vector<std::vector<int>> clusters;
  for (pcl::PointIndices& one : found) clusters.push_back(std::move(one.indices));
  return clusters;
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
