// What a picture shows, as plain data. Everything is in world coordinates (metres, z up) and linear
// colour; new kinds of things become new lists here.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "sim/core/image.hpp"
#include "sim/mesh/triangle_mesh.hpp"
#include "tools/scene/colour.hpp"
#include "tools/render/view.hpp"

namespace gnbv {

/// Lit triangles, seen from both sides. Edges sharper than the crease stay sharp,
/// others are smooth.
struct SurfaceItem {
  TriangleMesh mesh;
  std::vector<Rgb> vertex_colours;       // (n) as mesh.vertices_m; empty = colours of the materials
  double crease_rad = deg_to_rad(35.0);  // 0: every face is flat
  float opacity = 1.0F;  // under 1: a ghost, of which only the nearest layer is drawn
  bool is_lit = true;    // else its colours are what is seen: they carry light already
  bool is_painted =
      false;  // opaque: its colours are those of the scene's paint, where there is any
  bool casts_shadow = true;  // terrain casts none: its size says nothing of the scene's
};

/// A lit tube along a polyline with round joints and ends.
struct TubeItem {
  std::vector<Vec3f> points_m;
  std::vector<Rgb> colours;  // one a point, or one for all
  float radius_m = 0.05F;
  bool casts_shadow = false;  // a long path would hatch what lies below it
};

/// A lit ball; small ones draw a point cloud.
struct BallItem {
  Vec3f centre_m = Vec3f::Zero();
  float radius_m = 0.1F;
  Rgb colour = {0.5F, 0.5F, 0.5F};
  bool casts_shadow = false;
};

/// A point cloud as round dots: cheaper than balls by far, for millions of points.
struct DotsItem {
  std::vector<Vec3f> points_m = {};
  std::vector<Vec3f> normals = {};  // (n), unit, either side; empty: lit from everywhere
  std::vector<Rgb> colours = {};    // (n), or one for all
  float radius_m = 0.02F;
  bool casts_shadow = true;
};

/// The pyramid a camera sees, out to `length_m` along its axis.
struct FrustumItem {
  Isometry T_world_camera = Isometry::Identity();  // optical frame
  double fov_x_rad = deg_to_rad(60.0);
  double fov_y_rad = deg_to_rad(45.0);
  double length_m = 1.0;
  float edge_radius_m = 0.02F;
  Rgb colour = {0.5F, 0.5F, 0.5F};
  float face_opacity = 0.0F;  // 0: edges only
};

/// A level plane with grid lines that fades out around the scene; it receives shadows.
struct GroundItem {
  double z_m = 0.0;
  double minor_m = 1.0;
  double major_m = 5.0;
};

/// Colours of what a view looks at, of the size at which a picture of that view is drawn: 2 x 2 for
/// each of its pixels.
struct PaintItem {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgba =
      {};  // (height, width, 4), sRGB, rows from the bottom; 0 0 0 0: none
};

/// RenderScene::shading of pictures whose colours are data.
constexpr float kDataShading = 0.45F;

struct RenderScene {
  std::vector<SurfaceItem> surfaces;
  std::vector<TubeItem> tubes;
  std::vector<BallItem> balls;
  std::vector<DotsItem> dots;
  std::vector<FrustumItem> frusta;
  std::optional<GroundItem> ground;
  std::optional<PaintItem> paint;
  /// How far from each other surfaces darken their hollows at most; nothing: as suits the view.
  std::optional<double> hollow_m = {};
  /// Of what light and haze do to colours, how much: less where a legend says what they mean.
  float shading = 1.0F;
  /// One of a series that shows no more than what lies in this box, as a film: light, haze and
  /// shadows stay the same throughout, and a renderer draws again only what has changed.
  std::optional<Box3> series_box_m = {};
};

/// Draws scenes off screen with OSMesa, which is loaded here, at run time. Use from one thread.
class Renderer {
 public:
  /// Throws BadInput when the OSMesa library is missing or too old, naming the Debian package.
  Renderer();
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// The same scene and view give the same bytes. Throws BadInput for a size outside
  /// [1, kMaxSide_px], or of more than kMaxArea_px.
  Image render(const RenderScene& scene, const RenderView& view);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Mesa's largest target is 16384 px and every pixel is drawn as 2 x 2.
constexpr int kMaxSide_px = 8192;
/// An 8K picture: 1 GB of colour and depth while it is drawn.
constexpr std::int64_t kMaxArea_px = 7680 * 4320;

/// One picture with a renderer of its own (about 50 ms dearer than a kept one).
Image render(const RenderScene& scene, const RenderView& view);

}  // namespace gnbv
