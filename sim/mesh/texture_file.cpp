#include "sim/mesh/texture_file.hpp"

#include <fmt/ranges.h>
#include <png.h>

#include <csetjmp>
#include <cstdio>
// jpeglib.h wants size_t and FILE declared before it
#include <jerror.h>
#include <jpeglib.h>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/mesh/plain_text.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

void need_size(std::size_t width_px, std::size_t height_px, std::size_t most_px) {
  constexpr std::size_t kMostSide = 1U << 16U;
  if (width_px <= kMostSide && height_px <= kMostSide && width_px * height_px <= most_px) return;
  throw BadInput("too large ({} x {}; all of a mesh may have {} pixels)", width_px, height_px,
                 TextureFiles::kMostPixels);
}

/// Without what it says of its colours: they are sRGB, as glTF 2.0 (3.8.4) has it.
std::string without_colour_space(std::string_view png) {
  constexpr std::size_t kSignature = 8, kAround = 12;  // bytes; of a chunk, besides its data
  std::string out(png.substr(0, kSignature));
  png.remove_prefix(out.size());
  while (png.size() >= kAround) {
    std::size_t size = kAround;
    for (std::size_t i = 0; i < 4; ++i) {
      size += std::size_t{static_cast<unsigned char>(png[i])} << (24 - 8 * i);
    }
    const std::string_view chunk = png.substr(0, size), kind = chunk.substr(4, 4);
    if (kind != "gAMA" && kind != "cHRM" && kind != "iCCP" && kind != "sRGB") out += chunk;
    png.remove_prefix(chunk.size());
  }
  return out.append(png);
}

Image read_png(std::string_view file, std::size_t most_px) {
  const std::string bytes = without_colour_space(file);
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) == 0) {
    throw BadInput("damaged ({})", header.message);
  }
  const std::unique_ptr<png_image, void (*)(png_imagep)> freed(&header, png_image_free);
  need_size(header.width, header.height, most_px);
  header.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  header.format = PNG_FORMAT_RGBA;  // what lies under the alpha stays: libpng would blend it
  std::vector<std::uint8_t> rgba(PNG_IMAGE_SIZE(header));
  if (png_image_finish_read(&header, nullptr, rgba.data(), 0, nullptr) == 0) {
    throw BadInput("damaged ({})", header.message);
  }
  Image image{static_cast<int>(header.width), static_cast<int>(header.height), {}};
  image.rgb.reserve(rgba.size() / 4 * 3);
  for (std::size_t i = 0; i < rgba.size(); i += 4) {
    image.rgb.insert(image.rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
  }
  return image;
}

/// libjpeg's own handler ends the program: this one jumps back, and words stay here.
struct JpegErrors {
  jpeg_error_mgr manager{};
  std::jmp_buf back{};
  char message[JMSG_LENGTH_MAX] = "";
};

void jump_back(j_common_ptr info) {
  auto* const errors = reinterpret_cast<JpegErrors*>(info->err);
  info->err->format_message(info, errors->message);
  std::longjmp(errors->back, 1);
}

/// What is missing of a picture is grey in libjpeg: that is damage, bytes too many are none.
void take_message(j_common_ptr info, int level) {
  const bool is_passed_over = level >= 0 || info->err->msg_code == JWRN_EXTRANEOUS_DATA;
  if (!is_passed_over) jump_back(info);
}

/// The state of libjpeg between two jumps; nothing in these functions needs a destructor.
struct JpegReader {
  jpeg_decompress_struct info{};
  JpegErrors errors{};

  explicit JpegReader(std::string_view bytes) {
    info.err = jpeg_std_error(&errors.manager);
    errors.manager.error_exit = jump_back;
    errors.manager.emit_message = take_message;
    jpeg_create_decompress(&info);
    jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;
  ~JpegReader() { jpeg_destroy_decompress(&info); }

  bool read_header() {
    if (setjmp(errors.back) != 0) return false;
    jpeg_read_header(&info, TRUE);
    if (info.out_color_space != JCS_CMYK) info.out_color_space = JCS_RGB;
    return true;
  }
  bool read_rows(std::uint8_t* pixels) {
    if (setjmp(errors.back) != 0) return false;
    jpeg_start_decompress(&info);
    while (info.output_scanline < info.output_height) {
      const auto channels = static_cast<std::size_t>(info.output_components);
      JSAMPLE* row = pixels + channels * info.output_width * info.output_scanline;
      jpeg_read_scanlines(&info, &row, 1);
    }
    jpeg_finish_decompress(&info);
    return true;
  }
};

/// What four inks leave of white; inverted levels say that of each ink.
void make_rgb(std::vector<std::uint8_t>& cmyk, bool is_inverted) {
  const auto left_by = [&](std::uint8_t ink) { return is_inverted ? ink : 255 - ink; };
  for (std::size_t i = 0; i < cmyk.size() / 4; ++i) {
    const int left_by_black = left_by(cmyk[4 * i + 3]);
    for (std::size_t k = 0; k < 3; ++k) {
      cmyk[3 * i + k] =
          static_cast<std::uint8_t>((left_by(cmyk[4 * i + k]) * left_by_black + 127) / 255);
    }
  }
  cmyk.resize(cmyk.size() / 4 * 3);
}

Image read_jpeg(std::string_view bytes, std::size_t most_px) {
  JpegReader reader(bytes);
  const auto need = [&](bool is_read) {
    if (!is_read) throw BadInput("damaged ({})", reader.errors.message);
  };
  need(reader.read_header());
  need_size(reader.info.image_width, reader.info.image_height, most_px);
  Image image{
      static_cast<int>(reader.info.image_width), static_cast<int>(reader.info.image_height), {}};
  const bool is_cmyk = reader.info.out_color_space == JCS_CMYK;
  image.rgb.resize((is_cmyk ? std::size_t{4} : std::size_t{3}) * reader.info.image_width *
                   reader.info.image_height);
  need(reader.read_rows(image.rgb.data()));
  if (is_cmyk) make_rgb(image.rgb, reader.info.saw_Adobe_marker != 0);
  return image;
}

/// Without "file:" and its host.
std::string without_scheme(std::string uri) {
  if (!uri.starts_with("file:")) return uri;
  uri.erase(0, 5);
  if (uri.starts_with("//")) {
    const bool is_relative = uri.starts_with("//.");  // of some exporters
    const std::size_t path = is_relative ? 2 : uri.find('/', 2);
    uri.erase(0, std::min(path, uri.size()));
  }
  const bool has_drive = uri.size() > 2 && uri[0] == '/' && uri[2] == ':';
  return has_drive ? uri.substr(1) : uri;
}

/// Nothing for what is no base64 (RFC 4648, with either alphabet); blanks count for nothing.
std::optional<std::string> bytes_of_base64(std::string_view text) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/-_";
  std::string out;
  std::uint32_t bits = 0;
  unsigned filled = 0;
  for (const char c : text) {
    if (c == '=' || c == '\n' || c == '\r' || c == ' ' || c == '\t') continue;
    const std::size_t digit = kDigits.find(c);
    if (digit == kDigits.npos) return std::nullopt;
    bits = bits << 6U | static_cast<std::uint32_t>(digit < 64 ? digit : digit - 2);
    filled += 6;
    if (filled < 8) continue;
    filled -= 8;
    out += static_cast<char>(bits >> filled & 0xFFU);
  }
  return out;
}

}  // namespace

fs::path file_of_uri(const fs::path& mesh, const std::string& uri) {
  std::vector<std::string> names = {uri, without_scheme(uri)};
  names.push_back(percent_decoded(names.back()));
  names.push_back(names.back());
  std::replace(names.back().begin(), names.back().end(), '\\', '/');
  const fs::path folder = mesh.parent_path();
  const fs::path last = fs::path(names.back()).filename();
  std::vector<fs::path> places;
  for (const std::string& name : names) places.push_back(folder / name);
  for (const char* beside : {"", "textures", "../materials/textures"}) {
    places.push_back(folder / beside / last);
  }
  std::error_code ignored;  // a file that we may not look at counts as not there
  for (const fs::path& place : places) {
    if (fs::is_regular_file(place, ignored)) return place;
  }
  return {};
}

Image read_picture(std::string_view bytes, std::size_t most_px) {
  if (bytes.starts_with("\x89PNG")) return read_png(bytes, most_px);
  if (bytes.starts_with("\xff\xd8\xff")) return read_jpeg(bytes, most_px);
  if (bytes.starts_with("version https://git-lfs")) {
    throw BadInput("Git LFS pointers (git lfs pull)");
  }
  throw BadInput("neither PNG nor JPEG");
}

std::optional<std::string> bytes_of_data_uri(std::string_view uri) {
  const std::size_t comma = std::min(uri.find(','), uri.size() - 1);
  const std::string_view data = uri.substr(comma + 1);
  if (!uri.substr(0, comma).ends_with("base64")) return percent_decoded(data);
  return bytes_of_base64(data);
}

Texture TextureFiles::of(const std::string& name, std::string_view bytes,
                         const std::array<Wrap, 2>& wrap) {
  const auto [entry, is_new] = images_.try_emplace(name);
  if (is_new) {
    try {
      entry->second = std::make_shared<const Image>(read_picture(bytes, kMostPixels - pixels_));
      pixels_ += entry->second->rgb.size() / 3;
    } catch (const BadInput& error) {
      miss(name, error.what());
    }
  }
  return {name, entry->second, wrap};
}

Texture TextureFiles::at(const std::string& uri, const std::array<Wrap, 2>& wrap) {
  if (const auto known = images_.find(uri); known != images_.end()) {
    return {uri, known->second, wrap};
  }
  const fs::path file = file_of_uri(mesh_, uri);
  if (!file.empty()) {
    files_.push_back(file);
    return of(uri, read_file(file), wrap);
  }
  images_.emplace(uri, nullptr);
  miss(uri.empty() ? "one without a name" : uri, "not there");
  return {uri, nullptr, wrap};
}

void TextureFiles::miss(const std::string& name, const std::string& why) {
  missed_[why].push_back(name.substr(0, 100));
}

void TextureFiles::warn(std::vector<std::string>& warnings) const {
  constexpr std::size_t kMostNames = 5;
  for (const auto& [why, names] : missed_) {
    const auto first = std::span(names).first(std::min(names.size(), kMostNames));
    const std::string more =
        names.size() > kMostNames ? fmt::format(" and {} more", names.size() - kMostNames) : "";
    warnings.push_back(
        fmt::format("{}: textures {}, shown in the plain colours of their materials: {}{}",
                    mesh_.string(), why, fmt::join(first, ", "), more));
  }
}

}  // namespace gnbv
