#include <fmt/format.h>

#include <memory>

#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/execute.hpp"
#include "tools/gnbv/progress.hpp"
#include "tools/render/camera_choice.hpp"
#include "tools/render/pictures.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

struct RenderOptions {
  std::vector<fs::path> runs;
  std::vector<std::string> what = {"path"};
  fs::path out;
  std::string camera = "iso";
  PictureOptions picture;
};

void render(RenderOptions options) {
  const CameraChoice choice = choose_camera(options.camera);
  options.picture.angles = choice.angles;
  options.picture.camera = choice.camera;
  ProgressBar progress("render", false);
  std::vector<std::unique_ptr<RunSource>> sources;
  std::vector<RunSource*> runs;
  for (const fs::path& run : options.runs) {
    sources.push_back(std::make_unique<RunSource>(
        run, thread_count(0),
        [&](double share, const std::string& note) { progress.show(share, note); }));
    runs.push_back(sources.back().get());
  }
  Renderer renderer;
  for (const std::string& what : options.what) {
    const PictureKind& kind = picture_kind(what);
    const PanelLayout layout = lay_out(kind, runs, options.picture);
    for (RunSource* run : runs) {
      const Image image = draw_picture(kind, *run, options.picture, layout, renderer);
      const fs::path png = options.out / fmt::format("{}-{}.png", run->record().folder.filename().string(), kind.name);
      write_png(image, png);
      fmt::print("{}\n", png.string());
    }
  }
}

}  // namespace

void add_render_command(CLI::App& app) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* const command =
      app.add_subcommand("render", "draw the structure with the flown path, without a display");
  command->add_option("RUN", options->runs, "run directory")->required();
  command->add_option("-o,--out", options->out, "PNG to write (default: RUN/path.png)");
  command->add_option("--what", options->what, "")->delimiter(',');
  command->add_option("--camera", options->camera, "");
  command->add_option("--iteration", options->picture.iteration, "");
  command->add_option("--width", options->picture.width_px, "width in pixels")
      ->check(CLI::Range(16, 8192))
      ->capture_default_str();
  command->add_option("--height", options->picture.height_px, "height in pixels")
      ->check(CLI::Range(16, 8192))
      ->capture_default_str();
  command->callback([options] { render(*options); });
}

}  // namespace gnbv
