#include "sim/mesh/ply_write.hpp"

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"

namespace gnbv {
namespace {

constexpr const char* kColours = "property uchar red\nproperty uchar green\nproperty uchar blue\n";

template <typename Value, std::size_t kExtent>
void append_all(std::string& out, std::span<const Value, kExtent> values) {
  for (const Value& value : values) append_bytes(out, value);
}

void need_as_many(std::size_t values, std::size_t count, const char* what) {
  GNBV_CHECK(values == 0 || values == count, "{} {} of {}", values, what, count);
}

std::string head_of(const PlyVertices& vertices, const std::optional<PlyFaces>& faces) {
  std::string head = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment gnbv, world ENU, metres\n"
      "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n",
      vertices.places_world_m.size());
  if (!vertices.normals.empty())
    head += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!vertices.colours.empty()) head += kColours;
  if (!vertices.views.empty()) head += "property int view\n";
  if (faces) {
    head += fmt::format("element face {}\nproperty list uchar int vertex_indices\n",
                        faces->corners.size());
    if (!faces->colours.empty()) head += kColours;
  }
  return head + "end_header\n";
}

}  // namespace

std::string ply_bytes(const PlyVertices& vertices, const std::optional<PlyFaces>& faces) {
  const std::size_t count = vertices.places_world_m.size();
  need_as_many(vertices.normals.size(), count, "normals");
  need_as_many(vertices.colours.size(), count, "colours");
  need_as_many(vertices.views.size(), count, "views");
  std::string out = head_of(vertices, faces);
  out.reserve(out.size() + 31 * count + (faces ? 16 * faces->corners.size() : 0));
  for (std::size_t i = 0; i < count; ++i) {
    append_all(out, std::span<const float>(vertices.places_world_m[i].data(), 3));
    if (!vertices.normals.empty()) {
      append_all(out, std::span<const float>(vertices.normals[i].data(), 3));
    }
    if (!vertices.colours.empty()) append_all(out, std::span(vertices.colours[i]));
    if (!vertices.views.empty()) append_bytes(out, vertices.views[i]);
  }
  if (!faces) return out;
  need_as_many(faces->colours.size(), faces->corners.size(), "colours");
  for (std::size_t i = 0; i < faces->corners.size(); ++i) {
    append_bytes(out, std::uint8_t{3});
    append_all(out, std::span(faces->corners[i]));
    if (!faces->colours.empty()) append_all(out, std::span(faces->colours[i]));
  }
  return out;
}

}  // namespace gnbv
