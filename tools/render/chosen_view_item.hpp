// The view that a decision chose, as things to draw.
#pragma once

#include "planner/belief.hpp"
#include "sim/mesh/world.hpp"
#include "tools/render/scene.hpp"
#include "tools/run_files/run_record.hpp"

namespace gnbv {

struct ChosenViewLook {
  Rgb chosen, pyramid, ray_free, ray_unknown;
};
extern const ChosenViewLook kChosenLook;

/// Its camera's pyramid, rays to where the map ends them, and the way there from the view before.
void add_chosen_view(const RunRecord& record, const World& world, const Belief& belief,
                     std::size_t iteration, double unit_m, RenderScene& scene);

}  // namespace gnbv
