#include "tools/run_files/candidates_jsonl.hpp"

#include <algorithm>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <string>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run_files/file_names.hpp"
#include "tools/run_files/mission_result.hpp"
#include "tools/run_files/run_commands.hpp"
#include "tools/run_files/separated_text.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::string_view kNotWritten =
    "the interrupted run did not write its candidates: resume it without --candidates";

Json json_of(std::size_t iteration, const Candidate& c, bool is_chosen) {
  Json json = {{"iteration", iteration},      {"x_m", c.view.p_world_m.x()},
               {"y_m", c.view.p_world_m.y()}, {"z_m", c.view.p_world_m.z()},
               {"yaw_rad", c.view.yaw_rad},   {"sampler", c.sampler},
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
  for (const Rejection reason :
       {Rejection::out_of_bounds, Rejection::not_free, Rejection::collision,
        Rejection::path_blocked, Rejection::recently_visited, Rejection::cluster_outside_fov,
        Rejection::cluster_hidden, Rejection::sees_no_surface, Rejection::no_fly,
        Rejection::beyond_gimbal}) {
    if (name_of(reason) == name) return reason;
  }
  return std::nullopt;
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
  if (json.value("chosen", false)) plan.chosen = plan.candidates.size();
  plan.candidates.push_back(candidate_of(json));
}

/// Lines are told apart by how they begin: a long mission has hundreds of thousands.
std::string beginning_of(std::size_t iteration) {
  return fmt::format("{{\"iteration\":{},", iteration);
}

/// The whole lines of decisions before `iteration`, as an interrupted run left them. Throws when
/// they do not reach up to it: then that run did not write them all.
std::string lines_before(std::size_t iteration, const fs::path& part) {
  std::string kept;
  std::size_t last = 0;  // the start is no decision
  if (!fs::exists(part)) {
    if (iteration > 1) throw BadInput(fmt::format("{}: {}", part.string(), kNotWritten));
    return kept;
  }
  const std::string content = read_file(part);
  std::string_view rest(content.data(), content.rfind('\n') + 1);  // npos + 1: none
  for (int line = 1; !rest.empty(); ++line) {
    const std::string_view row = next_part(rest, '\n');
    const Json json = Json::parse(row, nullptr, false);
    const bool is_ours =
        json.is_object() && json.contains("iteration") && json["iteration"].is_number_unsigned();
    if (!is_ours) {
      throw BadInput(fmt::format("{}: is no candidate", to_string(TextPlace{part, line})));
    }
    const auto of = json["iteration"].get<std::size_t>();
    if (of >= iteration) continue;
    kept.append(row) += '\n';
    last = std::max(last, of);
  }
  if (last + 1 < iteration) {
    throw BadInput(
        fmt::format("{}: holds no candidates of iteration {}, which was flown: cut off, or {}",
                    part.string(), last + 1, kNotWritten));
  }
  return kept;
}

}  // namespace

CandidatesFile::CandidatesFile(const fs::path& folder, std::size_t first_iteration)
    : path_(folder / kCandidatesFile) {
  const fs::path before = fs::exists(part_of(path_)) ? part_of(path_) : path_;
  write_file_atomically(part_of(path_), lines_before(first_iteration, before));
  part_.open(part_of(path_), std::ios::binary | std::ios::app);
  if (!part_) refuse_to_write(part_of(path_), errno);
}

void CandidatesFile::write(std::size_t iteration, const Plan& plan) {
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    part_ << json_of(iteration, plan.candidates[i], plan.chosen == i).dump() << '\n';
  }
  part_.flush();
  if (!part_) refuse_to_write(part_of(path_), errno);
}

void CandidatesFile::finish() {
  part_.close();
  std::error_code error;
  sync_to_disk(part_of(path_));
  fs::rename(part_of(path_), path_, error);
  if (error) refuse_to_write(path_, error.value());
  sync_to_disk(path_.parent_path());
}

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
