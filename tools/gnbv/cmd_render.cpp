#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <map>
#include <memory>

#include "sim/core/error.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/render_options.hpp"
#include "tools/mission/execute.hpp"
#include "tools/render/movie.hpp"
#include "tools/render/pictures.hpp"
#include "tools/render/snapshots.hpp"
#include "tools/run_files/run_names.hpp"
#include "tools/terminal/progress.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kSnapshots = 12;  // about as many, without --every
constexpr std::size_t kFilmImages = 240;

class RenderCommand {
 public:
  explicit RenderCommand(const RenderOptions& options)
      : options_(options), kinds_(kinds_asked(options)), progress_("render", options.quiet) {
    need_consistent(options, kinds_);
    set_camera(options_);
    const std::vector<std::string> names = run_names(options.runs);
    for (const fs::path& run : options.runs) {
      sources_.push_back(std::make_unique<RunSource>(
          run, thread_count(options.threads),
          [this](double share, const std::string& note) { progress_.show(share, note); }));
      runs_.push_back(sources_.back().get());
      names_[runs_.back()] = names[runs_.size() - 1];
      for (const std::string& missing : runs_.back()->record().missing) note(missing);
    }
  }

  /// Draws what can be drawn, and says what cannot. Throws BadInput when that is everything.
  void draw() {
    for (const std::string& name : kinds_) draw_kind(name);
    if (drawn_ == 0) throw BadInput(fmt::format("{}", fmt::join(reasons_, "\n")));
    for (const std::string& reason : reasons_) note(reason);
    const bool has_any = std::any_of(images_.begin(), images_.end(),
                                     [](const Image& image) { return !image.rgb.empty(); });
    if (!options_.sheet.empty() && has_any) {
      written(options_.sheet, contact_sheet(images_, static_cast<int>(runs_.size())));
    }
  }

 private:
  void note(const std::string& sentence) const {
    if (!options_.quiet) say(sentence);
  }

  /// Whether that came to its end; if not, the reason is kept.
  bool tried(const std::string& name, const RunSource& run, const std::function<void()>& action) {
    try {
      action();
      return true;
    } catch (const BadInput& error) {
      reasons_.push_back(
          fmt::format("{} of {}: {}", name, run.record().folder.string(), error.what()));
      return false;
    }
  }

  /// The runs that have what has to be seen in such a picture.
  std::vector<RunSource*> runs_with(const std::string& name, const PictureKind& kind) {
    std::vector<RunSource*> able;
    for (RunSource* const run : runs_) {
      std::vector<Vec3> points;
      if (tried(name, *run, [&] { kind.frame(*run, options_.picture, points); }))
        able.push_back(run);
    }
    return able;
  }

  void draw_kind(const std::string& name) {
    const PictureKind& kind = is_series(name) ? kSnapshotFraming : picture_kind(name);
    const std::vector<RunSource*> able = runs_with(name, kind);
    if (able.empty()) return;
    const PanelLayout layout = lay_out(kind, able, options_.picture);
    for (RunSource* const run : runs_) {
      Image image;
      const auto draw_one = [&] {
        if (name == "movie") return film(*run, layout);
        if (name == "snapshots") return shoot(*run, layout);
        image = draw_picture(kind, *run, options_.picture, layout, renderer_);
        written(path_of(*run, name, ".png"), image);
      };
      const bool is_able = std::count(able.begin(), able.end(), run) > 0;
      if (is_able && tried(name, *run, draw_one)) ++drawn_;
      if (runs_.size() > 1) run->forget();
      if (!options_.sheet.empty() && !is_series(name)) images_.push_back(std::move(image));
    }
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
    return options_.out / fmt::format("{}-{}{}", names_.at(&run), name, ending);
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
  std::map<const RunSource*, std::string> names_;  // of runs, for files
  std::size_t drawn_ = 0;
  std::vector<std::string> reasons_;  // why something was not
  Renderer renderer_;
  std::vector<Image> images_;  // for the sheet: a run a column; empty where one was not drawn
};

}  // namespace

void add_render_command(CLI::App& app) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* const command = app.add_subcommand(
      "render", "draw runs: path, profile, cloud, coverage, voxels, candidates, plan");
  add_render_options(*command, *options);
  command->callback([options] { RenderCommand(*options).draw(); });
}

}  // namespace gnbv
