#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <filesystem>
#include <memory>
#include <optional>

#include "sensors/ray_scene.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/parallel.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/mission/execute.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/mission/reference.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/run_inputs.hpp"
#include "tools/surface/surface.hpp"
#include "tools/surface/surface_picture.hpp"
#include "tools/surface/surface_score.hpp"
#include "tools/terminal/progress.hpp"
#include "tools/terminal/say.hpp"
#include "tools/terminal/width.hpp"

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

/// A folder made before the work, so that one that cannot be made costs no time. It goes again when
/// nothing was written into it.
class OutFolder {
 public:
  explicit OutFolder(fs::path path) : path_(std::move(path)) {
    is_new_ = make_folder(path_);
    if (::access(path_.c_str(), W_OK | X_OK) != 0) {
      throw BadInput(fmt::format("{}: cannot write into the folder", path_.string()));
    }
  }
  ~OutFolder() {
    std::error_code not_empty;
    if (is_new_) fs::remove(path_, not_empty);
  }
  OutFolder(const OutFolder&) = delete;
  OutFolder& operator=(const OutFolder&) = delete;

 private:
  fs::path path_;
  bool is_new_ = false;
};

/// What the surface is scored against; nothing, and a note, when its mesh cannot be loaded.
std::optional<World> truth_of(const RunRecord& record, std::vector<std::string>& notes) {
  std::vector<std::string> told_by_run;  // the mesh's faults were told when it was flown
  try {
    World world = load_world(record.scenario, told_by_run);
    need_same_inputs(record.folder, world_inputs(record.scenario, world),
                     "another structure is none to score by");
    return world;
  } catch (const BadInput& error) {
    notes.push_back(fmt::format("{}; without the true structure there is no score", error.what()));
    return std::nullopt;
  }
}

/// Of each vertex to the true structure, as far as the finest voxels of the score go.
std::vector<double> errors_m(const TriangleMesh& mesh, const World& truth, int threads) {
  const RayScene scene(truth);
  std::vector<double> errors(mesh.vertices_m.size());
  constexpr double kMost_m = 0.05;
  parallel_for_chunks(threads, errors.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 p_m = mesh.vertices_m[i].cast<double>();
      errors[i] = std::min(kMost_m, scene.distance_to_structure_m(p_m, kMost_m));
    }
  });
  return errors;
}

/// The paths of what is written. What an earlier call knew of the truth and this one does not goes.
std::vector<fs::path> write_all(const TexturedMesh& mesh, const std::optional<SurfaceScore>& score,
                                const std::optional<World>& truth, const std::string& title,
                                const fs::path& folder, int threads) {
  std::vector<fs::path> paths = write_surface(mesh, folder);
  paths.push_back(folder / "preview.png");
  write_png(surface_picture(mesh, title, 1280, 720), paths.back());
  if (truth) {
    paths.push_back(folder / "error.png");
    write_png(error_picture(mesh.shape, errors_m(mesh.shape, *truth, threads), title, 1280, 720),
              paths.back());
  } else {
    std::error_code ignored;
    fs::remove(folder / "error.png", ignored);
  }
  if (score) {
    paths.push_back(folder / "score.json");
    write_file_atomically(paths.back(), score_json(*score));
  } else {
    std::error_code ignored;
    fs::remove(folder / "score.json", ignored);
  }
  return paths;
}

void surface(const SurfaceOptions& options) {
  SurfaceSettings settings = options.settings;
  settings.depth = depth_of(options.depth);
  settings.has_texture = !options.no_texture;
  const int threads = thread_count(options.threads);
  const RunRecord record = read_run(options.run);
  for (const std::string& missing : record.missing) say(missing);
  std::vector<std::string> notes;
  const std::optional<World> truth = truth_of(record, notes);
  if (options.json && !truth) throw BadInput("--json: " + notes.back());
  const fs::path folder = options.out.empty() ? options.run / kSurfaceFolder : options.out;
  const OutFolder made(folder);

  std::vector<fs::path> paths;
  std::optional<SurfaceScore> score;
  {
    ProgressBar bar("surface", options.quiet);
    const auto progress = [&](double share, const std::string& note) { bar.show(share, note); };
    const TexturedMesh mesh = reconstruct_surface(record, settings, threads, progress, notes);
    progress(0.9, "scoring");
    if (truth) {
      score = score_surface(mesh.shape, *truth, reference_config(record.scenario), threads);
    }
    progress(0.95, "writing");
    paths = write_all(mesh, score, truth, run_title(record), folder, threads);
    progress(1.0, "done");
  }
  for (const std::string& note : notes) say(note);
  if (options.json) {
    fmt::print("{}", score_json(*score));
    return;
  }
  for (const fs::path& path : paths) fmt::print("{}\n", path.string());
  if (score) fmt::print("\n{}", score_text(*score, run_title(record), stdout_columns()));
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
      ->check(is_positive());
  command
      ->add_option("--simplify-m", options->settings.simplify_m,
                   "how far the surface may move to become fewer faces; 0: not at all (default: a "
                   "fifth of a leaf)")
      ->check(CLI::Range(0.0, 10.0));
  command
      ->add_option("--texture-px", options->settings.texture_px,
                   "longest side of the texture, at most")
      ->check(CLI::Range(128, 16384))
      ->capture_default_str();
  command->add_flag("--no-texture", options->no_texture, "colours at the vertices alone");
  add_threads_option(*command, options->threads);
  add_quiet_option(*command, options->quiet);
  command->add_flag("--json", options->json, "print the score as JSON instead of paths and table");
  command->callback([options] { surface(*options); });
}

}  // namespace gnbv
