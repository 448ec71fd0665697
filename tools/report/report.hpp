// The report of one run or several: one page that holds all it shows.
#pragma once

#include <string>
#include <vector>

#include "tools/record/run_record.hpp"
#include "tools/report/camera_frames.hpp"

namespace gnbv {

/// More would be neither readable nor small.
constexpr std::size_t kMaxReportRuns = 8;

struct ReportOptions {
  int threads = 1;
  std::string title = {};  // empty: of the runs
};

struct Report {
  std::string html;
  std::vector<std::string> missing;  // a sentence each: what the page shows nothing of, and why
};

/// The page, at most 25 MB for missions as the paper's: points, voxels, structure and frames are
/// thinned to a budget that the runs share. The same bytes for the same runs, at any number of
/// threads. Needs no network, and forbids itself any. `progress` gets the share done. Requires
/// 1 to kMaxReportRuns records; throws BadInput as the readers of their files do.
Report make_report(const std::vector<RunRecord>& records, const ReportOptions& options,
                   const ReportProgress& progress);

}  // namespace gnbv
