// make_surface() of surface.hpp.
#include <unistd.h>

#include "sensors/ray_scene.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/mission/reference.hpp"
#include "tools/run/run_inputs.hpp"
#include "tools/surface/surface.hpp"
#include "tools/surface/surface_picture.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// A folder made before the work, so that one that cannot be made costs no time. It goes again when
/// nothing was written into it.
class OutFolder {
 public:
  explicit OutFolder(fs::path path) : path_(std::move(path)) {
    is_new_ = make_folder(path_);
    if (::access(path_.c_str(), W_OK | X_OK) != 0) {
      throw BadInput("{}: cannot write into the folder", path_.string());
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
  for_each_point(threads, errors.size(), [&](std::size_t i) {
    const Vec3 p_m = mesh.vertices_m[i].cast<double>();
    errors[i] = std::min(kMost_m, scene.distance_to_structure_m(p_m, kMost_m));
  });
  return errors;
}

/// The paths of what is written. What an earlier call knew of the truth and this one does not goes.
std::vector<fs::path> write_all(const TexturedMesh& mesh, const std::optional<SurfaceScore>& score,
                                const std::optional<World>& truth, const std::string& title,
                                const fs::path& folder, int threads) {
  std::vector<fs::path> paths = write_surface(mesh, folder);
  const auto write = [&](const char* name, bool is_known, const auto& write_to) {
    std::error_code ignored;
    if (is_known) {
      write_to(paths.emplace_back(folder / name));
    } else {
      fs::remove(folder / name, ignored);
    }
  };
  write("preview.png", true,
        [&](const fs::path& path) { write_png(surface_picture(mesh, title), path); });
  write("error.png", truth.has_value(), [&](const fs::path& path) {
    write_png(error_picture(mesh.shape, errors_m(mesh.shape, *truth, threads), title), path);
  });
  write("score.json", score.has_value(),
        [&](const fs::path& path) { write_file_atomically(path, score_json(*score)); });
  return paths;
}

}  // namespace

MadeSurface make_surface(const RunRecord& record, const SurfaceSettings& settings,
                         const fs::path& folder, bool needs_score, int threads,
                         const SurfaceProgress& progress) {
  MadeSurface made;
  const std::optional<World> truth = truth_of(record, made.notes);
  if (needs_score && !truth) throw BadInput("--json: " + made.notes.back());
  const OutFolder out(folder);
  const TexturedMesh mesh = reconstruct_surface(record, settings, threads, progress, made.notes);
  progress(0.9, "scoring");
  if (truth) {
    made.score = score_surface(mesh.shape, *truth, reference_config(record.scenario), threads);
  }
  progress(0.95, "writing");
  made.files = write_all(mesh, made.score, truth, run_title(record), folder, threads);
  progress(1.0, "done");
  return made;
}

}  // namespace gnbv
