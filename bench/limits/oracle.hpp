// A planner that knows the true structure: how far any other is from what is possible.
#pragma once

#include <string_view>
#include <vector>

#include "planner/decision.hpp"
#include "scenarios/scenario.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {

enum class OracleAim { views, metres };

/// Of "oracle_views" and "oracle_metres"; requires is_oracle(utility_name).
OracleAim aim_of(std::string_view utility_name);

/// Which share of the leaf ceiling's finest outside voxels the views are to find.
constexpr double kOracleShare = 0.99;

/// What a view costs beside its metres, for the aim metres.
constexpr double kMetresPerView = 1.0;

/// The views after the first one, which is `start`, in the order in which they are to be flown,
/// with the ways there, every one of which keeps the collision radius from the structure.
///
/// Views of the survey (view_survey.hpp) are taken greedily, those that find the most new voxels
/// first, or the most per metre of detour and kMetresPerView, until the cloud they leave
/// (CloudOfViews, in the order of choice) holds kOracleShare of what that of all views holds, or no
/// view finds anything new. Their positions then make a short tour (tour.hpp). Deterministic at
/// any number of threads. A bound it is not: greedy choices are at best near the fewest.
std::vector<Decision> plan_oracle(const Scenario& scenario, const World& world,
                                  const RayScene& scene, const ViewPose& start, OracleAim aim,
                                  int threads);

}  // namespace gnbv
