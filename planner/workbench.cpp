#include "planner/workbench.hpp"

#include <algorithm>

#include "planner/model.hpp"

namespace gnbv {

Workbench::Workbench(const PlannerModel& model, int thread_count)
    : threads(std::max(thread_count, 1)) {
  const GridGeometry grid(model.workspace_m, model.config.map.resolution_m);
  // one by one: copies would write pages that cost nothing yet
  const std::size_t cameras = std::max<std::size_t>(model.cameras.size(), 1);
  inserters.reserve(cameras);
  for (std::size_t i = 0; i < cameras; ++i) inserters.emplace_back(grid);
  marks.reserve(static_cast<std::size_t>(threads));
  for (int i = 0; i < threads; ++i) marks.emplace_back(grid.voxel_count());
  frontier_marks = FrontierMarks(grid.voxel_count());
}

}  // namespace gnbv
