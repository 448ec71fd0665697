#include "planner/core/scratch.hpp"

#include <algorithm>

#include "planner/core/model.hpp"

namespace gnbv {

Scratch::Scratch(const PlannerModel& model, int thread_count)
    : threads(std::max(thread_count, 1)), inserter(model.geometry()) {
  const GridGeometry grid = model.geometry();
  // one by one: copies would write pages that cost nothing yet
  marks.reserve(static_cast<std::size_t>(threads));
  for (int i = 0; i < threads; ++i) marks.emplace_back(grid.voxel_count());
  frontier_marks = FrontierMarks(grid.voxel_count());
}

}  // namespace gnbv
