// The figures of a finished run directory.
#pragma once

#include <filesystem>

#include "bench/score/run_figures.hpp"

namespace gnbv {

/// From summary.json and coverage.csv. Throws BadInput naming file and key for a run that is not
/// finished, or that another version wrote (the message names the command that scores it anew).
RunFigures read_run_figures(const std::filesystem::path& run);

}  // namespace gnbv
