// A picture of a reconstructed surface.
#pragma once

#include "tools/render/scene.hpp"
#include "tools/surface/textured_mesh.hpp"

namespace gnbv {

/// The surface with the colours of its vertices, as a thing to draw.
SurfaceItem surface_item(const TexturedMesh& mesh);

/// The surface with the colours of its vertices on a ground with a metre grid, framed. Throws
/// BadInput as Renderer does.
Image surface_picture(const TexturedMesh& mesh, int width_px, int height_px,
                      const ViewAngles& angles = {});

}  // namespace gnbv
