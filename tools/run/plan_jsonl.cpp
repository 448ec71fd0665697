#include "tools/run/plan_jsonl.hpp"

#include <fmt/format.h>

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

std::string pose_json(const ViewPose& view) {
  const Vec3& p_m = view.p_world_m;
  std::string json = fmt::format(R"({{"x_m":{:.4f},"y_m":{:.4f},"z_m":{:.4f},"yaw_rad":{:.5f})",
                                 p_m.x(), p_m.y(), p_m.z(), view.yaw_rad);
  if (view.gimbal_pitch_rad != 0.0) {
    json += fmt::format(R"(,"gimbal_pitch_rad":{:.5f})", view.gimbal_pitch_rad);
  }
  return json + "}";
}

std::string cubes_json(const TourPlan& plan, PatchSource source) {
  std::string json = fmt::format(R"("{}":[)", name_of(source));
  const char* separator = "";
  for (const PatchCube& cube : plan.cubes) {
    if (cube.source != source) continue;
    const Vec3& p_m = cube.p_world_m;
    json += fmt::format("{}[{:.2f},{:.2f},{:.2f},{:.1f}]", separator, p_m.x(), p_m.y(), p_m.z(),
                        cube.expected);
    separator = ",";
  }
  return json + "]";
}

Vec3 checked_place_m(const Vec3& p_m, const RunRecord& record, const TextPlace& place) {
  need_near_workspace(p_m, record.scenario.workspace_m, place);
  return p_m;
}

MadePlan made_plan_of(const Json& json, const RunRecord& record, const TextPlace& place) {
  MadePlan made;
  const double iteration = json.at("iteration");
  if (iteration < 1.0 || iteration > 1e9 || iteration != std::floor(iteration)) {
    throw BadInput(fmt::format("{}: iteration {} is none", to_string(place), iteration));
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
      const auto numbers = cube.get<std::array<double, 4>>();
      if (numbers[3] < 0.0) {
        throw BadInput(fmt::format("{}: a cube of {} voxels", to_string(place), numbers[3]));
      }
      const Vec3 p_m(numbers[0], numbers[1], numbers[2]);
      made.plan.cubes.push_back({source, checked_place_m(p_m, record, place), numbers[3]});
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

}  // namespace

std::string plan_jsonl(std::span<const MadePlan> plans) {
  std::string lines;
  for (const auto& [iteration, plan] : plans) {
    lines += fmt::format(R"({{"iteration":{},"tour":[)", iteration);
    const char* separator = "";
    for (const ViewPose& view : plan.views) {
      lines += separator + pose_json(view);
      separator = ",";
    }
    lines += fmt::format(R"(],"cube_m":{},"cubes":{{)", plan.cube_m);
    separator = "";
    for (const PatchSource source : kSources) {
      lines += separator + cubes_json(plan, source);
      separator = ",";
    }
    lines += "}}\n";
  }
  return lines;
}

std::vector<MadePlan> read_plans(const RunRecord& record) {
  const std::string& utility = record.scenario.planner.utility.name;
  if (!traits_of(record.scenario.planner).makes_tours) {
    throw BadInput(fmt::format("{}: was flown by {}, which plans no tour; {} flies one",
                               record.folder.string(), utility,
                               command_to_fly_again(record.folder, "--utility tour")));
  }
  const fs::path path = record.folder / kPlanFile;
  if (!RunFiles(record.folder).find(kPlanFile)) {
    throw BadInput(
        fmt::format("{}: is missing; {} writes it", path.string(), command_to_write_plans(record)));
  }
  const std::string text = read_file(path);
  std::string_view rest = text;
  std::vector<MadePlan> plans;
  for (int line = 1; !rest.empty(); ++line) {
    const TextPlace place{path, line};
    const std::string_view row = next_part(rest, '\n');
    try {
      plans.push_back(made_plan_of(Json::parse(row), record, place));
    } catch (const Json::exception& error) {
      throw BadInput(fmt::format("{}: {}; {} writes it anew", to_string(place), json_reason(error),
                                 command_to_write_plans(record)));
    }
    if (plans.size() > 1 && plans.back().iteration <= plans[plans.size() - 2].iteration) {
      throw BadInput(fmt::format("{}: iteration {} comes after {}", to_string(place),
                                 plans.back().iteration, plans[plans.size() - 2].iteration));
    }
  }
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

}  // namespace gnbv
