// A run as plain files: CSV, JSON, PLY and PNG, for whoever has none of our code.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "tools/frames/frame_sight.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

/// What a run holds beside its record; each may be missing.
struct PlainParts {
  std::optional<FrameRecord> frames = {};
  std::optional<RunCloud> cloud = {};
  std::vector<Rgb8> colours = {};  // of the cloud's points; empty without frames
};

/// Writes into the folder what there is of trajectory.csv, views.csv, intrinsics.json, cloud.ply,
/// voxels.ply (the map's occupied voxels), images/ and depth/, and a README.txt that documents
/// every file, frame and unit.
void write_plain(const RunRecord& record, const PlainParts& parts,
                 const std::filesystem::path& folder);

}  // namespace gnbv
