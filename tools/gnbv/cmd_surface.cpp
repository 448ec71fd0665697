#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "sim/core/error.hpp"
#include "sim/core/text.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/mission/execute.hpp"
#include "tools/run/file_names.hpp"
#include "tools/surface/cloud_surface.hpp"
#include "tools/terminal/progress.hpp"
#include "tools/terminal/say.hpp"
#include "tools/terminal/streams.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

struct SurfaceOptions {
  fs::path run;
  fs::path out;
  std::string depth = "auto";
  SurfaceSettings settings;
  std::vector<double> offset_m;  // x, y, z of a cloud; empty: none
  bool no_texture = false;
  int threads = 0;
  bool quiet = false;
  bool json = false;
};

int depth_of(const std::string& text) {
  if (text == "auto") return 0;
  const auto depth = number_in<int>(text);
  if (depth && *depth >= kMinDepth && *depth <= kMaxDepth) return *depth;
  throw BadInput("--depth: '{}' is neither auto nor a number from {} to {}", text, kMinDepth,
                 kMaxDepth);
}

void surface_from_cloud(const SurfaceOptions& options, const SurfaceSettings& settings) {
  fs::path folder = options.out;
  if (folder.empty()) folder = fs::path(options.run).replace_extension().string() + "_surface";
  const std::vector<double>& d = options.offset_m;
  std::vector<std::string> notes;
  const CloudSurface made = [&] {
    ProgressBar bar("surface", options.quiet);
    return surface_of_cloud(
        options.run, d.empty() ? Vec3::Zero() : Vec3(d[0], d[1], d[2]), settings, folder,
        thread_count(options.threads),
        [&](double share, const std::string& note) { bar.show(share, note); }, notes);
  }();
  for (const std::string& note : notes) say(note);
  if (options.json) return fmt::print("{}", made.json);
  for (const fs::path& file : made.files) fmt::print("{}\n", file.string());
  fmt::print("\n{}", made.text);
}

void surface(const SurfaceOptions& options) {
  SurfaceSettings settings = options.settings;
  settings.depth = depth_of(options.depth);
  settings.has_texture = !options.no_texture;
  if (fs::is_regular_file(options.run)) return surface_from_cloud(options, settings);
  if (!options.offset_m.empty()) throw BadInput("--offset-m: is for clouds, not for runs");
  const RunRecord record = read_run(options.run);
  for (const std::string& missing : record.missing) say(missing);
  const fs::path folder = options.out.empty() ? options.run / kSurfaceFolder : options.out;
  const MadeSurface made = [&] {
    ProgressBar bar("surface", options.quiet);
    return make_surface(record, settings, folder, options.json, thread_count(options.threads),
                        [&](double share, const std::string& note) { bar.show(share, note); });
  }();
  for (const std::string& note : made.notes) say(note);
  if (options.json) return fmt::print("{}", score_json(*made.score));
  for (const fs::path& file : made.files) fmt::print("{}\n", file.string());
  if (made.score) {
    fmt::print("\n{}", score_text(*made.score, run_title(record), stdout_columns()));
  }
}

}  // namespace

void add_surface_command(CLI::App& app) {
  auto options = std::make_shared<SurfaceOptions>();
  CLI::App* const command = app.add_subcommand(
      "surface", "make a textured mesh of a run, or a mesh of any cloud; say its error");
  command->add_option("RUN|CLOUD", options->run, "run directory, or a cloud as `score` reads it")
      ->required();
  command->add_option("-o,--out", options->out,
                      "folder to write (default: RUN/surface, or CLOUD_surface)");
  command
      ->add_option("--offset-m", options->offset_m,
                   "x,y,z (m), added to all points of a cloud before anything is rounded: for map "
                   "grids such as UTM")
      ->delimiter(',')
      ->expected(3);
  command->add_option("--depth", options->depth,
                      "depth of Poisson's octree, 5 to 12; one more is twice as fine and four "
                      "times as slow (default: auto, by leaf and extent of the cloud, up to 10)");
  command
      ->add_option("--trim-m", options->settings.trim_m,
                   "surface farther than this from any point is cut off (default: 2 spacings of "
                   "the points there, at most 6 leaves)")
      ->check(is_positive());
  command
      ->add_option("--simplify-m", options->settings.simplify_m,
                   "how far the surface may move to become fewer faces; 0: not at all (default: a "
                   "fifth of a leaf)")
      ->check(CLI::Range(0.0, 10.0));
  command
      ->add_option("--texture-px", options->settings.texture_px,
                   "most pixels along the texture's longest side")
      ->check(CLI::Range(128, 16384))
      ->capture_default_str();
  command->add_flag("--no-texture", options->no_texture,
                    "no texture, only colours at the vertices");
  add_threads_option(*command, options->threads);
  add_quiet_option(*command, options->quiet);
  command->add_flag("--json", options->json, "print the score as JSON instead of paths and table");
  command->callback([options] { surface(*options); });
}

}  // namespace gnbv
