#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <memory>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/execute.hpp"
#include "tools/gnbv/progress.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/surface/surface.hpp"
#include "tools/surface/surface_picture.hpp"
#include "tools/surface/surface_score.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

struct SurfaceOptions {
  fs::path run;
  fs::path out;
  std::string depth = "auto";
  SurfaceSettings settings;
  bool no_texture = false;
  int threads = 0;
  bool quiet = false;
  bool json = false;
};

int depth_of(const std::string& text) {
  if (text == "auto") return 0;
  int depth = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), depth);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  if (!is_number || depth < kMinDepth || depth > kMaxDepth) {
    throw BadInput(fmt::format("--depth: '{}' is neither auto nor a number from {} to {}", text,
                               kMinDepth, kMaxDepth));
  }
  return depth;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw BadInput(fmt::format("{}: cannot make the folder: {}", folder.string(), error.message()));
  }
}

void surface(const SurfaceOptions& options) {
  SurfaceSettings settings = options.settings;
  settings.depth = depth_of(options.depth);
  settings.has_texture = !options.no_texture;
  const int threads = thread_count(options.threads);
  const RunRecord record = read_run(options.run);
  for (const std::string& missing : record.missing) fmt::print(stderr, "gnbv: {}\n", missing);
  std::vector<std::string> told_by_run;  // the mesh's faults were told when it was flown
  const World truth = load_world(record.scenario, told_by_run);
  const fs::path folder = options.out.empty() ? options.run / "surface" : options.out;

  std::vector<std::string> notes;
  std::vector<fs::path> paths;
  SurfaceScore score;
  {
    ProgressBar bar("surface", options.quiet);
    const auto progress = [&](double share, const std::string& note) { bar.show(share, note); };
    const TexturedMesh mesh = reconstruct_surface(record, settings, threads, progress, notes);
    progress(0.9, "scoring");
    score = score_surface(mesh.shape, truth, record.scenario.planner.floor_z_m, threads);
    progress(0.95, "writing");
    make_folder(folder);
    paths = write_surface(mesh, folder);
    paths.push_back(folder / "preview.png");
    write_png(surface_picture(mesh, 1280, 720), paths.back());
    paths.push_back(folder / "score.json");
    write_file_atomically(paths.back(), score_json(score));
    progress(1.0, "done");
  }
  for (const std::string& note : notes) fmt::print(stderr, "gnbv: {}\n", note);
  if (options.json) {
    fmt::print("{}", score_json(score));
    return;
  }
  for (const fs::path& path : paths) fmt::print("{}\n", path.string());
  fmt::print("\n{}", score_text(score, run_title(record)));
}

}  // namespace

void add_surface_command(CLI::App& app) {
  auto options = std::make_shared<SurfaceOptions>();
  CLI::App* const command = app.add_subcommand(
      "surface", "a textured mesh from what a run saw, scored against the true structure");
  command->add_option("RUN", options->run, "run directory")->required();
  command->add_option("-o,--out", options->out, "folder to write (default: RUN/surface)");
  command->add_option("--depth", options->depth,
                      "of Poisson's octree, 5 to 12; one more is twice as fine and four times as "
                      "slow (default: auto, by leaf and extent of the cloud, up to 10)");
  command
      ->add_option("--trim-m", options->settings.trim_m,
                   "surface farther than this from any point is cut off (default: 2 spacings of "
                   "the points there, at most 6 leaves)")
      ->check(CLI::PositiveNumber);
  command->add_option("--texture-px", options->settings.texture_px, "longest side of the texture")
      ->check(CLI::Range(128, 16384))
      ->capture_default_str();
  command->add_flag("--no-texture", options->no_texture, "colours at the vertices alone");
  command->add_option("--threads", options->threads, "0 = all; the result does not depend on it")
      ->check(CLI::Range(0, 1024));
  command->add_flag("--quiet", options->quiet, "no progress on stderr");
  command->add_flag("--json", options->json, "print the score as JSON instead of paths and table");
  command->callback([options] { surface(*options); });
}

}  // namespace gnbv
