// A run as plain data: primitives with places and colours, and what words say of them. Everything
// is in world coordinates (metres, z up) and linear colour.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/image.hpp"
#include "sim/mesh/triangle_mesh.hpp"
#include "tools/scene/looks.hpp"
#include "tools/scene/view.hpp"

namespace gnbv {

/// Lit triangles, seen from both sides. Edges sharper than the crease stay sharp, others are
/// smooth.
struct SurfaceItem {
  TriangleMesh mesh = {};
  std::vector<Rgb> vertex_colours = {};  // (n) as mesh.vertices_m; empty: the materials' colours
  double crease_rad = deg_to_rad(35.0);  // 0: every face is flat
  float opacity = 1.0F;      // under 1: a ghost, of which only the nearest layer is drawn
  bool is_lit = true;        // else its colours are what is seen: they carry light already
  bool is_painted = false;   // opaque: its colours are the scene's paint, where there is any
  bool casts_shadow = true;  // terrain casts none: its size says nothing of the scene's
};

/// A lit tube along a polyline with round joints and ends.
struct TubeItem {
  std::vector<Vec3f> points_m;
  std::vector<Rgb> colours;  // one a point, or one for all
  float radius_m = 0.05F;
  bool casts_shadow = false;  // a long path would hatch what lies below it
};

/// A lit ball.
struct BallItem {
  Vec3f centre_m = Vec3f::Zero();
  float radius_m = 0.1F;
  Rgb colour = {0.5F, 0.5F, 0.5F};
  bool casts_shadow = false;
};

/// A point cloud as round dots: cheaper than balls by far, for millions of points. They cast
/// shadows.
struct DotsItem {
  std::vector<Vec3f> points_m = {};
  std::vector<Vec3f> normals = {};  // (n), unit, either side; empty: lit from everywhere
  std::vector<Rgb> colours = {};    // (n), or one for all
  float radius_m = 0.02F;
};

/// The pyramid around what a camera sees, out to `length_m` along its axis.
struct FrustumItem {
  Isometry T_world_camera = Isometry::Identity();  // optical frame
  Eigen::AlignedBox2d sight = {Eigen::Vector2d(-0.577, -0.414), Eigen::Vector2d(0.577, 0.414)};
  bool is_radial = false;  // its corners are length_m away
  double length_m = 1.0;
  float edge_radius_m = 0.02F;
  Rgb colour = {0.5F, 0.5F, 0.5F};
  float face_opacity = 0.0F;  // 0: edges only
};

/// Where its pyramid ends: around its axis.
inline std::array<Vec3, 4> far_corners_m(const FrustumItem& item) {
  const auto corner = [&](double x, double y) -> Vec3 {
    const Vec3 along = Vec3(x, y, 1.0) / (item.is_radial ? std::hypot(x, y, 1.0) : 1.0);
    return item.T_world_camera * Vec3(item.length_m * along);
  };
  const Eigen::Vector2d low = item.sight.min();
  const Eigen::Vector2d high = item.sight.max();
  return {corner(low.x(), low.y()), corner(high.x(), low.y()), corner(high.x(), high.y()),
          corner(low.x(), high.y())};
}

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
  /// (height, width, 4), sRGB, rows from the bottom; 0 0 0 0: none.
  std::vector<std::uint8_t> rgba = {};
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

  void add_ball(const Vec3& centre_m, double radius_m, const Rgb& colour,
                bool casts_shadow = false) {
    balls.push_back({centre_m.cast<float>(), static_cast<float>(radius_m), colour, casts_shadow});
  }
  /// A tube of one piece.
  void add_line(const Vec3& from_m, const Vec3& to_m, double radius_m, const Rgb& colour,
                bool casts_shadow = false) {
    tubes.push_back({{from_m.cast<float>(), to_m.cast<float>()},
                     {colour},
                     static_cast<float>(radius_m),
                     casts_shadow});
  }
};

/// What one colour, or one run of colours, means.
struct LegendItem {
  enum class Mark { line, dot, ring, square, pyramid };
  std::string label = {};
  std::vector<Rgb> colours = {};  // one, or those of a bar from its low end to its high end
  Mark mark = Mark::square;       // of a single colour
  std::string label_before = {};  // of a bar: at its low end; of others: of the row it begins
  bool begins_row = false;
  std::string label_middle = {};  // of a bar: what its middle stands for, set upon it

  bool operator==(const LegendItem&) const = default;
};

/// The entry of a thing, under its own words and perhaps more.
inline LegendItem entry(const Look& look, LegendItem::Mark mark = LegendItem::Mark::square,
                        const std::string& more = "") {
  return {std::string(look.words) + more, {look.rgb()}, mark};
}

/// What colours mean from their low end to their high one.
inline LegendItem bar(const std::vector<Rgb>& colours, const std::string& low,
                      const std::string& high, const std::string& middle = "") {
  return {.label = high, .colours = colours, .label_before = low, .label_middle = middle};
}

/// Words beside a place in the world; or on it, white on a badge of a colour, which is left out
/// where it would lie on an earlier one.
struct PlaceLabel {
  Vec3 p_world_m;
  std::string text;
  std::optional<Rgb> badge = {};
};

/// A line between two places that shows through everything, edged in white; a dot where they are
/// one.
struct PlaceLine {
  Vec3 from_world_m, to_world_m;
  Rgb colour;
  double width = 0.0;  // layout units
};

/// One scene of a picture that may hold several, side by side.
struct Panel {
  RenderScene scene;
  std::string note = {};                // over the panel
  std::vector<PlaceLine> lines = {};    // over the scene, the last one uppermost
  std::vector<PlaceLabel> labels = {};  // over everything
  std::optional<RenderView> view = {};  // instead of the layout's, of its size
};

struct Picture {
  std::vector<Panel> panels = {};
  std::string detail = {};  // one line of figures
  std::vector<LegendItem> legend = {};
  Image inset = {};              // small, in the upper right corner; empty: none
  std::string inset_words = {};  // under it
};

}  // namespace gnbv
