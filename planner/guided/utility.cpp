#include "planner/guided/utility.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "planner/view/view_stats.hpp"
#include "planner/view/visibility.hpp"
#include "sim/core/error.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

using Formula = Score (*)(const UtilityConfig&, const ViewStats&, const ScoreContext&);

Score gain(double value) { return {.value = value, .information = value}; }

Score discounted(double value, double lambda_per_m, double path_m) {
  const double distance = std::exp(-lambda_per_m * path_m);
  return {.value = value * distance, .information = value, .distance = distance};
}

/// Eq. (2), with P hat of Eq. (3). E hat is the share of the largest possible entropy of the
/// visible voxels; D hat is 0 when the view sees no point of the cloud.
Score proposed(const UtilityConfig& config, const ViewStats& s, const ScoreContext&) {
  Score out;
  const double voxels = static_cast<double>(s.free_voxels) + s.unknown_voxels + s.occupied_voxels;
  out.information = s.entropy_nat / (voxels * std::numbers::ln2);
  const double mean_density = s.density_sum / s.occupied_voxels;
  if (mean_density > 0.0) {
    const double share = std::min(mean_density / s.density_max, 1.0);
    out.density = config.density_term == DensityTerm::literal ? share : 1.0 - share;
  }
  out.prediction =
      s.predicted_voxels / (static_cast<double>(s.predicted_voxels) + s.occupied_voxels);
  out.distance = std::exp(-config.lambda_per_m * s.path_m);
  const double weights = config.normalise_weights ? config.beta + config.gamma : 1.0;
  const double quality = (config.beta * out.density + config.gamma * out.prediction) / weights;
  out.value = (1.0 + config.alpha * out.information) * quality * out.distance *
              std::log10(static_cast<double>(s.occupied_voxels));
  return out;
}

double baseline_gain(const UtilityConfig& config, const ViewStats& s) {
  return config.ig_counting == IgCounting::unique ? s.entropy_nat : s.entropy_per_ray_nat;
}

/// Isler et al. 2016 as the paper compares it: total entropy along the rays.
Score isler(const UtilityConfig& config, const ViewStats& s, const ScoreContext&) {
  return gain(baseline_gain(config, s));
}

/// Bircher et al. 2016 as the paper compares it: the same, discounted by distance.
Score bircher(const UtilityConfig& config, const ViewStats& s, const ScoreContext&) {
  return discounted(baseline_gain(config, s), config.bircher_lambda_per_m, s.path_m);
}

// ---- volumetric gains of Delmerico et al. 2018, which discount nothing

/// A number of the view as it is.
template <auto number>
Score plain(const UtilityConfig&, const ViewStats& s, const ScoreContext&) {
  return gain(s.*number);
}

/// Mean entropy along the rays that end at a surface; 0 without any.
Score average_entropy(const UtilityConfig&, const ViewStats& s, const ScoreContext&) {
  if (s.crossed_by_occupied == 0) return gain(0.0);
  return gain(s.entropy_of_occupied_nat / static_cast<double>(s.crossed_by_occupied));
}

/// Vasquez-Gomez et al. 2014: a cubic on each side of the share wanted, 1 there and 0 at 0 and 1.
double area_share(double x, double wanted) {
  const double a = wanted;
  if (x <= a) return x * x * (3.0 * a - 2.0 * x) / (a * a * a);
  const double numerator = -2.0 * x * x * x + 3.0 * (a + 1.0) * x * x - 6.0 * a * x + 3.0 * a - 1.0;
  return numerator / std::pow(a - 1.0, 3);
}

/// Shares of the rays that end at a surface seen from free space, and that look behind one.
Score area_factor(const UtilityConfig&, const ViewStats& s, const ScoreContext&) {
  constexpr double kOccupiedWanted = 0.2;
  constexpr double kShadowWanted = 0.8;
  if (s.rays == 0) return gain(0.0);
  const double rays = s.rays;
  return gain(area_share(s.front_rays / rays, kOccupiedWanted) +
              area_share(s.shadow_rays / rays, kShadowWanted));
}

// ---- volume of what is seen

/// Bircher et al. 2016, their released planner.
Score bircher_volume(const UtilityConfig& config, const ViewStats& s, const ScoreContext&) {
  const VolumeWeights& w = config.volume_weights;
  const double weighed =
      w.unmapped * s.unknown_voxels + w.free * s.free_voxels + w.occupied * s.occupied_voxels;
  return discounted(weighed * s.voxel_m3, config.lambda_per_m, s.path_m);
}

/// Selin et al. 2019.
Score aep(const UtilityConfig& config, const ViewStats& s, const ScoreContext&) {
  return discounted(s.unknown_volume_m3, config.lambda_per_m, s.path_m);
}

// ---- what a utility has to beat

Score random_choice(const UtilityConfig&, const ViewStats&, const ScoreContext& context) {
  return gain(uniform01({context.seed, Stream::random_view, context.iteration, context.candidate}));
}

Score nearest_frontier(const UtilityConfig&, const ViewStats& s, const ScoreContext&) {
  return gain(s.sparse_voxels > 0 ? 1.0 / (1.0 + s.path_m) : 0.0);
}

struct Utility {
  std::string_view name;
  Formula formula;
  UtilityTraits traits = {};
};

constexpr UtilityTraits kRays = {.rays = true};
constexpr UtilityTraits kVisibility = {.rays = true, .visibility = true};
constexpr UtilityTraits kShadow = {.rays = true, .shadow = true};
using S = ViewStats;

/// The one table of utilities: adding one is a function above and a line here.
constexpr std::array kUtilities = {
    Utility{
        "proposed", proposed, {.prediction = true, .eq2 = true, .lambda = true, .distance = true}},
    Utility{"bircher", bircher, {.baseline = true, .bircher_lambda = true, .distance = true}},
    Utility{"isler", isler, {.baseline = true}},
    Utility{"occlusion_aware", plain<&S::occlusion_aware_nat>, kVisibility},
    Utility{"unobserved_voxel", plain<&S::unobserved_nat>, kVisibility},
    Utility{"rear_side_voxel", plain<&S::rear_side_rays>, kRays},
    Utility{"rear_side_entropy", plain<&S::rear_side_nat>, kVisibility},
    Utility{"average_entropy", average_entropy, kRays},
    Utility{"proximity_count", plain<&S::proximity_sum>, kShadow},
    Utility{"area_factor", area_factor, kShadow},
    // Kriegel et al. 2015 as Pan et al. compare it: entropy of the rays that end at a surface
    Utility{"kriegel", plain<&S::entropy_of_occupied_nat>, kRays},
    Utility{"bircher_volume",
            bircher_volume,
            {.lambda = true, .distance = true, .volume_weights = true}},
    Utility{"aep", aep, {.rays = true, .lambda = true, .distance = true}},
    Utility{"random", random_choice},
    Utility{"nearest_frontier", nearest_frontier, {.distance = true}},
};

const Utility& utility_named(std::string_view name) {
  const auto* const utility = std::find_if(kUtilities.begin(), kUtilities.end(),
                                           [&](const Utility& u) { return u.name == name; });
  GNBV_CHECK(utility != kUtilities.end(), "utility '{}' has no formula", name);
  return *utility;
}

/// Of the words of a source, those in comments included: what costs time there costs no result.
UtilityTraits needs_of_words(std::string_view source) {
  constexpr std::string_view kPartOfWord =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_";
  UtilityTraits needs;
  for (std::size_t at = 0, end = 0; (at = source.find_first_of(kPartOfWord, end)) != source.npos;) {
    end = std::min(source.find_first_not_of(kPartOfWord, at), source.size());
    const std::string_view word = source.substr(at, end - at);
    for (const ViewField& field : kViewFields) {
      if (field.name != word) continue;
      needs.rays |= field.needs >= ViewFieldNeeds::rays;
      needs.shadow |= field.needs == ViewFieldNeeds::shadow;
    }
    needs.prediction |= word == "predicted_voxels";
  }
  return needs;
}

}  // namespace

std::vector<std::string_view> utility_names() {
  std::vector<std::string_view> names;
  for (const Utility& entry : kUtilities) names.push_back(entry.name);
  return names;
}

UtilityTraits utility_traits(std::string_view name) {
  if (is_user_utility(name)) return {.shadow = true, .distance = true, .visibility = true};
  for (const Utility& utility : kUtilities) {
    if (utility.name == name) return utility.traits;
  }
  return {};
}

UtilityTraits needs_of(const UtilityConfig& config) {
  if (is_user_utility(config.name)) return needs_of_words(config.python.source);
  UtilityTraits needs = utility_named(config.name).traits;
  needs.prediction &= config.gamma > 0.0;
  return needs;
}

ViewOptions view_options(const UtilityConfig& config, const ShadowBand& shadow,
                         double sparse_below) {
  const UtilityTraits needs = needs_of(config);
  const ReleasedSlips slips = {
      .excludes_hit_voxel = needs.baseline && config.hit_voxel == HitVoxel::excluded,
      .prediction_hides_hits = needs.eq2 && needs.prediction && config.prediction_hides_hits,
      .drops_leaving_rays = needs.baseline && config.leaving_rays == LeavingRays::dropped};
  return {.detail = needs.rays ? ViewDetail::rays : ViewDetail::voxels,
          .legacy_visibility = config.legacy_visibility,
          .sparse_below = sparse_below,
          .shadow = needs.shadow ? &shadow : nullptr,
          .slips = slips};
}

std::optional<Score> score(const UtilityConfig& config, const ViewStats& stats,
                           const ScoreContext& context) {
  const Utility& utility = utility_named(config.name);
  const bool refuses_blind = utility.traits.eq2 || utility.traits.baseline;
  if (refuses_blind && stats.occupied_voxels == 0) return std::nullopt;
  const Score result = utility.formula(config, stats, context);
  GNBV_CHECK(std::isfinite(result.value), "utility '{}' is {}", config.name, result.value);
  return result;
}

}  // namespace gnbv
