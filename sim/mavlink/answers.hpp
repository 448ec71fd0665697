// What a client asks at connection beside commands, and is answered or refused: parameters,
// missions, time. QGroundControl waits for each of them.
#pragma once

#include <optional>
#include <vector>

#include "sim/mavlink/frame.hpp"
#include "sim/mavlink/streams.hpp"

namespace gnbv::mavlink {

/// The answers to PARAM_REQUEST_LIST, PARAM_REQUEST_READ, PARAM_SET (PX4's names, read from
/// CommanderParameters; what it can be set to is bounded, and the answer is the value that holds),
/// to the mission protocol (there is none: a count of 0, uploads refused), TIMESYNC and PING, none
/// where the question needs none. nullopt: another message, or not for us.
std::optional<std::vector<Packed>> answers_to(const Frame& question, Quadrotor& vehicle);

}  // namespace gnbv::mavlink
