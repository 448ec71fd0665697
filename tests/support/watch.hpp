// An observer whose answers are functions of a test.
#pragma once

#include <functional>

#include "tools/mission/mission.hpp"

namespace gnbv {

struct Watch final : MissionObserver {
  std::function<void(const Belief&)> profile_belief = [](const Belief&) {};
  std::function<void(const SensedView&)> sensed = [](const SensedView&) {};
  std::function<void(const ViewRecord&, const Belief&)> view = [](const ViewRecord&,
                                                                  const Belief&) {};
  std::function<void(std::size_t, const Plan&)> plan = [](std::size_t, const Plan&) {};
  bool colour = false;

  void on_profile_belief(const Belief& belief) override { profile_belief(belief); }
  bool wants_colour() const override { return colour; }
  void on_sensed(const SensedView& all) override { sensed(all); }
  void on_view(const ViewRecord& record, const Belief& belief) override { view(record, belief); }
  void on_plan(std::size_t iteration, const Plan& made) override { plan(iteration, made); }
};

}  // namespace gnbv
