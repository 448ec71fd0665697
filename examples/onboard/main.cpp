// Plans views on board: after each view that was taken it prints where to take the next one.
// Here the views come from a recording; on a vehicle they come from its cameras.
//
// usage: onboard PROFILE RECORDING     PROFILE is profile.map of a run
#include <cstdio>
#include <gnbv/planner/onboard.hpp>

#include "recording.hpp"

int main(int count, char** arguments) {
  if (count != 3) return 2;
  gnbv::OnboardSettings settings;
  settings.workspace_m = {gnbv::Vec3(-4, -4, 0), gnbv::Vec3(4, 4, 5)};
  settings.cameras = {{.name = "rgbd", .width_px = 160, .height_px = 120, .range_max_m = 5}};
  settings.planner.cloud.leaf_m = 0.05;
  settings.planner.agvs.step_m = 0.7;
  settings.planner.fvs.entropy_threshold_nat = 0.01;
  settings.planner.validity.collision_radius_m = 0.8;
  settings.planner.termination.max_iterations = 12;

  gnbv::Onboard planner(settings);
  planner.load_profile(arguments[1]);
  Recording recording(arguments[2]);
  while (const auto taken = recording.next()) {
    planner.add_view(taken->pose, taken->frames);
    const auto next = planner.next_view();
    if (!next) break;
    const gnbv::Vec3& p_m = next->view.p_world_m;
    std::printf("%.17g %.17g %.17g %.17g\n", p_m.x(), p_m.y(), p_m.z(), next->view.yaw_rad);
  }
  return 0;
}
