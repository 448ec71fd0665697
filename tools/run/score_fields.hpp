// The part of summary.json that scores, described once for whoever writes it or reads it.
#pragma once

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "bench/score/cloud_metrics.hpp"
#include "bench/score/sized_coverage.hpp"

namespace gnbv {

/// What is scored: const for a writer.
template <bool kIsRead>
struct ScoreParts {
  template <typename T>
  using Ref = std::conditional_t<kIsRead, T&, const T&>;
  Ref<std::array<double, 3>> profile, final, profile_raw, final_raw;
  Ref<std::optional<std::array<double, 3>>> accurate;  // if there
  Ref<std::vector<SizedCoverage>> more;                // whose sizes are known
  Ref<CloudDistances> distances;
  Ref<CloudDensity> density;
};

/// Calls field("/coverage/final/0.05", number) and so on, in the order of the file.
template <bool kIsRead, typename Field>
void visit_score(const ScoreParts<kIsRead>& score, Field&& field) {
  const auto shares = [&](const std::string& of, auto& by_size, double SizedCoverage::*share) {
    field(of + "/0.05", by_size[0]);
    field(of + "/0.10", by_size[1]);
    field(of + "/0.50", by_size[2]);
    for (auto& at : score.more) field(of + '/' + size_name(at.size_m), at.*share);
  };
  shares("/coverage/profile", score.profile, &SizedCoverage::profile);
  shares("/coverage/final", score.final, &SizedCoverage::final);
  shares("/coverage/profile_raw_reference", score.profile_raw, &SizedCoverage::profile_raw);
  shares("/coverage/final_raw_reference", score.final_raw, &SizedCoverage::final_raw);
  if (score.accurate) shares("/coverage/accurate", *score.accurate, &SizedCoverage::accurate);
  for (std::size_t i = 0; i < score.distances.at.size(); ++i) {
    const std::string entry = fmt::format("/precision_recall/{}", i);
    field(entry + "/distance_m", score.distances.at[i].distance_m);
    field(entry + "/precision", score.distances.at[i].precision);
    field(entry + "/recall", score.distances.at[i].recall);
    field(entry + "/f", score.distances.at[i].f);
  }
  field("/accuracy_m", score.distances.accuracy_m);
  field("/completeness_m", score.distances.completeness_m);
  field("/chamfer_m", score.distances.chamfer_m);
  field("/density/voxel_m", score.density.voxel_m);
  field("/density/mean_points", score.density.mean_points);
  field("/density/variation", score.density.variation);
}

}  // namespace gnbv
