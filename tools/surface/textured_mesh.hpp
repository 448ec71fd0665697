// A reconstructed surface with its looks, and the files it goes into.
#pragma once

#include <filesystem>

#include "tools/surface/texture_atlas.hpp"

namespace gnbv {

struct TexturedMesh {
  TriangleMesh shape;                // world, metres, z up
  std::vector<Rgb8> vertex_rgb;      // (vertices)
  std::vector<FaceUv> face_uv = {};  // (faces) texels from the atlas's top left; empty without one
  Image atlas = {};
};

/// Gives each face of the mesh its texture: the charts of the layout as they were baked, and a
/// small swatch below them for each face that no picture shows. Vertices have the mean colour of
/// the charts around them or, where there is none, that of the nearest surface that has; swatches
/// blend those of their corners. Requires a chart.
TexturedMesh with_texture(TriangleMesh mesh, const AtlasLayout& layout, Image baked);

/// Without a texture: colours by height, dark blue at the bottom to yellow at the top.
TexturedMesh with_height_colours(TriangleMesh mesh);

/// Unit normals, means of the faces' around each vertex by area; (vertices).
std::vector<Vec3f> vertex_normals(const TriangleMesh& mesh);

/// Each corner of a face as one of a list of distinct pairs of vertex and texture coordinate, in
/// the order of their first use.
struct DistinctCorners {
  std::vector<std::uint32_t> vertex;
  std::vector<Vec2f> uv;  // as face_uv; empty without
  std::vector<std::array<std::uint32_t, 3>> faces;
};
DistinctCorners distinct_corners(const TexturedMesh& mesh);

/// Writes surface.ply (binary, colours of vertices), surface.obj with surface.mtl and surface.png,
/// and surface.glb (y up, the texture inside; pictures already carry the light of the scene, so
/// that its material is not lit again). Each by rename; the folder exists. Without a texture there
/// is no surface.png, and vertices carry colours everywhere. Returns the paths. Throws BadInput
/// naming what cannot be written.
std::vector<std::filesystem::path> write_surface(const TexturedMesh& mesh,
                                                 const std::filesystem::path& folder);

/// What write_surface() wrote into the folder, of its surface.obj and surface.png: without a
/// texture the colours of the vertices, with one not. Throws BadInput naming the file, and the line
/// of one that it did not write.
TexturedMesh read_surface(const std::filesystem::path& folder);

/// The GLB; `png` holds the atlas as a PNG, and is empty without one.
std::string glb_of(const TexturedMesh& mesh, std::string_view png);

}  // namespace gnbv
