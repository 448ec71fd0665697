#include "tools/run_files/summary_json.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/sha256.hpp"
#include "sim/core/shell_word.hpp"
#include "tools/run_files/coverage_csv.hpp"
#include "tools/run_files/file_names.hpp"
#include "tools/run_files/iterations_csv.hpp"
#include "tools/run_files/run_commands.hpp"
#include "tools/run_files/score_json.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

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

/// Keys of earlier schemas that this one has under another name.
constexpr std::array<std::string_view, 1> kRetiredKeys = {"auc"};

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
    } else if (std::find(kRetiredKeys.begin(), kRetiredKeys.end(), key) == kRetiredKeys.end() &&
               !part.contains(key)) {
      out[key] = value;
    }
  }
  return out;
}

/// summary.json, whose values are named by pointers: "/coverage/final/0.05".
class SummaryReader {
 public:
  explicit SummaryReader(const fs::path& run) : path_(run / kSummaryFile) {
    if (!fs::exists(path_)) {
      throw BadInput(fmt::format(
          "{}: holds no summary.json: no run, or one that is not finished; {} finishes it",
          run.string(), command_to_resume(run)));
    }
    json_ = Json::parse(read_file(path_), nullptr, false);
    if (!json_.is_object()) throw BadInput(fmt::format("{}: is no JSON object", path_.string()));
  }

  double number(const std::string& pointer) const {
    const Json& value = at(pointer);
    if (!value.is_number()) refuse(pointer, value, "is no number");
    return value.get<double>();
  }
  std::optional<double> number_or_null(const std::string& pointer) const {
    return at(pointer).is_null() ? std::nullopt : std::optional(number(pointer));
  }
  std::uint64_t count(const std::string& pointer) const {
    const Json& value = at(pointer);
    if (!value.is_number_unsigned()) refuse(pointer, value, "is no count");
    return value.get<std::uint64_t>();
  }
  std::string text(const std::string& pointer) const {
    const Json& value = at(pointer);
    if (!value.is_string()) refuse(pointer, value, "is no text");
    return value.get<std::string>();
  }
  std::array<double, 3> by_size(const std::string& pointer) const {
    return {number(pointer + "/0.05"), number(pointer + "/0.10"), number(pointer + "/0.50")};
  }
  /// At the sizes that coverage.csv's header names beside the paper's.
  std::vector<SizedCoverage> more_sizes(const CoverageFile& file) const {
    std::vector<SizedCoverage> more;
    for (std::size_t i = 0; i < file.more_names.size(); ++i) {
      const auto share = [&](const char* what) {
        return number(fmt::format("/coverage/{}/{}", what, file.more_names[i]));
      };
      more.push_back({.size_m = std::strtod(file.more_names[i].c_str(), nullptr),
                      .profile = share("profile"),
                      .final = share("final"),
                      .profile_raw = share("profile_raw_reference"),
                      .final_raw = share("final_raw_reference"),
                      .curve = file.more_curves[i]});
    }
    return more;
  }
  /// Nothing where the summary has no such value.
  template <typename Value>
  std::optional<Value> if_there(Value (SummaryReader::*read)(const std::string&) const,
                                const std::string& pointer) const {
    return json_.contains(Json::json_pointer(pointer)) ? std::optional((this->*read)(pointer))
                                                       : std::nullopt;
  }

 private:
  const Json& at(const std::string& pointer) const {
    const Json::json_pointer where(pointer);
    if (!json_.contains(where)) {
      throw BadInput(fmt::format("{}: {}: is missing", path_.string(), pointer));
    }
    return json_.at(where);
  }
  [[noreturn]] void refuse(const std::string& pointer, const Json& value, const char* what) const {
    throw BadInput(fmt::format("{}: {}: {} {}", path_.string(), pointer, value.dump(), what));
  }

  fs::path path_;
  Json json_;
};

CloudDistances distances_of(const SummaryReader& summary) {
  CloudDistances distances;
  for (std::size_t i = 0; i < distances.at.size(); ++i) {
    const std::string entry = fmt::format("/precision_recall/{}", i);
    distances.at[i] = {summary.number(entry + "/distance_m"), summary.number(entry + "/precision"),
                       summary.number(entry + "/recall"), summary.number(entry + "/f")};
  }
  distances.accuracy_m = summary.number("/accuracy_m");
  distances.completeness_m = summary.number("/completeness_m");
  distances.chamfer_m = summary.number("/chamfer_m");
  return distances;
}

/// How many candidates of the decision that found no valid view were rejected, and why.
Json rejections_of(const std::map<Rejection, int>& rejections) {
  if (rejections.empty()) return nullptr;
  Json counts = Json::object();
  for (const auto& [reason, count] : rejections) counts[std::string(name_of(reason))] = count;
  return counts;
}

/// Of an own utility.
Json source_hash_of(const UtilityConfig& utility) {
  if (!is_own_utility(utility.name)) return nullptr;
  Sha256 hash;
  hash.add(utility.python.source);
  return hash.hex();
}

Json home_of(const std::optional<HomeFlight>& home) {
  if (!home) return nullptr;
  return {{"reached", home->reached}, {"landed", home->landed}, {"flown_m", home->flown_m}};
}

}  // namespace

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
  return with_score(json, score).dump(2) + "\n";
}

RunSummary read_summary(const fs::path& run) {
  using R = SummaryReader;
  const SummaryReader summary(run);
  return {.schema = summary.count("/schema"),
          .termination = summary.if_there(&R::text, "/termination"),
          .iterations = summary.if_there(&R::count, "/iterations"),
          .profile_end_s = summary.if_there(&R::number, "/profile_end_s"),
          .views_begin_s = summary.if_there(&R::number, "/views_begin_s"),
          .profile_m = summary.if_there(&R::number, "/distance_m/profile"),
          .transfer_m = summary.if_there(&R::number, "/distance_m/transfer"),
          .result_sha256 = summary.if_there(&R::text, "/result_sha256"),
          .views_sha256 = summary.if_there(&R::text, "/views_sha256")};
}

void need_views_of_summary(const fs::path& csv, const RunSummary& summary,
                           std::span<const ViewRecord> views) {
  if (!summary.views_sha256 || *summary.views_sha256 == views_sha256(views)) return;
  throw BadInput(fmt::format(
      "{}: holds other rows than the run of summary.json wrote: edited, damaged, or files of two "
      "runs? {} flies it again",
      csv.string(), command_to_fly_again(csv.parent_path())));
}

RunFigures read_run_figures(const fs::path& run) {
  const SummaryReader summary(run);
  const std::uint64_t schema = summary.count("/schema");
  if (schema != kSummarySchema) {
    throw BadInput(fmt::format(
        "{}: schema {} of another version; `gnbv score {} --update` scores "
        "the run anew and makes it {}",
        (run / kSummaryFile).string(), schema, shell_word(run.string()), kSummarySchema));
  }
  CoverageFile coverage = read_coverage_csv(run / kCoverageFile);
  RunFigures figures{
      .scenario = summary.text("/scenario"),
      .structure = summary.text("/structure"),
      .utility = summary.text("/utility"),
      .preset = summary.text("/preset"),
      .seed = summary.count("/seed"),
      .version = summary.text("/version"),
      .termination = summary.text("/termination"),
      .result_sha256 = summary.text("/result_sha256"),
      .iterations = static_cast<int>(summary.count("/iterations")),
      .entropy_reduction_nat = summary.number("/entropy_nat/reduction"),
      .straight_m = summary.number("/distance_m/straight"),
      .flown_m = summary.number("/distance_m/flown"),
      .before = {.profile_m = summary.number("/distance_m/profile"),
                 .transfer_m = summary.number("/distance_m/transfer"),
                 .profile_end_s = summary.number("/profile_end_s")},
      .flight_time_s = summary.number("/flight_time_s"),
      .energy_wh = summary.number("/energy_wh"),
      .coverage_final = summary.by_size("/coverage/final"),
      .coverage_profile = summary.by_size("/coverage/profile"),
      .coverage_final_raw = summary.by_size("/coverage/final_raw_reference"),
      .coverage_profile_raw = summary.by_size("/coverage/profile_raw_reference"),
      .more = summary.more_sizes(coverage),
      .density_points_per_voxel = summary.number("/density_points_per_voxel"),
      .distances = distances_of(summary),
      .density = {.voxel_m = summary.number("/density/voxel_m"),
                  .mean_points = summary.number("/density/mean_points"),
                  .variation = summary.number("/density/variation")},
      .curve = std::move(coverage.curve),
      .ceiling = summary.number_or_null("/ceiling_at_0.05"),
      .wall_s = summary.number("/wall_s/total"),
  };
  if (figures.curve.coverage.size() != static_cast<std::size_t>(figures.iterations) + 1) {
    throw BadInput(fmt::format("{}: {} rows for the profile and {} views",
                               (run / kCoverageFile).string(), figures.curve.coverage.size(),
                               figures.iterations));
  }
  return figures;
}

void rescore_summary(const fs::path& run, const MissionScore& score) {
  const fs::path path = run / kSummaryFile;
  const Json json = Json::parse(read_file(path), nullptr, false);
  if (!json.is_object() || !json.contains("schema") || !json.contains("coverage")) {
    throw BadInput(fmt::format("{}: is not the summary of a run", path.string()));
  }
  const Json& schema = json.at("schema");
  if (!schema.is_number_unsigned() || schema.get<std::uint64_t>() > kSummarySchema) {
    throw BadInput(fmt::format("{}: /schema: {} is none that this version knows, 1 to {}",
                               path.string(), schema.dump(), kSummarySchema));
  }
  const std::string summary = with_score(json, score).dump(2) + "\n";
  write_file_atomically(run / kCoverageFile, coverage_csv(score.curve, score.more));
  write_file_atomically(path, summary);
}

}  // namespace gnbv
