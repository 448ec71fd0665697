// What cameras see of the structure, laid over a picture of it.
#pragma once

#include "sensors/ray_scene.hpp"
#include "tools/render/scene.hpp"

namespace gnbv {

/// The texture of the first `structure_faces` faces of the scene as that view looks at them,
/// without light. The same at any number of threads.
PaintItem paint_of_structure(const RayScene& scene, std::size_t structure_faces,
                             const RenderView& view, int threads);

}  // namespace gnbv
