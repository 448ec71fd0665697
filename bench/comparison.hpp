// Is A better than B here? Methods over seeds, with intervals and paired tests.
#pragma once

#include <string>
#include <vector>

#include "bench/run_figures.hpp"

namespace gnbv {

/// One mission in a comparison.
struct ComparedRun {
  std::string scenario;  // as the comparison names it
  std::string method;
  std::uint64_t seed = 0;
  RunFigures figures;
};

}  // namespace gnbv
