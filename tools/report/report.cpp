#include "tools/report/report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "bench/paper_table.hpp"
#include "sim/core/error.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/report/page_parts.hpp"
#include "tools/report/page_text.hpp"
#include "tools/report/run_json.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;

// Base64 makes four bytes of three: together these stay below 20 MB.
constexpr std::size_t kMaxPoints = 500'000;  // of one run: six bytes each, nine with colours
constexpr std::size_t kAllPoints = 800'000;
constexpr std::size_t kAllFrameBytes = 9'000'000;

RunBudget budget_of(const std::vector<RunRecord>& records) {
  const auto with_frames = static_cast<std::size_t>(
      std::count_if(records.begin(), records.end(),
                    [](const RunRecord& record) { return has_frames(record.folder); }));
  return {.points = std::min(kMaxPoints, kAllPoints / records.size()),
          .frame_bytes = kAllFrameBytes / std::max<std::size_t>(1, with_frames)};
}

/// A table a scenario, of the runs that were scored; of the paper's figures only where the
/// structure is the paper's.
Json tables_json(const std::vector<RunRecord>& records) {
  Json tables = Json::array();
  std::vector<std::string> done;
  for (const RunRecord& first : records) {
    if (!first.figures) continue;
    const std::string group = first.figures->scenario + "\n" + first.figures->structure;
    if (std::find(done.begin(), done.end(), group) != done.end()) continue;
    done.push_back(group);
    std::vector<RunFigures> runs;
    for (const RunRecord& r : records) {
      if (r.figures && r.figures->scenario + "\n" + r.figures->structure == group) {
        runs.push_back(*r.figures);
      }
    }
    const PaperTable* const paper = find_paper_table(first.figures->scenario);
    const std::string title = fmt::format("{}, {}", first.figures->scenario, runs[0].structure);
    const PaperTable none{
        .scenario = first.figures->scenario,
        .source = runs[0].structure == runs[0].scenario ? runs[0].scenario : title,
        .rows = {},
        .profile = {},
        .mesh_sha256 = ""};
    const bool is_papers = paper != nullptr && is_papers_structure(*paper, runs[0].structure);
    tables.push_back(table_json(comparison_table(is_papers ? *paper : none, runs, {})));
  }
  return tables;
}

/// The structures of the runs, each once.
class Structures {
 public:
  explicit Structures(BytePack& bytes) : bytes_(bytes) {}

  /// Number of the run's structure; -1, and a sentence more, when it cannot be had.
  int number_of(const Scenario& scenario, std::vector<std::string>& missing) {
    const MeshFileConfig& file = scenario.structure.file;
    const std::string key =
        fmt::format("{}\n{} {} {} {} {} {} {}", structure_name(scenario.structure), file.scale,
                    file.offset_m.x(), file.offset_m.y(), file.offset_m.z(), file.up_axis,
                    file.unit_m, file.path.empty() ? "built in" : "file");
    const auto known = std::find(keys_.begin(), keys_.end(), key);
    if (known != keys_.end()) return static_cast<int>(known - keys_.begin());
    try {
      std::vector<std::string> told_by_run;  // the mesh's faults were told when it was flown
      json_.push_back(mesh_json(load_structure(scenario, told_by_run), bytes_));
    } catch (const BadInput& error) {
      missing.emplace_back(error.what());
      return -1;
    }
    keys_.push_back(key);
    return static_cast<int>(keys_.size()) - 1;
  }

  const Json& json() const { return json_; }

 private:
  BytePack& bytes_;
  std::vector<std::string> keys_;
  Json json_ = Json::array();
};

std::string title_of(const std::vector<RunRecord>& records) {
  if (records.size() == 1) return run_title(records[0]);
  std::vector<std::string> scenarios;
  for (const RunRecord& r : records) {
    if (std::find(scenarios.begin(), scenarios.end(), r.scenario.name) == scenarios.end()) {
      scenarios.push_back(r.scenario.name);
    }
  }
  return fmt::format("{}: {} runs", fmt::join(scenarios, ", "), records.size());
}

std::string data_element(const std::string& id, const std::string& type, const std::string& text) {
  return fmt::format("<script type=\"{}\" id=\"{}\">{}</script>\n", type, id, text);
}

std::string bytes_element(const std::string& id, const BytePack& bytes) {
  return data_element(id, "application/octet-stream", base64(bytes.bytes()));
}

/// Nothing of the page may load or send anything, and only our own script may run, so that a name
/// which escaped its escaping would still be nothing but text.
std::string policy() {
  return fmt::format(
      "default-src 'none'; script-src {}; style-src {}; img-src data: blob:; base-uri 'none'; "
      "form-action 'none'",
      policy_hash(page_script()), policy_hash(page_style()));
}

}  // namespace

Report make_report(const std::vector<RunRecord>& records, const ReportOptions& options,
                   const ReportProgress& progress) {
  GNBV_CHECK(!records.empty() && records.size() <= kMaxReportRuns, "{} runs", records.size());
  GNBV_CHECK(page_script().find("</script") == std::string_view::npos, "the script ends itself");
  Report report;
  const std::string title = options.title.empty() ? title_of(records) : options.title;
  const std::vector<std::string> labels = run_labels(records);
  const RunBudget budget = budget_of(records);
  BytePack mesh_bytes;
  Structures structures(mesh_bytes);
  Json runs = Json::array();
  std::string data;
  for (std::size_t i = 0; i < records.size(); ++i) {
    PackedRun packed = pack_run(records[i], budget, options.threads, [&](double share) {
      progress((static_cast<double>(i) + share) / static_cast<double>(records.size()));
    });
    const int mesh = structures.number_of(records[i].scenario, packed.missing);
    runs.push_back(run_json(records[i], labels[i], packed, mesh));
    data += bytes_element(fmt::format("run-{}", i), packed.bytes);
    report.missing.insert(report.missing.end(), packed.missing.begin(), packed.missing.end());
  }
  data += bytes_element("meshes", mesh_bytes);
  const Json json = {{"title", title},
                     {"version", GNBV_VERSION},
                     {"tables", tables_json(records)},
                     {"meshes", structures.json()},
                     {"runs", runs}};
  // names may hold anything, also what is no UTF-8
  data += data_element("data", "application/json",
                       script_json(json.dump(-1, ' ', false, Json::error_handler_t::replace)));
  report.html = filled(page_template(), {{"POLICY", policy()},
                                         {"TITLE", html_escaped(title)},
                                         {"STYLE", page_style()},
                                         {"DATA", data},
                                         {"SCRIPT", page_script()}});
  return report;
}

}  // namespace gnbv
