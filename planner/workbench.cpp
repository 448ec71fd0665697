#include "planner/workbench.hpp"

#include <algorithm>

#include "planner/model.hpp"

namespace gnbv {

Workbench::Workbench(const PlannerModel& model, int thread_count)
    : threads(std::max(thread_count, 1)),
      inserter(GridGeometry(model.workspace_m, model.config.map.resolution_m)) {
  const GridGeometry grid(model.workspace_m, model.config.map.resolution_m);
  // one by one: copies would write pages that cost nothing yet
  marks.reserve(static_cast<std::size_t>(threads));
  for (int i = 0; i < threads; ++i) marks.emplace_back(grid.voxel_count());
  frontier_marks = FrontierMarks(grid.voxel_count());
}

}  // namespace gnbv
