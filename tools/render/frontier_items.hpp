// What a decision between frontier views looked at, as things to draw.
#pragma once

#include "planner/map/frontiers.hpp"
#include "tools/mission/replay.hpp"
#include "tools/render/picture.hpp"

namespace gnbv {

struct FrontierLook {
  Rgb frontier, looked_at, layer;
};
extern const FrontierLook kFrontierLook;

/// The clusters of density frontiers that an FVS decision looked at, numbered in the order in which
/// they were tried, but for numbers that the map hides from that camera and those that would lie
/// over an earlier one's; the chosen one's stands out. Rings join the views of a layer around them,
/// where these lie within the bounds.
void add_frontiers(const FrontierConfig& config, const ReplayedDecision& decision, double unit_m,
                   const RenderView& view, Panel& panel);

}  // namespace gnbv
