#include "planner/core/planner.hpp"

#include <algorithm>

#include "sim/core/error.hpp"

namespace gnbv {

Plan Planner::replay(std::span<const Decision> recorded, const Belief&, const History&,
                     const ViewPose&, Scratch&) {
  Plan plan;
  plan.views = {recorded.front()};
  return plan;
}

void refuse_another_view(std::size_t iteration) {
  throw BadInput(fmt::format(
      "view {}: what is decided anew is another view than was recorded: another version of the "
      "program or another mesh made this run; fly it anew",
      iteration));
}

void need_as_recorded(const Plan& plan, std::span<const Decision> recorded, std::size_t iteration) {
  if (!plan.has_view()) refuse_another_view(iteration);
  for (std::size_t i = 0; i < std::min(plan.views.size(), recorded.size()); ++i) {
    if (!is_same_view(plan.views[i].view, recorded[i].view)) refuse_another_view(iteration + i);
  }
}

}  // namespace gnbv
