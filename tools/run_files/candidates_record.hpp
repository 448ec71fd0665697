// candidates.jsonl read back: why a view was chosen, and every other one was not.
#pragma once

#include <filesystem>
#include <optional>

#include "planner/decision.hpp"

namespace gnbv {

/// The candidates of the decision that chose view `iteration`, in the order they were sampled, and
/// which of them was chosen; `next` stays empty, and so do the points on their ways. Nothing for a
/// run that wrote no candidates, or had none to write. Throws BadInput naming file and line of
/// whatever is damaged, or a decision that the file does not hold, and the command that writes it.
std::optional<Plan> read_candidates(const std::filesystem::path& run, std::size_t iteration);

}  // namespace gnbv
