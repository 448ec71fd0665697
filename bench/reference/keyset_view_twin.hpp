// Candidate evaluation as somebody does it who knows OctoMap: one walk a ray, hashed key sets, one
// search of the tree a voxel. The competent counterpart of paper_view_twin.hpp.
#pragma once

#include <memory>

#include "bench/reference/paper_view_twin.hpp"

namespace gnbv {

class KeysetViewTwin {
 public:
  /// Copies what the grid has measured into a tree.
  explicit KeysetViewTwin(const OccupancyGrid& grid);
  ~KeysetViewTwin();
  KeysetViewTwin(KeysetViewTwin&&) noexcept;
  KeysetViewTwin& operator=(KeysetViewTwin&&) noexcept;

  /// Equal to exact_view_counts(). Not const: the sets keep their memory from view to view.
  ViewCounts evaluate(const ViewRays& rays, const ViewPose& candidate);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gnbv
