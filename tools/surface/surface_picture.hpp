// Pictures of a reconstructed surface.
#pragma once

#include "tools/scene/scene.hpp"
#include "tools/surface/textured_mesh.hpp"

namespace gnbv {

/// The surface with the colours of its vertices, as a thing to draw.
SurfaceItem surface_item(const TexturedMesh& mesh);

/// The surface with its texture where it has one, as a thing to draw: faces are split so that no
/// piece is longer than `piece_m`, or than a 64th of its face, and a piece's corners have the
/// texture's colours there. Pictures carry their own light: it is not lit again.
SurfaceItem textured_item(const TexturedMesh& mesh, double piece_m);

/// The surface as its pictures show it on a ground with a metre grid, framed and titled. Throws
/// BadInput as Renderer does.
Image surface_picture(const TexturedMesh& mesh, const std::string& title);

/// The same coloured by the distance to the truth, from nothing to the end of error_scale() and
/// beyond. One distance a vertex.
Image error_picture(const TriangleMesh& mesh, std::span<const double> errors_m,
                    const std::string& title);

}  // namespace gnbv
