// What `gnbv render` is asked for.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/render/picture.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace gnbv {

struct RenderOptions {
  std::vector<std::filesystem::path> runs;
  std::vector<std::string> what = {"path"};
  std::filesystem::path out;
  std::filesystem::path sheet;
  std::string camera;  // empty: iso, of a profile from higher above
  std::optional<double> azimuth_deg;
  std::optional<double> elevation_deg;
  std::optional<double> letters;  // nothing: as suits pictures that stand alone, or on a sheet
  PictureOptions picture;
  bool follows = false;
  bool is_over_surface = false;
  int images_per_s = 15;
  double film_s = 10.0;
  int threads = 0;
  bool quiet = false;
};

void add_render_options(CLI::App& command, RenderOptions& options);

/// Whether a path names one image or film, not a folder.
bool is_file_name(const std::filesystem::path& path);
/// Many images of a run instead of one.
bool is_series(const std::string& kind);

/// The kinds asked for, each once; movies last, since they take longest. Throws BadInput naming all
/// kinds for another one.
std::vector<std::string> kinds_asked(const RenderOptions& options);

/// Throws BadInput for files that cannot be made of what is asked for.
void need_consistent(const RenderOptions& options, const std::vector<std::string>& kinds);

/// Sets the picture's camera; angles of the options replace those of a preset. Throws BadInput as
/// choose_camera(), and for angles beside a file.
void set_camera(RenderOptions& options);

/// Sets the size of the picture's words: larger where a sheet of several columns will be shown
/// smaller than its pictures.
void set_letters(RenderOptions& options);

}  // namespace gnbv
