// From a run to a surface: cloud, normals, screened Poisson, trim, texture. It sees what the run
// measured and believed, never the true mesh.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/run/run_record.hpp"
#include "tools/surface/oriented_cloud.hpp"
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

/// The frames of a run, and each as a view of the surface.
struct RunPictures {
  FrameRecord frames;
  std::vector<TextureView> views;
};

/// Nothing when the run has no frames, or one is damaged, which `notes` then says with the command
/// that helps. Depth images are read, pictures not yet.
std::optional<RunPictures> read_pictures(const RunRecord& record, int threads,
                                         std::vector<std::string>& notes);

/// The shape with the run's pictures on it; with colours by height when none shows any of it or a
/// picture is damaged, which `notes` then says. Deterministic at any number of threads.
TexturedMesh dressed(TriangleMesh shape, const RunRecord& record, const RunPictures& pictures,
                     const SurfaceSettings& settings, int threads, const SurfaceProgress& progress,
                     std::vector<std::string>& notes);

/// All of it, from the files of the run. Throws BadInput as read_run_cloud() does; without frames,
/// or with damaged ones, colours show the height.
TexturedMesh reconstruct_surface(const RunRecord& record, const SurfaceSettings& settings,
                                 int threads, const SurfaceProgress& progress,
                                 std::vector<std::string>& notes);

}  // namespace gnbv
