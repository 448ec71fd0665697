// glTF 2.0 in its binary form (Khronos, section 4.4), to write.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "sim/core/file.hpp"
#include "sim/core/pose.hpp"

namespace gnbv {

/// World coordinates as glTF's, whose y is up.
inline Vec3f y_up(const Vec3f& z_up) { return {z_up.x(), z_up.z(), -z_up.y()}; }

/// The binary chunk and the tables that say what lies where in it.
struct GlbBuffer {
  using Json = nlohmann::ordered_json;
  enum Component { kFloat = 5126, kUnsignedInt = 5125, kUnsignedShort = 5123 };

  std::string bytes;
  Json views = Json::array();
  Json accessors = Json::array();

  /// Values that `append(i)` puts at the end of the bytes; the index of their accessor.
  template <typename Append>
  std::size_t add(std::size_t count, const char* type, Component component, const Append& append) {
    constexpr int kVertices = 34962, kIndices = 34963;
    const std::size_t begin = bytes.size();
    for (std::size_t i = 0; i < count; ++i) append(i);
    views.push_back({{"buffer", 0},
                     {"byteOffset", begin},
                     {"byteLength", bytes.size() - begin},
                     {"target", component == kUnsignedInt ? kIndices : kVertices}});
    accessors.push_back({{"bufferView", views.size() - 1},
                         {"componentType", static_cast<int>(component)},
                         {"count", count},
                         {"type", type}});
    return accessors.size() - 1;
  }

  /// Positions of which `position(i)` gives each, y up.
  template <typename Position>
  std::size_t add_positions(std::size_t count, const Position& position) {
    Eigen::AlignedBox3f box;
    const std::size_t index = add(count, "VEC3", kFloat, [&](std::size_t i) {
      const Vec3f p = position(i);
      box.extend(p);
      for (const float x : p) append_bytes(bytes, x);
    });
    accessors.back()["min"] = {box.min().x(), box.min().y(), box.min().z()};
    accessors.back()["max"] = {box.max().x(), box.max().y(), box.max().z()};
    return index;
  }
};

/// The file: `json` with the buffer's tables added, and its bytes.
std::string glb_bytes(GlbBuffer::Json json, const GlbBuffer& buffer);

}  // namespace gnbv
