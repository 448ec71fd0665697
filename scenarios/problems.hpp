// What is wrong with a scenario whose values are each allowed, but do not go together.
#pragma once

#include <string>
#include <vector>

#include "scenarios/scenario.hpp"

namespace gnbv {

struct Problem {
  std::vector<std::string> keys;  // whose values do not go together, the likeliest cause first
  std::string what;
};
using Problems = std::vector<Problem>;

/// All of them; none for a scenario that can be run.
Problems problems(const Scenario& scenario);

// ---- its parts, each of which adds what it finds

/// Of structure.file, structure.files, terrain, obstacles, no_fly and score.region_m.
void check_world(const Scenario& scenario, Problems& out);
/// Of vehicle and guidance.
void check_vehicle(const Scenario& scenario, Problems& out);
/// Of wind and outages.
void check_disturbances(const Scenario& scenario, Problems& out);

/// The two have to be in order; the first key is the smaller one's.
void require_below(double low, double high, const std::string& low_key, const std::string& high_key,
                   Problems& out);
/// Whether the box of that key has a length along each axis; a problem for each along which it has
/// none.
bool check_box(const Box3& box_m, const std::string& key, Problems& out);

/// "[1, 2.5, -3]"
std::string text_of(const Vec3& p_m);

}  // namespace gnbv
