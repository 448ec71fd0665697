#include "tools/render/apng.hpp"

#include <png.h>
#include <zlib.h>

#include <algorithm>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";

void add_number(std::string& to, std::uint32_t value, int bytes = 4) {
  for (int k = bytes - 1; k >= 0; --k) to += static_cast<char>((value >> (8 * k)) & 0xFFU);
}

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    value = (value << 8) | static_cast<std::uint8_t>(bytes[at + k]);
  }
  return value;
}

void add_chunk(std::string& to, std::string_view name, std::string_view content) {
  add_number(to, static_cast<std::uint32_t>(content.size()));
  const std::size_t begin = to.size();
  to.append(name).append(content);
  const auto* const bytes = reinterpret_cast<const Bytef*>(to.data() + begin);
  add_number(to, static_cast<std::uint32_t>(
                     crc32(0, bytes, static_cast<uInt>(name.size() + content.size()))));
}

/// Where two images of one size differ, from `left`, `top` to before `right`, `bottom`.
struct PixelPatch {
  int left = 0, top = 0, right = 0, bottom = 0;
};

PixelPatch difference(const Image& a, const Image& b) {
  PixelPatch patch{a.width_px, a.height_px, 0, 0};
  for (int y = 0; y < a.height_px; ++y) {
    for (int x = 0; x < a.width_px; ++x) {
      if (a.at(x, y) == b.at(x, y)) continue;
      patch = {std::min(patch.left, x), std::min(patch.top, y), std::max(patch.right, x + 1),
               std::max(patch.bottom, y + 1)};
    }
  }
  // nothing changed, and yet time goes on
  return patch.right > 0 ? patch : PixelPatch{0, 0, 1, 1};
}

/// A PNG with alpha of the patch: opaque where the image differs from `before`.
std::string png_of(const Image& image, const Image& before, const PixelPatch& patch) {
  std::string rgba;
  for (int y = patch.top; y < patch.bottom; ++y) {
    for (int x = patch.left; x < patch.right; ++x) {
      const Rgb8 now = image.at(x, y);
      const bool is_new = before.rgb.empty() || now != before.at(x, y);
      for (const std::uint8_t level : now) rgba += static_cast<char>(is_new ? level : 0);
      rgba += static_cast<char>(is_new ? 255 : 0);
    }
  }
  png_image png = {};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(patch.right - patch.left);
  png.height = static_cast<png_uint_32>(patch.bottom - patch.top);
  png.format = PNG_FORMAT_RGBA;
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(png), '\0');
  png_alloc_size_t size = bytes.size();
  const int done = png_image_write_to_memory(&png, bytes.data(), &size, 0, rgba.data(), 0, nullptr);
  GNBV_CHECK(done != 0, "libpng: {}", png.message);
  bytes.resize(size);
  return bytes;
}

}  // namespace

std::string png_chunks(std::string_view png, std::string_view name) {
  std::string contents;
  for (std::size_t at = kSignature.size(); at + 12 <= png.size();) {
    const std::size_t size = number_at(png, at);
    if (png.substr(at + 4, 4) == name) contents += png.substr(at + 8, size);
    at += 12 + size;
  }
  return contents;
}

void Apng::add(const Image& image) {
  const bool is_first = images_ == 0;
  GNBV_CHECK(
      is_first || (image.width_px == before_.width_px && image.height_px == before_.height_px),
      "image of {} x {} px in a film of {} x {}", image.width_px, image.height_px, before_.width_px,
      before_.height_px);
  const PixelPatch patch =
      is_first ? PixelPatch{0, 0, image.width_px, image.height_px} : difference(image, before_);
  std::string control;
  add_number(control, sequence_++);
  for (const int value :
       {patch.right - patch.left, patch.bottom - patch.top, patch.left, patch.top}) {
    add_number(control, static_cast<std::uint32_t>(value));
  }
  add_number(control, 1, 2);
  add_number(control, static_cast<std::uint32_t>(images_per_s_), 2);
  add_number(control, 0, 1);                 // what is there stays
  add_number(control, is_first ? 0 : 1, 1);  // and this goes over it
  add_chunk(chunks_, "fcTL", control);
  const std::string data = png_chunks(png_of(image, before_, patch), "IDAT");
  if (is_first) {
    add_chunk(chunks_, "IDAT", data);
  } else {
    std::string numbered;
    add_number(numbered, sequence_++);
    add_chunk(chunks_, "fdAT", numbered + data);
  }
  before_ = image;
  ++images_;
}

std::string Apng::bytes() const {
  GNBV_CHECK(images_ > 0, "a film without images");
  std::string header;
  add_number(header, static_cast<std::uint32_t>(before_.width_px));
  add_number(header, static_cast<std::uint32_t>(before_.height_px));
  header += std::string_view("\x08\x06\x00\x00\x00", 5);  // 8 bits, RGBA, not interlaced
  std::string animation;
  add_number(animation, images_);
  add_number(animation, 0);  // for ever
  std::string file(kSignature);
  add_chunk(file, "IHDR", header);
  add_chunk(file, "acTL", animation);
  file += chunks_;
  add_chunk(file, "IEND", "");
  return file;
}

}  // namespace gnbv
