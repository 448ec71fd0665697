// What the adaptive grid samples, as things to draw.
#pragma once

#include "planner/guided/view_sampling.hpp"
#include "tools/scene/scene.hpp"

namespace gnbv {

/// The views that the grid offers around `from` at a scale, before any is checked: a ball a
/// position, and a short line a direction. The place of `from` is black.
void add_grid_samples(const AgvsConfig& config, const ViewPose& from, double scale, double unit_m,
                      RenderScene& scene);

/// From there, so that the samples of the largest of those scales are in the picture.
RenderView view_of_grid_samples(const AgvsConfig& config, const ViewPose& from, double largest,
                                const ViewAngles& angles, int width_px, int height_px);

}  // namespace gnbv
