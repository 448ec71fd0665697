#include "tools/run/tour_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "planner/planners.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run/run_files.hpp"
#include "tools/run/run_record.hpp"
#include "tools/run/separated_text.hpp"
#include "tools/run/trajectory_tum.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

// What a pose loses in the file is less; two views of a tour differ by more.
constexpr double kSamePlace_m = 1e-3;
constexpr double kSameAngle_rad = 1e-3;

constexpr std::array<PatchSource, kPatchSources> kSources = {
    PatchSource::sampled, PatchSource::extrapolated, PatchSource::opposite, PatchSource::boundary};

constexpr std::string_view kPredictionsHeader =
    "iteration,source,looks,incidence_deg,patches,missing,promised,found";

std::string pose_json(const ViewPose& view) {
  const Vec3& p_m = view.p_world_m;
  const std::string pitch =
      view.gimbal_pitch_rad == 0.0
          ? ""
          : fmt::format(R"(,"gimbal_pitch_rad":{:.5f})", view.gimbal_pitch_rad);
  return fmt::format(R"({{"x_m":{:.4f},"y_m":{:.4f},"z_m":{:.4f},"yaw_rad":{:.5f}{}}})", p_m.x(),
                     p_m.y(), p_m.z(), view.yaw_rad, pitch);
}

std::string cubes_json(const TourPlan& plan, PatchSource source) {
  std::vector<std::string> cubes;
  for (const PatchCube& cube : plan.cubes) {
    if (cube.source != source) continue;
    const Vec3& p_m = cube.p_world_m;
    cubes.push_back(
        fmt::format("[{:.2f},{:.2f},{:.2f},{:.1f}]", p_m.x(), p_m.y(), p_m.z(), cube.expected));
  }
  return fmt::format(R"("{}":[{}])", name_of(source), fmt::join(cubes, ","));
}

Vec3 checked_place_m(const Vec3& p_m, const RunRecord& record, const TextPlace& place) {
  need_near_workspace(p_m, record.scenario.workspace_m, place);
  return p_m;
}

MadePlan made_plan_of(const Json& json, const RunRecord& record, const TextPlace& place) {
  MadePlan made;
  const double iteration = json.at("iteration");
  if (iteration < 1.0 || iteration > 1e9 || iteration != std::floor(iteration)) {
    throw BadInput("{}: iteration {} is none", to_string(place), iteration);
  }
  made.iteration = static_cast<std::size_t>(iteration);
  for (const Json& pose : json.at("tour")) {
    const Vec3 p_m(pose.at("x_m"), pose.at("y_m"), pose.at("z_m"));
    made.plan.views.push_back({checked_place_m(p_m, record, place), pose.at("yaw_rad"),
                               pose.value("gimbal_pitch_rad", 0.0)});
  }
  made.plan.cube_m = json.at("cube_m");
  for (const PatchSource source : kSources) {
    for (const Json& cube : json.at("cubes").at(std::string(name_of(source)))) {
      const auto [x, y, z, expected] = cube.get<std::array<double, 4>>();
      if (expected < 0.0) throw BadInput("{}: a cube of {} voxels", to_string(place), expected);
      made.plan.cubes.push_back({source, checked_place_m({x, y, z}, record, place), expected});
    }
  }
  return made;
}

std::string command_to_write_plans(const RunRecord& record) {
  const bool is_over = RunFiles(record.folder).find(kSummaryFile).has_value();
  return is_over ? command_to_fly_again(record.folder) : command_to_resume(record.folder);
}

bool is_planned_view(const ViewPose& a, const ViewPose& b) {
  return (a.p_world_m - b.p_world_m).norm() < kSamePlace_m &&
         std::abs(wrap_angle_rad(a.yaw_rad - b.yaw_rad)) < kSameAngle_rad &&
         std::abs(a.gimbal_pitch_rad - b.gimbal_pitch_rad) < kSameAngle_rad;
}

/// The number of what equals the value; throws BadInput when none does.
template <typename Values, typename Value>
std::size_t index_in(const Values& values, const Value& value, const TextPlace& place,
                     const char* what) {
  const auto at = std::ranges::find(values, value);
  if (at != values.end()) return static_cast<std::size_t>(at - values.begin());
  throw BadInput("{}: '{}' is no {}", to_string(place), value, what);
}

ViewOutcome outcome_of(std::string_view row, const TextPlace& place) {
  const std::vector<std::string_view> cells = split(row, ',');
  if (cells.size() != split(kPredictionsHeader, ',').size()) {
    throw BadInput("{}: '{}' is no row of {}", to_string(place), row, kPredictionsHeader);
  }
  std::array<std::string_view, kPatchSources> sources;
  std::ranges::transform(kSources, sources.begin(), [](PatchSource of) { return name_of(of); });
  GainOutcome gain;
  gain.source = kSources[index_in(sources, cells[1], place, "source of patches")];
  gain.observations = static_cast<std::size_t>(to_count(cells[2], place, "looks"));
  if (gain.observations >= kObservationBins) {
    throw BadInput("{}: looks {} must be less than {}", to_string(place), gain.observations,
                   kObservationBins);
  }
  gain.incidence = index_in(kIncidenceFrom_deg, to_count(cells[3], place, "incidence_deg"), place,
                            "beginning of a bin of incidence");
  gain.patches = to_count(cells[4], place, "patches");
  gain.missing = to_number(cells[5], place, "missing");
  gain.predicted = to_number(cells[6], place, "promised");
  gain.found = to_number(cells[7], place, "found");
  return {static_cast<std::size_t>(to_count(cells[0], place, "iteration")), gain};
}

}  // namespace

std::string plan_jsonl(std::span<const MadePlan> plans) {
  std::string lines;
  for (const auto& [iteration, plan] : plans) {
    std::vector<std::string> views, cubes;
    for (const ViewPose& view : plan.views) views.push_back(pose_json(view));
    for (const PatchSource source : kSources) cubes.push_back(cubes_json(plan, source));
    lines += fmt::format(R"({{"iteration":{},"tour":[{}],"cube_m":{},"cubes":{{{}}}}})", iteration,
                         fmt::join(views, ","), plan.cube_m, fmt::join(cubes, ","));
    lines += '\n';
  }
  return lines;
}

std::vector<MadePlan> read_plans(const RunRecord& record) {
  if (!traits_of(record.scenario.planner).makes_tours) {
    throw BadInput("{}: was flown by {}, which plans no tour; {} flies one", record.folder.string(),
                   record.scenario.planner.utility.name,
                   command_to_fly_again(record.folder, "--utility tour"));
  }
  const fs::path path = record.folder / kPlanFile;
  if (!RunFiles(record.folder).find(kPlanFile)) {
    throw BadInput("{}: is missing; {} writes it", path.string(), command_to_write_plans(record));
  }
  std::vector<MadePlan> plans;
  for_each_line(read_file(path), path, [&](std::string_view row, const TextPlace& place) {
    const std::size_t before = plans.empty() ? 0 : plans.back().iteration;
    try {
      plans.push_back(made_plan_of(Json::parse(row), record, place));
    } catch (const Json::exception& error) {
      throw BadInput("{}: {}; {} writes it anew", to_string(place), json_reason(error),
                     command_to_write_plans(record));
    }
    if (plans.back().iteration <= before) {
      throw BadInput("{}: iteration {} comes after {}", to_string(place), plans.back().iteration,
                     before);
    }
  });
  return plans;
}

std::optional<StandingPlan> standing_plan(std::span<const MadePlan> plans, const RunRecord& record,
                                          std::size_t iteration) {
  const auto after = std::find_if(plans.begin(), plans.end(), [&](const MadePlan& made) {
    return made.iteration > iteration + 1;
  });
  if (after == plans.begin()) return std::nullopt;
  StandingPlan standing{.made = &*(after - 1)};
  const std::vector<ViewPose>& tour = standing.made->plan.views;
  // those that could not be flown to were passed over
  for (std::size_t i = standing.made->iteration; i <= iteration && i < record.views.size(); ++i) {
    const ViewPose& taken = record.views[i].decision.view;
    const auto at =
        std::find_if(tour.begin() + static_cast<std::ptrdiff_t>(standing.next), tour.end(),
                     [&](const ViewPose& view) { return is_planned_view(view, taken); });
    if (at != tour.end()) standing.next = static_cast<std::size_t>(at - tour.begin()) + 1;
  }
  return standing;
}

std::string predictions_csv(std::span<const ViewOutcome> outcomes) {
  std::string csv = fmt::format("{}\n", kPredictionsHeader);
  for (const auto& [iteration, gain] : outcomes) {
    csv += fmt::format("{},{},{},{},{},{:.1f},{:.1f},{:.1f}\n", iteration, name_of(gain.source),
                       gain.observations, kIncidenceFrom_deg[gain.incidence], gain.patches,
                       gain.missing, gain.predicted, gain.found);
  }
  return csv;
}

std::vector<ViewOutcome> read_predictions_csv(const fs::path& file) {
  const std::string text = read_file(file);
  std::string_view rest = text;
  need_header(next_part(rest, '\n'), kPredictionsHeader, {file, 1});
  std::vector<ViewOutcome> outcomes;
  const auto take = [&](std::string_view row, const TextPlace& place) {
    outcomes.push_back(outcome_of(row, place));
  };
  for_each_line(rest, file, take, 2);
  return outcomes;
}

}  // namespace gnbv
