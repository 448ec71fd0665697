#include <freetype/freetype.h>
#include <freetype/ftadvanc.h>
#include <freetype/ftoutln.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sim/core/error.hpp"
#include "sim/core/text.hpp"
#include "tools/render/caption.hpp"

namespace gnbv {
namespace {

/// The file that holds all letters.
std::string font_file() {
  const char* const wanted = std::getenv("GNBV_FONT");
  if (wanted != nullptr && *wanted != '\0') return wanted;
  for (std::string_view left = GNBV_FONT_FILES; !left.empty();) {
    const std::string file(left.substr(0, left.find(':')));
    if (std::filesystem::exists(file)) return file;
    left.remove_prefix(std::min(file.size() + 1, left.size()));
  }
  throw BadInput(
      "pictures need a font for their words, Debian package fonts-dejavu-core (tools/setup "
      "installs it) or the one that GNBV_FONT=FILE names; there is no " GNBV_FONT_FILES);
}

void blend(Image& image, int x, int y, double share, const Rgb8& colour) {
  if (x < 0 || y < 0 || x >= image.width_px || y >= image.height_px || share <= 0.0) return;
  std::uint8_t* const pixel = image.rgb.data() + 3 * (static_cast<std::size_t>(y) *
                                                          static_cast<std::size_t>(image.width_px) +
                                                      static_cast<std::size_t>(x));
  for (std::size_t k = 0; k < 3; ++k) {
    pixel[k] = static_cast<std::uint8_t>(std::lround((1.0 - share) * pixel[k] + share * colour[k]));
  }
}

int within(double px, int size_px) { return static_cast<int>(std::clamp(px, 0.0, 1.0 * size_px)); }

class Font {
 public:
  struct Letter {
    FT_UInt glyph = 0;
    FT_Pos x_units = 0;
  };
  struct Line {
    std::vector<Letter> letters;
    FT_Pos width_units = 0;
  };

  Font() {
    FT_Library library = nullptr;
    check(FT_Init_FreeType(&library));
    library_.reset(library);
    check(FT_New_Face(library, file_.c_str(), 0, &face_));
    if (!FT_IS_SCALABLE(face_)) throw BadInput(file_ + ": a font of pixels, not of outlines");
    check(FT_Load_Char(face_, 'H', FT_LOAD_NO_SCALE));
    capital_units_ = static_cast<double>(std::max<FT_Pos>(1, face_->glyph->metrics.height));
  }

  double px_per_unit(double height_px) const { return height_px / capital_units_; }

  /// Side by side, kerned.
  Line line_of(std::string_view text) const {
    Line line;
    while (!text.empty()) {
      const FT_UInt glyph = FT_Get_Char_Index(face_, take_code_point(text));
      FT_Vector kerning{};
      if (!line.letters.empty()) {
        const FT_UInt before = line.letters.back().glyph;
        check(FT_Get_Kerning(face_, before, glyph, FT_KERNING_UNSCALED, &kerning));
      }
      line.letters.push_back({glyph, line.width_units + kerning.x});
      FT_Fixed advance = 0;
      check(FT_Get_Advance(face_, glyph, FT_LOAD_NO_SCALE, &advance));
      line.width_units += kerning.x + advance;
    }
    return line;
  }

  void draw(const Line& line, double x_px, int baseline_px, double height_px, const Rgb8& colour,
            Image& image) const {
    const double scale = px_per_unit(height_px);
    check(FT_Set_Char_Size(face_, 0, std::lround(64.0 * scale * face_->units_per_EM), 72, 72));
    for (const Letter& letter : line.letters) {
      const double x = x_px + scale * static_cast<double>(letter.x_units);
      const int column = static_cast<int>(std::floor(x));
      // light: heights on whole pixels, widths as they were drawn
      check(FT_Load_Glyph(face_, letter.glyph, FT_LOAD_TARGET_LIGHT | FT_LOAD_NO_BITMAP));
      FT_Outline_Translate(&face_->glyph->outline, std::lround(64.0 * (x - column)), 0);
      check(FT_Render_Glyph(face_->glyph, FT_RENDER_MODE_NORMAL));
      const FT_Bitmap& bitmap = face_->glyph->bitmap;
      for (int v = 0; v < static_cast<int>(bitmap.rows); ++v) {
        for (int u = 0; u < static_cast<int>(bitmap.width); ++u) {
          blend(image, column + face_->glyph->bitmap_left + u,
                baseline_px - face_->glyph->bitmap_top + v,
                bitmap.buffer[v * bitmap.pitch + u] / 255.0, colour);
        }
      }
    }
  }

 private:
  void check(FT_Error error) const {
    if (error == 0) return;
    throw BadInput(
        "{}: cannot be read as a font (FreeType's error {}); GNBV_FONT=FILE names another", file_,
        error);
  }

  std::string file_ = font_file();
  std::unique_ptr<FT_LibraryRec_, decltype(&FT_Done_FreeType)> library_{nullptr, FT_Done_FreeType};
  FT_Face face_ = nullptr;  // the library's
  double capital_units_ = 1.0;
};

/// Read when the first letter is drawn; a face is of one thread.
const Font& font() {
  thread_local const Font font;
  return font;
}

}  // namespace

Rgb8 to_rgb8(const Rgb& linear) {
  Rgb8 out{};
  for (std::size_t k = 0; k < 3; ++k) out[k] = srgb_byte(std::clamp(linear[k], 0.0F, 1.0F));
  return out;
}

void draw_line(Image& image, const std::array<double, 2>& from_px,
               const std::array<double, 2>& to_px, double width_px, const Rgb8& colour) {
  const double reach = 0.5 * width_px + 1.0;
  const double dx = to_px[0] - from_px[0];
  const double dy = to_px[1] - from_px[1];
  const double dd = dx * dx + dy * dy;
  const int right = within(std::max(from_px[0], to_px[0]) + reach + 1.0, image.width_px);
  const int bottom = within(std::max(from_px[1], to_px[1]) + reach + 1.0, image.height_px);
  for (int y = within(std::min(from_px[1], to_px[1]) - reach, image.height_px); y < bottom; ++y) {
    for (int x = within(std::min(from_px[0], to_px[0]) - reach, image.width_px); x < right; ++x) {
      const double px = x + 0.5 - from_px[0];
      const double py = y + 0.5 - from_px[1];
      const double t = dd > 0.0 ? std::clamp((px * dx + py * dy) / dd, 0.0, 1.0) : 0.0;
      const double distance_px = std::hypot(px - t * dx, py - t * dy);
      const double cover = std::clamp(0.5 * width_px - distance_px + 0.5, 0.0, 1.0);
      blend(image, x, y, cover, colour);
    }
  }
}

void draw_box(Image& image, const std::array<double, 2>& from_px,
              const std::array<double, 2>& to_px, const Rgb8& colour, double opacity) {
  const int right = within(std::round(to_px[0]), image.width_px);
  const int bottom = within(std::round(to_px[1]), image.height_px);
  for (int y = within(std::round(from_px[1]), image.height_px); y < bottom; ++y) {
    for (int x = within(std::round(from_px[0]), image.width_px); x < right; ++x) {
      blend(image, x, y, opacity, colour);
    }
  }
}

double draw_text(Image& image, std::string_view text, double x_px, double baseline_px,
                 double height_px, const Rgb8& colour) {
  const Font::Line line = font().line_of(text);
  font().draw(line, x_px, static_cast<int>(std::lround(baseline_px)), height_px, colour, image);
  return x_px + font().px_per_unit(height_px) * static_cast<double>(line.width_units);
}

double text_width_px(std::string_view text, double height_px) {
  return font().px_per_unit(height_px) * static_cast<double>(font().line_of(text).width_units);
}

double fitting_height_px(std::string_view text, double height_px, double width_px) {
  return std::min(height_px, height_px * std::max(width_px, 0.0) / text_width_px(text, height_px));
}

}  // namespace gnbv
