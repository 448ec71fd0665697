// As examples/onboard, by a utility of its own: the volume of unknown space in sight, discounted by
// the way there. The program's bircher_volume is the same formula.
//
// usage: own_utility [UTILITY] PROFILE RECORDING     UTILITY: one of the program's instead
#include <cmath>
#include <cstdio>
#include <gnbv/planner/onboard.hpp>
#include <recording.hpp>

int main(int count, char** arguments) {
  gnbv::OnboardSettings settings;
  settings.workspace_m = {gnbv::Vec3(-4, -4, 0), gnbv::Vec3(4, 4, 5)};
  settings.seed = 1;  // as the scenario has it: a tour draws by it
  settings.cameras = {{.name = "rgbd", .width_px = 160, .height_px = 120, .range_max_m = 5}};
  settings.planner.cloud.leaf_m = 0.05;
  settings.planner.agvs.step_m = 0.7;
  settings.planner.fvs.entropy_threshold_nat = 0.01;
  settings.planner.validity.collision_radius_m = 0.8;
  settings.planner.termination.max_iterations = 12;
  if (count == 4) {
    settings.planner.utility.name = arguments[1];
  } else {
    settings.utility = {"unknown_volume",
                        [](const gnbv::ViewStats& view, const gnbv::ViewPose&) {
                          return view.unknown_voxels * view.voxel_m3 * std::exp(-0.2 * view.path_m);
                        },
                        "unknown_voxels voxel_m3 path_m"};
  }

  gnbv::Onboard planner(settings);
  planner.load_profile(arguments[count - 2]);
  Recording recording(arguments[count - 1]);
  while (const auto taken = recording.next()) {
    planner.add_view(taken->pose, taken->frames);
    const auto next = planner.next_view();
    if (!next) break;
    const gnbv::Vec3& p_m = next->view.p_world_m;
    std::printf("%.17g %.17g %.17g %.17g\n", p_m.x(), p_m.y(), p_m.z(), next->view.yaw_rad);
  }
  return 0;
}
