// What `gnbv score` prints.
#pragma once

#include <string>

#include "tools/mission/rescore.hpp"

namespace gnbv {

/// A table of lines no wider than that (0: as wide as it takes), and a JSON object. `is_run`: with
/// its profile and curve.
std::string score_text(const Scored& scored, const std::string& name, bool is_run,
                       std::size_t width);
std::string score_json(const Scored& scored, bool is_run);

}  // namespace gnbv
