// read_las_cloud() of tools/run/cloud_formats.hpp: ASPRS LAS 1.4 R15, section 2.4.
#include <fmt/format.h>

#include "sim/core/file.hpp"
#include "sim/core/text.hpp"
#include "sim/mesh/plain_text.hpp"
#include "tools/run/cloud_formats.hpp"

namespace gnbv {

void read_las_cloud(CloudPoints& to) {
  constexpr std::size_t kHeader = 227, kHeader14 = 375;  // bytes, of 1.0 and of 1.4
  const std::string bytes = read_file(to.path);
  const auto at = [&]<typename T>(std::size_t offset, T) {
    return number_at<T>(bytes.data() + offset);
  };
  if (!bytes.starts_with("LASF")) to.fail("is no LAS file: it does not begin with LASF");
  if (bytes.size() < kHeader) to.fail("ends within its header");
  const bool has_wide_count = at(24, std::uint8_t{}) == 1 && at(25, std::uint8_t{}) >= 4;
  if (has_wide_count && bytes.size() < kHeader14) to.fail("ends within its header");
  if ((at(104, std::uint8_t{}) & 0x80U) != 0) {
    const std::string las = to.path.stem().string() + ".las";
    to.fail(
        fmt::format("is compressed (LAZ), which we do not read; `python3 -c \"import laspy; "
                    "laspy.read('{}').write('{}')\"` (pip install 'laspy[lazrs]') unpacks it",
                    to.path.string(), las));
  }
  const std::uint64_t first = at(96, std::uint32_t{});
  const std::uint64_t stride = at(105, std::uint16_t{});
  std::uint64_t points = at(107, std::uint32_t{});
  if (has_wide_count && at(247, std::uint64_t{}) > 0) points = at(247, std::uint64_t{});
  if (stride < 12) to.fail(fmt::format("has points of {} bytes, too few for x, y, z", stride));
  const std::uint64_t held = first > bytes.size() ? 0 : (bytes.size() - first) / stride;
  if (held < points) {
    to.fail(fmt::format("ends after {} of the {} points that its header announces", held, points));
  }
  // what may follow the points since 1.3: wave forms, and since 1.4 more records
  const bool has_wave_forms = at(24, std::uint8_t{}) == 1 && at(25, std::uint8_t{}) >= 3;
  std::uint64_t end = bytes.size();
  const auto end_at = [&](std::uint64_t offset) {
    if (offset >= first + points * stride) end = std::min(end, offset);
  };
  if (has_wave_forms && bytes.size() >= kHeader + 8) end_at(at(227, std::uint64_t{}));
  if (has_wide_count) end_at(at(235, std::uint64_t{}));
  if (first <= end) {
    to.left_out((end - first) / stride - points, "points after those that its header announces");
  }
  to.points_m.reserve(points);
  for (std::uint64_t i = 0; i < points; ++i) {
    Vec3 p_m;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      p_m[static_cast<Eigen::Index>(axis)] =
          at(131 + 8 * axis, double{}) * at(first + i * stride + 4 * axis, std::int32_t{}) +
          at(155 + 8 * axis, double{});
    }
    to.add(p_m);
  }
}

}  // namespace gnbv
