// What each view would see: worked out once, and again where the surface nearby has changed; and
// further nodes, off the lattice, for patches that no node sees.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "planner/motion/roadmap.hpp"
#include "planner/tour/patch_view.hpp"

namespace gnbv {

struct FramePose;

class VisibilityCache {
 public:
  using Node = Roadmap::Node;

  /// `pitches_rad`: of the cameras' gimbal; one, whatever it is, without.
  VisibilityCache(const TourConfig& config, std::span<const CameraModel> cameras,
                  std::span<const double> pitches_rad, const Box3& workspace_m);

  /// Ways to look from a node: each yaw with each pitch.
  /// How far any camera sees from a node.
  double reach_m() const { return reach_m_; }
  int headings() const { return yaws_ * static_cast<int>(pitches_rad_.size()); }
  ViewPose pose(const Vec3& p_world_m, int heading) const;
  /// The heading nearest to that of the pose.
  int heading_near(const ViewPose& pose) const;

  /// Observes from every reachable node that it never did, and again from `most_again` of those
  /// around which the surface changed since: from `first`, then where it changed most.
  void follow(const TourScene& scene, const Roadmap& roadmap, std::span<const Node> first,
              std::size_t most_again, int threads, const HeedStop& stop);

  /// What was last seen from there at that heading, in ascending order.
  std::span<const SeenPatch> seen(Node node, int heading) const;

  /// What all cameras see from a pose, now.
  std::vector<SeenPatch> observe(const TourScene& scene, const ViewPose& view, int threads);
  /// What frames saw together: each patch once, at its best incidence.
  std::vector<SeenPatch> observe(const TourScene& scene, std::span<const FramePose> looks,
                                 int threads);

 private:
  struct AtNode {
    std::uint32_t version = 0;                      // of the cells, when it was last observed
    std::vector<std::vector<SeenPatch>> seen = {};  // by heading; none: never observed
  };
  using Blocks = std::vector<const CellBlocks::Block*>;
  std::uint32_t changes_near(const Vec3& p_world_m, std::uint32_t since) const;
  std::vector<SeenPatch> observe(const TourScene& scene, const ViewPose& view, const Blocks& near,
                                 PatchViewer& viewer) const;

  std::vector<CameraModel> cameras_;
  std::vector<double> pitches_rad_;
  CellBlocks blocks_;
  double reach_m_ = 0.0;
  int yaws_;
  std::vector<AtNode> at_;
};

/// What nodes are looked for in.
struct NodeSearch {
  const OccupancyGrid& grid;
  const OpenSpace& space;
  std::span<const CameraModel> cameras;
};

/// The best `most` points from which some camera, turned to the patch by the vehicle's yaw, has it
/// in its image with no occupied voxel in between: the more face on and the nearer, the better.
/// Tries bearings within 60 deg of the normal's, five elevations of each camera's image and four
/// distances up to its range.
std::vector<Vec3> points_to_see(const NodeSearch& search, const Patch& patch, std::size_t most);

/// How often each cube of a metre was searched for in vain; -1 where a point was found.
using SearchedCubes = std::map<Key, int>;

/// Points for what no node sees (`is_seen`: of each patch): two for each of the cubes of a metre
/// that lack the most, at most 24 cubes a call. A cube for which none is found is searched again
/// after all others: space may open.
std::vector<Vec3> points_for_unseen(const NodeSearch& search, std::span<const Patch> patches,
                                    std::span<const std::uint8_t> is_seen, SearchedCubes& searched);

}  // namespace gnbv
