// The parts of a run as its page has them, each thinned until it takes at most so many bytes.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/score/surface_reference.hpp"
#include "sensors/ray_scene.hpp"
#include "tools/frames/frame_sight.hpp"
#include "tools/page/page_data.hpp"
#include "tools/run/run_inputs.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

constexpr std::size_t kLeastElements = 16;  // whatever the room is

inline std::uint32_t as_count(std::size_t count) { return static_cast<std::uint32_t>(count); }

// ---- a run

/// What a run may take of the page, at most.
struct RunBudget {
  std::size_t bytes = 0;  // of its arrays
  std::size_t points = 0;
};

/// The voxels that coverage counts (SurfaceReference::counted), of one of kCoverageSizes_m.
struct TrueVoxels {
  double size_m = 0.0;
  VoxelSet codes = {};
};

/// A structure among what is around it, and what of its surface there is to find.
struct KnownStructure {
  World world;
  RayScene scene;
  TrueVoxels to_find;

  explicit KnownStructure(World its_world) : world(std::move(its_world)), scene(world) {}
};

/// Names, figures and views: all that a run has without its other files.
page::RunData run_data(const RunRecord& record, page::Arrays& arrays);

/// What else of the run is there, thinned to the budget: each part may take a share of what those
/// before it left, points and frames the rest. What is not there, or cannot be used, is named in
/// `missing`, where a command makes it with that command. Without a structure (`known`) nothing is
/// said of what was found of it.
void pack_run(const RunRecord& record, const KnownStructure* known, const RunBudget& budget,
              int threads, const ShareDone& progress, page::Arrays& arrays, page::RunData& run);

/// Every n-th sample and the last one, with the least n that fits.
page::PathData pack_path(std::span<const TrajectorySample> path, std::size_t max_bytes,
                         page::Arrays& arrays);

/// Of each plan of a tour as many views from its beginning as all of them have room for. Throws
/// BadInput as read_plans() does.
page::PlanData pack_plan(const RunRecord& record, std::size_t max_bytes, page::Arrays& arrays);

/// All or none: throws BadInput when they take more, or are damaged. Nothing for a run that kept
/// none.
std::optional<page::CandidateData> pack_candidates(const RunRecord& record, std::size_t max_bytes,
                                                   page::Arrays& arrays);

/// In cells that are larger where there is no room; a cell is of a list when any of its voxels is.
/// Nothing for a run that kept none. Throws BadInput when they are damaged.
std::optional<page::BeliefData> pack_beliefs(const RunRecord& record, std::size_t max_bytes,
                                             page::Arrays& arrays);

/// The sentence for a run that kept candidates, but not these: an older program's; empty otherwise.
std::string why_no_beliefs(const RunRecord& record);

/// In voxels of the lattice that stands at the origin, of the map's size or larger. Requires points
/// within 2^15 voxels of the origin.
page::VoxelData pack_voxels(const RunCloud& cloud, double size_m, std::size_t max_bytes,
                            page::Arrays& arrays);

/// `surface.glb` of `gnbv surface`, where the run has one. Throws BadInput when it takes more, or
/// is no whole file of its kind.
std::optional<page::Array<std::uint8_t>> pack_surface(const RunRecord& record,
                                                      std::size_t max_bytes, page::Arrays& arrays);

// ---- its points, and the true surface

/// Indices, ascending, of the first point in each cube of a lattice with cubes of `cell_m`.
/// Requires cell_m > 0 and points within 2^20 cells of the origin.
std::vector<std::size_t> first_points(std::span<const Vec3f> points_m, double cell_m);

struct ThinnedPoints {
  double cell_m = 0.0;            // 0: nothing had to go
  std::vector<std::size_t> kept;  // ascending
};

/// All points, or the first ones of the finest lattice (of `finest_m` times powers of 1.25) that
/// leaves at most `max_points`. Requires max_points > 0 and finest_m > 0.
ThinnedPoints thinned(std::span<const Vec3f> points_m, std::size_t max_points, double finest_m);

/// The points that were kept; with their errors where the structure's scene is known.
page::CloudData pack_cloud(const RunCloud& cloud, const ThinnedPoints& thin, const RayScene* scene,
                           int threads, page::Arrays& arrays);

/// The finest voxels of at most `max_voxels` whose indices fit 16 bits; none where even the
/// coarsest are too many.
TrueVoxels true_voxels(const SurfaceReference& reference, std::size_t max_voxels);

constexpr std::uint16_t kNeverFound = 0xffff;

/// Of each voxel the number of views after which a point first covered it, 0 after the profile
/// alone, or kNeverFound. What came after the last view counts to it. Requires fewer than
/// kNeverFound views.
std::vector<std::uint16_t> views_until_found(const TrueVoxels& voxels, const RunCloud& cloud);

constexpr std::uint8_t kNotOfStructure = 0xff;

/// Distance of each of those points of the cloud to the structure, rounded to millimetres and at
/// most 254 of them; kNotOfStructure for points of what stands around it. The same at any number of
/// threads.
std::vector<std::uint8_t> point_errors(const RayScene& scene, std::span<const Vec3f> points_world_m,
                                       int threads);

// ---- what stands in the worlds of the runs

struct Structures {
  struct OfRun {
    int number = -1;       // into `meshes`; -1: it cannot be had
    std::string why = {};  // not
    std::shared_ptr<const KnownStructure> known = {};
    std::vector<RunInput> inputs = {};  // that it is made of
  };
  std::vector<page::MeshData> meshes;  // each once
  std::vector<page::MoverData> movers;
  std::vector<OfRun> of_run;
};

/// Of all records, none where the run was flown around another structure; the true surface from the
/// cache, or found.
Structures pack_structures(const std::vector<RunRecord>& records, int threads,
                           page::Arrays& arrays);

/// The structure, thinned until its arrays take at most `max_bytes`.
page::MeshData pack_mesh(const TriangleMesh& mesh, std::size_t max_bytes, page::Arrays& arrays);

/// The mesh, or the finest of its kind (vertices of a lattice's cubes drawn together, faces without
/// area dropped) that has at most `max_faces`. No vertex moves outside of the mesh's bounds.
TriangleMesh with_fewer_faces(const TriangleMesh& mesh, std::size_t max_faces);

/// A mesh with pictures, its edges cut in two until it has about `faces` of about the same size, or
/// `max_faces`: fine enough to show its pictures by colours of vertices. Others stay as they are.
TriangleMesh cut_finer(TriangleMesh mesh, std::size_t faces, std::size_t max_faces);

/// Colours of a mesh with pictures by place: the mean of the faces that meet there.
class VertexColours {
 public:
  explicit VertexColours(const TriangleMesh& mesh);

  /// Linear, (n, 3) shares of 65535, of vertices of that mesh.
  std::vector<std::uint16_t> of(std::span<const Vec3f> vertices_m);
  bool empty() const { return colours_.empty(); }

 private:
  PositionIndices places_;
  std::vector<std::uint16_t> colours_;
};

}  // namespace gnbv
