// Laws of a surface's texture: a texel shows what the picture shows there, nothing is taken from a
// picture in which something else stands before it, charts keep apart, and files read back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/srgb.hpp"
#include "sim/mesh/mesh_file.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/surface/surface_picture.hpp"
#include "tools/surface/textured_mesh.hpp"

namespace gnbv {
namespace {

constexpr int kWidth_px = 160;
constexpr int kHeight_px = 120;

/// A camera at height z_m over (x_m, 0) that looks straight down.
TextureView view_from(float x_m, float z_m) {
  Isometry T_world_camera = Isometry::Identity();
  T_world_camera.translate(Vec3(x_m, 0, z_m));
  T_world_camera.rotate(Eigen::AngleAxisd(kPi, Vec3::UnitX()));  // optical axis down
  return {.T_camera_world = T_world_camera.inverse(),
          .p_world_m = Vec3f(x_m, 0, z_m),
          .camera = {.name = "c",
                     .width_px = kWidth_px,
                     .height_px = kHeight_px,
                     .fx_px = 130,
                     .fy_px = 140,
                     .cx_px = 80,
                     .cy_px = 60}};
}

/// A level sheet of 2 n^2 triangles around (x_m, 0), facing up.
void add_sheet(TriangleMesh& mesh, float x_m, float z_m, float side_m, int n) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const auto at = [&](int k) {
        return side_m * (static_cast<float>(k) / static_cast<float>(n) - 0.5F);
      };
      mesh.vertices_m.emplace_back(x_m + at(i), at(j), z_m);
    }
  }
  const auto row = static_cast<std::uint32_t>(n + 1);
  for (std::uint32_t i = 0; i + 1 < row; ++i) {
    for (std::uint32_t j = 0; j + 1 < row; ++j) {
      const std::uint32_t a = first + i * row + j;
      mesh.faces.push_back({a, a + row, a + row + 1});
      mesh.faces.push_back({a, a + row + 1, a + 1});
    }
  }
}

TriangleMesh sheet(float side_m = 1.0F, int n = 20) {
  TriangleMesh mesh;
  add_sheet(mesh, 0.0F, 0.0F, side_m, n);
  return mesh;
}

/// Smooth and without two equal places: red grows to the right, green downwards.
Image gradient(std::uint8_t blue) {
  Image image{kWidth_px, kHeight_px, {}};
  for (int y = 0; y < kHeight_px; ++y) {
    for (int x = 0; x < kWidth_px; ++x) {
      image.rgb.push_back(static_cast<std::uint8_t>(x + 40));
      image.rgb.push_back(static_cast<std::uint8_t>(2 * y));
      image.rgb.push_back(blue);
    }
  }
  return image;
}

/// Without depth images, a face at the sheet's edge has no view: the background is near.
bool is_at_edge(const TriangleMesh& mesh, std::size_t face, float side_m = 1.0F) {
  for (const std::uint32_t v : mesh.faces[face]) {
    const Vec3f& p_m = mesh.vertices_m[v];
    if (p_m.head<2>().cwiseAbs().maxCoeff() > 0.499F * side_m) return true;
  }
  return false;
}

std::vector<std::int32_t> chosen_views(const TriangleMesh& mesh,
                                       const std::vector<TextureView>& views, int threads = 2) {
  const RayScene scene(World{.structure = mesh, .has_ground = false});
  return choose_views(mesh, scene, views, {}, threads);
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
TexturedMesh textured(int threads = 2) {
  TriangleMesh mesh = sheet();
  const std::vector<TextureView> views = {view_from(-0.9F, 2.0F)};
  const AtlasLayout layout = lay_out_atlas(mesh, chosen_views(mesh, views, threads), views, {});
  const Image baked = bake_atlas(
      layout, [](std::uint32_t) { return gradient(200); }, threads);
  return with_texture(std::move(mesh), layout, baked);
}

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

TEST(TexturedMesh, IsTheSameAtAnyNumberOfThreads) {
  const TexturedMesh one = textured(1);
  const TexturedMesh three = textured(3);
  EXPECT_EQ(one.atlas.rgb, three.atlas.rgb);
  EXPECT_EQ(glb_of(one, ""), glb_of(three, ""));
}

std::vector<std::vector<float>> sorted_triangles(const TriangleMesh& mesh) {
  std::vector<std::vector<float>> triangles;
  for (const auto& face : mesh.faces) {
    auto& t = triangles.emplace_back();
    for (const std::uint32_t v : face) {
      for (const float x : mesh.vertices_m[v]) t.push_back(std::round(x * 1e4F));
    }
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

TEST(SurfaceFiles, EachReadsBackWithTheSameFaces) {
  TempFolder temp;
  const TexturedMesh mesh = textured();
  const auto paths = write_surface(mesh, temp.path());
  EXPECT_EQ(paths.size(), 5U);
  for (const char* name : {"surface.glb", "surface.obj", "surface.ply"}) {
    const TriangleMesh back = load_mesh({.path = (temp.path() / name).string()});
    EXPECT_EQ(sorted_triangles(back), sorted_triangles(mesh.shape)) << name;
  }
  EXPECT_EQ(read_png(temp.path() / "surface.png").rgb, mesh.atlas.rgb);
  const auto plain = write_surface(with_height_colours(mesh.shape), temp.path());
  EXPECT_EQ(plain.size(), 3U);
  EXPECT_FALSE(std::filesystem::exists(temp.path() / "surface.png"));
  for (const auto& path : plain) {
    EXPECT_EQ(sorted_triangles(load_mesh({.path = path.string()})), sorted_triangles(mesh.shape));
  }
}

TEST(SurfaceFiles, ReadBackWithTheirLooks) {
  TempFolder temp;
  const auto same_uv = [](const FaceUv& a, const FaceUv& b) {
    return (a[0] - b[0]).norm() + (a[1] - b[1]).norm() + (a[2] - b[2]).norm() < 0.02;  // texels
  };
  for (const TexturedMesh& mesh : {textured(), with_height_colours(sheet(1.0F, 3))}) {
    write_surface(mesh, temp.path());
    const TexturedMesh back = read_surface(temp.path());
    EXPECT_EQ(back.shape.faces, mesh.shape.faces);
    ASSERT_EQ(back.shape.vertices_m.size(), mesh.shape.vertices_m.size());
    EXPECT_EQ(sorted_triangles(back.shape), sorted_triangles(mesh.shape));
    EXPECT_EQ(back.atlas.rgb, mesh.atlas.rgb);
    ASSERT_EQ(back.face_uv.size(), mesh.face_uv.size());
    EXPECT_TRUE(
        std::equal(back.face_uv.begin(), back.face_uv.end(), mesh.face_uv.begin(), same_uv));
    if (mesh.face_uv.empty()) {
      EXPECT_EQ(back.vertex_rgb, mesh.vertex_rgb);
    }
  }
}

TEST(SurfaceFiles, LinesOfOthersAreNamed) {
  TempFolder temp;
  write_surface(with_height_colours(sheet(1.0F, 3)), temp.path());
  const std::string text = read_file(temp.path() / "surface.obj");
  for (const char* line : {"f 1 2 99", "f 1/1 2/2 3/3", "f 1 2", "f 0 1 2", "v 1 2 nan 0 0 0",
                           "v 1 2 3", "v 1 2 3 0 0 1.5", "g what"}) {
    write_file_atomically(temp.path() / "surface.obj", text + line + "\n");
    const auto lines = std::count(text.begin(), text.end(), '\n') + 1;
    try {
      read_surface(temp.path());
      ADD_FAILURE() << line;
    } catch (const BadInput& error) {
      EXPECT_NE(std::string(error.what()).find("surface.obj:" + std::to_string(lines)),
                std::string::npos)
          << error.what();
    }
  }
}

template <typename T>
T value_at(const std::string& bytes, std::size_t at) {
  T value{};
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

TEST(SurfaceFiles, WithoutATextureTheGlbShowsTheColoursOfTheVerticesUnlit) {
  TexturedMesh mesh = with_height_colours(sheet(1.0F, 2));
  for (std::size_t i = 0; i < mesh.vertex_rgb.size(); ++i) {
    const auto level = static_cast<std::uint8_t>(i);  // dark
    mesh.vertex_rgb[i] = {level, static_cast<std::uint8_t>(2 * level), 255};
  }
  const std::string glb = glb_of(mesh, "");
  const auto json_bytes = value_at<std::uint32_t>(glb, 12);
  const auto json = nlohmann::json::parse(glb.substr(20, json_bytes));
  EXPECT_TRUE(json["materials"][0]["extensions"].contains("KHR_materials_unlit"));
  EXPECT_EQ(json["extensionsUsed"][0], "KHR_materials_unlit");
  const auto& attributes = json["meshes"][0]["primitives"][0]["attributes"];
  const auto& accessor = json["accessors"][attributes["COLOR_0"].get<std::size_t>()];
  EXPECT_EQ(accessor["componentType"], 5123);  // unsigned short
  EXPECT_EQ(accessor["normalized"], true);
  const auto& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  const std::size_t begin = 28 + json_bytes + view["byteOffset"].get<std::size_t>();
  const DistinctCorners corners = distinct_corners(mesh);
  for (std::size_t i = 0; i < corners.vertex.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const float linear =
          static_cast<float>(value_at<std::uint16_t>(glb, begin + 8 * i + 2 * k)) / 65535.0F;
      EXPECT_NEAR(255.0F * linear_to_srgb(linear), mesh.vertex_rgb[corners.vertex[i]][k], 0.1F);
    }
    EXPECT_EQ(value_at<std::uint16_t>(glb, begin + 8 * i + 6), 65535);
  }
}

TEST(SurfaceFiles, TheGlbHoldsTheAtlasAndItsCoordinates) {
  const TexturedMesh mesh = textured();
  const std::string png(37, 'p');
  const std::string glb = glb_of(mesh, png);
  const auto word = [&](std::size_t at) { return value_at<std::uint32_t>(glb, at); };
  ASSERT_EQ(glb.substr(0, 4), "glTF");
  ASSERT_EQ(word(8), glb.size());
  const auto json = nlohmann::json::parse(glb.substr(20, word(12)));
  EXPECT_TRUE(json["materials"][0]["extensions"].contains("KHR_materials_unlit"));
  const std::size_t data = 20 + word(12) + 8;
  const auto view_at = [&](std::size_t view) {
    return data + json.at("bufferViews").at(view).at("byteOffset").get<std::size_t>();
  };
  EXPECT_EQ(glb.substr(view_at(json["images"][0]["bufferView"]), png.size()), png);
  const auto& primitive = json["meshes"][0]["primitives"][0];
  const auto begin_of = [&](std::size_t accessor) {
    return view_at(json["accessors"][accessor]["bufferView"]);
  };
  const std::size_t uv = begin_of(primitive["attributes"]["TEXCOORD_0"]);
  const std::size_t indices = begin_of(primitive["indices"]);
  for (std::size_t i = 0; i < 3 * mesh.shape.faces.size(); ++i) {
    std::array<float, 2> read{};
    std::memcpy(read.data(), glb.data() + uv + 8 * word(indices + 4 * i), sizeof read);
    const Vec2f& made = mesh.face_uv[i / 3][i % 3];
    EXPECT_NEAR(read[0] * static_cast<float>(mesh.atlas.width_px), made.x(), 1e-3F);
    EXPECT_NEAR(read[1] * static_cast<float>(mesh.atlas.height_px), made.y(), 1e-3F);
  }
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

}  // namespace
}  // namespace gnbv
