#include "tools/exports/point_ply.hpp"

#include <bit>
#include <string>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"

namespace gnbv {
namespace {

static_assert(std::endian::native == std::endian::little);

template <typename Value>
void append(const Value& value, std::string& content) {
  content.append(reinterpret_cast<const char*>(&value), sizeof(Value));
}

}  // namespace

void write_point_ply(std::span<const Vec3f> points_world_m, std::span<const Rgb24> colours,
                     std::span<const std::int32_t> views, const std::filesystem::path& path) {
  const std::size_t count = points_world_m.size();
  GNBV_CHECK(colours.empty() || colours.size() == count, "{} of {} colours", colours.size(), count);
  GNBV_CHECK(views.empty() || views.size() == count, "{} of {} views", views.size(), count);
  std::string content = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment gnbv, world ENU, metres\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n",
      count);
  if (!colours.empty()) {
    content += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  }
  if (!views.empty()) content += "property int view\n";
  content += "end_header\n";
  content.reserve(content.size() + 19 * count);
  for (std::size_t i = 0; i < count; ++i) {
    append(points_world_m[i], content);
    if (!colours.empty()) append(colours[i], content);
    if (!views.empty()) append(views[i], content);
  }
  write_file_atomically(path, content);
}

}  // namespace gnbv
