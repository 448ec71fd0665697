// One run as its page has it.
#pragma once

#include "tools/frames/frame_sight.hpp"
#include "tools/page/page_data.hpp"
#include "tools/page/structures.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

/// What a run may take of the page, at most.
struct RunBudget {
  std::size_t bytes = 0;  // of its arrays
  std::size_t points = 0;
};

/// Names, figures and views: all that a run has without its other files.
page::RunData run_data(const RunRecord& record, page::Arrays& arrays);

/// What else of the run is there, thinned to the budget: each part may take a share of what those
/// before it left, points and frames the rest. What is not there, or cannot be used, is named in
/// `missing`, where a command makes it with that command. Without a structure (`known`) nothing is
/// said of what was found of it.
void pack_run(const RunRecord& record, const KnownStructure* known, const RunBudget& budget,
              int threads, const ShareDone& progress, page::Arrays& arrays, page::RunData& run);

}  // namespace gnbv
