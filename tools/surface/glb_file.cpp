// glb_of() of textured_mesh.hpp: glTF 2.0 in its binary form (Khronos, section 4.4). Own writer:
// one mesh with one material is less text than the importer library's scene.
#include <nlohmann/json.hpp>

#include "sim/core/file.hpp"
#include "sim/core/image.hpp"
#include "tools/surface/textured_mesh.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;

// values of the specification
constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr int kUnsignedShort = 5123;
constexpr int kVertexBuffer = 34962;
constexpr int kIndexBuffer = 34963;
constexpr std::uint32_t kMagic = 0x46546C67;      // glTF
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // JSON
constexpr std::uint32_t kBinChunk = 0x004E4942;   // BIN

Vec3f y_up(const Vec3f& z_up) { return {z_up.x(), z_up.z(), -z_up.y()}; }

/// The binary chunk and the tables that say what lies where in it.
struct Buffer {
  std::string bytes;
  Json views = Json::array();
  Json accessors = Json::array();

  /// Values that `append(i)` puts at the end of the bytes; the index of their accessor.
  template <typename Append>
  std::size_t add(std::size_t count, const char* type, int component, int target,
                  const Append& append) {
    const std::size_t begin = bytes.size();
    for (std::size_t i = 0; i < count; ++i) append(i);
    views.push_back({{"buffer", 0},
                     {"byteOffset", begin},
                     {"byteLength", bytes.size() - begin},
                     {"target", target}});
    accessors.push_back({{"bufferView", views.size() - 1},
                         {"componentType", component},
                         {"count", count},
                         {"type", type}});
    return accessors.size() - 1;
  }
  /// The index of its view.
  std::size_t add_image(std::string_view png) {
    views.push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", png.size()}});
    bytes += png;
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
    return views.size() - 1;
  }
};

/// Positions, normals, texture coordinates or colours, and indices; the primitive that uses them.
Json add_triangles(const TexturedMesh& mesh, Buffer& buffer) {
  const DistinctCorners corners = distinct_corners(mesh);
  const std::vector<Vec3f> normals = vertex_normals(mesh.shape);
  const auto add = [&](const char* type, int component, const auto& append) {
    return buffer.add(corners.vertex.size(), type, component, kVertexBuffer, append);
  };
  const auto append = [&](const auto& numbers) {
    for (const auto x : numbers) append_bytes(buffer.bytes, x);
  };
  Eigen::AlignedBox3f box;
  for (const std::uint32_t vertex : corners.vertex) box.extend(y_up(mesh.shape.vertices_m[vertex]));
  Json attributes;
  attributes["POSITION"] = add("VEC3", kFloat, [&](std::size_t i) {
    append(y_up(mesh.shape.vertices_m[corners.vertex[i]]));
  });
  buffer.accessors.back()["min"] = {box.min().x(), box.min().y(), box.min().z()};
  buffer.accessors.back()["max"] = {box.max().x(), box.max().y(), box.max().z()};
  attributes["NORMAL"] =
      add("VEC3", kFloat, [&](std::size_t i) { append(y_up(normals[corners.vertex[i]])); });
  if (corners.uv.empty()) {
    attributes["COLOR_0"] = add("VEC4", kUnsignedShort, [&](std::size_t i) {
      // linear in glTF, where 8 bits would be too few for the darks
      for (const std::uint8_t level : mesh.vertex_rgb[corners.vertex[i]]) {
        const float linear = srgb_to_linear(static_cast<float>(level) / 255.0F);
        append_bytes(buffer.bytes, static_cast<std::uint16_t>(std::lround(65535.0F * linear)));
      }
      append_bytes(buffer.bytes, std::uint16_t{65535});
    });
    buffer.accessors.back()["normalized"] = true;
  } else {
    const Vec2f size(static_cast<float>(mesh.atlas.width_px),
                     static_cast<float>(mesh.atlas.height_px));
    attributes["TEXCOORD_0"] = add(
        "VEC2", kFloat, [&](std::size_t i) { append(Vec2f(corners.uv[i].cwiseQuotient(size))); });
  }
  const std::size_t indices =
      buffer.add(3 * corners.faces.size(), "SCALAR", kUnsignedInt, kIndexBuffer,
                 [&](std::size_t i) { append_bytes(buffer.bytes, corners.faces[i / 3][i % 3]); });
  return {{"attributes", attributes}, {"indices", indices}, {"material", 0}};
}

void append_chunk(std::string& out, std::uint32_t type, std::string_view content, char padding) {
  const std::size_t padded = (content.size() + 3) / 4 * 4;
  append_bytes(out, static_cast<std::uint32_t>(padded));
  append_bytes(out, type);
  out += content;
  out.append(padded - content.size(), padding);
}

}  // namespace

std::string glb_of(const TexturedMesh& mesh, std::string_view png) {
  Buffer buffer;
  const Json primitive = add_triangles(mesh, buffer);
  Json surface = {{"metallicFactor", 0.0}, {"roughnessFactor", 1.0}};
  // unlit: the pictures' light is in the colours already
  Json material = {{"name", "surface"},
                   {"doubleSided", true},
                   {"extensions", {{"KHR_materials_unlit", Json::object()}}}};
  Json json = {
      {"asset", {{"version", "2.0"}, {"generator", "gnbv"}}},
      {"extensionsUsed", {"KHR_materials_unlit"}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", {{{"name", "surface"}, {"mesh", 0}}}},
      {"meshes", {{{"name", "surface"}, {"primitives", {primitive}}}}},
  };
  if (!png.empty()) {
    surface["baseColorTexture"] = {{"index", 0}};
    json["textures"] = {{{"sampler", 0}, {"source", 0}}};
    // linear, no mipmaps: those of an atlas mix charts
    json["samplers"] = {
        {{"magFilter", 9729}, {"minFilter", 9729}, {"wrapS", 33071}, {"wrapT", 33071}}};
    json["images"] = {{{"bufferView", buffer.add_image(png)}, {"mimeType", "image/png"}}};
  }
  material["pbrMetallicRoughness"] = surface;
  json["materials"] = {material};
  json["accessors"] = buffer.accessors;
  json["bufferViews"] = buffer.views;
  json["buffers"] = {{{"byteLength", buffer.bytes.size()}}};

  std::string chunks;
  append_chunk(chunks, kJsonChunk, json.dump(), ' ');
  append_chunk(chunks, kBinChunk, buffer.bytes, '\0');
  std::string glb;
  append_bytes(glb, kMagic);
  append_bytes(glb, std::uint32_t{2});
  append_bytes(glb, static_cast<std::uint32_t>(12 + chunks.size()));
  return glb + chunks;
}

}  // namespace gnbv
