// From a run to a surface: cloud, normals, screened Poisson, trim, texture. The reconstruction sees
// what the run measured and believed, never the true mesh; what is made of it is scored.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/run/run_record.hpp"
#include "tools/surface/oriented_cloud.hpp"
#include "tools/surface/surface_score.hpp"
#include "tools/surface/textured_mesh.hpp"

namespace gnbv {

struct SurfaceSettings {
  int depth = 0;  // of Poisson's octree; 0: cells of about 1.5 leaves of the cloud, 10 at most
  double trim_m = 0.0;  // surface farther from any point goes; 0: by the spacing of the points
  std::optional<double> simplify_m;  // how far it may move to become fewer faces; a fifth of a leaf
  int texture_px = 8192;             // longest side of the atlas
  bool has_texture = true;           // also without it vertices get the pictures' colours
};

constexpr int kMinDepth = 5;
constexpr int kMaxDepth = 12;

/// Told what is being done, and how much of everything is done.
using SurfaceProgress = std::function<void(double share_done, const std::string& note)>;

/// Poisson's depth for cells of about `cell_m`, from kMinDepth to 10.
int depth_for(const Box3& points_m, double cell_m);

/// The trimmed surface of a cloud. Throws BadInput, naming `name`, for a cloud without points and
/// when nothing of the surface holds.
TriangleMesh shape_of(const OrientedCloud& cloud, double leaf_m, const SurfaceSettings& settings,
                      const std::string& name, int threads, const SurfaceProgress& progress);

/// All of it, from the files of the run. Throws BadInput as read_run_cloud() does; without frames,
/// with damaged ones, or where none shows any of it, colours show the height, which `notes` then
/// says with the command that helps. Deterministic at any number of threads.
TexturedMesh reconstruct_surface(const RunRecord& record, const SurfaceSettings& settings,
                                 int threads, const SurfaceProgress& progress,
                                 std::vector<std::string>& notes);

struct MadeSurface {
  std::vector<std::filesystem::path> files;
  std::optional<SurfaceScore> score;  // none where the true structure cannot be loaded
  std::vector<std::string> notes;
};

/// Reconstructs, scores and writes into the folder, which is made if need be. Throws BadInput as
/// reconstruct_surface(), for a folder that cannot be written to before any work, and without a
/// score when that is needed.
MadeSurface make_surface(const RunRecord& record, const SurfaceSettings& settings,
                         const std::filesystem::path& folder, bool needs_score, int threads,
                         const SurfaceProgress& progress);

}  // namespace gnbv
