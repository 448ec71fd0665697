// How much a view is worth. Every formula scores the same ViewStats.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/core/plan.hpp"
#include "planner/guided/user_utility.hpp"
#include "planner/view/config.hpp"

namespace gnbv {

class ShadowBand;
struct ViewOptions;
struct ViewStats;

/// Eq. (2)'s reward for density: of sparse regions (released code, fits the text's aim) or of dense
/// ones (the formula to the letter).
enum class DensityTerm { sparse, literal };

/// How often bircher and isler count a voxel: once a ray that crosses it (released code), or once.
enum class IgCounting { per_ray, unique };

/// Whether bircher and isler count the occupied voxel that ends a ray; the released code does not,
/// see ray_by_ray.hpp.
enum class HitVoxel { counted, excluded };

/// The distance d that formulas discount by: of the way that is flown, or from here to there. They
/// differ only where the way leads around something (PathCheck::astar).
enum class DistanceAlong { path, straight };

/// What bircher_volume pays for a cubic metre of visible space.
struct VolumeWeights {
  double unmapped = 1.0;
  double free = 0.0;
  double occupied = 0.0;
};

/// The formula by name and the weights of Table 1, Scenario 1. Each formula takes what it needs.
struct UtilityConfig {
  std::string name = "proposed";
  double alpha = 10.0;
  double beta = 0.5;
  double gamma = 0.5;
  double lambda_per_m = 0.2;          // proposed, bircher_volume, aep
  double bircher_lambda_per_m = 0.2;  // bircher; 0.5 in the released configuration
  DistanceAlong distance = DistanceAlong::path;
  DensityTerm density_term = DensityTerm::sparse;
  bool normalise_weights = true;  // beta and gamma divided by their sum (released code)
  IgCounting ig_counting = IgCounting::per_ray;
  HitVoxel hit_voxel = HitVoxel::counted;
  bool prediction_hides_hits = false;  // slip of the released code, see ray_by_ray.hpp
  bool legacy_visibility = false;      // see ViewOptions
  VolumeWeights volume_weights = {};
  ShadowConfig shadow = {};
  UserUtilityConfig python = {};
};

/// What a random choice is keyed by. Nothing else reads it.
struct ScoreContext {
  std::uint64_t seed = 0;
  std::uint64_t iteration = 0;
  std::uint64_t candidate = 0;  // index among those sampled
};

/// What a formula asks of evaluate_view().
struct UtilityNeeds {
  bool rays = false;               // ViewDetail::rays
  bool shadow = false;             // a ShadowBand
  bool refuses_blind = false;      // no score for views that see nothing occupied (released code)
  bool released_baseline = false;  // hit_voxel is for it
  bool prediction = false;         // predicted surface
};

/// The formulas by name, those of the paper's tables first.
std::vector<std::string_view> utility_names();

/// What tables and files call it: its name, of the user's own that of the function.
inline std::string utility_label(const UtilityConfig& config) {
  return is_user_utility(config.name) ? config.python.function : config.name;
}

/// Requires a name of utility_names(), or that of a utility of the user's own.
UtilityNeeds needs_of(const UtilityConfig& config);

/// Whether the choice of views depends on predicted surface (section 2.3): names that are no
/// formula's do not ask for it.
bool reads_prediction(const UtilityConfig& config);

/// How evaluate_view() has to look for this utility, and no more closely: with the released slips
/// where the configuration asks for them. `shadow` is kept only where it is needed; `sparse_below`
/// is the density below which a voxel is a frontier.
ViewOptions view_options(const UtilityConfig& config, const ShadowBand& shadow,
                         double sparse_below);

/// Scores with the formula that `config` names. Nothing for a view that sees no occupied voxel and
/// a formula that refuses those. Requires a name of utility_names().
std::optional<Score> score(const UtilityConfig& config, const ViewStats& stats,
                           const ScoreContext& context = {});

}  // namespace gnbv
