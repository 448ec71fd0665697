#include "sim/core/image.hpp"

#include <png.h>

#include <cerrno>
#include <cstdio>
#include <memory>
#include <span>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"

namespace gnbv {
namespace {

// libpng's callbacks must not return to it after an error: this one jumps back to encode(). Its
// words are no more than "Write Error"; errno knows why.
void jump_back(png_structp png, png_const_charp) { png_longjmp(png, 1); }
void ignore_warning(png_structp, png_const_charp) {}

/// RGB of 8 bits or grey of 16, in the byte order of this machine.
struct Rows {
  int width_px = 0;
  int height_px = 0;
  bool is_rgb = true;
  const std::uint8_t* bytes = nullptr;
};

// Between setjmp and longjmp there is only plain data of the caller: nothing needs a destructor.
bool encode(std::FILE* file, const Rows& rows) {
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, jump_back, ignore_warning);
  png_infop info = png_create_info_struct(png);
  if (setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_init_io(png, file);
  png_set_compression_level(png, 3);  // 0.4 of the time of the default, 6 % more bytes
  png_set_IHDR(png, info, static_cast<png_uint_32>(rows.width_px),
               static_cast<png_uint_32>(rows.height_px), rows.is_rgb ? 8 : 16,
               rows.is_rgb ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (rows.is_rgb) png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(png, info);
  if (!rows.is_rgb) png_set_swap(png);  // PNG is big-endian, we are little-endian
  const std::size_t stride = static_cast<std::size_t>(rows.width_px) * (rows.is_rgb ? 3 : 2);
  for (int y = 0; y < rows.height_px; ++y) {
    png_write_row(png, rows.bytes + static_cast<std::size_t>(y) * stride);
  }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return true;
}

void write_rows(const Rows& rows, std::size_t byte_count, const std::filesystem::path& path,
                Lasting lasting) {
  GNBV_CHECK(rows.width_px > 0 && rows.height_px > 0 &&
                 byte_count == static_cast<std::size_t>(rows.width_px) *
                                   static_cast<std::size_t>(rows.height_px) * (rows.is_rgb ? 3 : 2),
             "{} bytes for {} x {} px", byte_count, rows.width_px, rows.height_px);
  const auto write = [&](const std::filesystem::path& part) {
    errno = 0;
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(part.c_str(), "wb"),
                                                         &std::fclose);
    bool is_written = file && encode(file.get(), rows);
    const int cause = errno;
    if (file && std::fclose(file.release()) != 0) is_written = false;
    if (!is_written) refuse_to_write(path, cause != 0 ? cause : errno);
  };
  write_file_atomically(path, write, lasting);
}

/// Reads all pixels in the format, a value a channel. Throws BadInput.
template <typename Picture, typename Value>
Picture read_pixels(std::uint32_t format, const std::filesystem::path& path) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&header, path.c_str()) != 0) {
    if (format == PNG_FORMAT_LINEAR_Y && header.format != format) {
      png_image_free(&header);
      throw BadInput(fmt::format("{}: is no grey picture of 16 bits a pixel", path.string()));
    }
    header.format = format;
    std::vector<Value> pixels(PNG_IMAGE_SIZE(header) / sizeof(Value));
    if (png_image_finish_read(&header, nullptr, pixels.data(), 0, nullptr) != 0) {
      return {static_cast<int>(header.width), static_cast<int>(header.height), std::move(pixels)};
    }
  }
  throw BadInput(fmt::format("{}: {}", path.string(), header.message));
}

}  // namespace

void write_png(const Image& image, const std::filesystem::path& path, Lasting lasting) {
  write_rows({image.width_px, image.height_px, true, image.rgb.data()}, image.rgb.size(), path,
             lasting);
}

void write_png(const GreyImage16& image, const std::filesystem::path& path, Lasting lasting) {
  const auto bytes = std::as_bytes(std::span(image.values));
  write_rows(
      {image.width_px, image.height_px, false, reinterpret_cast<const std::uint8_t*>(bytes.data())},
      bytes.size(), path, lasting);
}

Image read_png(const std::filesystem::path& path) {
  return read_pixels<Image, std::uint8_t>(PNG_FORMAT_RGB, path);
}

GreyImage16 read_png_grey16(const std::filesystem::path& path) {
  return read_pixels<GreyImage16, std::uint16_t>(PNG_FORMAT_LINEAR_Y, path);
}

}  // namespace gnbv
