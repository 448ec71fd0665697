#include "tools/page/jpeg.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
// jpeglib.h wants size_t and FILE declared before it
#include <jpeglib.h>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

// In the place of libjpeg's own handler, which ends the program. Only a lack of memory gets here.
[[noreturn]] void refuse(j_common_ptr info) {
  char message[JMSG_LENGTH_MAX];
  info->err->format_message(info, message);
  throw BrokenInvariant(fmt::format("libjpeg: {}", message));
}

}  // namespace

std::vector<std::uint8_t> jpeg_bytes(const Image& image, int quality) {
  GNBV_CHECK(image.width_px > 0 && image.height_px > 0, "{} x {} px", image.width_px,
             image.height_px);
  jpeg_error_mgr errors{};
  jpeg_compress_struct info{};
  info.err = jpeg_std_error(&errors);
  errors.error_exit = refuse;
  jpeg_create_compress(&info);
  unsigned char* buffer = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&info, &buffer, &size);
  info.image_width = static_cast<JDIMENSION>(image.width_px);
  info.image_height = static_cast<JDIMENSION>(image.height_px);
  info.input_components = 3;
  info.in_color_space = JCS_RGB;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, quality, TRUE);
  info.optimize_coding = TRUE;
  jpeg_start_compress(&info, TRUE);
  const std::size_t stride = 3 * static_cast<std::size_t>(image.width_px);
  while (info.next_scanline < info.image_height) {
    auto* row = const_cast<JSAMPLE*>(image.rgb.data() + info.next_scanline * stride);
    jpeg_write_scanlines(&info, &row, 1);
  }
  jpeg_finish_compress(&info);
  std::vector<std::uint8_t> bytes(buffer, buffer + size);
  jpeg_destroy_compress(&info);
  std::free(buffer);
  return bytes;
}

Image shrunk(const Image& image, int factor) {
  Image out{image.width_px / factor, image.height_px / factor, {}};
  GNBV_CHECK(factor >= 1 && out.width_px > 0 && out.height_px > 0, "{} x {} px by {}",
             image.width_px, image.height_px, factor);
  const auto width = static_cast<std::size_t>(out.width_px);
  const auto side = static_cast<std::size_t>(factor);
  const std::uint32_t pixels = static_cast<std::uint32_t>(factor * factor);
  const std::size_t stride = 3 * static_cast<std::size_t>(image.width_px);
  std::vector<std::uint32_t> sums(3 * width);
  for (std::size_t y = 0; y < static_cast<std::size_t>(out.height_px); ++y) {
    std::fill(sums.begin(), sums.end(), pixels / 2);  // to round
    for (std::size_t row = y * side; row < (y + 1) * side; ++row) {
      const std::uint8_t* from = image.rgb.data() + row * stride;
      for (std::size_t x = 0; x < width; ++x) {
        for (std::size_t i = 0; i < side; ++i, from += 3) {
          for (std::size_t k = 0; k < 3; ++k) sums[3 * x + k] += from[k];
        }
      }
    }
    for (const std::uint32_t sum : sums) out.rgb.push_back(static_cast<std::uint8_t>(sum / pixels));
  }
  return out;
}

}  // namespace gnbv
