#include <fmt/format.h>

#include <memory>

#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
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
  const fs::path yaml = options.run / "scenario.yaml";
  if (!fs::exists(yaml)) {
    throw BadInput(
        fmt::format("{}: no run directory: scenario.yaml is missing; `gnbv run SCENARIO "
                    "--out {}` makes one",
                    options.run.string(), options.run.string()));
  }
  const Scenario scenario = load_scenario(yaml.string(), {});
  RunPictureOptions picture = options.picture;
  picture.camera = scenario.cameras.front();
  picture.has_ground = scenario.structure.ground;
  const fs::path png = options.out.empty() ? options.run / "path.png" : options.out;
  std::vector<std::string>
      told_by_run;  // the mesh was read, and its faults told, when it was flown
  render_run(options.run, load_world(scenario, told_by_run).structure, picture, png);
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
