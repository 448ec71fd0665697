#include "tools/run/candidates_jsonl.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/mission_result.hpp"
#include "tools/run/run_commands.hpp"
#include "tools/run/separated_text.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::string_view kNotWritten =
    "the interrupted run did not write its candidates: resume it without --candidates";

Json json_of(std::size_t iteration, const Candidate& c, bool is_chosen) {
  Json json = {{"iteration", iteration},      {"x_m", c.view.p_world_m.x()},
               {"y_m", c.view.p_world_m.y()}, {"z_m", c.view.p_world_m.z()},
               {"yaw_rad", c.view.yaw_rad},   {"sampler", traits_of(c.sampler).name},
               {"path_m", c.path_m}};
  if (c.view.gimbal_pitch_rad != 0.0) json["gimbal_pitch_rad"] = c.view.gimbal_pitch_rad;
  if (c.cluster >= 0) {
    json["cluster"] = c.cluster;
  } else {
    json["scale"] = c.scale;
  }
  if (c.rejected) {
    json["rejected"] = name_of(*c.rejected);
    return json;
  }
  json["utility"] = c.score.value;
  json["information"] = c.score.information;
  json["density"] = c.score.density;
  json["prediction"] = c.score.prediction;
  json["distance"] = c.score.distance;
  json["chosen"] = is_chosen;
  return json;
}

std::optional<Rejection> rejection_of(const std::string& name) {
  const auto at = std::find(kRejectionNames.begin(), kRejectionNames.end(), name);
  if (at == kRejectionNames.end()) return std::nullopt;
  return static_cast<Rejection>(at - kRejectionNames.begin());
}

/// Of a candidate that was sampled around one; -1 without. A number that is no int is none at all.
int cluster_of(const Json& json) {
  if (!json.contains("cluster")) return -1;
  const Json& cluster = json.at("cluster");
  if (!cluster.is_number_unsigned() || cluster.get<std::uint64_t>() > 2'147'483'647) {
    throw BadInput("cluster: is no number of one");
  }
  return cluster.get<int>();
}

Candidate candidate_of(const Json& json) {
  const std::string& sampler = json.at("sampler").get_ref<const std::string&>();
  const auto known = sampler_named(sampler);
  if (!known) throw BadInput(fmt::format("sampler: no sampler is named {}", sampler));
  Candidate c{.view = {Vec3(json.at("x_m"), json.at("y_m"), json.at("z_m")), json.at("yaw_rad"),
                       json.value("gimbal_pitch_rad", 0.0)},
              .sampler = *known,
              .scale = json.value("scale", 1.0),
              .cluster = cluster_of(json),
              .path_m = json.at("path_m")};
  if (json.contains("rejected")) {
    c.rejected = rejection_of(json.at("rejected"));
    if (!c.rejected) throw BadInput("rejected: no such reason");
    return c;
  }
  c.score = {.value = json.at("utility"),
             .information = json.at("information"),
             .density = json.at("density"),
             .prediction = json.at("prediction"),
             .distance = json.at("distance")};
  return c;
}

void add_candidate(const Json& json, Plan& plan) {
  if (json.value("chosen", false)) plan.chosen.push_back(plan.candidates.size());
  plan.candidates.push_back(candidate_of(json));
}

/// Lines are told apart by how they begin: a long mission has hundreds of thousands.
std::string beginning_of(std::size_t iteration) {
  return fmt::format("{{\"iteration\":{},", iteration);
}

/// What an interrupted run wrote of the decisions before `iteration`. Throws when it does not reach
/// up to it: then that run did not write them all.
std::string candidates_before(std::size_t iteration, const fs::path& file) {
  const LinesBefore kept = lines_before(iteration, file);
  if (kept.last_iteration + 1 >= iteration) return kept.text;
  const fs::path part = part_of(file);
  if (!fs::exists(part) && !fs::exists(file)) {
    throw BadInput(fmt::format("{}: {}", file.string(), kNotWritten));
  }
  throw BadInput(
      fmt::format("{}: holds no candidates of iteration {}, which was flown: cut off, or {}",
                  (fs::exists(part) ? part : file).string(), kept.last_iteration + 1, kNotWritten));
}

}  // namespace

CandidatesFile::CandidatesFile(const fs::path& folder, std::size_t first_iteration)
    : lines_(folder / kCandidatesFile,
             candidates_before(first_iteration, folder / kCandidatesFile)) {}

void CandidatesFile::write(std::size_t iteration, const Plan& plan) {
  std::string lines;
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    lines += json_of(iteration, plan.candidates[i], plan.is_chosen(i)).dump() += '\n';
  }
  lines_.write(lines);
}

void CandidatesFile::finish() { lines_.finish(); }

std::optional<Plan> read_candidates(const fs::path& run, std::size_t iteration) {
  const fs::path path = run / kCandidatesFile;
  if (!fs::exists(path)) return std::nullopt;
  const std::string text = read_file(path);
  if (text.empty()) return std::nullopt;  // an oracle's mission samples none
  const std::string again = command_to_fly_again(run, "--candidates");
  const std::string beginning = beginning_of(iteration);
  std::string_view rest = text;
  Plan plan;
  for (int line = 1; !rest.empty(); ++line) {
    const std::string_view row = next_part(rest, '\n');
    if (!row.starts_with(beginning)) continue;
    try {
      add_candidate(Json::parse(row), plan);
    } catch (const std::exception& error) {
      throw BadInput(fmt::format("{}: {}; {} writes it anew", to_string(TextPlace{path, line}),
                                 json_reason(error), again));
    }
  }
  if (plan.candidates.empty()) {
    throw BadInput(fmt::format("{}: holds no candidate of iteration {}; {} writes them",
                               path.string(), iteration, again));
  }
  return plan;
}

std::vector<Plan> read_all_candidates(const fs::path& run, std::size_t iterations) {
  const fs::path path = run / kCandidatesFile;
  if (!fs::exists(path)) return {};
  const std::string text = read_file(path);
  std::string_view rest = text;
  std::vector<Plan> plans(iterations);
  for (int line = 1; !rest.empty(); ++line) {
    try {
      const Json json = Json::parse(next_part(rest, '\n'));
      const Json& iteration = json.at("iteration");
      if (!iteration.is_number_unsigned())
        throw BadInput("iteration: not a whole number from 0 on");
      const auto of = iteration.get<std::size_t>();
      if (of < iterations) add_candidate(json, plans[of]);
    } catch (const std::exception& error) {
      throw BadInput(fmt::format("{}: {}; {} writes it anew", to_string(TextPlace{path, line}),
                                 json_reason(error), command_to_fly_again(run, "--candidates")));
    }
  }
  return text.empty() ? std::vector<Plan>{} : plans;
}

}  // namespace gnbv
