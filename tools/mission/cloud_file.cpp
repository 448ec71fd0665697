#include "tools/mission/cloud_file.hpp"

#include <fmt/format.h>

#include <bit>
#include <string>

#include "sim/core/file.hpp"

namespace gnbv {

static_assert(std::endian::native == std::endian::little);
static_assert(sizeof(Vec3f) == 3 * sizeof(float));

void write_cloud_ply(std::span<const Vec3f> points_world_m, const std::filesystem::path& path) {
  std::string content = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment gnbv, world ENU, metres\n"
      "element vertex {}\nproperty float x\nproperty float y\nproperty float z\nend_header\n",
      points_world_m.size());
  content.append(reinterpret_cast<const char*>(points_world_m.data()), points_world_m.size_bytes());
  write_file_atomically(path, content);
}

}  // namespace gnbv
