// A reconstructed surface with its looks, and the files it goes into.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "sim/core/image.hpp"
#include "tools/surface/texture_views.hpp"

namespace gnbv {

// ---- texture_atlas.cpp: a texture, cut from the pictures that show the surface

using FaceUv = std::array<Vec2f, 3>;

/// A rectangle of a picture, scaled, in the atlas: faces that hang together and share a view.
struct Chart {
  std::uint32_t view = 0;
  std::vector<std::uint32_t> faces;
  float scale = 1.0F;               // texels a picture's pixel, at most 1
  Vec2f origin_px = Vec2f::Zero();  // of the picture; lies kGutter_px texels inside the rectangle
  int x = 0;                        // the rectangle in the atlas, gutter included
  int y = 0;
  int width = 0;
  int height = 0;

  /// Atlas coordinates in texels of a point of the picture.
  Vec2f texel_of(const Vec2f& p_px) const;
  /// The point of the picture that the middle of texel (column, row) of the rectangle shows.
  Vec2f pixel_of(int column, int row) const;
};

/// Texels around each chart that show what lies around it in the picture, so that no filter mixes
/// in another chart.
constexpr int kGutter_px = 2;

/// Below the charts each face without a view has a swatch of 2 x 2 texels; their height in an atlas
/// of that width.
int swatches_height_px(std::size_t faces_without_view, int atlas_width_px);

struct AtlasLayout {
  int width = 0;
  int height = 0;             // of the charts
  double texels_per_m = 0.0;  // no chart has more
  std::vector<Chart> charts = {};
  std::vector<FaceUv> face_uv =
      {};  // (faces) texels from the top left; -1 for faces without a view
};

struct AtlasSettings {
  double texels_per_m = 100.0;  // at most; fewer where the pictures have fewer, or to fit
  int max_side_px = 8192;
};

/// Charts of the faces by their views, and where each lies. As fine as the settings, the pictures
/// and the largest atlas, swatches included, allow. No charts when no face has a view.
AtlasLayout lay_out_atlas(const TriangleMesh& mesh, std::span<const std::int32_t> chosen,
                          std::span<const TextureView> views, const AtlasSettings& settings);

/// The charts filled from their pictures, bilinearly or, scaled down, by the mean over each texel;
/// grey between them. `picture(view)` reads one; it is called once a view, from any thread.
Image bake_atlas(const AtlasLayout& layout, const std::function<Image(std::uint32_t view)>& picture,
                 int threads);

/// The picture's colour between pixel centres, those beyond its border like those on it; sRGB in
/// [0, 255].
Vec3f bilinear(const Image& image, const Vec2f& p_px);

// ---- textured_mesh.cpp, surface_files.cpp and glb_file.cpp

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
