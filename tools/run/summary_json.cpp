#include "tools/run/summary_json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/score/run_figures.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/sha256.hpp"
#include "tools/run/coverage_csv.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/iterations_csv.hpp"
#include "tools/run/score_fields.hpp"
#include "tools/run/separated_text.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// By effort: what `value_of` gives for its budget; null without one.
template <typename ValueOf>
Json by_effort(const Budgets& budgets, const ValueOf& value_of) {
  Json json;
  for (std::size_t i = 0; i < budgets.size(); ++i) {
    json[std::string(kEffortNames[i])] =
        budgets[i] > 0.0 ? Json(value_of(static_cast<Effort>(i), budgets[i])) : Json(nullptr);
  }
  return json;
}

/// By share of the ceiling; null where it is not reached, and for all when the ceiling is unknown;
/// so is energy, with the battery, of runs of older versions.
Json effort_of(const MissionScore& score) {
  if (!score.ceiling) return nullptr;
  Json all;
  for (std::size_t i = 0; i < kReachShares.size(); ++i) {
    Json& entry = all[std::string(kReachNames[i])] = nullptr;
    const auto reached = entry_that_covers(score.curve, kReachShares[i] * *score.ceiling);
    if (!reached) continue;
    for (const Effort effort : kEfforts) {
      Json& spent = entry[std::string(name_of(effort))] = nullptr;
      if (is_known(score.curve, effort)) {
        spent = effort_at(score.curve, score.before, effort, *reached);
      }
    }
    entry["views"] = *reached;
    const auto& on_one_battery = score.curve.on_one_battery;
    entry["on_one_battery"] = nullptr;
    if (!on_one_battery.empty()) entry["on_one_battery"] = bool(on_one_battery[*reached]);
  }
  return all;
}

Json score_part(const MissionScore& score) {
  Json json;
  json["coverage"]["reference"] = reference_name(score.area_samples);
  if (score.area_samples > 0) json["coverage"]["area_samples"] = score.area_samples;
  json["coverage"]["is_noisy"] = score.is_noisy;
  visit_score(
      ScoreParts<false>{score.profile, score.final, score.profile_raw, score.final_raw,
                        score.accurate, score.more, score.distances, score.density},
      [&](const std::string& pointer, double value) { json[Json::json_pointer(pointer)] = value; });
  json["budget"] = by_effort(score.budgets, [](Effort, double budget) { return budget; });
  json["mean_coverage"] = by_effort(score.budgets, [&](Effort effort, double budget) {
    return area_under_coverage(score.curve, effort, 0, budget);
  });
  json["ceiling_at_0.05"] = score.ceiling ? Json(*score.ceiling) : Json(nullptr);
  json["effort_to_reach"] = effort_of(score);
  return json;
}

Json symmetry_of(const Prediction& prediction) {
  const Symmetry& symmetry = prediction.symmetry;
  Json plane = nullptr;
  if (symmetry.plane) {
    const Vec3& n = symmetry.plane->normal_world;
    plane = {{"normal", std::vector<double>(n.begin(), n.end())},
             {"offset_m", symmetry.plane->offset_m}};
  }
  return {{"plane", plane},
          {"support", symmetry.support},
          {"confirmed", symmetry.confirmed},
          {"predicted_voxels", prediction.predicted_voxels}};
}

constexpr std::array<std::string_view, 2> kRetiredKeys = {"auc", "mean_coverage_over_own"};

/// The summary with this score instead of the one it has, and this schema. `coverage` is where the
/// score stands.
Json with_score(const Json& summary, const MissionScore& score) {
  const Json part = score_part(score);
  Json out;
  for (const auto& [key, value] : summary.items()) {
    if (key == "schema") {
      out[key] = kSummarySchema;
    } else if (key == "coverage") {
      for (const auto& [score_key, score_value] : part.items()) out[score_key] = score_value;
    } else if (std::ranges::count(kRetiredKeys, key) == 0 && !part.contains(key)) {
      out[key] = value;
    }
  }
  return out;
}

/// How many candidates of the decision that found no valid view were rejected, and why.
Json rejections_of(const std::map<Rejection, int>& rejections) {
  if (rejections.empty()) return nullptr;
  Json counts = Json::object();
  for (const auto& [reason, count] : rejections) counts[std::string(name_of(reason))] = count;
  return counts;
}

/// Of a function of the user's own.
Json source_hash_of(const UtilityConfig& utility) {
  const UserFunctionConfig* const own = user_function(utility);
  return own == nullptr ? Json(nullptr) : Json(sha256_of(own->source));
}

Json home_of(const std::optional<HomeFlight>& home) {
  if (!home) return nullptr;
  return {{"reached", home->reached}, {"landed", home->landed}, {"flown_m", home->flown_m}};
}

}  // namespace

std::string score_json(const MissionScore& score, bool is_run) {
  Json json = score_part(score);
  if (!is_run) {
    for (const char* key : {"budget", "mean_coverage", "ceiling_at_0.05", "effort_to_reach"}) {
      json.erase(key);
    }
    json["coverage"].erase("is_noisy");
    json["coverage"].erase("profile");
    json["coverage"].erase("profile_raw_reference");
  }
  return json.dump(2);
}

std::string summary_json(const Scenario& scenario, const MissionResult& r,
                         const MissionScore& score, double total_wall_s) {
  const double entropy_nat = r.belief.grid.total_entropy_nat();
  const double battery_wh = scenario.vehicle.power.battery_wh;
  const Json battery = battery_wh > 0.0 ? Json(battery_wh) : Json(nullptr);  // null: never empty
  const WindConfig& wind = scenario.wind;
  const Vec3 p = r.final_state.T_world_body.translation();
  const Eigen::Quaterniond q(r.final_state.T_world_body.linear());
  const Vec3& v = r.final_state.v_world_m_s;
  Json json = {
      {"schema", kSummarySchema},
      {"scenario", scenario.name},
      {"structure", structure_name(scenario.structure)},
      {"utility", utility_label(scenario.planner.utility)},
      {"utility_source_sha256", source_hash_of(scenario.planner.utility)},
      {"preset", scenario.planner.preset},
      {"vehicle", scenario.vehicle.kind == VehicleKind::ideal ? "ideal" : scenario.vehicle.preset},
      {"seed", scenario.seed},
      {"version", GNBV_VERSION},
      {"iterations", r.views.size()},
      {"termination", name_of(r.termination)},
      {"failure", r.failure.empty() ? Json(nullptr) : Json(r.failure)},
      {"ended_by_truth", r.termination == Termination::coverage_reached},
      {"last_rejections", rejections_of(r.last_rejections)},
      {"distance_m",
       {{"straight", r.distance.straight_m},
        {"flown", r.distance.flown_m},
        {"profile", r.distance.profile_m},
        {"profile_flown", r.distance.profile_flown_m},
        {"transfer", r.distance.transfer_m}}},
      {"profile_end_s", r.profile_end_s},
      {"views_begin_s", r.views.empty() ? r.profile_end_s : r.views.front().time_s},
      {"flight_time_s", r.flight_time_s},
      {"energy_wh", r.energy_wh},
      {"battery_wh", battery},
      {"battery_left_wh", battery_wh > 0.0 ? Json(battery_wh - r.energy_wh) : Json(nullptr)},
      {"home", home_of(r.home)},
      {"entropy_nat",
       {{"after_profile", r.entropy_after_profile_nat},
        {"final", entropy_nat},
        {"reduction", r.entropy_after_profile_nat - entropy_nat}}},
      {"symmetry", symmetry_of(r.prediction)},
      {"coverage", nullptr},
      {"density_points_per_voxel", r.views.empty() ? 0.0 : r.views.back().density_points_per_voxel},
      {"collisions", r.termination == Termination::collision ? 1 : 0},
      {"legs_timed_out", r.legs_timed_out},
      {"path_error_m", {{"rms", r.path_error.rms_m()}, {"max", r.path_error.max_m}}},
      {"frames", {{"taken", r.frames.taken}, {"dropped", r.frames.dropped}}},
      {"wind",
       {{"mean_m_s", std::vector<double>(wind.mean_world_m_s.begin(), wind.mean_world_m_s.end())},
        {"gust_w20_m_s", wind.gust_w20_m_s}}},
      {"final_state",
       {{"position_m", std::vector<double>(p.begin(), p.end())},
        {"quaternion_xyzw", std::vector<double>{q.x(), q.y(), q.z(), q.w()}},
        {"velocity_m_s", std::vector<double>(v.begin(), v.end())}}},
      {"wall_s",
       {{"total", total_wall_s},
        {"profile", r.wall.profile_s},
        {"symmetry", r.wall.symmetry_s},
        {"sense", r.wall.sense_s},
        {"map", r.wall.map_s},
        {"plan", r.wall.plan_s},
        {"fly", r.wall.fly_s},
        {"score", r.wall.score_s}}},
      {"views_sha256", views_sha256(r.views)},
      {"result_sha256", result_sha256(r)},
  };
  return with_score(json, score).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void rescore_summary(const fs::path& run, const MissionScore& score) {
  const fs::path path = run / kSummaryFile;
  const Json json = Json::parse(read_json_text(path), nullptr, false);
  if (!json.is_object() || !json.contains("schema") || !json.contains("coverage")) {
    throw BadInput("{}: is not the summary of a run", path.string());
  }
  const Json& schema = json.at("schema");
  if (!schema.is_number_unsigned() || schema.get<std::uint64_t>() > kSummarySchema) {
    throw BadInput("{}: /schema: {} is none that this version knows, 1 to {}", path.string(),
                   schema.dump(), kSummarySchema);
  }
  const std::string summary =
      with_score(json, score).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  // killed in between, the run is one without a curve, which scoring gives back, not one of two
  fs::remove(run / kCoverageFile);
  write_file_atomically(path, summary);
  write_file_atomically(run / kCoverageFile, coverage_csv(score.curve, score.more));
}

}  // namespace gnbv
