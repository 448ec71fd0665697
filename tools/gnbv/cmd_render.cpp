#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <future>
#include <iterator>
#include <map>
#include <memory>

#include "sim/core/error.hpp"
#include "tools/figures/groups.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/render_options.hpp"
#include "tools/mission/execute.hpp"
#include "tools/render/film.hpp"
#include "tools/render/pictures.hpp"
#include "tools/render/snapshots.hpp"
#include "tools/run/file_names.hpp"
#include "tools/surface/surface_picture.hpp"
#include "tools/terminal/progress.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kSnapshots = 12;  // about as many, without --every

/// What `gnbv surface` made of the run.
SurfaceItem made_surface(RunSource& run, double piece_m) {
  const fs::path& folder = run.record().folder;
  if (!fs::exists(folder / kSurfaceFolder / "surface.obj")) {
    throw BadInput("no {}: `gnbv surface {}` makes it",
                   (folder / kSurfaceFolder / "surface.obj").string(), folder.string());
  }
  return textured_item(read_surface(folder / kSurfaceFolder), piece_m);
}

class RenderCommand {
 public:
  explicit RenderCommand(const RenderOptions& options)
      : options_(options), kinds_(kinds_asked(options)), progress_("render", options.quiet) {
    need_consistent(options, kinds_);
    set_camera(options_);
    set_letters(options_);
    if (options.is_over_surface) options_.picture.surface = made_surface;
    const std::vector<std::string> names = run_names(options.runs);
    for (const fs::path& run : options.runs) {
      sources_.push_back(std::make_unique<RunSource>(
          run, thread_count(options.threads),
          [this](double share, const std::string& note) { show(share, note); }));
      runs_.push_back(sources_.back().get());
      names_[runs_.back()] = names[runs_.size() - 1];
      expect(*runs_.back());
      for (const std::string& missing : runs_.back()->record().missing) note(missing);
    }
  }

  /// Draws what can be drawn, and says what cannot. Throws BadInput when that is everything.
  void draw() {
    const std::vector<std::string> order = drawing_order();
    for (const std::string& name : order) {
      show(0.0, name);
      draw_kind(name);
      kinds_done_ += 1.0;
    }
    if (drawn_ == 0) throw BadInput("{}", fmt::join(reasons_, "\n"));
    for (const std::string& reason : reasons_) note(reason);
    if (!options_.sheet.empty()) write_sheet();
  }

 private:
  /// As asked; of one run, what waits for its mission to be flown again comes last: the rest is
  /// drawn meanwhile.
  std::vector<std::string> drawing_order() {
    std::vector<std::string> order = kinds_;
    if (runs_.size() > 1 || order.size() == 1) return order;
    std::stable_partition(order.begin(), order.end(),
                          [](const std::string& name) { return !is_flown_again(name); });
    runs_.front()->fly_ahead();
    return order;
  }

  static bool is_flown_again(const std::string& kind) {
    return kind == "profile" || kind == "voxels" || kind == "candidates";
  }

  void write_sheet() {
    std::vector<DrawnPicture> cells;  // in the order asked for, however they were drawn
    for (const std::string& name : kinds_) {
      std::vector<DrawnPicture>& row = rows_[name];
      std::move(row.begin(), row.end(), std::back_inserter(cells));
    }
    const bool has_any = std::any_of(cells.begin(), cells.end(), [](const DrawnPicture& drawn) {
      return !drawn.image.rgb.empty();
    });
    if (!has_any) return;
    const int columns = static_cast<int>(runs_.size());
    written(options_.sheet, contact_sheet(sheet_cells(std::move(cells), columns), columns));
  }

  /// One bar for all: every kind takes as much of it, and this much of the present one is done.
  void show(double share, const std::string& what) {
    progress_.show((kinds_done_ + share) / static_cast<double>(kinds_.size()), what);
  }

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
    const PictureOptions shared = with_shared_angles(
        kind, able, with_shared_colours(kind, able, options_.picture), layout.view);
    for (RunSource* const run : runs_) {
      DrawnPicture drawn;
      const auto draw_one = [&] {
        if (name == "movie") return film(*run, layout);
        if (name == "snapshots") return shoot(*run, layout);
        drawn = draw_without_words(kind.draw(*run, shared, layout.view), title_of(*run, shared),
                                   shared, layout, renderer_);
        written(path_of(*run, name, ".png"), with_words(drawn));
      };
      const bool is_able = std::count(able.begin(), able.end(), run) > 0;
      if (is_able && tried(name, *run, draw_one)) ++drawn_;
      if (runs_.size() > 1) run->forget();
      if (!options_.sheet.empty() && !is_series(name)) rows_[name].push_back(std::move(drawn));
    }
  }

  Image finished(const Picture& picture, const RunSource& run, PanelLayout layout,
                 const RenderView& view) {
    layout.view = view;
    return draw_picture(picture, run, options_.picture, layout, renderer_);
  }

  void shoot(RunSource& run, const PanelLayout& layout) {
    Snapshots snapshots(run, options_.picture, layout.view, options_.follows);
    const fs::path folder = path_of(run, "snapshots", "");
    fs::create_directories(folder);
    const std::vector<std::size_t> iterations =
        snapshot_iterations(run.record().views.size(), options_.picture.every, kSnapshots);
    for (const std::size_t iteration : iterations) {
      const RenderView view = snapshots.view(iteration);
      written(folder / fmt::format("snapshot_{:04}.png", iteration),
              finished(snapshots.picture(iteration, view), run, layout, view));
    }
  }

  /// The mission along its flown path, faster by one factor throughout.
  void film(RunSource& run, const PanelLayout& layout) {
    const fs::path path = path_of(run, "movie", has_ffmpeg() ? ".mp4" : ".apng");
    make_folder_of(path);
    Film movie(path, options_.picture.width_px, options_.picture.height_px, options_.images_per_s);
    Snapshots snapshots(run, options_.picture, layout.view, options_.follows);
    const auto images = static_cast<std::size_t>(
        std::lround(options_.film_s * static_cast<double>(options_.images_per_s)));
    const std::vector<double> times_s = film_times_s(run.record(), images);
    const double speed = (times_s.back() - times_s.front()) / options_.film_s;
    // what the next image shows is put together while this one is drawn
    const auto begin = [&](std::size_t i) {
      return std::async(std::launch::async, [&snapshots, speed, time_s = times_s[i]] {
        return snapshots.picture_at(time_s, speed, snapshots.view_at(time_s));
      });
    };
    std::future<Picture> next = begin(0);
    for (std::size_t i = 0; i < times_s.size(); ++i) {
      show(static_cast<double>(i) / static_cast<double>(times_s.size()),
           fmt::format("movie, image {}/{}", i + 1, times_s.size()));
      const Picture picture = next.get();
      if (i + 1 < times_s.size()) next = begin(i + 1);
      movie.add(finished(picture, run, layout, snapshots.view_at(times_s[i])));
    }
    movie.finish();
    fmt::print("{}\n", path.string());
  }

  /// What the kinds need of the mission flown again, so that it is flown once.
  void expect(RunSource& run) const {
    const auto is_asked = [&](const char* name) {
      return std::count(kinds_.begin(), kinds_.end(), name) > 0;
    };
    const std::size_t views = run.record().views.size();
    const std::optional<int>& asked = options_.picture.iteration;
    const auto iteration = static_cast<std::size_t>(asked.value_or(0));
    if (views == 0 || (asked && iteration >= views)) return;  // which the pictures will say
    ReplayRequest request{.has_profile = is_asked("profile")};
    if (is_asked("voxels")) request.belief = asked ? iteration : views - 1;
    const std::size_t decision = asked ? iteration : views / 2;
    if (is_asked("candidates") && decision > 0) request.decision = decision;
    run.expect(request);
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
  double kinds_done_ = 0.0;
  std::size_t drawn_ = 0;
  std::vector<std::string> reasons_;  // why something was not
  Renderer renderer_;
  // of the sheet, by kind: a run a column; empty where one was not drawn
  std::map<std::string, std::vector<DrawnPicture>> rows_;
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
