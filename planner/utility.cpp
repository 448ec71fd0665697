#include "planner/utility.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

using Formula = Score (*)(const UtilityConfig&, const ViewStats&);

/// E hat of Eq. (2): the share of the largest possible entropy of the visible voxels.
double normalised_entropy(const ViewStats& s) {
  const double voxels = static_cast<double>(s.free_voxels) + s.unknown_voxels + s.occupied_voxels;
  return s.entropy_nat / (voxels * std::numbers::ln2);
}

/// D hat of Eq. (2); 0 when the view sees no point of the cloud.
double normalised_density(const UtilityConfig& config, const ViewStats& s) {
  const double mean = s.density_sum / s.occupied_voxels;
  if (mean <= 0.0) return 0.0;
  const double share = std::min(mean / s.density_max, 1.0);
  return config.density_term == DensityTerm::literal ? share : 1.0 - share;
}

/// Eq. (2), with beta and gamma normalised to sum 1 as the released code does.
Score proposed(const UtilityConfig& config, const ViewStats& s) {
  Score out;
  out.information = normalised_entropy(s);
  out.density = normalised_density(config, s);
  out.prediction = s.predicted_voxels /
                   (static_cast<double>(s.predicted_voxels) + s.occupied_voxels);  // Eq. (3)
  out.distance = std::exp(-config.lambda_per_m * s.path_m);
  const double weights = config.beta + config.gamma;
  const double quality = (config.beta * out.density + config.gamma * out.prediction) / weights;
  out.value = (1.0 + config.alpha * out.information) * quality * out.distance *
              std::log10(static_cast<double>(s.occupied_voxels));
  return out;
}

/// Isler et al. 2016 as the paper compares it: total entropy along the rays.
Score isler(const UtilityConfig&, const ViewStats& s) {
  return {.value = s.entropy_per_ray_nat, .information = s.entropy_per_ray_nat};
}

/// Bircher et al. 2016 as the paper compares it: the same, discounted by distance.
Score bircher(const UtilityConfig& config, const ViewStats& s) {
  const double distance = std::exp(-config.lambda_per_m * s.path_m);
  return {.value = s.entropy_per_ray_nat * distance,
          .information = s.entropy_per_ray_nat,
          .distance = distance};
}

struct NamedFormula {
  std::string_view name;
  Formula formula;
};

/// The one table of utilities: adding one is a function above and a line here.
constexpr std::array kFormulas = {
    NamedFormula{"proposed", proposed},
    NamedFormula{"bircher", bircher},
    NamedFormula{"isler", isler},
};

}  // namespace

std::vector<std::string_view> utility_names() {
  std::vector<std::string_view> names;
  for (const NamedFormula& entry : kFormulas) names.push_back(entry.name);
  return names;
}

std::optional<Score> score(const UtilityConfig& config, const ViewStats& stats) {
  if (stats.occupied_voxels == 0) return std::nullopt;
  const auto* const entry =
      std::find_if(kFormulas.begin(), kFormulas.end(),
                   [&](const NamedFormula& e) { return e.name == config.name; });
  GNBV_CHECK(entry != kFormulas.end(), "utility '{}' has no formula", config.name);
  const Score result = entry->formula(config, stats);
  GNBV_CHECK(std::isfinite(result.value), "utility '{}' is {}", config.name, result.value);
  return result;
}

}  // namespace gnbv
