// A texture for a surface, cut from the pictures that show it.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "sim/core/image.hpp"
#include "tools/surface/texture_views.hpp"

namespace gnbv {

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

}  // namespace gnbv
