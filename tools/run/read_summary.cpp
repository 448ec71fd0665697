#include <cstdlib>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "sim/core/text.hpp"
#include "tools/run/coverage_csv.hpp"
#include "tools/run/iterations_csv.hpp"
#include "tools/run/run_files.hpp"
#include "tools/run/score_fields.hpp"
#include "tools/run/separated_text.hpp"
#include "tools/run/summary_json.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

template <typename T>
struct IsOptional : std::false_type {};
template <typename T>
struct IsOptional<std::optional<T>> : std::true_type {};

/// summary.json, whose values are named by pointers: "/coverage/final/0.05".
class SummaryReader {
 public:
  explicit SummaryReader(const fs::path& run) : path_(run / kSummaryFile) {
    if (!RunFiles(run).find(kSummaryFile)) {
      throw BadInput(
          "{}: holds no summary.json: no run, or one that is not finished; {} finishes it",
          run.string(), command_to_resume(run));
    }
    json_ = Json::parse(read_json_text(path_), nullptr, false);
    if (!json_.is_object()) throw BadInput("{}: is no JSON object", path_.string());
  }

  bool has(const std::string& pointer) const { return json_.contains(Json::json_pointer(pointer)); }
  bool holds_true(const std::string& pointer) const {
    return has(pointer) && json_.at(Json::json_pointer(pointer)) == true;
  }

  /// A number, a count or a text; nothing, where that may be, for null.
  template <typename Value>
  void read(Value& value, const std::string& pointer) const {
    const Json::json_pointer where(pointer);
    if (!has(pointer)) throw BadInput("{}: {}: is missing", path_.string(), pointer);
    const Json& json = json_.at(where);
    if constexpr (IsOptional<Value>::value) {
      if (!json.is_null()) read(value.emplace(), pointer);
    } else {
      constexpr bool kIsNumber = std::is_same_v<Value, double>;
      constexpr bool kIsCount = std::is_integral_v<Value>;
      const bool is_one = kIsNumber  ? json.is_number()
                          : kIsCount ? json.is_number_unsigned()
                                     : json.is_string();
      if (!is_one) {
        throw BadInput("{}: {}: {} is no {}", path_.string(), pointer, json.dump(),
                       kIsNumber  ? "number"
                       : kIsCount ? "count"
                                  : "text");
      }
      value = json.get<Value>();
    }
  }
  template <typename Value>
  void read_if_there(std::optional<Value>& value, const std::string& pointer) const {
    if (has(pointer)) read(value.emplace(), pointer);
  }

 private:
  fs::path path_;
  Json json_;
};

}  // namespace

RunSummary read_summary(const fs::path& run) {
  const SummaryReader from(run);
  RunSummary summary;
  from.read(summary.schema, "/schema");
  from.read_if_there(summary.termination, "/termination");
  from.read_if_there(summary.iterations, "/iterations");
  from.read_if_there(summary.profile_end_s, "/profile_end_s");
  from.read_if_there(summary.views_begin_s, "/views_begin_s");
  from.read_if_there(summary.profile_m, "/distance_m/profile");
  from.read_if_there(summary.transfer_m, "/distance_m/transfer");
  from.read_if_there(summary.result_sha256, "/result_sha256");
  from.read_if_there(summary.views_sha256, "/views_sha256");
  return summary;
}

void need_views_of_summary(const fs::path& csv, const RunSummary& summary,
                           std::span<const ViewRecord> views) {
  if (!summary.views_sha256 || *summary.views_sha256 == views_sha256(views)) return;
  throw BadInput(
      "{}: holds other rows than the run of summary.json wrote: edited, damaged, or files of two "
      "runs? {} flies it again",
      csv.string(), command_to_fly_again(csv.parent_path()));
}

RunFigures read_run_figures(const fs::path& run) {
  const SummaryReader summary(run);
  std::uint64_t schema = 0;
  summary.read(schema, "/schema");
  if (schema != kSummarySchema) {
    throw BadInput(
        "{}: schema {} of another version; `gnbv score {} --update` scores the run anew and makes "
        "it {}",
        (run / kSummaryFile).string(), schema, shell_word(run.string()), kSummarySchema);
  }
  RunFigures figures;
  summary.read(figures.scenario, "/scenario");
  summary.read(figures.structure, "/structure");
  summary.read(figures.utility, "/utility");
  summary.read(figures.preset, "/preset");
  summary.read(figures.seed, "/seed");
  summary.read(figures.version, "/version");
  summary.read(figures.termination, "/termination");
  summary.read(figures.result_sha256, "/result_sha256");
  summary.read(figures.iterations, "/iterations");
  summary.read(figures.entropy_reduction_nat, "/entropy_nat/reduction");
  summary.read(figures.straight_m, "/distance_m/straight");
  summary.read(figures.flown_m, "/distance_m/flown");
  summary.read(figures.before.profile_m, "/distance_m/profile");
  summary.read(figures.before.transfer_m, "/distance_m/transfer");
  summary.read(figures.before.profile_end_s, "/profile_end_s");
  summary.read(figures.flight_time_s, "/flight_time_s");
  summary.read(figures.energy_wh, "/energy_wh");
  summary.read(figures.density_points_per_voxel, "/density_points_per_voxel");
  summary.read(figures.ceiling, "/ceiling_at_0.05");
  for (std::size_t i = 0; i < figures.budgets.size(); ++i) {
    std::optional<double> budget;  // older summaries have none
    const std::string pointer = fmt::format("/budget/{}", kEffortNames[i]);
    if (summary.has(pointer)) summary.read(budget, pointer);
    figures.budgets[i] = budget.value_or(0.0);
  }
  summary.read(figures.wall_s, "/wall_s/total");
  std::optional<std::size_t> area_samples;
  summary.read_if_there(area_samples, "/coverage/area_samples");
  figures.area_samples = area_samples.value_or(0);
  figures.is_noisy = summary.holds_true("/coverage/is_noisy");
  if (summary.has("/coverage/accurate")) figures.coverage_accurate.emplace();
  CoverageFile coverage = read_coverage_csv(run / kCoverageFile);
  for (std::size_t i = 0; i < coverage.more_names.size(); ++i) {
    figures.more.push_back({.size_m = std::strtod(coverage.more_names[i].c_str(), nullptr),
                            .curve = std::move(coverage.more_curves[i]),
                            .accurate_curve = std::move(coverage.more_accurate[i])});
  }
  visit_score(
      ScoreParts<true>{figures.coverage_profile, figures.coverage_final,
                       figures.coverage_profile_raw, figures.coverage_final_raw,
                       figures.coverage_accurate, figures.more, figures.distances, figures.density},
      [&](const std::string& pointer, double& value) { summary.read(value, pointer); });
  figures.curve = std::move(coverage.curve);
  if (figures.curve.coverage.size() != static_cast<std::size_t>(figures.iterations) + 1) {
    throw BadInput("{}: {} rows for the profile and {} views", (run / kCoverageFile).string(),
                   figures.curve.coverage.size(), figures.iterations);
  }
  return figures;
}

}  // namespace gnbv
