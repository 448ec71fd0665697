// Laws of paint: what cameras see of the structure, on a picture of it.
#include <gtest/gtest.h>

#include "sim/mesh/triangle_mesh.hpp"
#include "tools/render/renderer.hpp"
#include "tools/scene/structure.hpp"

namespace gnbv {
namespace {

/// A box in checks, on its own.
World checked_box() {
  World world;
  world.structure = box_mesh(Box3(Vec3(-1.0, -1.0, 0.0), Vec3(1.0, 1.0, 2.0)),
                             Material{.rgb = {0.9F, 0.1F, 0.1F},
                                      .pattern = Pattern::checker,
                                      .rgb_2 = {0.1F, 0.1F, 0.9F},
                                      .pattern_size_m = 0.5F});
  return world;
}

RenderView view_of(const World& world) {
  std::vector<Vec3> corners_m;
  for (const Vec3f& v : world.structure.vertices_m) corners_m.push_back(v.cast<double>());
  return frame_points(corners_m, {deg_to_rad(30.0), deg_to_rad(25.0)}, 160, 120);
}

const std::uint8_t* texel(const PaintItem& paint, int column, int row) {
  return paint.rgba.data() + 4 * (paint.width_px * row + column);
}

TEST(Paint, IsTheTextureWhereTheStructureIsDrawn) {
  const World world = checked_box();
  const RenderView view = view_of(world);
  const PaintItem paint = paint_of_structure(RayScene(world), 12, view, 2);
  // of places on its upper side that lie well inside a check: they project to their own colour
  for (const double x_m : {-0.56, -0.06, 0.44}) {
    for (const double y_m : {-0.56, -0.06, 0.44}) {
      const Vec3 p_m(x_m, y_m, 2.0);
      const Vec3 at_px = project(view, p_m).value();
      const std::uint8_t* const got = texel(paint, static_cast<int>(2.0 * at_px.x()),
                                            static_cast<int>(2.0 * (view.height_px - at_px.y())));
      const auto want = albedo(world.structure.materials[0], p_m.cast<float>(), Vec3f::UnitZ());
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(got[k], 255.0F * linear_to_srgb(want[k]), 0.51F) << x_m << ", " << y_m;
      }
      EXPECT_EQ(got[3], 255);
    }
  }
  EXPECT_EQ(texel(paint, 0, 0)[3], 0);  // nothing is there
}

TEST(Paint, IsTheSameAtAnyNumberOfThreadsAndOfNoFacesNone) {
  const World world = checked_box();
  const RayScene scene(world);
  const RenderView view = view_of(world);
  EXPECT_EQ(paint_of_structure(scene, 12, view, 1).rgba,
            paint_of_structure(scene, 12, view, 3).rgba);
  for (const std::uint8_t byte : paint_of_structure(scene, 0, view, 1).rgba) ASSERT_EQ(byte, 0);
}

/// All in one colour, it is the surface in that colour; where there is none, the mesh's own.
TEST(Paint, IsLitAsTheMeshsOwnColourWouldBe) {
  const World world = checked_box();
  const RenderView view = view_of(world);
  const float green = srgb_to_linear(180.0F / 255.0F);
  RenderScene plain;
  plain.surfaces.emplace_back().mesh = world.structure;
  plain.surfaces[0].vertex_colours.assign(8, {green, green, 0.0F});
  RenderScene painted = plain;
  painted.surfaces[0].is_painted = true;
  painted.paint = PaintItem{.width_px = 320, .height_px = 240};
  painted.paint->rgba.assign(4 * 320 * 240, 0);
  EXPECT_EQ(render(painted, view).rgb, render(plain, view).rgb);
  painted.surfaces[0].vertex_colours.assign(8, {0.3F, 0.0F, 0.9F});
  for (std::size_t i = 0; i < painted.paint->rgba.size(); i += 4) {
    painted.paint->rgba[i] = painted.paint->rgba[i + 1] = 180;
    painted.paint->rgba[i + 3] = 255;
  }
  const Image got = render(painted, view);
  const Image want = render(plain, view);
  for (std::size_t i = 0; i < want.rgb.size(); ++i) {
    ASSERT_NEAR(got.rgb[i], want.rgb[i], 1) << i;  // Mesa decodes sRGB by a table
  }
}

}  // namespace
}  // namespace gnbv
