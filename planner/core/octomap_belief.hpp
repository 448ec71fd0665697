// What anybody's OctoMap lets us believe; read_belief() in belief.hpp says how.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planner/core/belief.hpp"

namespace gnbv {

Belief belief_of_octomap(const std::filesystem::path& path, const PlannerModel& model,
                         std::vector<std::string>& notes);

}  // namespace gnbv
