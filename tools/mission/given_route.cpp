#include "tools/mission/given_route.hpp"

#include <iterator>
#include <utility>

#include "planner/follow_route.hpp"
#include "planner/routes.hpp"
#include "sim/core/error.hpp"
#include "tools/mission/mission_state.hpp"

namespace gnbv {
namespace {

/// The first view that may be flown to among those known and not yet tried. None is taken for a
/// repetition of another: who gives a view twice wants it twice.
Plan try_known_views(Mission& m) {
  std::vector<ViewPose> ahead;
  for (std::size_t i = m.next_given; i < m.out.given_views.size(); ++i) {
    ahead.push_back(m.out.given_views[i].view);
  }
  Plan plan = first_flyable(m.planner, m.out.belief, {}, ahead, m.current);
  for (const Candidate& candidate : plan.candidates) {
    GivenView& given = m.out.given_views[m.next_given++];
    given.rejected = candidate.rejected;
    if (given.rejected) m.hooks.on_refused(m.next_given - 1, *given.rejected);
  }
  return plan;
}

/// Whether another view came through the pipe.
bool hears_another(Mission& m) {
  const std::optional<ViewPose> view = m.hooks.next_given();
  if (view) m.out.given_views.push_back({*view});
  return view.has_value();
}

}  // namespace

bool flies_given(const Mission& m) { return is_given_route(m.scenario.planner.utility.name); }

std::optional<Decision> next_given_view(Mission& m) {
  const std::size_t iteration = m.history.decisions.size();
  const bool is_replayed = iteration < m.hooks.replay.size();
  Plan plan = try_known_views(m);
  while (!plan.next && !is_replayed && hears_another(m)) {
    Plan more = try_known_views(m);
    if (more.chosen) plan.chosen = plan.candidates.size() + *more.chosen;
    std::move(more.candidates.begin(), more.candidates.end(), std::back_inserter(plan.candidates));
    plan.next = std::move(more.next);
  }
  if (is_replayed) {
    need_as_recorded(m, plan.next, iteration);
  } else {
    m.hooks.on_candidates(iteration, plan);
  }
  return std::move(plan.next);
}

Termination end_of_given(const Mission& m) {
  return should_stop(m) ? Termination::interrupted : Termination::route_flown;
}

}  // namespace gnbv
