// The structure and what stands around it, as things to draw.
#pragma once

#include "tools/scene/run_source.hpp"
#include "tools/scene/scene.hpp"

namespace gnbv {

/// Appends the corners of the structure: what has to be seen.
void frame_structure(RunSource& run, std::vector<Vec3>& points_world_m);

/// The level ground or the terrain, if the scenario has one.
void add_ground(RunSource& run, RenderScene& scene);
/// Obstacles in one colour, those that move where they stand at first with their ways, and the
/// no-fly boxes as ghosts.
void add_surroundings(RunSource& run, RenderScene& scene);
std::vector<LegendItem> legend_of_surroundings(RunSource& run);
/// Structure and obstacles, where these are then, as pale ghosts, with the ground.
void add_ghost(RunSource& run, float opacity, RenderScene& scene, double time_s = 0.0);
/// The structure as the cameras see it from that view, its surroundings and the ground.
void add_structure(RunSource& run, const RenderView& view, RenderScene& scene);

/// The texture of the first `structure_faces` faces of the scene as that view looks at them,
/// without light. The same at any number of threads.
PaintItem paint_of_structure(const RayScene& scene, std::size_t structure_faces,
                             const RenderView& view, int threads);

}  // namespace gnbv
