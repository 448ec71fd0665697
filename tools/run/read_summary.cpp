#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/text.hpp"
#include "tools/run/coverage_csv.hpp"
#include "tools/run/iterations_csv.hpp"
#include "tools/run/run_files.hpp"
#include "tools/run/summary_json.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// summary.json, whose values are named by pointers: "/coverage/final/0.05".
class SummaryReader {
 public:
  explicit SummaryReader(const fs::path& run) : path_(run / kSummaryFile) {
    if (!RunFiles(run).find(kSummaryFile)) {
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

}  // namespace

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

}  // namespace gnbv
