// glb_of() of textured_mesh.hpp.
#include "sim/core/image.hpp"
#include "sim/mesh/glb_write.hpp"
#include "tools/surface/textured_mesh.hpp"

namespace gnbv {
namespace {

using Json = GlbBuffer::Json;

/// The index of the picture's view.
std::size_t add_image(GlbBuffer& buffer, std::string_view png) {
  buffer.views.push_back(
      {{"buffer", 0}, {"byteOffset", buffer.bytes.size()}, {"byteLength", png.size()}});
  buffer.bytes += png;
  buffer.bytes.resize((buffer.bytes.size() + 3) / 4 * 4, '\0');
  return buffer.views.size() - 1;
}

/// Positions, normals, texture coordinates or colours, and indices; the primitive that uses them.
Json add_triangles(const TexturedMesh& mesh, GlbBuffer& buffer) {
  const DistinctCorners corners = distinct_corners(mesh);
  const std::vector<Vec3f> normals = vertex_normals(mesh.shape);
  const auto add = [&](const char* type, GlbBuffer::Component component, const auto& append) {
    return buffer.add(corners.vertex.size(), type, component, append);
  };
  const auto append = [&](const auto& numbers) {
    for (const auto x : numbers) append_bytes(buffer.bytes, x);
  };
  Json attributes;
  attributes["POSITION"] = buffer.add_positions(corners.vertex.size(), [&](std::size_t i) {
    return y_up(mesh.shape.vertices_m[corners.vertex[i]]);
  });
  attributes["NORMAL"] = add("VEC3", GlbBuffer::kFloat,
                             [&](std::size_t i) { append(y_up(normals[corners.vertex[i]])); });
  if (corners.uv.empty()) {
    attributes["COLOR_0"] = add("VEC4", GlbBuffer::kUnsignedShort, [&](std::size_t i) {
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
    attributes["TEXCOORD_0"] = add("VEC2", GlbBuffer::kFloat, [&](std::size_t i) {
      append(Vec2f(corners.uv[i].cwiseQuotient(size)));
    });
  }
  const std::size_t indices =
      buffer.add(3 * corners.faces.size(), "SCALAR", GlbBuffer::kUnsignedInt,
                 [&](std::size_t i) { append_bytes(buffer.bytes, corners.faces[i / 3][i % 3]); });
  return {{"attributes", attributes}, {"indices", indices}, {"material", 0}};
}

}  // namespace

std::string glb_of(const TexturedMesh& mesh, std::string_view png) {
  GlbBuffer buffer;
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
    json["images"] = {{{"bufferView", add_image(buffer, png)}, {"mimeType", "image/png"}}};
  }
  material["pbrMetallicRoughness"] = surface;
  json["materials"] = {material};
  return glb_bytes(std::move(json), buffer);
}

}  // namespace gnbv
