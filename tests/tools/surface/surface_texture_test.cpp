// Laws of a surface's texture: a texel shows what the picture shows there, nothing is taken from a
// picture in which something else stands before it, and charts keep apart.
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/core/image.hpp"
#include "tests/tools/surface/pictured_sheet.hpp"
#include "tools/scene/colour.hpp"
#include "tools/surface/surface_picture.hpp"
#include "tools/surface/textured_mesh.hpp"

namespace gnbv {
namespace {

/// Without depth images, a face at the sheet's edge has no view: the background is near.
bool is_at_edge(const TriangleMesh& mesh, std::size_t face, float side_m = 1.0F) {
  for (const std::uint32_t v : mesh.faces[face]) {
    const Vec3f& p_m = mesh.vertices_m[v];
    if (p_m.head<2>().cwiseAbs().maxCoeff() > 0.499F * side_m) return true;
  }
  return false;
}

TEST(Texture, ATexelHasTheColourOfThePixelItProjectsTo) {
  const TriangleMesh mesh = sheet();
  const std::vector<TextureView> views = {view_from(0.1F, 2.0F)};
  const auto chosen = chosen_views(mesh, views);
  for (const double texels_per_m : {1000.0, 30.0}) {  // as it is, and scaled down
    const AtlasLayout layout =
        lay_out_atlas(mesh, chosen, views, {.texels_per_m = texels_per_m, .max_side_px = 512});
    ASSERT_EQ(layout.charts.size(), 1U);
    const Image atlas = bake_atlas(
        layout, [](std::uint32_t) { return gradient(9); }, 2);
    for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
      // the middle of the face, by its texture coordinates and by the camera
      const FaceUv& uv = layout.face_uv[face];
      ASSERT_EQ(uv[0].x() < 0.0F, is_at_edge(mesh, face));
      if (is_at_edge(mesh, face)) continue;
      Vec3f middle_m = Vec3f::Zero();
      for (const std::uint32_t v : mesh.faces[face]) middle_m += mesh.vertices_m[v] / 3.0F;
      const Vec3f drawn = bilinear(atlas, (uv[0] + uv[1] + uv[2]) / 3.0F);
      const Vec2f pixel = views[0].pixel_of(middle_m);
      const Vec3f seen(pixel.x() - 0.5F + 40.0F, 2.0F * (pixel.y() - 0.5F), 9.0F);
      EXPECT_LT((drawn - seen).cwiseAbs().maxCoeff(), 1.1F) << texels_per_m;  // two roundings
    }
  }
}

TEST(Texture, APictureWithSomethingInBetweenIsNotUsed) {
  TriangleMesh mesh = sheet();
  const std::size_t below = mesh.faces.size();
  add_sheet(mesh, 0.0F, 0.5F, 0.4F, 8);
  const std::vector<TextureView> views = {view_from(0.0F, 2.0F)};
  const auto chosen = chosen_views(mesh, views);
  const auto shadow_m = 0.5F * 0.4F / 1.5F * 2.0F;  // half side of what the upper sheet hides
  for (std::size_t face = 0; face < below; ++face) {
    float farthest_m = 0.0F;
    float nearest_m = 10.0F;
    for (const std::uint32_t v : mesh.faces[face]) {
      const float m = mesh.vertices_m[v].head<2>().cwiseAbs().maxCoeff();
      farthest_m = std::max(farthest_m, m);
      nearest_m = std::min(nearest_m, m);
    }
    if (nearest_m < shadow_m) {
      EXPECT_EQ(chosen[face], kNoView);
    }
    if (nearest_m > shadow_m + 0.06F && !is_at_edge(mesh, face)) {
      EXPECT_EQ(chosen[face], 0);
    }
  }
  // a second camera that sees past the upper sheet serves what the first one cannot
  const auto both = chosen_views(mesh, {views[0], view_from(-1.2F, 2.0F)});
  EXPECT_GT(std::count(both.begin(), both.begin() + static_cast<std::ptrdiff_t>(below), 1), 0);
}

TEST(Texture, AFaceThatTurnsAwayOrLeavesThePictureHasNoView) {
  TriangleMesh turned = sheet();
  for (auto& f : turned.faces) std::swap(f[1], f[2]);
  for (const std::int32_t view : chosen_views(turned, {view_from(0.0F, 2.0F)})) {
    EXPECT_EQ(view, kNoView);
  }
  const TriangleMesh wide = sheet(8.0F, 40);
  const std::vector<TextureView> views = {view_from(0.0F, 2.0F)};
  const auto chosen = chosen_views(wide, views);
  for (std::size_t face = 0; face < wide.faces.size(); ++face) {
    bool is_inside = true;
    for (const std::uint32_t v : wide.faces[face]) {  // its own edge is far outside
      const Vec2f px = views[0].pixel_of(wide.vertices_m[v]);
      is_inside = is_inside && px.x() >= 1 && px.x() <= kWidth_px - 1 && px.y() >= 1 &&
                  px.y() <= kHeight_px - 1;
    }
    EXPECT_EQ(chosen[face], is_inside ? 0 : kNoView);
  }
}

TEST(Texture, TheNearerAndTheMoreFrontalPictureServesAFace) {
  const TriangleMesh mesh = sheet();
  const auto inner = [&](const std::vector<TextureView>& views) {
    const auto chosen = chosen_views(mesh, views);
    return chosen[mesh.faces.size() / 2 + 20];  // in the middle of the sheet
  };
  EXPECT_EQ(inner({view_from(0.0F, 4.0F), view_from(0.0F, 2.0F)}), 1);
  EXPECT_EQ(inner({view_from(0.0F, 2.0F), view_from(0.0F, 4.0F)}), 0);
  // both 2.5 m away, one of them 37 degrees off
  EXPECT_EQ(inner({view_from(-1.5F, 2.0F), view_from(0.0F, 2.5F)}), 1);
}

/// Of pictures that are about as good, two show a part of the sheet and one shows all of it.
TEST(Texture, ThePictureThatShowsTheMostTakesItAll) {
  const TriangleMesh mesh = sheet();
  const auto chosen =
      chosen_views(mesh, {view_from(-1.0F, 2.0F), view_from(0.0F, 2.1F), view_from(1.0F, 2.0F)});
  for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
    EXPECT_EQ(chosen[face], is_at_edge(mesh, face) ? kNoView : 1);
  }
}

TEST(Texture, APictureWhoseDepthDisagreesIsNotUsed) {
  const TriangleMesh mesh = sheet();
  const auto view_at = [](float z_m, std::uint16_t depth_mm, double range_max_m) {
    TextureView view = view_from(0.0F, z_m);
    view.depth_steps = {kWidth_px, kHeight_px, {}};
    view.depth_steps.values.assign(static_cast<std::size_t>(kWidth_px) * kHeight_px, depth_mm);
    view.range_max_m = range_max_m;
    return view;
  };
  const auto all_are = [&](std::int32_t wanted, const std::vector<TextureView>& views) {
    const auto chosen = chosen_views(mesh, views);
    return std::all_of(chosen.begin(), chosen.end(),
                       [&](std::int32_t view) { return view == wanted; });
  };
  // the nearer one saw something else there; and with agreeing depth, no edge is too near
  EXPECT_TRUE(all_are(1, {view_at(1.5F, 1800, 8.0), view_at(1.8F, 1800, 8.0)}));
  EXPECT_TRUE(all_are(kNoView, {view_at(1.5F, 1800, 8.0)}));
  EXPECT_TRUE(all_are(kNoView, {view_at(1.5F, 0, 8.0)}));  // sky
  // beyond the range nothing is measured: better than none, but no more, and nothing at the edge
  const auto beyond = chosen_views(mesh, {view_at(1.5F, 0, 1.0)});
  for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
    EXPECT_EQ(beyond[face], is_at_edge(mesh, face) ? kNoView : 0);
  }
  EXPECT_TRUE(all_are(1, {view_at(1.5F, 0, 1.0), view_at(1.8F, 1800, 8.0)}));
}

TEST(Atlas, ChartsHoldTheirFacesAndKeepApart) {
  TriangleMesh mesh = sheet(1.0F, 10);
  add_sheet(mesh, 3.0F, 0.2F, 1.0F, 10);
  add_sheet(mesh, 6.0F, 0.4F, 0.5F, 10);
  const std::vector<TextureView> views = {view_from(0.0F, 2.0F), view_from(3.0F, 2.0F),
                                          view_from(6.0F, 2.0F)};
  const AtlasLayout layout = lay_out_atlas(mesh, chosen_views(mesh, views), views,
                                           {.texels_per_m = 50, .max_side_px = 256});
  ASSERT_GE(layout.charts.size(), 3U);
  std::vector<int> owners(static_cast<std::size_t>(layout.width) *
                          static_cast<std::size_t>(layout.height));
  for (const Chart& chart : layout.charts) {
    for (int i = 0; i < chart.width * chart.height; ++i) {
      const int x = chart.x + i % chart.width;
      const int y = chart.y + i / chart.width;
      ASSERT_TRUE(x >= 0 && y >= 0 && x < layout.width && y < layout.height);
      EXPECT_EQ(owners[static_cast<std::size_t>(y * layout.width + x)]++, 0);
    }
    for (const std::uint32_t face : chart.faces) {
      for (const Vec2f& uv : layout.face_uv[face]) {  // with the gutter around
        EXPECT_GE(uv.x(), static_cast<float>(chart.x + kGutter_px));
        EXPECT_GE(uv.y(), static_cast<float>(chart.y + kGutter_px));
        EXPECT_LE(uv.x(), static_cast<float>(chart.x + chart.width - kGutter_px));
        EXPECT_LE(uv.y(), static_cast<float>(chart.y + chart.height - kGutter_px));
      }
    }
  }
}

TEST(Atlas, IsNeverLargerThanAllowedButCoarser) {
  const TriangleMesh mesh = sheet();
  const std::vector<TextureView> views = {view_from(0.0F, 2.0F)};
  const auto chosen = chosen_views(mesh, views);
  const AtlasLayout fine = lay_out_atlas(mesh, chosen, views, {.max_side_px = 512});
  const AtlasLayout coarse = lay_out_atlas(mesh, chosen, views, {.max_side_px = 64});
  EXPECT_LE(coarse.height + swatches_height_px(152, coarse.width), 64);  // those at the edge
  EXPECT_LE(coarse.width, 64);
  EXPECT_LT(coarse.texels_per_m, fine.texels_per_m);
}

/// The sheet textured from one picture, its right third unseen.
TEST(TexturedMesh, FacesThatNoPictureShowsHaveTheirNeighboursColours) {
  const TexturedMesh mesh = textured();
  std::size_t swatches = 0;
  for (std::size_t face = 0; face < mesh.shape.faces.size(); ++face) {
    const FaceUv& uv = mesh.face_uv[face];
    ASSERT_GE(uv[0].x(), 0.0F);
    if (uv[0] + Vec2f(1, 0) != uv[1] || uv[0] + Vec2f(0, 1) != uv[2]) continue;
    ++swatches;
    for (std::size_t k = 0; k < 3; ++k) {
      const Rgb8& rgb = mesh.vertex_rgb[mesh.shape.faces[face][k]];
      const Vec3f drawn = bilinear(mesh.atlas, uv[k]);
      EXPECT_EQ(drawn, Vec3f(rgb[0], rgb[1], rgb[2]));
      EXPECT_EQ(drawn.z(), 200.0F);  // blue is the same all over
    }
  }
  EXPECT_GT(swatches, 50U);
  EXPECT_LT(swatches, mesh.shape.faces.size() / 2);
  for (const Rgb8& rgb : mesh.vertex_rgb) EXPECT_EQ(rgb[2], 200);
}

TEST(SurfacePicture, PiecesHaveTheTexturesColoursAndTheFacesArea) {
  TexturedMesh mesh;
  mesh.shape.vertices_m = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  mesh.shape.faces = {{0, 1, 2}};
  mesh.vertex_rgb.assign(3, {0, 0, 0});
  mesh.atlas = {8, 8, std::vector<std::uint8_t>(192, 0)};
  for (std::size_t i = 0; i < 192; i += 3) mesh.atlas.rgb[i] = 200;  // red wherever one looks
  mesh.face_uv = {{Vec2f(1, 1), Vec2f(6, 1), Vec2f(1, 6)}};
  const SurfaceItem item = textured_item(mesh, 1.0);
  EXPECT_FALSE(item.is_lit);
  EXPECT_EQ(item.mesh.faces.size(), 36U);  // an edge of 5.66 m in six
  EXPECT_NEAR(surface_area_m2(item.mesh), 8.0, 1e-4);
  for (const Rgb& colour : item.vertex_colours) {
    EXPECT_NEAR(colour[0], srgb(0xc80000)[0], 1e-5F);
    EXPECT_EQ(colour[1], 0.0F);
  }
}

/// An axis on which nearly all is pale would show no error.
TEST(SurfacePicture, ErrorsHaveAnAxisOfTheirOwnLength) {
  EXPECT_EQ(error_scale({}).most_m, 0.001);
  for (const auto& [most_m, end_m] :
       {std::pair{0.0004, 0.001}, std::pair{0.009, 0.01}, std::pair{0.01, 0.01},
        std::pair{0.011, 0.02}, std::pair{0.021, 0.05}, std::pair{0.06, 0.1}}) {
    std::vector<double> errors_m(100, 0.2 * most_m);
    std::fill_n(errors_m.begin(), 8, most_m);  // up to it stay 97 of 100
    std::fill_n(errors_m.begin(), 3, 10.0);
    EXPECT_NEAR(error_scale(errors_m).most_m, end_m, 1e-12) << most_m;
  }
}

}  // namespace
}  // namespace gnbv
