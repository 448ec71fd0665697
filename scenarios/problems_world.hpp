// What is wrong with the world of a scenario: its mesh files and boxes. For problems.cpp.
#pragma once

#include <string>
#include <vector>

#include "scenarios/problems.hpp"

namespace gnbv {

/// "[1, 2.5, -3]"
std::string text_of(const Vec3& p_m);

/// Whether the box has a length along each axis; adds a problem for each along which it has none.
bool check_box(const Vec3& low_m, const Vec3& high_m, const std::string& min_key,
               const std::string& max_key, std::vector<Problem>& out);

/// Adds what is wrong with structure.file, structure.files, terrain, obstacles, no_fly and
/// score.region_m.
void check_world(const Scenario& scenario, std::vector<Problem>& out);

}  // namespace gnbv
