#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>

#include "sim/core/error.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/execute.hpp"
#include "tools/gnbv/progress.hpp"
#include "tools/render/camera_choice.hpp"
#include "tools/render/movie.hpp"
#include "tools/render/pictures.hpp"
#include "tools/render/snapshots.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

struct RenderOptions {
  std::vector<fs::path> runs;
  std::vector<std::string> what = {"path"};
  fs::path out;
  fs::path sheet;
  std::string camera = "iso";
  std::optional<double> azimuth_deg;
  std::optional<double> elevation_deg;
  PictureOptions picture;
  bool follows = false;
  int images_per_s = 24;
  int threads = 0;
};

constexpr std::size_t kSnapshots = 12;  // about as many, without --every
constexpr std::size_t kFilmImages = 240;

bool is_film_name(const fs::path& path) {
  return path.extension() == ".mp4" || path.extension() == ".gif";
}

bool is_file_name(const fs::path& path) { return path.extension() == ".png" || is_film_name(path); }

/// The kinds asked for, each once; movies last, since they take longest.
std::vector<std::string> kinds_asked(const RenderOptions& options) {
  std::vector<std::string> names;
  for (const std::string& what : options.what) {
    if (what == "all") {
      for (const PictureKind* kind : picture_kinds()) names.emplace_back(kind->name);
      names.insert(names.end(), {"snapshots", "movie"});
    } else {
      if (what != "snapshots" && what != "movie") picture_kind(what);
      names.push_back(what);
    }
  }
  std::set<std::string> seen;
  std::erase_if(names, [&](const std::string& name) { return !seen.insert(name).second; });
  std::stable_partition(names.begin(), names.end(),
                        [](const std::string& name) { return name != "movie"; });
  return names;
}

class RenderCommand {
 public:
  explicit RenderCommand(const RenderOptions& options)
      : options_(options), kinds_(kinds_asked(options)), progress_("render", false) {
    const bool is_one_file = is_file_name(options.out);
    if (is_one_file && (options.runs.size() > 1 || kinds_.size() > 1)) {
      throw BadInput(
          fmt::format("--out {}: one file for {} runs and {} kinds of pictures: give a "
                      "folder",
                      options.out.string(), options.runs.size(), kinds_.size()));
    }
    if (is_one_file && (kinds_.front() == "snapshots" ||
                        is_film_name(options.out) != (kinds_.front() == "movie"))) {
      throw BadInput(
          fmt::format("--out {}: {} is no such file", options.out.string(), kinds_.front()));
    }
    for (const fs::path& run : options.runs) {
      sources_.push_back(std::make_unique<RunSource>(
          run, thread_count(options.threads),
          [this](double share, const std::string& note) { progress_.show(share, note); }));
      runs_.push_back(sources_.back().get());
      for (const std::string& missing : runs_.back()->record().missing) {
        fmt::print(stderr, "gnbv: {}\n", missing);
      }
    }
    const CameraChoice choice = choose_camera(options.camera);
    options_.picture.angles = choice.angles;
    options_.picture.camera = choice.camera;
    if (options.azimuth_deg) options_.picture.angles.azimuth_rad = deg_to_rad(*options.azimuth_deg);
    if (options.elevation_deg) {
      options_.picture.angles.elevation_rad = deg_to_rad(*options.elevation_deg);
    }
  }

  void draw() {
    const bool is_all = std::count(options_.what.begin(), options_.what.end(), "all") > 0;
    std::size_t drawn = 0;
    std::string reason;
    for (const std::string& name : kinds_) {
      try {
        draw_kind(name);
        ++drawn;
      } catch (const BadInput& error) {
        if (!is_all) throw;
        reason = error.what();
        fmt::print(stderr, "gnbv: {}: {}\n", name, reason);
      }
    }
    if (drawn == 0) throw BadInput(reason);
    if (!options_.sheet.empty() && !images_.empty()) {
      written(options_.sheet, contact_sheet(images_, static_cast<int>(runs_.size())));
    }
  }

 private:
  void draw_kind(const std::string& name) {
    if (name == "snapshots" || name == "movie") {
      const PanelLayout layout = lay_out(kSnapshotFraming, runs_, options_.picture);
      for (RunSource* const run : runs_) {
        name == "movie" ? film(*run, layout) : shoot(*run, layout);
      }
      return;
    }
    const PictureKind& kind = picture_kind(name);
    const PanelLayout layout = lay_out(kind, runs_, options_.picture);
    std::vector<Image> images;
    for (RunSource* const run : runs_) {
      images.push_back(draw_picture(kind, *run, options_.picture, layout, renderer_));
      written(path_of(*run, name, ".png"), images.back());
    }
    if (!options_.sheet.empty())
      std::move(images.begin(), images.end(), std::back_inserter(images_));
  }

  Image snapshot(const Snapshots& snapshots, RunSource& run, const PanelLayout& fixed,
                 std::size_t iteration) {
    PanelLayout layout = fixed;
    layout.view = snapshots.view(iteration);
    return draw_picture(snapshots.picture(iteration, layout.view), run, options_.picture, layout,
                        renderer_);
  }

  void shoot(RunSource& run, const PanelLayout& layout) {
    const Snapshots snapshots(run, options_.picture, layout.view, options_.follows);
    const fs::path folder = path_of(run, "snapshots", "");
    fs::create_directories(folder);
    const std::vector<std::size_t> iterations =
        snapshot_iterations(run.record().views.size(), options_.picture.every, kSnapshots);
    for (const std::size_t iteration : iterations) {
      written(folder / fmt::format("snapshot_{:04}.png", iteration),
              snapshot(snapshots, run, layout, iteration));
    }
  }

  void film(RunSource& run, const PanelLayout& layout) {
    const fs::path path = path_of(run, "movie", ".mp4");
    make_folder_of(path);
    Movie movie(path, layout.view.width_px, layout.view.height_px, options_.images_per_s);
    const Snapshots snapshots(run, options_.picture, layout.view, options_.follows);
    const std::vector<std::size_t> iterations =
        snapshot_iterations(run.record().views.size(), options_.picture.every, kFilmImages);
    for (std::size_t i = 0; i < iterations.size(); ++i) {
      progress_.show(static_cast<double>(i) / static_cast<double>(iterations.size()),
                     fmt::format("movie, image {}/{}", i + 1, iterations.size()));
      movie.add(snapshot(snapshots, run, layout, iterations[i]));
    }
    movie.finish();
    fmt::print("{}\n", path.string());
  }

  /// RUN/NAME without --out, else the file or FOLDER/NAME; of several runs FOLDER/RUN-NAME.
  fs::path path_of(const RunSource& run, const std::string& name, const std::string& ending) const {
    const fs::path& folder = run.record().folder;
    if (options_.out.empty()) return folder / (name + ending);
    if (is_file_name(options_.out)) return options_.out;
    if (runs_.size() == 1) return options_.out / (name + ending);
    const fs::path plain = fs::absolute(folder).lexically_normal();
    const std::string run_name = (plain.has_filename() ? plain : plain.parent_path()).filename();
    return options_.out / fmt::format("{}-{}{}", run_name, name, ending);
  }

  static void make_folder_of(const fs::path& path) {
    if (path.has_parent_path()) fs::create_directories(path.parent_path());
  }

  static void written(const fs::path& path, const Image& image) {
    make_folder_of(path);
    write_png(image, path);
    fmt::print("{}\n", path.string());
  }

  RenderOptions options_;
  std::vector<std::string> kinds_;
  ProgressBar progress_;
  std::vector<std::unique_ptr<RunSource>> sources_;
  std::vector<RunSource*> runs_;
  Renderer renderer_;
  std::vector<Image> images_;  // for the sheet
};

std::string help_on_what() {
  std::string help = "what to draw, separated by commas, or all:";
  for (const PictureKind* kind : picture_kinds()) {
    help += fmt::format("\n{} = {}", kind->name, kind->shows);
  }
  return help + "\nsnapshots = third-person images each --every views" +
         "\nmovie = the same as a film, by ffmpeg";
}

void add_camera_options(CLI::App& command, RenderOptions& options) {
  command
      .add_option(
          "--camera", options.camera,
          "iso, front, back, left, right, top, or a JSON file with position_m, target_m and "
          "fov_y_deg; presets frame the picture by themselves")
      ->capture_default_str();
  command.add_option("--azimuth-deg", options.azimuth_deg,
                     "from where to look: 0 east, 90 north (default: the camera's)");
  command.add_option("--elevation-deg", options.elevation_deg, "above the horizon")
      ->check(CLI::Range(-89.0, 90.0));
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

void add_render_command(CLI::App& app) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* const command =
      app.add_subcommand("render", "draw runs: path, profile, cloud, coverage, voxels, candidates");
  command->add_option("RUN", options->runs, "run directories; all get the same camera")->required();
  command->add_option("--what", options->what, help_on_what())
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
  command->add_option("-o,--out", options->out,
                      "PNG, MP4 or GIF to write, or a folder (default: the run directory)");
  command->add_option("--sheet", options->sheet,
                      "also a PNG with all pictures side by side: a column a run, a row a kind");
  add_camera_options(*command, *options);
  command
      ->add_option("--iteration", options->picture.iteration,
                   "cloud, coverage, voxels: after this view (default: the last); candidates: the "
                   "decision that chose it (default: half way)")
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--every", options->picture.every,
                   "path: frusta of each n-th view; snapshots, movie: an image each n views")
      ->check(CLI::PositiveNumber);
  command->add_option("--fps", options->images_per_s, "movie: images a second")
      ->check(CLI::Range(1, 120))
      ->capture_default_str();
  command->add_option("--title", options->picture.title, "(default: scenario and utility)");
  command->add_flag("--with-profile", options->picture.has_profile,
                    "path: the profile's flight, too, wide around the structure");
  command->add_flag("!--no-caption", options->picture.has_caption, "no title, legend and scale");
  command->add_option("--threads", options->threads, "0 = all; the pictures do not depend on it")
      ->check(CLI::Range(0, 1024));
  command->callback([options] { RenderCommand(*options).draw(); });
}

}  // namespace gnbv
