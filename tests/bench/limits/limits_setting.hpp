// What limits are found from; nothing comes from a cache.
#pragma once

#include <cstdlib>

#include "bench/limits/ceiling.hpp"
#include "bench/limits/seen_surface.hpp"
#include "scenarios/load.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/mission/start_pose.hpp"

namespace gnbv {

struct LimitsSetting {
  explicit LimitsSetting(const Scenario& made) : scenario(made) { setenv("GNBV_CACHE", "", 1); }
  SeenSurface seen() const {
    return find_seen_surface(scenario, world, scene, legal, reference, 2, {});
  }

  Scenario scenario;
  std::vector<std::string> warnings;
  World world = load_world(scenario, warnings);
  RayScene scene{world};
  ViewPose start = start_pose(scenario, scene);
  LegalViewpoints legal = find_legal_viewpoints(scenario, scene, start, 2);
  SurfaceReference reference = make_surface_reference(world, scene, reference_config(scenario), 2);
};

}  // namespace gnbv
