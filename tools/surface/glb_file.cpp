// glb_of() of textured_mesh.hpp: glTF 2.0 in its binary form (Khronos, section 4.4). Own writer:
// one mesh with one material is less text than the importer library's scene.
#include <nlohmann/json.hpp>

#include "sim/core/file.hpp"
#include "sim/core/image.hpp"
#include "tools/surface/textured_mesh.hpp"

namespace gnbv {
namespace {

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
class Buffer {
 public:
  /// Values that `append` puts at the end of the bytes; the index of their accessor.
  template <typename Append>
  int add(std::size_t count, const char* type, int component, int target, const Append& append) {
    const std::size_t begin = bytes_.size();
    for (std::size_t i = 0; i < count; ++i) append(i, bytes_);
    views_.push_back({{"buffer", 0},
                      {"byteOffset", begin},
                      {"byteLength", bytes_.size() - begin},
                      {"target", target}});
    accessors_.push_back({{"bufferView", views_.size() - 1},
                          {"componentType", component},
                          {"count", count},
                          {"type", type}});
    return static_cast<int>(accessors_.size()) - 1;
  }
  /// The index of its view.
  int add_image(std::string_view png) {
    views_.push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", png.size()}});
    bytes_ += png;
    bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
    return static_cast<int>(views_.size()) - 1;
  }
  nlohmann::ordered_json& accessor(int index) {
    return accessors_[static_cast<std::size_t>(index)];
  }
  const std::string& bytes() const { return bytes_; }
  const nlohmann::ordered_json& views() const { return views_; }
  const nlohmann::ordered_json& accessors() const { return accessors_; }

 private:
  std::string bytes_;
  nlohmann::ordered_json views_ = nlohmann::ordered_json::array();
  nlohmann::ordered_json accessors_ = nlohmann::ordered_json::array();
};

/// Positions, normals, texture coordinates or colours, and indices; the primitive that uses them.
nlohmann::ordered_json add_triangles(const TexturedMesh& mesh, Buffer& buffer) {
  const DistinctCorners corners = distinct_corners(mesh);
  const std::vector<Vec3f> normals = vertex_normals(mesh.shape);
  const std::size_t count = corners.vertex.size();
  Eigen::AlignedBox3f box;
  for (const std::uint32_t vertex : corners.vertex) box.extend(y_up(mesh.shape.vertices_m[vertex]));
  const auto append_vec3 = [](const Vec3f& v, std::string& out) {
    for (const float x : v) append_bytes(out, x);
  };
  nlohmann::ordered_json attributes;
  const int position =
      buffer.add(count, "VEC3", kFloat, kVertexBuffer, [&](std::size_t i, auto& out) {
        append_vec3(y_up(mesh.shape.vertices_m[corners.vertex[i]]), out);
      });
  buffer.accessor(position)["min"] = {box.min().x(), box.min().y(), box.min().z()};
  buffer.accessor(position)["max"] = {box.max().x(), box.max().y(), box.max().z()};
  attributes["POSITION"] = position;
  attributes["NORMAL"] = buffer.add(
      count, "VEC3", kFloat, kVertexBuffer,
      [&](std::size_t i, auto& out) { append_vec3(y_up(normals[corners.vertex[i]]), out); });
  if (corners.uv.empty()) {
    attributes["COLOR_0"] =
        buffer.add(count, "VEC4", kUnsignedShort, kVertexBuffer, [&](std::size_t i, auto& out) {
          // linear in glTF, where 8 bits would be too few for the darks
          for (const std::uint8_t level : mesh.vertex_rgb[corners.vertex[i]]) {
            const float linear = srgb_to_linear(static_cast<float>(level) / 255.0F);
            append_bytes(out, static_cast<std::uint16_t>(std::lround(65535.0F * linear)));
          }
          append_bytes(out, std::uint16_t{65535});
        });
    buffer.accessor(attributes["COLOR_0"])["normalized"] = true;
  } else {
    const Vec2f size(static_cast<float>(mesh.atlas.width_px),
                     static_cast<float>(mesh.atlas.height_px));
    attributes["TEXCOORD_0"] =
        buffer.add(count, "VEC2", kFloat, kVertexBuffer, [&](std::size_t i, auto& out) {
          append_bytes(out, corners.uv[i].x() / size.x());
          append_bytes(out, corners.uv[i].y() / size.y());
        });
  }
  const int indices =
      buffer.add(3 * corners.faces.size(), "SCALAR", kUnsignedInt, kIndexBuffer,
                 [&](std::size_t i, auto& out) { append_bytes(out, corners.faces[i / 3][i % 3]); });
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
  const nlohmann::ordered_json primitive = add_triangles(mesh, buffer);
  nlohmann::ordered_json surface = {{"metallicFactor", 0.0}, {"roughnessFactor", 1.0}};
  // unlit: the pictures' light is in the colours already
  nlohmann::ordered_json material = {
      {"name", "surface"},
      {"doubleSided", true},
      {"extensions", {{"KHR_materials_unlit", nlohmann::ordered_json::object()}}}};
  nlohmann::ordered_json json = {
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
  json["accessors"] = buffer.accessors();
  json["bufferViews"] = buffer.views();
  json["buffers"] = {{{"byteLength", buffer.bytes().size()}}};

  std::string chunks;
  append_chunk(chunks, kJsonChunk, json.dump(), ' ');
  append_chunk(chunks, kBinChunk, buffer.bytes(), '\0');
  std::string glb;
  append_bytes(glb, kMagic);
  append_bytes(glb, std::uint32_t{2});
  append_bytes(glb, static_cast<std::uint32_t>(12 + chunks.size()));
  return glb + chunks;
}

}  // namespace gnbv
