#include "planner/tour/tour_plan.hpp"

#include <map>
#include <utility>

namespace gnbv {
namespace {

constexpr double kLeastExpected = 0.5;  // a cube that can be expected to bring less is left out

std::vector<PatchCube> gathered(std::span<const Patch> patches, const ObservationYield& yield,
                                double cube_m) {
  std::map<std::pair<PatchSource, Key>, PatchCube> cubes;
  for (const Patch& patch : patches) {
    const auto expected = static_cast<double>(patch.missing * yield.share(patch, 0));
    if (expected <= 0.0) continue;
    const Vec3 target_m = patch.target_m.cast<double>();
    const Eigen::Vector3i at = (target_m / cube_m).array().floor().cast<int>();
    PatchCube& cube = cubes[{patch.source, {at.x(), at.y(), at.z()}}];
    cube.source = patch.source;
    cube.p_world_m += expected * target_m;
    cube.expected += expected;
  }
  std::vector<PatchCube> kept;
  for (auto& [key, cube] : cubes) {
    if (cube.expected < kLeastExpected) continue;
    cube.p_world_m /= cube.expected;
    kept.push_back(cube);
  }
  return kept;
}

}  // namespace

TourPlan make_tour_plan(std::vector<ViewPose> views, std::span<const Patch> patches,
                        const ObservationYield& yield) {
  TourPlan plan{.views = std::move(views), .cube_m = kLeastCube_m, .cubes = {}};
  plan.cubes = gathered(patches, yield, plan.cube_m);
  while (plan.cubes.size() > kMostCubes) {
    plan.cube_m *= 2.0;
    plan.cubes = gathered(patches, yield, plan.cube_m);
  }
  return plan;
}

}  // namespace gnbv
