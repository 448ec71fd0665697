// Laws of a surface's files: they hold its shape and its looks, and read back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/image.hpp"
#include "sim/mesh/mesh_file.hpp"
#include "tests/support/fault.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/tools/surface/pictured_sheet.hpp"
#include "tools/surface/textured_mesh.hpp"

namespace gnbv {
namespace {

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
    EXPECT_TRUE(test::says(test::fault_of([&] { read_surface(temp.path()); }),
                           {"surface.obj:" + std::to_string(lines)}))
        << line;
  }
}

/// A GLB taken apart.
struct Glb {
  explicit Glb(const std::string& glb)
      : bytes(glb),
        json(nlohmann::json::parse(glb.substr(20, at<std::uint32_t>(12)))),
        data(28 + at<std::uint32_t>(12)) {
    EXPECT_EQ(glb.substr(0, 4), "glTF");
    EXPECT_EQ(at<std::uint32_t>(8), glb.size());
    EXPECT_TRUE(json["materials"][0]["extensions"].contains("KHR_materials_unlit"));
    EXPECT_EQ(json["extensionsUsed"][0], "KHR_materials_unlit");
  }
  template <typename T>
  T at(std::size_t where) const {
    T value{};
    std::memcpy(&value, bytes.data() + where, sizeof value);
    return value;
  }
  std::size_t view(const nlohmann::json& index) const {
    return data + json["bufferViews"][index.get<std::size_t>()]["byteOffset"].get<std::size_t>();
  }
  const nlohmann::json& accessor(const nlohmann::json& index) const {
    return json["accessors"][index.get<std::size_t>()];
  }

  const std::string& bytes;
  const nlohmann::json json;
  std::size_t data;
};

TEST(SurfaceFiles, WithoutATextureTheGlbShowsTheColoursOfTheVerticesUnlit) {
  TexturedMesh mesh = with_height_colours(sheet(1.0F, 2));
  for (std::size_t i = 0; i < mesh.vertex_rgb.size(); ++i) {
    const auto level = static_cast<std::uint8_t>(i);  // dark
    mesh.vertex_rgb[i] = {level, static_cast<std::uint8_t>(2 * level), 255};
  }
  const std::string bytes = glb_of(mesh, "");
  const Glb glb(bytes);
  const auto& accessor =
      glb.accessor(glb.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"]);
  EXPECT_EQ(accessor["componentType"], 5123);  // unsigned short
  EXPECT_EQ(accessor["normalized"], true);
  const std::size_t begin = glb.view(accessor["bufferView"]);
  const DistinctCorners corners = distinct_corners(mesh);
  for (std::size_t i = 0; i < corners.vertex.size(); ++i) {
    const auto rgba = glb.at<std::array<std::uint16_t, 4>>(begin + 8 * i);
    for (std::size_t k = 0; k < 3; ++k) {
      const float linear = static_cast<float>(rgba[k]) / 65535.0F;
      EXPECT_NEAR(255.0F * linear_to_srgb(linear), mesh.vertex_rgb[corners.vertex[i]][k], 0.1F);
    }
    EXPECT_EQ(rgba[3], 65535);
  }
}

TEST(SurfaceFiles, TheGlbHoldsTheAtlasAndItsCoordinates) {
  const TexturedMesh mesh = textured();
  const std::string png(37, 'p');
  const std::string bytes = glb_of(mesh, png);
  const Glb glb(bytes);
  EXPECT_EQ(bytes.substr(glb.view(glb.json["images"][0]["bufferView"]), png.size()), png);
  const auto& primitive = glb.json["meshes"][0]["primitives"][0];
  const std::size_t uv =
      glb.view(glb.accessor(primitive["attributes"]["TEXCOORD_0"])["bufferView"]);
  const std::size_t indices = glb.view(glb.accessor(primitive["indices"])["bufferView"]);
  for (std::size_t i = 0; i < 3 * mesh.shape.faces.size(); ++i) {
    const auto corner = glb.at<std::uint32_t>(indices + 4 * i);
    const auto read = glb.at<std::array<float, 2>>(uv + 8 * corner);
    const Vec2f& made = mesh.face_uv[i / 3][i % 3];
    EXPECT_NEAR(read[0] * static_cast<float>(mesh.atlas.width_px), made.x(), 1e-3F);
    EXPECT_NEAR(read[1] * static_cast<float>(mesh.atlas.height_px), made.y(), 1e-3F);
  }
}

}  // namespace
}  // namespace gnbv
