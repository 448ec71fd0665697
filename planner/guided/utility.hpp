// How much a view is worth. Every formula scores the same ViewStats; so does a utility of the
// user's own: a function that gets all candidates of a decision at once.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "planner/core/plan.hpp"
#include "planner/view/shadow_band.hpp"
#include "planner/view/view_stats.hpp"

namespace gnbv {

class ShadowBand;
struct ViewOptions;

enum class DensityTerm { sparse, literal };
enum class IgCounting { per_ray, unique };
enum class HitVoxel { counted, excluded };
enum class LeavingRays { counted, dropped };
enum class DistanceAlong { path, straight };

/// What bircher_volume pays for a cubic metre of visible space.
struct VolumeWeights {
  double unmapped = 1.0;
  double free = 0.0;
  double occupied = 0.0;
};

/// What a function of the user's own does: scores the candidates, or plans the next view.
enum class UserFunctionKind { utility, planner };

/// A Python function of the user's own. Label and file are for readers: missions do not depend on
/// them.
struct UserFunctionConfig {
  UserFunctionKind kind = UserFunctionKind::utility;
  std::string label = {};     // what tables call it; empty: by its name
  std::string file = {};      // the name of the file that it is from; empty: of none
  std::string function = {};  // its name in the source
  std::string source = {};    // Python, all of it
};

/// The formula by name and the weights of Table 1, Scenario 1. Each formula takes what it needs.
struct UtilityConfig {
  std::string name = "proposed";
  double alpha = 10.0;
  double beta = 0.5;
  double gamma = 0.5;
  double lambda_per_m = 0.2;          // proposed, bircher_volume, aep
  double bircher_lambda_per_m = 0.2;  // bircher; 0.5 in the released configuration
  /// The way that is flown, or from here to there. They differ only where the way leads around
  /// something (PathCheck::astar).
  DistanceAlong distance = DistanceAlong::path;
  /// Eq. (2) rewards sparse regions (released code, fits the text's aim), or dense ones (to the
  /// letter).
  DensityTerm density_term = DensityTerm::sparse;
  bool normalise_weights = true;  // beta and gamma divided by their sum (released code)
  /// bircher, isler: a voxel counts once a ray that crosses it (released code), or once.
  IgCounting ig_counting = IgCounting::per_ray;
  // slips of the released code, see ReleasedSlips: two of the baselines; the third is Proposed's
  HitVoxel hit_voxel = HitVoxel::counted;
  LeavingRays leaving_rays = LeavingRays::counted;
  bool prediction_hides_hits = false;
  bool legacy_visibility = false;  // see ViewOptions
  VolumeWeights volume_weights = {};
  ShadowConfig shadow = {};
  UserFunctionConfig python = {};
};

/// The formulas by name, those of the paper's tables first.
std::vector<std::string_view> utility_names();

/// The UtilityConfig::name of the user's own function, which is asked from outside.
constexpr std::string_view kUserUtilityName = "python";
inline bool is_user_utility(std::string_view name) { return name == kUserUtilityName; }
inline bool is_user_planner(const UtilityConfig& config) {
  return is_user_utility(config.name) && config.python.kind == UserFunctionKind::planner;
}
/// The UtilityConfig::name of who flies given views. A function of the user's own may have given
/// them (UtilityConfig::python).
constexpr std::string_view kRouteName = "route";

/// The user's own function that decided, or gave the views; nothing for a planner of ours.
inline const UserFunctionConfig* user_function(const UtilityConfig& config) {
  const bool is_users = is_user_utility(config.name) || config.name == kRouteName;
  return is_users && !config.python.function.empty() ? &config.python : nullptr;
}

/// What tables and files call it: its name, of the user's own its label or that of the function.
inline std::string utility_label(const UtilityConfig& config) {
  const UserFunctionConfig* const own = user_function(config);
  if (own == nullptr) return config.name;
  return own->label.empty() ? own->function : own->label;
}

/// What a utility asks of evaluate_view(), and which settings it reads that not all do.
struct UtilityTraits {
  bool rays = false;            // ViewDetail::rays
  bool shadow = false;          // a ShadowBand
  bool prediction = false;      // predicted surface (section 2.3)
  bool eq2 = false;             // alpha, beta, gamma, density_term, normalise_weights
  bool baseline = false;        // ig_counting, hit_voxel, leaving_rays
  bool lambda = false;          // lambda_per_m
  bool bircher_lambda = false;  // bircher_lambda_per_m
  bool distance = false;
  bool visibility = false;  // legacy_visibility
  bool volume_weights = false;
};
/// What a utility of that name may ask and read; of a name that none has nothing.
UtilityTraits utility_traits(std::string_view name);
/// What it does with these settings; of the user's own, what the fields of ViewStats that its
/// source names ask for. Requires its name or one of utility_names().
UtilityTraits needs_of(const UtilityConfig& config);

/// How evaluate_view() has to look for this utility, and no more closely: with the released slips
/// where the configuration asks for them. `shadow` is kept only where it is needed; `sparse_below`
/// is the density below which a voxel is a frontier.
ViewOptions view_options(const UtilityConfig& config, const ShadowBand& shadow,
                         double sparse_below);

/// What a random choice is keyed by. Nothing else reads it.
struct ScoreContext {
  std::uint64_t seed = 0;
  std::uint64_t iteration = 0;
  std::uint64_t candidate = 0;  // index among those sampled
};

/// Scores with the formula that `config` names. Nothing for a view that sees no occupied voxel, by
/// proposed, bircher and isler (released code). Requires a name of utility_names().
std::optional<Score> score(const UtilityConfig& config, const ViewStats& stats,
                           const ScoreContext& context = {});

/// One candidate as the user's function sees it.
struct UserCandidate {
  ViewStats stats;
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;  // of the body, world ENU
  double yaw_rad = 0.0;
  double gimbal_pitch_rad = 0.0;
};

/// The candidates of one decision, all of them valid.
struct UserQuestion {
  std::size_t iteration = 0;                 // the view that is being decided
  std::span<const UserCandidate> rows = {};  // what the function gets
  std::span<const std::size_t> indices;      // of each row among those sampled, for messages
};

/// The function failed: raised, or returned what are no scores.
class UserUtilityFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A finite score for each row. Whoever runs it is outside of the planner. Throws
/// UserUtilityFailed.
using UserScores = std::function<std::vector<double>(const UserQuestion&)>;

}  // namespace gnbv
