// From a run to a surface: cloud, normals, screened Poisson, trim, texture. The reconstruction sees
// what the run measured and believed, never the true mesh; what is made of it is scored.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/score/cloud_metrics.hpp"
#include "bench/score/surface_reference.hpp"
#include "tools/run/run_record.hpp"
#include "tools/surface/oriented_cloud.hpp"
#include "tools/surface/textured_mesh.hpp"

namespace gnbv {

// ---- surface_score.cpp: how near a reconstructed surface is to the true one

struct SurfaceScore {
  CloudDistances distances = {};  // precision, accuracy: of the surface's samples; recall,
                                  // completeness: of the reference's, exactly to the surface
  std::size_t samples = 0;        // of the surface, above the floor
  double floor_z_m = 0.0;
};

/// Points spread over a mesh evenly by area, the same for the same mesh: one in each of `count`
/// equal parts of its area, drawn by `seed`.
std::vector<Vec3f> samples_by_area(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed);

/// Scores the surface above the floor: samples by area against the true structure, and the samples
/// of the true surface that see out (bench/score/surface_reference.hpp) against the reconstructed
/// one. What belongs to obstacles or terrain, or lies outside the region, is left out.
/// Deterministic at any number of threads.
SurfaceScore score_surface(const TriangleMesh& surface, const World& truth,
                           const ReferenceConfig& config, int threads);

/// A table for people, no wider than that (0: as wide as it takes), and a JSON object for machines.
std::string score_text(const SurfaceScore& score, const std::string& name, std::size_t width = 0);
std::string score_json(const SurfaceScore& score);

// ---- surface.cpp and made_surface.cpp

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
