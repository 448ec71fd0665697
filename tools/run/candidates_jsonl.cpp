#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run/decision_lines.hpp"
#include "tools/run/mission_result.hpp"
#include "tools/run/run_files.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::string_view kNotWritten =
    "the run did not write its candidates: resume it without --candidates";

constexpr std::array<std::pair<const char*, double Score::*>, 5> kTerms = {
    {{"utility", &Score::value},
     {"information", &Score::information},
     {"density", &Score::density},
     {"prediction", &Score::prediction},
     {"distance", &Score::distance}}};

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
  if (c.covers) json["covers"] = *c.covers;
  if (c.rejected) {
    json["rejected"] = name_of(*c.rejected);
    return json;
  }
  if (!c.covers || is_chosen) {
    for (const auto& [name, term] : kTerms) json[name] = c.score.*term;
  }
  json["chosen"] = is_chosen;
  return json;
}

Rejection rejection_of(const Json& json) {
  const auto at = std::ranges::find(kRejectionNames, json.get_ref<const std::string&>());
  if (at == kRejectionNames.end()) throw BadInput("rejected: no such reason");
  return static_cast<Rejection>(at - kRejectionNames.begin());
}

/// What lines of bursts or of views around clusters have. A number that is no int is none at all.
std::optional<int> count_of(const Json& json, const char* name) {
  if (!json.contains(name)) return std::nullopt;
  const Json& count = json.at(name);
  if (!count.is_number_unsigned() || count.get<std::uint64_t>() > 2'147'483'647) {
    throw BadInput("{}: is no whole number from 0 on", name);
  }
  return count.get<int>();
}

Candidate candidate_of(const Json& json) {
  const std::string& sampler = json.at("sampler").get_ref<const std::string&>();
  const auto known = sampler_named(sampler);
  if (!known) throw BadInput("sampler: no sampler is named {}", sampler);
  Candidate c{.view = {Vec3(json.at("x_m"), json.at("y_m"), json.at("z_m")), json.at("yaw_rad"),
                       json.value("gimbal_pitch_rad", 0.0)},
              .sampler = *known,
              .scale = json.value("scale", 1.0),
              .cluster = count_of(json, "cluster").value_or(-1),
              .path_m = json.at("path_m"),
              .covers = count_of(json, "covers")};
  if (json.contains("rejected")) {
    c.rejected = rejection_of(json.at("rejected"));
    return c;
  }
  if (c.covers && !json.contains("utility")) return c;
  for (const auto& [name, term] : kTerms) c.score.*term = json.at(name);
  return c;
}

void add_candidate(const Json& json, Plan& plan) {
  if (json.value("chosen", false)) plan.chosen.push_back(plan.candidates.size());
  plan.candidates.push_back(candidate_of(json));
}

/// What an interrupted run wrote of the decisions before `iteration`. Throws when it does not reach
/// up to it: then that run did not write them all.
std::string candidates_before(std::size_t iteration, const fs::path& run) {
  const LinesBefore kept = lines_before(iteration, run, kCandidatesFile);
  if (kept.next_iteration >= iteration) return kept.text;
  const auto file = RunFiles(run).find(kCandidatesFile);
  if (!file) throw BadInput("{}: {}", (run / kCandidatesFile).string(), kNotWritten);
  if (read_file(*file).empty()) return "";  // an oracle's mission samples none
  throw BadInput("{}: holds no candidates of iteration {}, which was flown: cut off, or {}",
                 file->string(), kept.next_iteration, kNotWritten);
}

}  // namespace

CandidatesFile::CandidatesFile(const fs::path& folder, std::size_t first_iteration)
    : DecisionLines(folder / kCandidatesFile, candidates_before(first_iteration, folder)) {}

void CandidatesFile::write(std::size_t iteration, const Plan& plan) {
  std::string lines;
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    lines += json_of(iteration, plan.candidates[i], plan.is_chosen(i)).dump() += '\n';
  }
  write_lines(lines);
}

std::optional<Plan> read_candidates(const fs::path& run, std::size_t iteration) {
  Plan plan;
  // lines are told apart by how they begin: a long mission has hundreds of thousands
  const bool has_lines = read_decision_lines(
      run, kCandidatesFile, iteration + 1, fmt::format("{{\"iteration\":{},", iteration),
      [&](std::size_t, const Json& json, std::string_view) { add_candidate(json, plan); });
  if (!has_lines) return std::nullopt;  // an oracle's mission samples none
  if (plan.candidates.empty()) {
    throw BadInput("{}: holds no candidate of iteration {}; {} writes them",
                   (run / kCandidatesFile).string(), iteration,
                   command_to_fly_again(run, "--candidates"));
  }
  return plan;
}

std::vector<Plan> read_all_candidates(const fs::path& run, std::size_t iterations) {
  std::vector<Plan> plans(iterations);
  const bool has_lines =
      read_decision_lines(run, kCandidatesFile, iterations, "",
                          [&](std::size_t iteration, const Json& json, std::string_view) {
                            add_candidate(json, plans[iteration]);
                          });
  return has_lines ? plans : std::vector<Plan>{};
}

}  // namespace gnbv
