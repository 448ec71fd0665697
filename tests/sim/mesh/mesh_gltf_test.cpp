// glTF files as programs write them: the shape is what the scene shows, or the file is refused by
// what it is.
#include <gtest/gtest.h>

#include "sim/core/file.hpp"
#include "tests/sim/mesh/mesh_files.hpp"

namespace gnbv {
namespace {

using namespace test;

/// A triangle (0,0,0) (1,0,0) (0,1,0), three numbers of `T` a corner, and what else stands in the
/// file: of the node, the mesh, the primitive and the root.
struct Gltf {
  std::string node, mesh, primitive, root;
  std::string position = R"("bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3")";
  std::string indices = R"("bufferView": 1, "componentType": 5121, "count": 3, "type": "SCALAR")";
  std::string more_accessors, more_views, more_bytes;
  std::string uri;

  std::string bytes() const {
    std::string out;
    for (const float x : {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F})
      append_bytes(out, x);
    return out + std::string("\0\1\2\0", 4) + more_bytes;
  }
  std::string json() const {
    return fmt::format(
        R"({{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0, 1]}}],
"nodes": [{{"mesh": 0{}}}, {{"scale": [2, 2, 2]}}],
"meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0{}}}, "indices": 1}}]{}}}],
"accessors": [{{{}}}, {{{}}}{}],
"bufferViews": [{{"buffer": 0, "byteLength": 36}},
 {{"buffer": 0, "byteOffset": 36, "byteLength": 3}}{}],
"buffers": [{{"byteLength": {}, "uri": "{}"}}]{}}})",
        node, primitive, mesh, position, indices, more_accessors, more_views, bytes().size(),
        uri.empty() ? data_uri(bytes()) : uri, root);
  }
};

class GltfFile : public MeshFile {
 protected:
  /// Extent of the triangle of a glTF file: x, z up, and its area.
  void expect_triangle(const Gltf& gltf, const Box3& box_m, double area_m2, const char* what) {
    const MeshReading found = read("t.gltf", gltf.json());
    EXPECT_TRUE(bounds_m(found.mesh).isApprox(box_m, 1e-6))
        << what << bounds_m(found.mesh).max().transpose();
    EXPECT_NEAR(surface_area_m2(found.mesh), area_m2, 1e-6) << what;
  }
};

TEST_F(GltfFile, ShapesAreAsTheSceneShowsThem) {
  Gltf morphed;
  morphed.mesh = R"(, "weights": [0.5])";
  std::string text =
      replaced(morphed.json(), "\"indices\": 1", R"("indices": 1, "targets": [{"POSITION": 0}])");
  EXPECT_NEAR(surface_area_m2(read("t.gltf", text).mesh), 0.5 * 1.5 * 1.5, 1e-6);
  text = replaced(text, "\"mesh\": 0", R"("mesh": 0, "weights": [1])");
  EXPECT_NEAR(surface_area_m2(read("t.gltf", text).mesh), 0.5 * 4.0, 1e-6);

  Gltf skinned;  // wholly by the second node, whose scale is 2
  skinned.node = R"(, "skin": 0, "translation": [5, 0, 0])";
  skinned.root = R"(, "skins": [{"joints": [1]}])";
  skinned.primitive = R"(, "JOINTS_0": 2, "WEIGHTS_0": 3)";
  skinned.more_accessors =
      R"(, {"componentType": 5121, "count": 3, "type": "VEC4"},
 {"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC4"})";
  skinned.more_views = R"(, {"buffer": 0, "byteOffset": 40, "byteLength": 48})";
  for (int i = 0; i < 3; ++i) {
    for (const float weight : {1.0F, 0.0F, 0.0F, 0.0F}) append_bytes(skinned.more_bytes, weight);
  }
  expect_triangle(skinned, Box3(Vec3(0, 0, 0), Vec3(2, 0, 2)), 2.0, "skin");

  Gltf spread;
  spread.node =
      R"(, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}})";
  spread.root = R"(, "extensionsRequired": ["EXT_mesh_gpu_instancing"])";
  expect_triangle(spread, Box3(Vec3(0, 0, 0), Vec3(2, 0, 2)), 1.5, "three instances");

  Gltf quantized;
  quantized.position = R"("bufferView": 2, "componentType": 5122, "count": 3, "type": "VEC3",
 "normalized": true)";
  quantized.root = R"(, "extensionsRequired": ["KHR_mesh_quantization", "KHR_texture_basisu"])";
  quantized.more_views = R"(, {"buffer": 0, "byteOffset": 40, "byteLength": 24, "byteStride": 8})";
  for (const int x : {0, 0, 0, 0, 32767, 0, 0, 0, 0, 32767, 0, 0}) {
    append_bytes(quantized.more_bytes, static_cast<std::int16_t>(x));
  }
  expect_triangle(quantized, Box3(Vec3(0, 0, 0), Vec3(1, 0, 1)), 0.5, "quantized");
  quantized.position.resize(quantized.position.find(",\n"));
  expect_triangle(quantized, Box3(Vec3(0, 0, 0), Vec3(32767, 0, 32767)), 0.5 * 32767.0 * 32767.0,
                  "integers");
}

TEST_F(GltfFile, NodesPlaceTheirMeshesWithYUp) {
  Gltf turned;
  turned.node = R"(, "rotation": [0, 0.70710678, 0, 0.70710678], "scale": [2, 2, 2]}, {"mesh": 0,
 "matrix": [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1])";
  turned.primitive = R"(}, "material": 0, "extras": {)";
  turned.root = R"(, "materials": [{"name": "brass", "pbrMetallicRoughness": {"baseColorFactor":
 [0.5, 0.25, 0.125, 1]}}])";
  const std::string text = replaced(replaced(turned.json(), "\"scale\": [2, 2, 2]}]",
                                             "\"translation\": [10, 0, 0], \"children\": [0]}]"),
                                    "[0, 1]", "[1, 2]");
  const TriangleMesh mesh = read("t.gltf", text).mesh;
  ASSERT_EQ(mesh.faces.size(), 2U);
  // turned about y, (x, y, z) becomes (z, y, -x); y up, (x, y, z) becomes (x, -z, y)
  const auto [a, b, c] = face_corners_m(mesh, 1);
  EXPECT_LT((a - Vec3(10, 0, 0)).norm() + (b - Vec3(10, 2, 0)).norm(), 1e-5);
  EXPECT_LT((c - Vec3(10, 0, 2)).norm(), 1e-5);
  // the mirrored one keeps its front
  const auto mirrored = face_corners_m(mesh, 0);
  EXPECT_LT((mirrored[0] - Vec3(0, -5, 0)).norm() + (mirrored[2] - Vec3(-1, -5, 0)).norm(), 1e-6);
  EXPECT_EQ(mesh.materials.at(0).name, "brass");
  EXPECT_EQ(mesh.materials.at(0).rgb, (std::array{0.5F, 0.25F, 0.125F}));
}

TEST_F(GltfFile, WhatIsLeftOutIsCounted) {
  Gltf beyond;
  beyond.indices = R"("bufferView": 1, "componentType": 5121, "count": 6, "type": "SCALAR")";
  beyond.more_bytes = "unused";
  const MeshReading found =
      read("t.gltf", replaced(replaced(beyond.json(), "\"byteLength\": 3}", "\"byteLength\": 6}"),
                              "%00%75", "%00%03"));
  EXPECT_EQ(found.lost_faces, 1U);
  ASSERT_FALSE(found.warnings.empty());
  EXPECT_TRUE(says(found.warnings.back(), {"vertices that do not exist"}));
}

TEST_F(GltfFile, OnlyUnsignedIntegersNameVerticesAndJoints) {
  for (const char* type : {"5120", "5122", "5126", "4294972417"}) {  // the last is 5121 in 32 bits
    Gltf named;
    named.indices = replaced(named.indices, "5121", type);
    named.indices = replaced(named.indices, "\"bufferView\": 1", "\"bufferView\": 2");
    named.more_views = R"(, {"buffer": 0, "byteOffset": 40, "byteLength": 12})";
    named.more_bytes = std::string(12, '\xc1');  // below 0 in each of them
    EXPECT_TRUE(says(fault("t.gltf", named.json()), {"accessors[1]", type, "no unsigned"}));

    Gltf skinned;
    skinned.node = R"(, "skin": 0)";
    skinned.root = R"(, "skins": [{"joints": [1]}])";
    skinned.primitive = R"(, "JOINTS_0": 2, "WEIGHTS_0": 2)";
    skinned.more_accessors = fmt::format(
        R"(, {{"bufferView": 2, "componentType": {}, "count": 3, "type": "VEC4"}})", type);
    skinned.more_views = R"(, {"buffer": 0, "byteOffset": 40, "byteLength": 48})";
    skinned.more_bytes = std::string(48, '\xc1');
    EXPECT_TRUE(says(fault("t.gltf", skinned.json()), {"accessors[2]", type, "no unsigned"}));
  }
}

TEST_F(GltfFile, ContainersAreReadAsTheyAre) {
  expect_triangle({}, Box3(Vec3(0, 0, 0), Vec3(1, 0, 1)), 0.5, "plain");
  EXPECT_EQ(read("t.gltf", "\xEF\xBB\xBF" + Gltf{}.json()).mesh.faces.size(), 1U);
  EXPECT_EQ(read("t.gltf", in_utf16(Gltf{}.json(), false, true)).mesh.faces.size(), 1U);
  Gltf apart;
  apart.uri = "with%20blank.bin";
  write("with blank.bin", apart.bytes());
  expect_triangle(apart, Box3(Vec3(0, 0, 0), Vec3(1, 0, 1)), 0.5, "percent-encoded");
  apart.uri = R"(.\\with blank.bin)";
  expect_triangle(apart, Box3(Vec3(0, 0, 0), Vec3(1, 0, 1)), 0.5, "a backslash");
  apart.uri = R"(a\u0000\u001bb.bin)";
  EXPECT_TRUE(says(fault("t.gltf", apart.json()), {"its buffer 'a\\x00\\x1bb.bin' is not there"}));
  std::string json =
      replaced(Gltf{}.json(), "\"uri\": \"" + data_uri(Gltf{}.bytes()) + "\"", "\"name\": \"b\"");
  while (json.size() % 4 != 1) json += ' ';  // no multiple of four
  std::string glb = "glTF";
  append_bytes(glb, std::uint32_t{2});
  append_bytes(glb, static_cast<std::uint32_t>(28 + json.size() + Gltf{}.bytes().size()));
  append_bytes(glb, static_cast<std::uint32_t>(json.size()));
  glb += "JSON" + json;
  append_bytes(glb, static_cast<std::uint32_t>(Gltf{}.bytes().size()));
  glb += std::string("BIN\0", 4) + Gltf{}.bytes();
  EXPECT_EQ(read("t.glb", glb).mesh.faces.size(), 1U);
  EXPECT_TRUE(says(fault("t.glb", glb.substr(0, glb.size() - 9)), {"is cut off"}));
  const std::string whole = Gltf{}.json();
  const std::string nested = std::string(100'000, '[') + std::string(100'000, ']');
  for (const auto& [text, what] : std::vector<std::pair<std::string, const char*>>{
           {replaced(whole, "\"2.0\"", "\"1.0\""), "is glTF 1"},
           {replaced(whole, "\"2.0\"", "\"3.0\""), "is glTF 3"},
           {replaced(whole, "\"buffers\"", R"("extensionsRequired": ["X_new"], "buffers")"),
            "requires the extension X_new"},
           {replaced(whole, "\"buffers\"",
                     R"("extensionsRequired": ["KHR_draco_mesh_compression"], "buffers")"),
            "is compressed (KHR_draco_mesh_compression)"},
           {replaced(whole, "\"buffers\"",
                     R"("extensionsRequired": ["EXT_meshopt_compression"], "buffers")"),
            "is compressed (EXT_meshopt_compression)"},
           {replaced(whole, "\"scale\": [2, 2, 2]", "\"children\": [1]"), "its own ancestor"},
           {replaced(whole, "\"count\": 3", "\"count\": 4"), "reaches beyond"},
           {replaced(whole, "\"count\": 3", "\"count\": -1"), "'count' is -1"},
           {replaced(whole, "\"mesh\": 0", "\"mesh\": 7"), "meshes[7], which does not exist"},
           {replaced(whole, "\"count\": 3", "\"count\": " + nested), "more than 200 deep"},
           {replaced(whole, "\"count\": 3", "\"count\": 1e400"), "overflow parsing '1e400'"},
           {whole.substr(0, 200), "is no JSON"},
           {"[]", "no object"}}) {
    EXPECT_TRUE(says(fault("t.gltf", text), {what})) << what;
  }
}

}  // namespace
}  // namespace gnbv
