#include <fmt/format.h>

#include <memory>

#include "tools/gnbv/commands.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/render/run_picture.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

struct RenderOptions {
  fs::path run;
  fs::path out;
  RunPictureOptions picture;
};

void render(const RenderOptions& options) {
  const RunRecord record = read_run(options.run);
  for (const std::string& missing : record.missing) fmt::print(stderr, "gnbv: {}\n", missing);
  const fs::path png = options.out.empty() ? options.run / "path.png" : options.out;
  std::vector<std::string> told_by_run;  // the mesh's faults were told when it was flown
  const World world = load_world(record.scenario, told_by_run);
  render_run(record, world.structure, options.picture, png);
  fmt::print("{}\n", png.string());
}

}  // namespace

void add_render_command(CLI::App& app) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* const command =
      app.add_subcommand("render", "draw the structure with the flown path, without a display");
  command->add_option("RUN", options->run, "run directory")->required();
  command->add_option("-o,--out", options->out, "PNG to write (default: RUN/path.png)");
  command->add_option("--width", options->picture.width_px, "width in pixels")
      ->check(CLI::Range(16, 8192))
      ->capture_default_str();
  command->add_option("--height", options->picture.height_px, "height in pixels")
      ->check(CLI::Range(16, 8192))
      ->capture_default_str();
  command->callback([options] { render(*options); });
}

}  // namespace gnbv
