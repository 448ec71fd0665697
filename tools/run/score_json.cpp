#include "tools/run/score_json.hpp"

#include <nlohmann/json.hpp>

#include "bench/score/effort_to_reach.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;

/// The paper's sizes first.
Json by_size(const std::array<double, 3>& coverage, std::span<const SizedCoverage> more,
             double SizedCoverage::*share) {
  Json json = {{"0.05", coverage[0]}, {"0.10", coverage[1]}, {"0.50", coverage[2]}};
  for (const SizedCoverage& at : more) json[size_name(at.size_m)] = at.*share;
  return json;
}

/// Mean coverage at 0.05 m over the run's own length; null for a run that has none.
Json mean_over_own(const CoverageCurve& curve) {
  const auto mean = [&](Effort effort, double length) {
    return length > 0.0 ? Json(area_under_coverage(curve, effort, 0, length)) : Json(nullptr);
  };
  return {{"views", mean(Effort::views, static_cast<double>(curve.views()))},
          {"metres", mean(Effort::metres, curve.metres.back())},
          {"seconds", mean(Effort::seconds, curve.seconds.back())}};
}

/// By share of the ceiling; null where it is not reached, and for all when the ceiling is unknown.
Json effort_of(const MissionScore& score) {
  if (!score.ceiling) return nullptr;
  Json all;
  for (std::size_t i = 0; i < kReachShares.size(); ++i) {
    Json& entry = all[std::string(kReachNames[i])] = nullptr;
    const auto spent = effort_to_reach(score.curve, score.before, kReachShares[i] * *score.ceiling);
    if (!spent) continue;
    entry = {{"views", static_cast<std::uint64_t>(spent->views)},
             {"metres", spent->metres},
             {"metres_with_profile", spent->metres_with_profile},
             {"seconds", spent->seconds},
             {"seconds_with_profile", spent->seconds_with_profile}};
  }
  return all;
}

}  // namespace

nlohmann::ordered_json score_part(const MissionScore& score) {
  Json at = Json::array();
  for (const DistanceScore& d : score.distances.at) {
    at.push_back({{"distance_m", d.distance_m},
                  {"precision", d.precision},
                  {"recall", d.recall},
                  {"f", d.f}});
  }
  return {
      {"coverage",
       {{"profile", by_size(score.profile, score.more, &SizedCoverage::profile)},
        {"final", by_size(score.final, score.more, &SizedCoverage::final)},
        {"profile_raw_reference",
         by_size(score.profile_raw, score.more, &SizedCoverage::profile_raw)},
        {"final_raw_reference", by_size(score.final_raw, score.more, &SizedCoverage::final_raw)}}},
      {"precision_recall", at},
      {"accuracy_m", score.distances.accuracy_m},
      {"completeness_m", score.distances.completeness_m},
      {"chamfer_m", score.distances.chamfer_m},
      {"density",
       {{"voxel_m", score.density.voxel_m},
        {"mean_points", score.density.mean_points},
        {"variation", score.density.variation}}},
      {"mean_coverage_over_own", mean_over_own(score.curve)},
      {"ceiling_at_0.05", score.ceiling ? Json(*score.ceiling) : Json(nullptr)},
      {"effort_to_reach", effort_of(score)},
  };
}

std::string score_json(const MissionScore& score, bool is_run) {
  Json json = score_part(score);
  if (!is_run) {
    for (const char* key : {"mean_coverage_over_own", "ceiling_at_0.05", "effort_to_reach"}) {
      json.erase(key);
    }
    json["coverage"].erase("profile");
    json["coverage"].erase("profile_raw_reference");
  }
  return json.dump(2);
}

}  // namespace gnbv
