// One run as the page wants it: numbers in one block of bytes, and what a block cannot say.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/report/belief_pack.hpp"
#include "tools/report/byte_pack.hpp"
#include "tools/report/camera_frames.hpp"
#include "tools/report/candidate_pack.hpp"
#include "tools/report/packed_points.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

struct PackedCloud {
  PackedPoints points = {};  // in the order of growth
  ByteSlice after = {};      // uint32 (views + 1): how many there are after the first n views
  std::optional<ByteSlice> colour = {};  // uint8 (n, 3), sRGB; only with frames
  std::optional<ByteSlice> error = {};   // uint8 (n), see point_errors(); where the structure is
  std::size_t all_points = 0;            // before thinning
  double cell_m = 0.0;                   // of the thinning; 0: none
};

/// The map's voxels that hold points of the cloud, in the order in which they first did, and how
/// many of the whole cloud's points each held after every view.
struct PackedVoxels {
  double size_m = 0.0;  // the map's, or twice, four times ... that, so that the page can carry them
  // see VoxelGrowth
  ByteSlice index;        // int16 (n, 3)
  ByteSlice after;        // uint32 (views + 1)
  ByteSlice gain_step;    // uint16 (gains)
  ByteSlice gain_points;  // uint8 (gains)
  ByteSlice gains_after;  // uint32 (views + 1)
};

struct PackedPath {
  PackedPoints points;
  ByteSlice time_s;      // float32 (n)
  ByteSlice quaternion;  // int16 (n, 4): x y z w in steps of 1 / 32767, body in world
};

/// What of a tour is still to come. Each plan's views stand in a row, so that what is left of one
/// is a range of them.
struct PackedPlan {
  ByteSlice
      poses;  // float32 (n, 7): place of the body, then the first camera in the world, x y z w
  ByteSlice ranges;  // uint32 (views, 2): begin and end of the poses to come after each view
};

struct PackedThumbnail {
  int view = 0;  // index of the view
  std::size_t camera = 0;
  int width_px = 0;
  int height_px = 0;
  ByteSlice jpeg;
  ByteSlice depth_jpeg;
};

struct PackedRun {
  BytePack bytes;
  std::optional<PackedCloud> cloud = {};
  std::optional<PackedVoxels> voxels = {};
  std::optional<PackedPath> path = {};
  std::optional<PackedPlan> plan = {};              // of tours
  std::optional<PackedCandidates> candidates = {};  // where the run kept them
  std::optional<PackedBeliefs> beliefs = {};        // likewise
  std::optional<ByteSlice> found = {};              // uint16, see views_until_found()
  std::optional<ByteSlice> surface = {};  // uint8: surface.glb, as `gnbv surface` wrote it
  std::vector<std::string> cameras = {};  // names, of the thumbnails
  std::vector<PackedThumbnail> thumbnails = {};
  std::vector<std::string> missing = {};  // beyond what the record says
};

struct KnownStructure;

/// What a run may take of the page, at most.
struct RunBudget {
  std::size_t bytes = 0;  // of its block
  std::size_t points = 0;
};

/// What of the run is there, thinned to the budget: voxels get a quarter of it, the path an eighth,
/// a tour's plans, the candidates and what was believed of the views at most another one each, of a
/// plan its next views, of the candidates all or none, of beliefs larger cells, a surface a third
/// or nothing; points and frames share the rest. What is not there, or cannot be used, is named in
/// `missing`, where a command makes it with that command. Without a structure nothing is said of
/// what was found of it.
PackedRun pack_run(const RunRecord& record, const KnownStructure* structure,
                   const RunBudget& budget, int threads, const ReportProgress& progress);

}  // namespace gnbv
