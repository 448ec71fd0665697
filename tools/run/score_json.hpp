// A score as JSON: the part of summary.json that is measured against the truth.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "bench/score/mission_score.hpp"

namespace gnbv {

/// The keys of summary.json that a score makes, in their order.
nlohmann::ordered_json score_part(const MissionScore& score);

/// They as an object of its own; without the run's curve and profile when it is only a cloud that
/// was scored.
std::string score_json(const MissionScore& score, bool is_run);

}  // namespace gnbv
