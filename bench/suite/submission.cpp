#include "bench/suite/submission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/compare/statistics.hpp"
#include "bench/suite/zip_file.hpp"
#include "sim/core/error.hpp"
#include "sim/core/sha256.hpp"
#include "sim/core/text.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr const char* kSubmissionFile = "submission.json";
constexpr const char* kFormat = "gnbv-bench submission 1";
constexpr const char* kSeal = "sha256";  // of the object without this key
constexpr std::size_t kText_bytes = 4000;

// Each value with its key, for whoever writes it (a const thing) or reads it.

template <typename Figures, typename Field>
void visit_figures(Figures& f, Field&& field) {
  field("task", f.task);
  field("termination", f.termination);
  field("views", f.views);
  field("spent", f.spent);
  field("integral", f.integral);
  field("share", f.share);
  field("coverage", f.coverage);
  field("to_90", f.to_90);
  field("to_95", f.to_95);
  field("plan_s", f.plan_s);
  field("result_sha256", f.result_sha256);
}

template <typename Track, typename Field>
void visit_track(Track& f, Field&& field) {
  field("score", f.score.mean);
  field("score_low", f.score.low);
  field("score_high", f.score.high);
  field("public_score", f.public_score);
  field("held_out_score", f.held_out_score);
  field("coverage", f.coverage.mean);
  field("coverage_low", f.coverage.low);
  field("coverage_high", f.coverage.high);
  field("to_90", f.to_90);
  field("to_95", f.to_95);
  field("plan_s", f.plan_s);
}

template <typename Entry, typename Field>
void visit_words(Entry& entry, Field&& field) {
  field("suite_version", entry.suite_version);
  field("track", entry.track);
  field("track_sha256", entry.track_sha256);
  field("name", entry.name);
  field("kind", entry.kind);
  field("settings", entry.settings);
  field("description", entry.description);
  field("licence", entry.licence);
  field("machine", entry.machine);
  field("program", entry.program);
  field("program_sha256", entry.program_sha256);
}

struct Writer {
  Json json = Json::object();

  void operator()(const char* key, const auto& value) { json[key] = value; }
  void operator()(const char* key, const std::optional<double>& value) {
    json[key] = value ? Json(*value) : Json(nullptr);
  }
  void operator()(const char* key, EntryKind kind) {
    json[key] = kEntryKindNames.at(static_cast<std::size_t>(kind));
  }
};

/// Takes values of an object, each of its type.
struct Reader {
  const Json& json;
  const std::string& place;  // file and member, as faults begin

  const Json& at(const char* key, bool (Json::*is_one)() const noexcept, const char* what) const {
    if (!json.is_object()) throw BadInput("{}: expects an object", place);
    const auto found = json.find(key);
    if (found == json.end()) throw BadInput("{}: {}: is missing", place, key);
    if ((*found.*is_one)()) return *found;
    throw BadInput("{}: {}: expects {}", place, key, what);
  }
  void operator()(const char* key, std::string& value) const {
    value = at(key, &Json::is_string, "a text").get<std::string>();
    need_text(place, key, value);
  }
  void operator()(const char* key, double& value) const {
    value = at(key, &Json::is_number, "a number").get<double>();
  }
  void operator()(const char* key, std::optional<double>& value) const {
    if (json.is_object() && json.contains(key) && json[key].is_null()) return value.reset();
    (*this)(key, value.emplace());
  }
  void operator()(const char* key, std::uint64_t& value) const {
    value = at(key, &Json::is_number_unsigned, "a whole number").get<std::uint64_t>();
  }
  void operator()(const char* key, int& value) const {
    const auto count = at(key, &Json::is_number_unsigned, "a whole number").get<std::uint64_t>();
    if (count > 1'000'000) throw BadInput("{}: {}: is too large", place, key);
    value = static_cast<int>(count);
  }
  void operator()(const char* key, EntryKind& kind) const {
    std::string name;
    (*this)(key, name);
    const auto* const known = std::ranges::find(kEntryKindNames, name);
    if (known == kEntryKindNames.end()) {
      throw BadInput("{}: {}: expects planner or views", place, key);
    }
    kind = static_cast<EntryKind>(known - kEntryKindNames.begin());
  }
  void operator()(const char* key, std::vector<std::string>& texts) const {
    for (const Json& text : at(key, &Json::is_array, "a list of texts")) {
      if (!text.is_string()) throw BadInput("{}: {}: expects a list of texts", place, key);
      need_text(place, key, texts.emplace_back(text.get<std::string>()));
    }
  }
};

/// Of what people say, that it can be read again.
struct TextCheck {
  std::string place;

  void operator()(const char*, const auto&) const {}
  void operator()(const char* key, const std::string& text) const { need_text(place, key, text); }
  void operator()(const char* key, const std::vector<std::string>& texts) const {
    for (const std::string& text : texts) need_text(place, key, text);
  }
};

Json json_of(const Submission& entry) {
  Writer all;
  all("format", kFormat);
  visit_words(entry, all);
  Writer track;
  visit_track(entry.figures, track);
  all("figures", track.json);
  Json missions = Json::array();
  for (const SubmittedMission& mission : entry.missions) {
    Writer one;
    visit_figures(mission.figures, one);
    one("trajectory_sha256", mission.trajectory_sha256);
    one("files", mission.files);
    missions.push_back(std::move(one.json));
  }
  all("missions", missions);
  all(kSeal, sha256_of(all.json.dump()));
  return std::move(all.json);
}

std::string text_of(const Submission& entry) { return json_of(entry).dump(1) + "\n"; }

SubmittedMission mission_of(const Json& json, const std::string& place) {
  SubmittedMission mission;
  const Reader read{json, place};
  visit_figures(mission.figures, read);
  read("trajectory_sha256", mission.trajectory_sha256);
  for (const auto& [name, hash] : read.at("files", &Json::is_object, "an object").items()) {
    if (!hash.is_string()) throw BadInput("{}: files: expects hashes", place);
    need_text(place, "files", name);
    mission.files[name] = hash.get<std::string>();
  }
  return mission;
}

/// All that the text says. The same text comes of it, or it was edited.
Submission entry_of(const std::string& text, const std::string& place) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) throw BadInput("{}: is no JSON", place);
  Submission entry;
  const Reader read{json, place};
  std::string format;
  read("format", format);
  if (format != kFormat) {
    throw BadInput("{}: format: value '{}': expects '{}'", place, format, kFormat);
  }
  visit_words(entry, read);
  const std::string of_figures = place + ": figures";
  visit_track(entry.figures, Reader{read.at("figures", &Json::is_object, "an object"), of_figures});
  for (const Json& mission : read.at("missions", &Json::is_array, "a list")) {
    entry.missions.push_back(
        mission_of(mission, fmt::format("{}: missions.{}", place, entry.missions.size())));
  }
  if (text_of(entry) != text) {
    throw BadInput(
        "{}: is not as `gnbv bench submit` writes it, or was edited: its {} does not fit", place,
        kSeal);
  }
  return entry;
}

/// Every file that it names is there as it says, and nothing else.
void need_records(const Submission& entry, const std::string& place) {
  std::set<std::string> named;
  for (const SubmittedMission& mission : entry.missions) {
    std::set<std::string> needed = {kRecordFile, kPathFile, kCurveFile};
    if (entry.kind == EntryKind::views) needed.insert(kGivenFile);
    for (const auto& [file, hash] : mission.files) {
      const std::string member = member_name(mission.figures.task, file);
      if (needed.erase(file) == 0) {
        throw BadInput("{}: member '{}': is no file of a mission", place, member);
      }
      const auto found = entry.records.find(member);
      if (found == entry.records.end()) {
        throw BadInput("{}: member '{}': is missing", place, member);
      }
      if (sha256_of(found->second) != hash) {
        throw BadInput("{}: member '{}': is damaged or edited: its SHA-256 is another", place,
                       member);
      }
      named.insert(member);
    }
    if (needed.empty()) continue;
    throw BadInput("{}: member '{}': is missing", place,
                   member_name(mission.figures.task, *needed.begin()));
  }
  for (const auto& [member, content] : entry.records) {
    if (named.contains(member)) continue;
    throw BadInput("{}: member '{}': belongs to no submission", place, member);
  }
}

std::optional<double> median_of(const std::vector<SubmittedMission>& missions,
                                std::optional<double> TaskFigures::*effort) {
  std::vector<double> values;
  for (const SubmittedMission& mission : missions) {
    values.push_back((mission.figures.*effort).value_or(std::numeric_limits<double>::infinity()));
  }
  return median_effort(values);
}

/// The figures of the track follow from those of the missions, whoever checks only some of these.
void need_own_figures(const Submission& submission, const Suite& suite) {
  Writer given, said;
  const TrackFigures own = track_figures(suite, submission.missions);
  visit_track(own, given);
  visit_track(submission.figures, said);
  for (const auto& [key, value] : given.json.items()) {
    if (said.json[key] == value) continue;
    throw BadInput("{}: figures.{}: value {}: its missions give {}", submission.file.string(), key,
                   said.json[key].dump(), value.dump());
  }
}

}  // namespace

std::string member_name(const std::string& task, const std::string& file) {
  return fmt::format("missions/{}/{}", task, file);
}

TrackFigures track_figures(const Suite& suite, const std::vector<SubmittedMission>& missions) {
  std::vector<double> shares, coverages, plans;
  std::map<std::string, std::vector<double>> by_set;
  for (const SubmittedMission& mission : missions) {
    const TaskFigures& figures = mission.figures;
    shares.push_back(figures.share);
    coverages.push_back(figures.coverage);
    plans.push_back(figures.plan_s);
    const auto structure = std::ranges::find(suite.structures, figures.task, &SuiteStructure::name);
    GNBV_CHECK(structure != suite.structures.end(), "no task {}", figures.task);
    by_set[structure->set].push_back(figures.share);
  }
  const auto mean_in = [&](const char* set) {
    return by_set.contains(set) ? mean_of(by_set[set]) : 0.0;
  };
  return {.score = bootstrap_mean(shares),
          .coverage = bootstrap_mean(coverages),
          .public_score = mean_in("public"),
          .held_out_score = mean_in("held_out"),
          .to_90 = median_of(missions, &TaskFigures::to_90),
          .to_95 = median_of(missions, &TaskFigures::to_95),
          .plan_s = mean_of(plans)};
}

void need_text(const std::string& place, const std::string& key, const std::string& text) {
  std::string what;
  if (text.size() > kText_bytes) {
    what = fmt::format("is too long: {} bytes, and at most {}", text.size(), kText_bytes);
  } else if (printable(text) != text || (key != "description" && text.find('\n') != text.npos)) {
    what = "expects a line of UTF-8 text";
  } else if (key.ends_with("sha256") &&
             (text.size() != 64 || text.find_first_not_of("0123456789abcdef") != text.npos)) {
    what = "expects 64 hexadecimal digits";
  }
  if (!what.empty()) throw BadInput("{}: {}: {}", place, key, what);
}

void write_submission(Submission submission, const fs::path& zip) {
  visit_words(submission, TextCheck{zip.string()});
  for (SubmittedMission& mission : submission.missions) {
    for (auto& [file, hash] : mission.files) {
      hash = sha256_of(submission.records.at(member_name(mission.figures.task, file)));
    }
  }
  std::map<std::string, std::string> members = submission.records;
  members[kSubmissionFile] = text_of(submission);
  write_zip(zip, members);
}

Submission read_submission(const fs::path& zip) {
  std::map<std::string, std::string> members = read_zip(zip);
  const auto json = members.find(kSubmissionFile);
  if (json == members.end()) {
    throw BadInput("{}: member '{}': is missing: no submission", zip.string(), kSubmissionFile);
  }
  Submission entry = entry_of(json->second, fmt::format("{}: {}", zip.string(), kSubmissionFile));
  members.erase(json);
  entry.file = zip;
  entry.records = std::move(members);
  need_records(entry, zip.string());
  return entry;
}

void need_of_suite(const Submission& submission, const Suite& suite) {
  const std::string place = submission.file.string();
  const std::vector<SuiteTask> tasks = suite.tasks_of(submission.track);
  if (tasks.empty()) {
    throw BadInput("{}: track '{}': is none of the suite; --suite FILE reads another", place,
                   submission.track);
  }
  if (submission.suite_version != suite.version ||
      submission.track_sha256 != track_sha256(suite, submission.track)) {
    throw BadInput(
        "{}: is of another suite than this: track {} of version {} with SHA-256 {}, here version "
        "{} with {}; --suite FILE reads another",
        place, submission.track, submission.suite_version, submission.track_sha256.substr(0, 16),
        suite.version, track_sha256(suite, submission.track).substr(0, 16));
  }
  bool is_whole = submission.missions.size() == tasks.size();
  for (std::size_t i = 0; i < tasks.size() && is_whole; ++i) {
    is_whole = submission.missions[i].figures.task == tasks[i].structure;
  }
  if (!is_whole) {
    throw BadInput("{}: its missions are not the {} tasks of track {} in their order", place,
                   tasks.size(), submission.track);
  }
  need_own_figures(submission, suite);
}

}  // namespace gnbv
