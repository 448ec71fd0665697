// A utility of the user's own: a function written in Python, kept as text, that scores all
// candidates of a decision at once. Whoever runs it is outside of the planner.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "planner/view/view_stats.hpp"
#include "sim/core/pose.hpp"

namespace gnbv {

/// The --utility that has the scores from elsewhere.
constexpr std::string_view kUserUtilityName = "python";

inline bool is_user_utility(std::string_view utility_name) {
  return utility_name == kUserUtilityName;
}

struct UserUtilityConfig {
  std::string function;  // its name in the source
  std::string source;    // Python, all of it
};

/// One candidate as the function sees it.
struct UserCandidate {
  ViewStats stats;
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;  // of the body, world ENU
  double yaw_rad = 0.0;
  double gimbal_pitch_rad = 0.0;
};

/// The function failed: raised, or returned what are no scores.
class UserUtilityFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The candidates of one decision, all of them valid.
struct UserQuestion {
  std::size_t iteration = 0;                 // the view that is being decided
  std::span<const UserCandidate> rows = {};  // what the function gets
  std::span<const std::size_t> indices;      // of each row among those sampled, for messages
};

/// A finite score for each row. Throws UserUtilityFailed.
using UserScores = std::function<std::vector<double>(const UserQuestion&)>;

/// Whether the source names the field that needs predicted surface.
bool names_prediction(const UserUtilityConfig& config);

/// Whether the source names any field of ViewStats that needs rays, or the shadow band.
bool names_ray_fields(const UserUtilityConfig& config);
bool names_shadow_fields(const UserUtilityConfig& config);

}  // namespace gnbv
