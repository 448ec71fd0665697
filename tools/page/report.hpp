// The report of one run or several: one page that holds all it shows.
#pragma once

#include <string>
#include <vector>

#include "bench/compare/text_table.hpp"
#include "tools/figures/looks.hpp"
#include "tools/frames/frame_sight.hpp"
#include "tools/page/page_data.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

/// More would be neither readable nor small.
constexpr std::size_t kMaxReportRuns = 8;

/// Of a page, for missions as the paper's.
constexpr std::size_t kMaxReportBytes = 25'000'000;

struct ReportOptions {
  int threads = 1;
  std::string title = {};  // empty: of the runs
  bool is_live = false;    // asks its server for more while it is looked at
};

struct Report {
  std::string html;
  std::string policy;                // its Content-Security-Policy, which the page states, too
  std::vector<std::string> missing;  // a sentence each: what the page shows nothing of, and why
};

/// The page, at most kMaxReportBytes: points, voxels, paths, structures and frames are thinned to
/// what the text of the page leaves; the runs share it. The same bytes for the same runs, at any
/// number of threads. Needs no network, and forbids itself any. `progress` gets the share done.
/// Requires 1 to kMaxReportRuns records. Files that are missing or damaged are left out and named.
Report make_report(std::vector<RunRecord> records, const ReportOptions& options,
                   const ShareDone& progress);

/// Coverage, entropy, density and the terms of the chosen views, of runs with those labels.
std::vector<page::Plot> plots_of(const std::vector<RunRecord>& records,
                                 const std::vector<std::string>& labels, page::Arrays& arrays);

/// Of each run's lines, by its method.
std::vector<SeriesLook> line_looks(const std::vector<RunRecord>& records);

/// A table as the page has it, without columns of dashes alone.
page::Table page_table(const TextTable& table);

}  // namespace gnbv
