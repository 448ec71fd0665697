// Pictures on surfaces: what a texture is at a place, and that every format brings its own there.
#include <gtest/gtest.h>

#include <random>

#include "sim/core/file.hpp"
#include "sim/mesh/texture_file.hpp"
#include "tests/sim/mesh/mesh_files.hpp"

namespace gnbv {
namespace {

using namespace test;

using Colour = std::array<float, 3>;
constexpr Rgb8 kRed = {255, 0, 0}, kGreen = {0, 255, 0}, kBlue = {0, 0, 255},
               kWhite = {255, 255, 255};

Texture picture_of(int width_px, int height_px, const std::vector<Rgb8>& pixels,
                   Wrap wrap = Wrap::repeat) {
  Image image{width_px, height_px, {}};
  for (const Rgb8& pixel : pixels) image.rgb.insert(image.rgb.end(), pixel.begin(), pixel.end());
  return {"", std::make_shared<const Image>(image), {wrap, wrap}};
}

Rgb8 bytes_of(const Colour& c) { return {srgb_byte(c[0]), srgb_byte(c[1]), srgb_byte(c[2])}; }

TEST(Picture, IsItsPixelsAtTheirCentresAndLinearLightBetweenThem) {
  const Texture texture = picture_of(2, 2, {kRed, kGreen, kBlue, {188, 188, 188}});
  EXPECT_EQ(bytes_of(colour_at(texture, {0.25F, 0.25F})), kRed);
  EXPECT_EQ(bytes_of(colour_at(texture, {0.75F, 0.25F})), kGreen);
  EXPECT_EQ(bytes_of(colour_at(texture, {0.25F, 0.75F})), kBlue);
  EXPECT_EQ(bytes_of(colour_at(texture, {0.75F, 0.75F})), (Rgb8{188, 188, 188}));
  const float grey = srgb_to_linear(188.0F / 255.0F);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> share(0.0F, 1.0F);
  for (int i = 0; i < 1000; ++i) {
    const float s = share(random), t = share(random);
    const Colour c = colour_at(texture, {0.25F + 0.5F * s, 0.25F + 0.5F * t});
    EXPECT_NEAR(c[0], (1 - s) * (1 - t) + s * t * grey, 1e-6F);
    EXPECT_NEAR(c[1], s * (1 - t) + s * t * grey, 1e-6F);
    EXPECT_NEAR(c[2], (1 - s) * t + s * t * grey, 1e-6F);
  }
}

TEST(Picture, GoesOnBeyondItsBordersAsItsWrapSays) {
  std::vector<Rgb8> pixels;
  for (std::uint8_t i = 0; i < 15; ++i) pixels.push_back({static_cast<std::uint8_t>(17 * i), i, 7});
  const Texture repeat = picture_of(5, 3, pixels);
  const Texture mirror = picture_of(5, 3, pixels, Wrap::mirror);
  const Texture clamp = picture_of(5, 3, pixels, Wrap::clamp);
  const auto near = [](const Colour& a, const Colour& b) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 2e-5F);
  };
  std::mt19937 random(2);
  std::uniform_real_distribution<float> share(0.0F, 1.0F);
  for (int i = 0; i < 1000; ++i) {
    const Vec2f uv(share(random), share(random));
    const Vec2f tiles(static_cast<float>(i % 7 - 3), static_cast<float>(i % 5 - 2));
    near(colour_at(repeat, uv + tiles), colour_at(repeat, uv));
    near(colour_at(mirror, uv + 2.0F * tiles), colour_at(mirror, uv));
    near(colour_at(mirror, -uv), colour_at(mirror, uv));
    near(colour_at(mirror, uv), colour_at(clamp, uv));
    const Vec2f beyond = uv + tiles;
    near(colour_at(clamp, beyond), colour_at(clamp, beyond.cwiseMax(0.0F).cwiseMin(1.0F)));
  }
  // half way between the last pixel and the first
  const Colour seam = colour_at(repeat, {0.0F, 0.5F / 3.0F});
  EXPECT_NEAR(seam[0], 0.5F * srgb_to_linear(68.0F / 255.0F), 1e-6F);
  EXPECT_EQ(bytes_of(colour_at(repeat, {1e30F, 0.1F}))[2], 7);
}

/// Red upper left, green upper right, blue lower left, white lower right.
const std::vector<Rgb8> kFour = {kRed, kGreen, kBlue, kWhite};

class PictureFile : public MeshFile {
 protected:
  PictureFile() { save("four.png", kFour); }
  void save(const std::string& name, const std::vector<Rgb8>& pixels) const {
    write_png(*picture_of(2, 2, pixels).image, folder_ / name);
  }
  MeshReading read(const std::string& name, const std::string& content) const {
    MeshFileConfig config = file(write(name, content));
    config.up_axis = "z";
    return read_mesh(config);
  }
  std::string bytes_of_four() const { return read_file(folder_ / "four.png"); }
};

/// Of the face that the point lies in, seen from above.
Rgb8 colour(const TriangleMesh& mesh, double x, double y) {
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const auto [a, b, c] = face_corners_m(mesh, i);
    const auto side = [&](const Vec3& p, const Vec3& q) {
      return (q.x() - p.x()) * (y - p.y()) - (q.y() - p.y()) * (x - p.x());
    };
    const double of_ab = side(a, b), of_bc = side(b, c), of_ca = side(c, a);
    const bool is_in =
        (of_ab >= 0 && of_bc >= 0 && of_ca >= 0) || (of_ab <= 0 && of_bc <= 0 && of_ca <= 0);
    if (is_in) return bytes_of(albedo(mesh, i, Vec3(x, y, 0).cast<float>(), Vec3f::UnitZ()));
  }
  ADD_FAILURE() << "no face at " << x << ", " << y;
  return {};
}

/// A unit square with the picture upright on it.
void expect_upright(const MeshReading& reading) {
  ASSERT_EQ(reading.warnings, std::vector<std::string>{});
  EXPECT_EQ(colour(reading.mesh, 0.25, 0.75), kRed);
  EXPECT_EQ(colour(reading.mesh, 0.75, 0.75), kGreen);
  EXPECT_EQ(colour(reading.mesh, 0.25, 0.25), kBlue);
  EXPECT_EQ(colour(reading.mesh, 0.75, 0.25), kWhite);
}

const std::string kObj =
    "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl m\nf 1/1 2/2 3/3 4/4\n";

TEST_F(PictureFile, ObjHasVGoingUpAndItsMtlSaysWhere) {
  std::filesystem::create_directory(folder_ / "sub dir");
  std::filesystem::copy(folder_ / "four.png", folder_ / "sub dir/a b.png");
  std::filesystem::create_directory(folder_ / "textures");
  std::filesystem::copy(folder_ / "four.png", folder_ / "textures/last.png");
  for (const std::string map :
       {"four.png", "-clamp off -s 1 1 1 -o 0 0 0 -bm 0.5 four.png", "sub dir/a b.png",
        "sub dir\\a b.png", "sub%20dir/a%20b.png", "\"sub dir/a b.png\"", "-blendu on four.png",
        "C:\\Users\\me\\last.png", "/elsewhere/last.png"}) {
    SCOPED_TRACE(map);
    write("m.mtl", "newmtl m\nKd 1 1 1\nmap_Kd " + map + "\n");
    expect_upright(read("a.obj", kObj));
  }
  write("m.mtl", "newmtl m\nmap_Kd file://" + (folder_ / "four.png").string());
  expect_upright(read("a.obj", kObj));
  write("m.mtl", "newmtl m\nKd 0 0 0\nmap_Kd four.png");  // black is no base colour
  expect_upright(read("a.obj", kObj));
  write("sub dir/m.mtl", "newmtl m\nmap_Kd a b.png");
  const std::string below = replaced(kObj, "mtllib m.mtl", "mtllib sub dir/m.mtl");
  expect_upright(read("a.obj", below));
  // the library last, and corners that count back
  write("m.mtl", "newmtl m\nmap_Kd four.png");
  std::string last = replaced(kObj, "mtllib m.mtl\n", "") + "mtllib m.mtl\n";
  last = replaced(last, "1/1 2/2 3/3 4/4", "-4/-4 -3/-3 -2/-2 -1/-1");
  expect_upright(read("a.obj", last));
}

TEST_F(PictureFile, ObjOptionsScaleMoveAndClamp) {
  write("m.mtl", "newmtl m\nKd 0.5 1 1\nmap_Kd -s 2 2 -o 0.5 four.png\n");
  const TriangleMesh moved = read("a.obj", kObj).mesh;
  // (u, v) becomes (2 u + 0.5, 2 v): u = 0.125 is the second column, and the picture is there twice
  EXPECT_EQ(colour(moved, 0.125, 0.125), (Rgb8{188, 255, 255}));  // times Kd, in linear light
  EXPECT_EQ(colour(moved, 0.125, 0.625), (Rgb8{188, 255, 255}));
  EXPECT_EQ(colour(moved, 0.375, 0.375), (Rgb8{188, 0, 0}));
  write("m.mtl", "newmtl m\nmap_Kd -clamp on -o -0.5 -0.5 four.png\n");
  const TriangleMesh clamped = read("a.obj", kObj).mesh;
  EXPECT_EQ(colour(clamped, 0.25, 0.25), kBlue);
  EXPECT_EQ(colour(clamped, 0.75, 0.75), kBlue);
  write("m.mtl", "newmtl m\nmap_Kd -mm 0 2 four.png\n");
  EXPECT_THAT(read("a.obj", kObj).warnings, testing::ElementsAre(testing::HasSubstr("option -mm")));
}

TEST_F(PictureFile, AffineCoordinatesStayAffineOnAnyPolygon) {
  // oracle: the coordinates are (x / 4, y / 4) at the corners, so they are everywhere
  std::vector<Rgb8> pixels;
  for (std::uint8_t i = 0; i < 4; ++i) pixels.push_back({static_cast<std::uint8_t>(60 * i), 9, i});
  save("p.png", pixels);
  const std::vector<Vec2f> ring = {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {4, 3}, {4, 4}, {0, 4}};
  std::string obj = "mtllib m.mtl\nusemtl m\n", face = "f";
  for (std::size_t i = 0; i < ring.size(); ++i) {
    obj += fmt::format("v {} {} 0\nvt {} {}\n", ring[i].x(), ring[i].y(), ring[i].x() / 4,
                       1.0F - ring[i].y() / 4);
    face += fmt::format(" {0}/{0}", i + 1);
  }
  write("m.mtl", "newmtl m\nmap_Kd p.png\n");
  const TriangleMesh mesh = read("a.obj", obj + face + "\n").mesh;
  ASSERT_EQ(mesh.faces.size(), 6U);
  const Texture texture = picture_of(2, 2, pixels);
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const auto [a, b, c] = face_corners_m(mesh, i);
    for (const Vec3& p : {Vec3((a + b + c) / 3), Vec3(0.6 * a + 0.3 * b + 0.1 * c), a, c}) {
      const Vec3f at = p.cast<float>();
      const Colour seen = albedo(mesh, i, at, Vec3f::UnitZ());
      const Colour expected = colour_at(texture, {at.x() / 4, at.y() / 4});
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(seen[k], expected[k], 1e-5F);
    }
  }
}

const std::string kFourPng = R"(, "textures": [{"source": 0}], "images": [{"uri": "four.png"}])";
const std::string kTextured = R"("baseColorTexture": {"index": 0})";

/// The unit square as two triangles with texture coordinates of that encoding, v down.
struct GltfSquare {
  std::string material = kTextured, root = kFourPng, attributes, bytes, accessors, views;

  GltfSquare() {
    for (const int x : {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0})
      append_bytes(bytes, static_cast<float>(x));
    bytes += std::string("\0\1\2\0\2\3", 6);
    bytes.resize(56);
  }
  template <typename T>
  void add(const std::string& name, const std::vector<T>& values, int component,
           const std::string& type, const std::string& more = "") {
    const std::size_t begin = bytes.size();
    for (const T value : values) append_bytes(bytes, value);
    const std::size_t number =
        static_cast<std::size_t>(std::count(views.begin(), views.end(), '{'));
    views += fmt::format(R"(, {{"buffer": 0, "byteOffset": {}, "byteLength": {}}})", begin,
                         bytes.size() - begin);
    accessors +=
        fmt::format(R"(, {{"bufferView": {}, "componentType": {}, "count": 4, "type": "{}"{}}})",
                    number + 2, component, type, more);
    attributes += fmt::format(R"(, "{}": {})", name, number + 2);
    bytes.resize((bytes.size() + 3) / 4 * 4);
  }
  std::string json() const {
    return fmt::format(
        R"({{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
"meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0{}}}, "indices": 1, "material": 0}}]}}],
"materials": [{{"pbrMetallicRoughness": {{{}}}}}],
"accessors": [{{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"}},
{{"bufferView": 1, "componentType": 5121, "count": 6, "type": "SCALAR"}}{}],
"bufferViews": [{{"buffer": 0, "byteLength": 48}},
{{"buffer": 0, "byteOffset": 48, "byteLength": 6}}{}],
"buffers": [{{"byteLength": {}, "uri": "square.bin"}}]{}}})",
        attributes, material, accessors, views, bytes.size(), root);
  }
};

const std::vector<float> kUvs = {0, 1, 1, 1, 1, 0, 0, 0};

TEST_F(PictureFile, GltfHasVGoingDownInEveryEncodingAndFromAnywhere) {
  const auto expect = [&](const GltfSquare& square) {
    write("square.bin", square.bytes);
    expect_upright(read("a.gltf", square.json()));
  };
  GltfSquare plain;
  GltfSquare square = plain;
  square.add("TEXCOORD_0", kUvs, 5126, "VEC2");
  expect(square);
  square = plain;
  square.add("TEXCOORD_0", std::vector<std::uint8_t>{0, 255, 255, 255, 255, 0, 0, 0}, 5121, "VEC2",
             R"(, "normalized": true)");
  expect(square);
  square = plain;
  square.add("TEXCOORD_0", std::vector<std::uint16_t>{0, 65535, 65535, 65535, 65535, 0, 0, 0}, 5123,
             "VEC2", R"(, "normalized": true)");
  square.add("TEXCOORD_1", std::vector<float>(8, 0.25F), 5126, "VEC2");  // another set
  expect(square);
  square.material = R"("baseColorTexture": {"index": 0, "texCoord": 2})";
  square.add("TEXCOORD_2", kUvs, 5126, "VEC2");
  expect(square);
  // in the buffer, and in the JSON
  const std::string png = bytes_of_four();
  square.root = fmt::format(
      R"(, "textures": [{{"source": 0}}], "images": [{{"bufferView": 5, "mimeType": "image/png"}}])");
  square.views += fmt::format(R"(, {{"buffer": 0, "byteOffset": {}, "byteLength": {}}})",
                              square.bytes.size(), png.size());
  square.bytes += png;
  expect(square);
  square.root = replaced(kFourPng, "four.png", data_uri(png));
  expect(square);
}

TEST_F(PictureFile, GltfSamplersWrapAndTransformsPlace) {
  GltfSquare square;
  square.add("TEXCOORD_0", std::vector<float>{-1, 2, 1, 2, 1, 0, -1, 0}, 5126, "VEC2");
  const auto colours = [&](int wrap) {
    square.root = fmt::format(
        R"(, "samplers": [{{"wrapS": {0}, "wrapT": {0}}}], "images": [{{"uri": "four.png"}}],
"textures": [{{"source": 0, "sampler": 0}}])",
        wrap);
    write("square.bin", square.bytes);
    const TriangleMesh mesh = read("a.gltf", square.json()).mesh;
    return std::array{colour(mesh, 0.125, 0.875),
                      colour(mesh, 0.375, 0.125)};  // (-.75, .25) (-.25, 1.75)
  };
  EXPECT_EQ(colours(10497), (std::array{kRed, kWhite}));
  EXPECT_EQ(colours(33648), (std::array{kGreen, kRed}));
  EXPECT_EQ(colours(33071), (std::array{kRed, kBlue}));
  // the specification's example: the lower left quarter of the picture, rotated clockwise by 90
  // degrees; its picture as 4 x 4, of which that quarter is `kFour`
  GltfSquare turned;
  turned.material = R"("baseColorTexture": {"index": 0, "extensions": {"KHR_texture_transform":
{"offset": [0, 1], "rotation": 1.57079632679, "scale": [0.5, 0.5]}}})";
  turned.add("TEXCOORD_0", kUvs, 5126, "VEC2");
  Image large{4, 4, std::vector<std::uint8_t>(48, 77)};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t pixel = (2 + i / 2) * 4 + i % 2;
    std::copy(kFour[i].begin(), kFour[i].end(),
              large.rgb.begin() + static_cast<std::ptrdiff_t>(3 * pixel));
  }
  write_png(large, folder_ / "four.png");
  write("square.bin", turned.bytes);
  const TriangleMesh mesh = read("a.gltf", turned.json()).mesh;
  EXPECT_EQ(colour(mesh, 0.25, 0.75), kBlue);  // lower left came to the upper left
  EXPECT_EQ(colour(mesh, 0.75, 0.75), kRed);
  EXPECT_EQ(colour(mesh, 0.75, 0.25), kGreen);
  EXPECT_EQ(colour(mesh, 0.25, 0.25), kWhite);
}

TEST_F(PictureFile, GltfColoursOfVerticesAreTheSameInEveryEncoding) {
  const auto tint = [&](auto full, int component, bool is_share, std::size_t width) {
    GltfSquare square;
    square.material = R"("baseColorFactor": [0.5, 1, 1, 1], )" + kTextured;
    square.add("TEXCOORD_0", kUvs, 5126, "VEC2");
    std::vector<decltype(full)> values;
    for (int i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < width; ++k) values.push_back(k == 1 ? decltype(full)(0) : full);
    }
    square.add("COLOR_0", values, component, width == 3 ? "VEC3" : "VEC4",
               is_share ? R"(, "normalized": true)" : "");
    write("square.bin", square.bytes);
    return read("a.gltf", square.json()).mesh;
  };
  for (const TriangleMesh& mesh :
       {tint(1.0F, 5126, false, 3), tint(1.0F, 5126, false, 4),
        tint(std::uint8_t{255}, 5121, true, 3), tint(std::uint8_t{255}, 5121, true, 4),
        tint(std::uint8_t{255}, 5121, false, 4), tint(std::uint16_t{65535}, 5123, true, 3),
        tint(std::uint16_t{65535}, 5123, true, 4)}) {
    EXPECT_EQ(colour(mesh, 0.25, 0.75), (Rgb8{188, 0, 0}));  // base colour, picture, vertex
    EXPECT_EQ(colour(mesh, 0.75, 0.25), (Rgb8{188, 0, 255}));
  }
  // half of the light between a black edge and a white one
  GltfSquare shaded;
  shaded.material = shaded.root = "";
  shaded.add("COLOR_0", std::vector<float>{0, 0, 0, 1, 1, 1, 1, 1, 1, 0, 0, 0}, 5126, "VEC3");
  write("square.bin", shaded.bytes);
  const TriangleMesh mesh = read("a.gltf", shaded.json()).mesh;
  EXPECT_EQ(colour(mesh, 0.5, 0.5), (Rgb8{188, 188, 188}));
  EXPECT_NEAR(mean_colour(mesh, 0)[0] + mean_colour(mesh, 1)[0], 1.0F, 1e-5F);
}

const std::string kDae = R"(<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema"
 version="1.4.1"><asset><up_axis>Z_UP</up_axis></asset>
<library_images><image id="img"><init_from>four.png</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON>
<newparam sid="surf"><surface type="2D"><init_from>img</init_from></surface></newparam>
<newparam sid="samp"><sampler2D><source>surf</source></sampler2D></newparam>
<technique sid="c"><lambert><diffuse><texture texture="samp" texcoord="UVSET0"/></diffuse></lambert>
</technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array>
<technique_common><accessor source="#pa" count="4" stride="3"/></technique_common></source>
<source id="t"><float_array id="ta" count="8">0 0 1 0 1 1 0 1</float_array>
<technique_common><accessor source="#ta" count="4" stride="2"/></technique_common></source>
<source id="w"><float_array id="wa" count="8">.25 .25 .25 .25 .25 .25 .25 .25</float_array>
<technique_common><accessor source="#wa" count="4" stride="2"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist material="s" count="1"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="TEXCOORD" source="#w" offset="1" set="0"/>
<input semantic="TEXCOORD" source="#t" offset="2" set="1"/>
<vcount>4</vcount><p>0 0 0 1 1 1 2 2 2 3 3 3</p></polylist></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="vs"><node><instance_geometry url="#g"><bind_material>
<technique_common><instance_material symbol="s" target="#m">
<bind_vertex_input semantic="UVSET0" input_semantic="TEXCOORD" input_set="1"/></instance_material>
</technique_common></bind_material></instance_geometry></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#vs"/></scene></COLLADA>)";

TEST_F(PictureFile, ColladaHasVGoingUpThroughEveryChain) {
  std::filesystem::create_directories(folder_ / "../materials/textures");
  save("a b.png", kFour);
  const std::string path = "<init_from>four.png</init_from>";
  const std::string sampler = "<source>surf</source>";
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {path, path},
           {path, "<init_from>a%20b.png</init_from>"},
           {"0 0 1 0 1 1 0 1<", "0,0 0,0 1,0 0,0 1,0 1,0 0,0 1,0<"},
           {path, "<init_from>\n  ./four.png\n</init_from>"},
           {path, "<init_from>file://" + (folder_ / "four.png").string() + "</init_from>"},
           {path, "<init_from>file://" + (folder_ / "a%20b.png").string() + "</init_from>"},
           {path, "<init_from>file:///C:/models/four.png</init_from>"},
           {path, "<init_from><ref>four.png</ref></init_from>"},
           {sampler, "<instance_image url=\"#img\"/>"},
           {sampler, "<source>img</source>"},
           {"texture=\"samp\"", "texture=\"img\""}}) {
    SCOPED_TRACE(to);
    expect_upright(read("a.dae", replaced(kDae, from, to)));
  }
  const std::string image = "<image id=\"img\"><init_from>four.png</init_from></image>";
  expect_upright(read("a.dae", replaced(replaced(kDae, image, ""), "<profile_COMMON>",
                                        "<profile_COMMON>" + image)));
  expect_upright(read("a.dae", replaced(replaced(replaced(kDae, "source=\"#p\"/></vertices>",
                                                          "source=\"#p\"/><input "
                                                          "semantic=\"TEXCOORD\" source=\"#t\"/>"
                                                          "</vertices>"),
                                                 "semantic=\"TEXCOORD\" source=\"#t\" offset",
                                                 "semantic=\"NORMAL\" source=\"#t\" offset"),
                                        "offset=\"1\" set=\"0\"", "offset=\"1\" set=\"5\"")));
  // of the first set where none is bound; a mirrored instance keeps its picture in place
  const std::string unbound = replaced(kDae, "semantic=\"UVSET0\" input", "semantic=\"U\" input");
  EXPECT_EQ(colour(read("a.dae", unbound).mesh, 0.5, 0.5), kBlue);
  const TriangleMesh flipped =
      read("a.dae", replaced(kDae, "<node>", "<node><scale>-1 1 1</scale>")).mesh;
  EXPECT_EQ(colour(flipped, -0.25, 0.75), kRed);
  EXPECT_EQ(colour(flipped, -0.75, 0.25), kWhite);
  const TriangleMesh clamped =
      read("a.dae", replaced(replaced(kDae, sampler, sampler + "<wrap_s>CLAMP</wrap_s>"),
                             "0 0 1 0 1 1 0 1<", "1 0 2 0 2 1 1 1<"))
          .mesh;
  EXPECT_EQ(colour(clamped, 0.25, 0.75), kGreen);
}

TEST_F(PictureFile, ColladaPolygonsWithHolesKeepTheirCoordinates) {
  std::string holed = replaced(kDae, "<vcount>4</vcount><p>0 0 0 1 1 1 2 2 2 3 3 3</p></polylist>",
                               "<ph><p>0 0 0 1 1 1 2 2 2 3 3 3</p>"
                               "<h>4 0 4 5 0 5 6 0 6 7 0 7</h></ph></polygons>");
  holed =
      replaced(replaced(holed, "<polylist", "<polygons"), "count=\"12\">0 0 0 1 0 0 1 1 0 0 1 0",
               "count=\"24\">0 0 0 1 0 0 1 1 0 0 1 0 .4 .4 0 .6 .4 0 .6 .6 0 .4 .6 0");
  holed = replaced(replaced(holed, "#pa\" count=\"4\"", "#pa\" count=\"8\""), "0 0 1 0 1 1 0 1<",
                   "0 0 1 0 1 1 0 1 .4 .4 .6 .4 .6 .6 .4 .6<");
  expect_upright(read("a.dae", holed));
}

TEST(Picture, OfFourInksIsWhatTheyLeaveOfWhite) {
  // a pixel of (200, 100, 50, 127), which are inverted where Adobe's mark stands
  const std::string adobe = *bytes_of_data_uri(
      "data:;base64,"
      "/9j/7gAOQWRvYmUAZAAAAAAA/9sAQwABAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQ"
      "EBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEB/8AAFAgAAQABBEMRAE0RAFkRAEsRAP/EABYAAQEB"
      "AAAAAAAAAAAAAAAAAAoECP/EABQQAQAAAAAAAAAAAAAAAAAAAAD/2gAOBEMATQBZAEsAAD8ASAw+Me"
      "nf/9k=");
  std::string ycck = adobe;
  ycck[17] = 2;  // of the mark: which colours they are
  const auto rgb = [](const std::string& jpeg) { return read_picture(jpeg, 1).rgb; };
  using Rgb = std::vector<std::uint8_t>;
  EXPECT_EQ(rgb(adobe), (Rgb{100, 50, 25}));
  EXPECT_EQ(rgb(ycck), (Rgb{82, 0, 52}));
  EXPECT_EQ(rgb(adobe.substr(0, 2) + adobe.substr(18)), (Rgb{28, 78, 103}));
}

TEST_F(PictureFile, APngIsInSrgbWhateverItsDepthAndItsGamma) {
  write_png(GreyImage16{1, 1, {0x8080}}, folder_ / "grey.png");
  const std::string png = read_file(folder_ / "grey.png");
  const std::vector<std::uint8_t> grey = {0x80, 0x80, 0x80};
  EXPECT_EQ(read_picture(png, 1).rgb, grey);
  constexpr std::size_t kHeader = 33;  // bytes, signature and IHDR
  std::string with_gamma = png;
  with_gamma.insert(kHeader, std::string("\0\0\0\4gAMA\0\1\x86\xa0\x31\xe8\x96\x5f", 16));
  EXPECT_EQ(read_picture(with_gamma, 1).rgb, grey);
}

TEST_F(PictureFile, WhatIsWrongWithAPictureIsAWarningAndThePlainColour) {
  write("text.png", "no picture");
  write("lfs.png", "version https://git-lfs.github.com/spec/v1\noid sha256:0\n");
  write("cut.png", bytes_of_four().substr(0, 60));
  std::string huge = bytes_of_four();
  huge[18] = huge[22] = '\x7f';  // 32,000 pixels a side; its checksum is wrong then, too
  write("huge.png", huge);
  for (const std::string name : {"none.png", "text.png", "lfs.png", "cut.png", "huge.png"}) {
    SCOPED_TRACE(name);
    write("m.mtl", "newmtl m\nKd 0 1 0\nmap_Kd " + name + "\n");
    GltfSquare square;
    square.material = R"("baseColorFactor": [0, 1, 0, 1], )" + kTextured;
    square.root = replaced(kFourPng, "four.png", name);
    square.add("TEXCOORD_0", kUvs, 5126, "VEC2");
    write("square.bin", square.bytes);
    for (const MeshReading& reading : {read("a.obj", kObj), read("a.gltf", square.json()),
                                       read("a.dae", replaced(kDae, "four.png", name))}) {
      ASSERT_EQ(reading.warnings.size(), 1U);
      EXPECT_THAT(reading.warnings[0], testing::HasSubstr(name));
      EXPECT_EQ(reading.mesh.faces.size(), 2U);
      EXPECT_TRUE(textures_of(reading.mesh).empty());
      EXPECT_EQ(colour(reading.mesh, 0.5, 0.4)[1], 255);
    }
    EXPECT_EQ(colour(read("a.obj", kObj).mesh, 0.25, 0.75), kGreen);
  }
}

TEST_F(PictureFile, NoFaultOfLooksRefusesAShape) {
  const auto survives = [&](const std::string& name, const std::string& content) {
    SCOPED_TRACE(content);
    const MeshReading reading = read(name, content);
    EXPECT_EQ(reading.mesh.faces.size(), 2U);
    colour(reading.mesh, 0.5, 0.4);
  };
  write("m.mtl", "newmtl m\nmap_Kd four.png\n");
  survives("a.obj", replaced(kObj, "vt 1 0", "vt x y"));
  survives("a.obj", replaced(kObj, "vt 1 0", "vt nan 1e999"));
  survives("a.obj", replaced(kObj, "2/2", "2/99"));
  survives("a.obj", replaced(kObj, "2/2", "2/-9"));
  survives("a.obj", replaced(kObj, "2/2", "2"));
  GltfSquare square;
  square.add("TEXCOORD_0", kUvs, 5126, "VEC2");
  square.add("COLOR_0", std::vector<float>(12, 1.0F), 5126, "VEC3");
  write("square.bin", square.bytes);
  const std::string gltf = square.json();
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {R"("material": 0)", R"("material": 99)"},
           {R"("material": 0)", R"("material": -1)"},
           {R"("materials": [)", R"("materials": [null], "none": [)"},
           {R"("index": 0)", R"("index": 7)"},
           {R"("index": 0)", R"("index": "x")"},
           {R"("source": 0)", R"("source": 9)"},
           {R"("source": 0)", R"("extensions": {"KHR_texture_basisu": {"source": 0}})"},
           {R"("uri": "four.png")", R"("bufferView": 99)"},
           {R"("uri": "four.png")", R"("uri": 5)"},
           {R"("TEXCOORD_0": 2)", R"("TEXCOORD_0": 99)"},
           {R"("TEXCOORD_0": 2)", R"("TEXCOORD_0": 0)"},
           {R"("COLOR_0": 3)", R"("COLOR_0": 1)"}}) {
    survives("a.gltf", replaced(gltf, from, to));
  }
  survives("a.dae", replaced(kDae, "0 0 1 0 1 1 0 1<", "0 0 1 0 x y<"));
  survives("a.dae",
           replaced(kDae, "#ta\" count=\"4\" stride=\"2\"", "#ta\" count=\"4\" stride=\"1\""));
  survives("a.dae", replaced(kDae, "source=\"#t\"", "source=\"#none\""));
  survives("a.dae", replaced(kDae, "<p>0 0 0 1 1 1", "<p>0 0 0 1 1 99"));
}

TEST_F(PictureFile, LooksThatNobodySeesAreAWarning) {
  const auto expect_warning = [&](const MeshReading& reading, const std::string& what) {
    ASSERT_EQ(reading.warnings.size(), 1U) << what;
    EXPECT_THAT(reading.warnings[0], testing::HasSubstr(what));
  };
  const std::string lacking = " faces lack texture coordinates";
  write("m.mtl", "newmtl m\nmap_Kd four.png\n");
  expect_warning(read("a.obj", replaced(kObj, "f 1/1 2/2 3/3 4/4", "f 1 2 3 4")), "2" + lacking);
  expect_warning(read("a.obj", replaced(kObj, "2/2", "2/9")), "1" + lacking);
  GltfSquare square;
  write("square.bin", square.bytes);
  expect_warning(read("a.gltf", square.json()), "2" + lacking);
  write("n.mtl", "newmtl n\nKd 1 1 1\n");
  const std::string vertices = "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\n";
  EXPECT_EQ(colour(read("a.obj", vertices + "f 1 2 3\n").mesh, 0.2, 0.2), kRed);
  const std::string bytes = "v 1 0 0 255 0 0\nv 0 1 0 255 1 0\nv 0 0 0 255 0 0\nf 1 2 3\n";
  EXPECT_EQ(colour(read("a.obj", bytes).mesh, 0.2, 0.2), kRed);
  EXPECT_EQ(read("a.obj", "v 0 0 0 1 1 1\n" + bytes).warnings, std::vector<std::string>{});
  expect_warning(read("a.obj", replaced(bytes, "255", "-1")), "not all of them have one");
  for (const std::string type : {"uchar", "int", "float", "ushort"}) {
    EXPECT_EQ(colour(read("a.ply",
                          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                          "property float y\nproperty float z\nproperty " +
                              type + " diffuse_red\nproperty " + type +
                              " diffuse_green\nproperty " + type +
                              " diffuse_blue\nelement face 1\nproperty list uchar int "
                              "vertex_indices\nend_header\n0 0 0 255 0 0\n"
                              "1 0 0 255 0 0\n0 1 0 255 0 0\n3 0 1 2\n")
                         .mesh,
                     0.2, 0.2),
              kRed)
        << type;
  }
  expect_warning(read("a.obj", "mtllib n.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl o\nf 1 2 3\n"),
                 "1 materials in none of its libraries");
  expect_warning(read("a.dae", replaced(kDae, "source=\"#p\"/></vertices>",
                                        "source=\"#p\"/><input semantic=\"COLOR\" "
                                        "source=\"#t\"/></vertices>")),
                 "colours of vertices are not read");
  expect_warning(read("a.obj", "mtllib n.mtl\n" + vertices + "f 1 2 3\n"), "colours of vertices");
  expect_warning(read("a.obj", vertices + "v 1 1 0\nf 1 2 3\n"), "colours of vertices");
  expect_warning(
      read(
          "a.ply",
          "ply\nformat ascii 1.0\ncomment TextureFile a b.png\nelement vertex 3\nproperty float x\n"
          "property float y\nproperty float z\nelement face 1\nproperty list uchar int "
          "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
      "its picture a b.png is not read");
}

TEST_F(PictureFile, LooksFollowTheirFaces) {
  write("m.mtl", "newmtl m\nmap_Kd four.png\n");
  // a flat face first: load_mesh() leaves it out
  const std::string path = write("a.obj", replaced(kObj, "f 1/1", "f 1/3 2/3 2/3\nf 1/1")).string();
  TriangleMesh mesh = load_mesh({.path = path});
  ASSERT_EQ(mesh.faces.size(), 2U);
  EXPECT_EQ(colour(mesh, 0.25, 0.75), kRed);
  TriangleMesh both = box_mesh(Box3(Vec3(5, 5, -1), Vec3(6, 6, 0)));
  append(both, mesh);
  append(both, box_mesh(Box3(Vec3(7, 7, -1), Vec3(8, 8, 0))));
  EXPECT_EQ(both.face_looks.size(), both.faces.size());
  EXPECT_EQ(colour(both, 0.25, 0.75), kRed);
  EXPECT_EQ(colour(both, 0.75, 0.25), kWhite);
  EXPECT_EQ(textures_of(both).size(), 1U);
  EXPECT_EQ(bytes_of(textures_of(both)), 12U);
}

TEST_F(PictureFile, AModelsMeshesBringTheirs) {
  // as Gazebo's folders have it: meshes here, materials/textures there; mirrored, and moved by 3 m
  std::filesystem::create_directories(folder_ / "materials/textures");
  std::filesystem::rename(folder_ / "four.png", folder_ / "materials/textures/four.png");
  write("meshes/a.dae", replaced(kDae, "four.png", "file:///home/them/four.png"));
  write("model.sdf", R"(<sdf version="1.6"><model name="m"><link name="l"><visual name="v">
<pose>3 0 0 0 0 0</pose><geometry><mesh><uri>model://m/meshes/a.dae</uri><scale>-1 1 1</scale></mesh>
</geometry></visual></link></model></sdf>)");
  const MeshReading reading = read_mesh(file(folder_ / "model.sdf"));
  ASSERT_EQ(reading.warnings, std::vector<std::string>{});
  EXPECT_EQ(colour(reading.mesh, 2.75, 0.75), kRed);
  EXPECT_EQ(colour(reading.mesh, 2.25, 0.25), kWhite);
  EXPECT_EQ(reading.files.size(), 2U);
}

TEST_F(PictureFile, ModelsPutPicturesOnMeshesThatHaveNone) {
  write("plain.obj", replaced(replaced(kObj, "mtllib m.mtl\n", ""), "usemtl m\n", ""));
  std::filesystem::create_directories(folder_ / "skin/materials/textures");
  std::filesystem::copy(folder_ / "four.png", folder_ / "skin/materials/textures/a b.png");
  const auto sdf = [](const std::string& geometry, const std::string& uri) {
    return "<sdf version='1.9'><model name='m'><link name='l'><visual name='v'>" + geometry +
           "<material><diffuse>1 0 0 1</diffuse><pbr><metal><albedo_map>" + uri +
           "</albedo_map></metal></pbr></material></visual></link></model></sdf>";
  };
  const std::string mesh = "<geometry><mesh><uri>plain.obj</uri></mesh></geometry>";
  const std::string uri = "model://skin/materials/textures/a%20b.png";
  expect_upright(read("m.sdf", sdf(mesh, uri)));
  GltfSquare square;
  square.material = square.root = "";
  square.add("TEXCOORD_0", kUvs, 5126, "VEC2");
  write("square.bin", square.bytes);
  write("plain.gltf", square.json());
  expect_upright(
      read("m.sdf",
           sdf("<pose>0 0 0 -1.5707963267948966 0 0</pose>" + replaced(mesh, "obj", "gltf"), uri)));
  std::string dae = replaced(kDae, "#w\" offset=\"1\" set=\"0\"", "#w\" offset=\"1\" set=\"2\"");
  const std::size_t images = dae.find("<library_images>");
  dae.erase(images, dae.find("<library_geometries>") - images);
  write("plain.dae", dae);
  expect_upright(read("m.sdf", sdf(replaced(mesh, "obj", "dae"), uri)));
  expect_upright(read("m.urdf", "<robot><material name='skin'><texture filename='package://" +
                                    uri.substr(8) +
                                    "'/></material><link name='l'><visual><geometry><mesh "
                                    "filename='plain.obj'/></geometry><material name='skin'/>"
                                    "</visual></link></robot>"));
  for (const auto& [geometry, picture, why] : std::vector<std::array<std::string, 3>>{
           {mesh, "gone.png", "not there"},
           {mesh, "plain.obj", "neither PNG nor JPEG"},
           {"<geometry><box><size>1 1 1</size></box></geometry>", "four.png",
            "without texture coordinates"}}) {
    const MeshReading reading = read("m.sdf", sdf(geometry, picture));
    ASSERT_EQ(reading.warnings.size(), 1U);
    EXPECT_TRUE(test::says(reading.warnings[0], {picture, why}));
    EXPECT_EQ(colour(reading.mesh, 0.25, 0.25), kRed) << "the colour beside it";
  }
}

TEST_F(PictureFile, AMeshIsReadFromItsFilesAllOfThem) {
  write("m.mtl", "newmtl m\nmap_Kd four.png\n");
  const auto names = [](const MeshReading& reading) {
    std::vector<std::string> out;
    for (const auto& path : reading.files) out.push_back(path.filename().string());
    return out;
  };
  EXPECT_EQ(names(read("a.obj", kObj)), (std::vector<std::string>{"m.mtl", "four.png"}));
  GltfSquare square;
  square.add("TEXCOORD_0", kUvs, 5126, "VEC2");
  write("square.bin", square.bytes);
  EXPECT_EQ(names(read("a.gltf", square.json())),
            (std::vector<std::string>{"square.bin", "four.png"}));
  EXPECT_EQ(names(read("a.dae", kDae)), (std::vector<std::string>{"four.png"}));
}

}  // namespace
}  // namespace gnbv
