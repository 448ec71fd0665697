// A run for viewers with a timeline, by Python: Rerun's recordings, MCAP with Foxglove's schemas.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "sim/mesh/triangle_mesh.hpp"
#include "tools/run/frames_folder.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

/// What a run holds beside its record; each may be missing.
struct TimelineParts {
  std::optional<TriangleMesh> structure = {};
  std::optional<RunCloud> cloud = {};
  std::optional<FrameRecord> frames = {};  // without them cameras are as they truly were, blind
};

/// Writes the folder's run.rrd (format "rerun") or run.mcap ("mcap") in `python3`, or what
/// GNBV_PYTHON names: structure, cloud as it grew, path, cameras at the views with what they saw,
/// plots. Returns what was written, in words. Throws BadInput with the one line that installs what
/// is missing there, or with what went wrong.
std::string write_timeline(const RunRecord& record, const TimelineParts& parts,
                           std::string_view format, const std::filesystem::path& folder);

}  // namespace gnbv
