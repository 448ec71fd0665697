// Clouds as the paper's code filters and counts them: PCL, from scratch each time.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

/// Points as PCL wants them: made ahead, so that nobody times the copy.
class PclCloud {
 public:
  explicit PclCloud(std::span<const Vec3f> points_m);
  ~PclCloud();
  PclCloud(PclCloud&&) noexcept;
  PclCloud& operator=(PclCloud&&) noexcept;

  std::size_t size() const;
  std::vector<Vec3f> points_m() const;
  /// pcl::VoxelGrid: one centroid a leaf, in PCL's order.
  PclCloud filtered(double leaf_m) const;

 private:
  struct Points;
  explicit PclCloud(std::unique_ptr<Points> points);
  std::unique_ptr<Points> points_;
};

/// The same from our points to ours.
std::vector<Vec3f> pcl_leaf_filter(std::span<const Vec3f> points_m, double leaf_m);

/// The clusters of points (indices into them) that pcl::EuclideanClusterExtraction finds, none too
/// small or too large.
std::vector<std::vector<int>> pcl_clusters(std::span<const Vec3f> points_m, double tolerance_m,
                                           int min_points, int max_points);

/// For each point, how many of the points lie within `radius_m` of it, itself included
/// (pcl::KdTreeFLANN, built anew). FLANN asks for less than the squared radius: a pair at exactly
/// that float32 distance, which SurfaceCloud counts, is counted here as well.
std::vector<std::uint32_t> pcl_neighbour_counts(std::span<const Vec3f> points_m, double radius_m);

/// The same for a cloud that grows and points of it that are asked for one by one.
class PclNeighbours {
 public:
  explicit PclNeighbours(double radius_m);
  ~PclNeighbours();
  PclNeighbours(const PclNeighbours&) = delete;
  PclNeighbours& operator=(const PclNeighbours&) = delete;

  void append(std::span<const Vec3f> points_m);
  std::size_t size() const;
  /// Builds the kd-tree of all points anew; for count().
  void build();
  std::uint32_t count(std::size_t point);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gnbv
