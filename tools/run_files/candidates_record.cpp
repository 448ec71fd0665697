#include "tools/run_files/candidates_record.hpp"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run_files/run_record.hpp"
#include "tools/run_files/separated_text.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::json;

std::optional<Rejection> rejection_of(const std::string& name) {
  for (const Rejection reason :
       {Rejection::out_of_bounds, Rejection::not_free, Rejection::collision,
        Rejection::path_blocked, Rejection::recently_visited, Rejection::cluster_outside_fov,
        Rejection::cluster_hidden, Rejection::sees_no_surface}) {
    if (name_of(reason) == name) return reason;
  }
  return std::nullopt;
}

/// A name that lives as long as the program, as Candidate::sampler needs it.
std::string_view sampler_of(const std::string& name) {
  for (const std::string_view known : {"agvs", "fvs", "route"}) {
    if (known == name) return known;
  }
  throw BadInput(fmt::format("sampler: no sampler is named {}", name));
}

Candidate candidate_of(const Json& json) {
  Candidate c{.view = {Vec3(json.at("x_m"), json.at("y_m"), json.at("z_m")), json.at("yaw_rad")},
              .sampler = sampler_of(json.at("sampler")),
              .scale = json.value("scale", 1.0),
              .cluster = json.value("cluster", -1),
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

/// Lines are told apart by how they begin: a long mission has hundreds of thousands.
std::string beginning_of(std::size_t iteration) {
  return fmt::format("{{\"iteration\":{},", iteration);
}

}  // namespace

std::optional<Plan> read_candidates(const std::filesystem::path& run, std::size_t iteration) {
  const std::filesystem::path path = run / "candidates.jsonl";
  if (!std::filesystem::exists(path)) return std::nullopt;
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
      const Json json = Json::parse(row);
      if (json.value("chosen", false)) plan.chosen = plan.candidates.size();
      plan.candidates.push_back(candidate_of(json));
    } catch (const std::exception& error) {
      throw BadInput(fmt::format("{}: {}; {} writes it anew", to_string(TextPlace{path, line}),
                                 error.what(), again));
    }
  }
  if (plan.candidates.empty()) {
    throw BadInput(fmt::format("{}: holds no candidate of iteration {}; {} writes them",
                               path.string(), iteration, again));
  }
  return plan;
}

}  // namespace gnbv
