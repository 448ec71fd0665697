#include "tools/gnbv/render_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <set>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/render/film.hpp"
#include "tools/render/picture.hpp"

namespace gnbv {
namespace {

std::string help_on_what() {
  std::string help = "what to draw, separated by commas, or all:";
  for (const PictureKind* kind : picture_kinds()) {
    help += fmt::format("\n{} = {}", kind->name, kind->shows);
  }
  return help + "\nsnapshots = third-person images, one every --every views" +
         "\nmovie = the flight as a film: MP4 by ffmpeg, or APNG, GIF or WebP by Pillow";
}

void add_camera_options(CLI::App& command, RenderOptions& options) {
  command.add_option("--camera", options.camera,
                     "iso, front, back, left, right, top, or a JSON file with position_m, target_m "
                     "and fov_y_deg; presets frame the picture by themselves (default: iso; a "
                     "profile is seen from higher above)");
  command.add_option("--azimuth-deg", options.azimuth_deg,
                     "from where to look: 0 east, 90 north (default: the camera's)");
  command
      .add_option("--elevation-deg", options.elevation_deg,
                  "how far above the horizon to look from")
      ->check(is_elevation_deg());
  command.add_option("--width", options.picture.width_px, "width in pixels")
      ->check(CLI::Range(16, 8192))
      ->capture_default_str();
  command.add_option("--height", options.picture.height_px, "height in pixels")
      ->check(CLI::Range(16, 8192))
      ->capture_default_str();
  command.add_flag("--follow", options.follows,
                   "snapshots, movie: the camera flies behind and above the vehicle");
}

}  // namespace

bool is_file_name(const std::filesystem::path& path) {
  return path.extension() == ".png" || is_film_ending(path.extension());
}

bool is_series(const std::string& kind) { return kind == "snapshots" || kind == "movie"; }

std::vector<std::string> kinds_asked(const RenderOptions& options) {
  std::vector<std::string> names;
  for (const std::string& what : options.what) {
    if (what == "all") {
      for (const PictureKind* kind : picture_kinds()) names.emplace_back(kind->name);
      names.insert(names.end(), {"snapshots", "movie"});
    } else {
      if (!is_series(what)) picture_kind(what);
      names.push_back(what);
    }
  }
  std::set<std::string> seen;
  std::erase_if(names, [&](const std::string& name) { return !seen.insert(name).second; });
  std::stable_partition(names.begin(), names.end(),
                        [](const std::string& name) { return name != "movie"; });
  return names;
}

void need_consistent(const RenderOptions& options, const std::vector<std::string>& kinds) {
  const bool is_one_file = is_file_name(options.out);
  if (options.is_over_surface && std::count(kinds.begin(), kinds.end(), "path") == 0) {
    throw BadInput("--over-surface: is of the picture path, which --what does not name");
  }
  if (is_one_file && (options.runs.size() > 1 || kinds.size() > 1)) {
    throw BadInput("--out {}: one file for {} runs and {} kinds of pictures: give a folder",
                   options.out.string(), options.runs.size(), kinds.size());
  }
  if (is_one_file && (kinds.front() == "snapshots" ||
                      is_film_ending(options.out.extension()) != (kinds.front() == "movie"))) {
    const char* const endings =
        kinds.front() == "movie" ? "ends in .mp4, .gif, .apng or .webp" : "ends in .png";
    throw BadInput("--out {}: {}", options.out.string(),
                   kinds.front() == "snapshots"
                       ? "snapshots are many files: name a folder"
                       : fmt::format("the name of a {} {}", kinds.front(), endings));
  }
  for (const char* other : {".jpg", ".jpeg", ".svg", ".pdf", ".tif", ".tiff", ".bmp", ".webm",
                            ".avi", ".mov", ".mkv"}) {
    if (extension_of(options.out) != other) continue;
    throw BadInput("--out {}: pictures are .png, movies .mp4, .gif, .apng or .webp",
                   options.out.string());
  }
  if (!options.sheet.empty() && extension_of(options.sheet) != ".png") {
    throw BadInput("--sheet {}: a sheet is a .png", options.sheet.string());
  }
  if (!options.sheet.empty() && std::all_of(kinds.begin(), kinds.end(), is_series)) {
    throw BadInput(
        "--sheet {}: snapshots and movies have no place on a sheet: name other pictures with "
        "--what",
        options.sheet.string());
  }
}

void set_camera(RenderOptions& options) {
  PictureOptions& picture = options.picture;
  const bool is_named = !options.camera.empty();
  const CameraChoice choice = choose_camera(is_named ? options.camera : "iso");
  const bool is_turned = options.azimuth_deg || options.elevation_deg;
  if (choice.camera && is_turned) {
    throw BadInput(
        "--camera {}: the file says from where to look; leave out --azimuth-deg and "
        "--elevation-deg, or the file",
        options.camera);
  }
  picture.camera = choice.camera;
  if (!is_named && !is_turned) return;
  ViewAngles& angles = picture.angles.emplace(choice.angles);
  if (options.azimuth_deg) angles.azimuth_rad = deg_to_rad(*options.azimuth_deg);
  if (options.elevation_deg) angles.elevation_rad = deg_to_rad(*options.elevation_deg);
}

void set_letters(RenderOptions& options) {
  constexpr double kOnSheet = 1.4;
  const bool is_for_sheet = !options.sheet.empty() && options.runs.size() > 1;
  options.picture.letters = options.letters.value_or(is_for_sheet ? kOnSheet : 1.0);
}

void add_render_options(CLI::App& command, RenderOptions& options) {
  command.add_option("RUN", options.runs, "run directories; all get the same camera")->required();
  add_list(command, "--what", options.what, help_on_what())->capture_default_str();
  command.add_option(
      "-o,--out", options.out,
      "PNG, MP4, GIF, APNG or WebP to write, or a folder (default: the run directory)");
  command.add_option("--sheet", options.sheet,
                     "also a PNG with all pictures side by side: one column for each run, one row "
                     "for each kind, lettered (a), (b), ...");
  add_camera_options(command, options);
  command
      .add_option(
          "--iteration", options.picture.iteration,
          "cloud, coverage, voxels: what there was after this view (default: the last). plan: the "
          "same; candidates: the decision that chose this view (both by default half way)")
      ->check(CLI::Range(0, 1'000'000));
  command
      .add_option("--every", options.picture.every,
                  "path, plan: frusta of every n-th view; snapshots: an image every n views")
      ->check(CLI::Range(1, 1'000'000));
  command.add_option("--fps", options.images_per_s, "movie: images per second")
      ->check(CLI::Range(1, 120))
      ->capture_default_str();
  command.add_option("--film-s", options.film_s, "movie: how long it is (s)")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  command
      .add_option("--letters", options.letters,
                  "how large words and marks are (default: 1; with a --sheet of several runs 1.4)")
      ->check(CLI::Range(0.5, 3.0));
  command.add_option("--title", options.picture.title, "title (default: scenario and utility)");
  command.add_flag("--with-profile", options.picture.has_profile,
                   "path: also draw the flight of the profile, wide around the structure");
  command.add_flag(
      "--over-surface", options.is_over_surface,
      "path: draw the surface that `gnbv surface` made of the run, instead of the structure");
  command.add_flag("!--no-caption", options.picture.has_caption, "draw no title, legend or scale");
  add_threads_option(command, options.threads, "the pictures do");
  add_quiet_option(command, options.quiet, "progress, no notes");
}

}  // namespace gnbv
