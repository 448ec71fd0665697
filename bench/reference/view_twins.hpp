// Candidate evaluation on a plain octomap::OcTree, in the paper's way and in a competent one.
#pragma once

#include <memory>

#include "planner/view/visibility.hpp"

namespace gnbv {

/// Voxels that a view sees, each once.
struct ViewCounts {
  std::int64_t free = 0;
  std::int64_t occupied = 0;
  std::int64_t unknown = 0;

  bool operator==(const ViewCounts&) const = default;
};

/// As the paper's code does it: cast the ray, list its keys, keep them in a sorted set, search the
/// tree for every voxel that is new to it. Slow, and trusted.
class PaperViewTwin {
 public:
  /// Copies what the grid has measured into a tree.
  explicit PaperViewTwin(const OccupancyGrid& grid);
  ~PaperViewTwin();

  /// A ray that hits something is listed to the centre of the voxel it hit, as in the paper's code,
  /// so that the voxels before it may differ from those of the ray itself.
  ViewCounts evaluate(const ViewRays& rays, const ViewPose& candidate) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// As somebody does it who knows OctoMap: one walk a ray, hashed key sets, one search of the tree a
/// voxel.
class KeysetViewTwin {
 public:
  /// Copies what the grid has measured into a tree.
  explicit KeysetViewTwin(const OccupancyGrid& grid);
  ~KeysetViewTwin();

  /// Equal to exact_view_counts(). Not const: the sets keep their memory from view to view.
  ViewCounts evaluate(const ViewRays& rays, const ViewPose& candidate);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The voxels that evaluate_view() is to count, by OctoMap's float64 walk.
ViewCounts exact_view_counts(const OccupancyGrid& grid, const ViewRays& rays,
                             const ViewPose& candidate);

}  // namespace gnbv
