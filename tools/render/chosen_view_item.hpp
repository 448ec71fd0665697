// The view that a decision chose, as things to draw.
#pragma once

#include "planner/core/belief.hpp"
#include "sim/mesh/world.hpp"
#include "tools/render/picture.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

struct ChosenViewLook {
  Rgb chosen, pyramid, before, ray_free, ray_unknown, hit;
};
extern const ChosenViewLook kChosenLook;

/// Its cameras' pyramids; and of the rays all over their images those that meet a surface, or
/// unknown voxels beside the structure, as far as that.
void add_chosen_view(const RunRecord& record, const World& world, const Belief& belief,
                     std::size_t iteration, double unit_m, RenderScene& scene);

/// From the view before, and both as rings: over everything, since a grid's step beside a large
/// structure is short, and may lie behind it.
std::vector<PlaceLine> way_to_chosen(const RunRecord& record, std::size_t iteration);

}  // namespace gnbv
