#include "tools/run_files/candidates_file.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::string_view kName = "candidates.jsonl";
constexpr std::string_view kNotWritten =
    "the interrupted run did not write its candidates: resume it without --candidates";

fs::path part_of(const fs::path& path) { return path.string() + ".part"; }

Json json_of(std::size_t iteration, const Candidate& c, bool is_chosen) {
  Json json = {{"iteration", iteration},      {"x_m", c.view.p_world_m.x()},
               {"y_m", c.view.p_world_m.y()}, {"z_m", c.view.p_world_m.z()},
               {"yaw_rad", c.view.yaw_rad},   {"sampler", c.sampler},
               {"path_m", c.path_m}};
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
  for (std::size_t begin = 0; begin < content.size();) {
    const std::size_t end = content.find('\n', begin);
    if (end == std::string::npos) break;
    const std::string line = content.substr(begin, end - begin + 1);
    begin = end + 1;
    const Json json = Json::parse(line, nullptr, false);
    const bool is_ours =
        json.is_object() && json.contains("iteration") && json["iteration"].is_number_unsigned();
    if (!is_ours)
      throw BadInput(fmt::format("{}: holds a line that is no candidate", part.string()));
    const auto of = json["iteration"].get<std::size_t>();
    if (of >= iteration) continue;
    kept += line;
    last = std::max(last, of);
  }
  if (last + 1 < iteration) throw BadInput(fmt::format("{}: {}", part.string(), kNotWritten));
  return kept;
}

}  // namespace

CandidatesFile::CandidatesFile(const fs::path& folder, std::size_t first_iteration)
    : path_(folder / kName) {
  const fs::path before = fs::exists(part_of(path_)) ? part_of(path_) : path_;
  write_file_atomically(part_of(path_), lines_before(first_iteration, before));
  part_.open(part_of(path_), std::ios::binary | std::ios::app);
  if (!part_) throw BadInput(fmt::format("{}: cannot write", part_of(path_).string()));
}

void CandidatesFile::write(std::size_t iteration, const Plan& plan) {
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    part_ << json_of(iteration, plan.candidates[i], plan.chosen == i).dump() << '\n';
  }
  part_.flush();
  if (!part_) throw BadInput(fmt::format("{}: cannot write", part_of(path_).string()));
}

void CandidatesFile::finish() {
  part_.close();
  std::error_code error;
  fs::rename(part_of(path_), path_, error);
  if (error) throw BadInput(fmt::format("{}: cannot write: {}", path_.string(), error.message()));
}

}  // namespace gnbv
