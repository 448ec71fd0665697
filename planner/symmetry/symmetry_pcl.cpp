// The module that knows PCL (SymmetryModule). Nothing here is random: PCL's searches, filters and
// keypoints give the same answer for the same points in the same order.
#include <pcl/common/centroid.h>
#include <pcl/common/point_tests.h>
#include <pcl/console/print.h>
#include <pcl/features/fpfh.h>
#include <pcl/features/normal_3d.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/keypoints/sift_keypoint.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/registration/correspondence_rejection_surface_normal.h>
#include <pcl/registration/icp.h>
#include <pcl/search/kdtree.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstddef>

#include "planner/symmetry/symmetry.hpp"
#include "sim/core/module.hpp"

GNBV_MODULE(GNBV_VERSION)

namespace gnbv {
namespace {

using Cloud = pcl::PointCloud<pcl::PointNormal>;
using Tree = pcl::search::KdTree<pcl::PointNormal>;
using Feature = pcl::FPFHSignature33;
using Features = pcl::PointCloud<Feature>;

constexpr int kNeighbours = 50;            // released: of normals and of features
constexpr float kRefineLeaf_m = 0.2F;      // of the cloud that ICP aligns
constexpr std::size_t kMaxRefine = 20000;  // points of it; 15 thousand of exact airliners
constexpr std::size_t kMatchesEach = 5;    // best matches of a keypoint

/// The points with normals and curvature. Leaves out points without a normal, such as duplicates.
Cloud::Ptr with_normals(std::span<const ProfilePoint> profile) {
  auto cloud = pcl::make_shared<Cloud>();
  for (const ProfilePoint& from : profile) {
    if (from.normal_world.isZero()) continue;
    pcl::PointNormal point;
    point.getVector3fMap() = from.p_world_m;
    point.getNormalVector3fMap() = from.normal_world;
    point.curvature = from.curvature;
    cloud->push_back(point);
  }
  return cloud;
}

/// Indices of the cloud's points that stand out by their curvature at any of several scales.
pcl::IndicesPtr keypoints_of(const Cloud::ConstPtr& cloud, const Tree& tree) {
  pcl::SIFTKeypoint<pcl::PointNormal, pcl::PointWithScale> sift;  // looks at the curvature
  sift.setSearchMethod(pcl::make_shared<Tree>());
  sift.setScales(0.2F, 3, 4);        // released: from 0.1 m, four times as slow
  sift.setMinimumContrast(0.0001F);  // released
  sift.setInputCloud(cloud);
  pcl::PointCloud<pcl::PointWithScale> keypoints;
  sift.compute(keypoints);

  auto indices = pcl::make_shared<pcl::Indices>();
  pcl::Indices nearest(1);
  std::vector<float> distance2_m2(1);
  for (const pcl::PointWithScale& keypoint : keypoints) {
    pcl::PointNormal query;
    query.getVector3fMap() = keypoint.getVector3fMap();
    if (tree.nearestKSearch(query, 1, nearest, distance2_m2) == 1) indices->push_back(nearest[0]);
  }
  std::sort(indices->begin(), indices->end());
  indices->erase(std::unique(indices->begin(), indices->end()), indices->end());
  return indices;
}

/// The keypoints whose features are most like the mirrored ones of keypoint `of`; the best first.
std::vector<std::size_t> best_matches(const Features& features, std::size_t of) {
  // of the three angles only the second, against the cross product of normal and distance, changes
  // its sign in a mirror; its histogram is the middle third
  Feature wanted = features[of];
  std::reverse(wanted.histogram + 11, wanted.histogram + 22);
  std::vector<std::pair<float, std::size_t>> matches;
  for (std::size_t j = 0; j < features.size(); ++j) {
    float d2 = 0.0F;
    for (int i = 0; i < 33; ++i) {
      const float difference = wanted.histogram[i] - features[j].histogram[i];
      d2 += difference * difference;
    }
    if (j != of && d2 >= 0.0F) matches.emplace_back(d2, j);
  }
  const std::size_t count = std::min(kMatchesEach, matches.size());
  std::ranges::partial_sort(matches, matches.begin() + static_cast<std::ptrdiff_t>(count));
  std::vector<std::size_t> best;
  for (std::size_t i = 0; i < count; ++i) best.push_back(matches[i].second);
  return best;
}

Cloud::Ptr thinned(const Cloud::ConstPtr& cloud) {
  pcl::VoxelGrid<pcl::PointNormal> filter;
  filter.setInputCloud(cloud);
  filter.setLeafSize(kRefineLeaf_m, kRefineLeaf_m, kRefineLeaf_m);
  auto thin = pcl::make_shared<Cloud>();
  filter.filter(*thin);
  for (pcl::PointNormal& point : *thin) {
    const Vec3f n = point.getNormalVector3fMap();
    point.getNormalVector3fMap() = n.normalized();
  }
  std::erase_if(thin->points, [](const pcl::PointNormal& p) { return !pcl::isNormalFinite(p); });
  thin->points = evenly(std::move(thin->points), kMaxRefine);
  thin->width = static_cast<std::uint32_t>(thin->points.size());
  return thin;
}

Cloud::Ptr mirrored(const Cloud& cloud, const MirrorPlane& plane) {
  auto image = pcl::make_shared<Cloud>(cloud);
  const MirrorPlane direction = {plane.normal_world, 0.0};
  for (pcl::PointNormal& point : *image) {
    const Vec3 p = point.getVector3fMap().cast<double>();
    const Vec3 n = point.getNormalVector3fMap().cast<double>();
    point.getVector3fMap() = gnbv::mirrored(plane, p).cast<float>();
    point.getNormalVector3fMap() = gnbv::mirrored(direction, n).cast<float>();
  }
  return image;
}

/// The plane that mirrors most like mirroring in `plane` followed by T does. Its normal is the
/// direction that the two together turn around; it lies in the middle between centre and image.
MirrorPlane moved(const MirrorPlane& plane, const Eigen::Matrix4f& T, const Vec3& center_world_m) {
  const Eigen::Matrix3d R = T.topLeftCorner<3, 3>().cast<double>();
  const Vec3& n = plane.normal_world;
  const Eigen::Matrix3d A = R * (Eigen::Matrix3d::Identity() - 2.0 * n * n.transpose());
  // ascending: the first eigenvalue of a reflection is -1
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(0.5 * (A + A.transpose()));
  const Vec3 image_m =
      R * gnbv::mirrored(plane, center_world_m) + T.topRightCorner<3, 1>().cast<double>();
  return plane_through(0.5 * (center_world_m + image_m), solver.eigenvectors().col(0));
}

/// One alignment of the mirrored cloud against the cloud, point to plane.
MirrorPlane aligned(const Cloud::Ptr& cloud, const MirrorPlane& plane, double reach_m,
                    const Vec3& center_world_m) {
  pcl::IterativeClosestPointWithNormals<pcl::PointNormal, pcl::PointNormal> icp;
  icp.setInputSource(mirrored(*cloud, plane));
  icp.setInputTarget(cloud);
  icp.setMaxCorrespondenceDistance(reach_m);
  icp.setMaximumIterations(20);
  icp.setTransformationEpsilon(1e-8);
  auto same_side = pcl::make_shared<pcl::registration::CorrespondenceRejectorSurfaceNormal>();
  same_side->setThreshold(0.8);  // cosine
  icp.addCorrespondenceRejector(same_side);
  Cloud result;
  icp.align(result);
  const Eigen::Matrix4f T = icp.getFinalTransformation();
  if (!icp.hasConverged() || !T.allFinite()) return plane;
  return moved(plane, T, center_world_m);
}

void estimate_normals(std::span<ProfilePoint> profile, std::size_t begin, std::size_t end) {
  if (profile.size() < kNeighbours) return;
  auto points = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const ProfilePoint& point : profile) {
    points->emplace_back(point.p_world_m.x(), point.p_world_m.y(), point.p_world_m.z());
  }
  auto which = pcl::make_shared<pcl::Indices>();
  for (std::size_t i = begin; i < end; ++i) which->push_back(static_cast<pcl::index_t>(i));
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud(points);
  estimation.setIndices(which);
  estimation.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  estimation.setKSearch(kNeighbours);
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);
  for (std::size_t i = begin; i < end; ++i) {
    const pcl::Normal& normal = normals[i - begin];
    const Vec3f n = normal.getNormalVector3fMap();
    if (!n.allFinite() || !(n.norm() > 0.5F)) continue;
    profile[i].normal_world = n.dot(profile[i].outward_world) < 0.0F ? Vec3f(-n) : n;
    profile[i].curvature = normal.curvature;
  }
}

void match_keypoints(std::span<const ProfilePoint> profile, std::vector<KeypointPair>& pairs) {
  pairs.clear();
  const Cloud::Ptr cloud = with_normals(profile);
  if (cloud->size() < kNeighbours) return;
  auto tree = pcl::make_shared<Tree>();
  tree->setInputCloud(cloud);
  const pcl::IndicesPtr keypoints = keypoints_of(cloud, *tree);
  if (keypoints->empty()) return;
  pcl::FPFHEstimation<pcl::PointNormal, pcl::PointNormal, Feature> estimation;
  estimation.setInputCloud(cloud);
  estimation.setInputNormals(cloud);
  estimation.setIndices(keypoints);
  estimation.setSearchMethod(tree);
  estimation.setKSearch(kNeighbours);
  Features features;
  estimation.compute(features);
  for (std::size_t i = 0; i < features.size(); ++i) {
    const pcl::PointNormal& a = (*cloud)[static_cast<std::size_t>((*keypoints)[i])];
    for (const std::size_t j : best_matches(features, i)) {
      const pcl::PointNormal& b = (*cloud)[static_cast<std::size_t>((*keypoints)[j])];
      pairs.push_back({a.getVector3fMap(), b.getVector3fMap(), a.getNormalVector3fMap(),
                       b.getNormalVector3fMap()});
    }
  }
}

void refine_plane(std::span<const ProfilePoint> profile, MirrorPlane& plane) {
  if (profile.size() < kNeighbours) return;
  const Cloud::Ptr cloud = thinned(with_normals(profile));
  if (cloud->size() < kNeighbours) return;
  Eigen::Vector4d center_world_m = Eigen::Vector4d::Zero();
  pcl::compute3DCentroid(*cloud, center_world_m);
  for (const double reach_m : {1.0, 0.4}) {  // released: 1 m
    plane = aligned(cloud, plane, reach_m, center_world_m.head<3>());
  }
}

}  // namespace
}  // namespace gnbv

extern "C" __attribute__((visibility("default"))) const gnbv::SymmetryModule& gnbv_symmetry() {
  static const gnbv::SymmetryModule module = {gnbv::estimate_normals, gnbv::match_keypoints,
                                              gnbv::refine_plane};
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  return module;
}
