#include "tools/figures/groups.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <unordered_map>

#include "planner/guided/utility.hpp"
#include "scenarios/load.hpp"
#include "sim/core/sha256.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

using Values = std::vector<std::pair<std::string, std::string>>;

constexpr std::array<std::string_view, 3> kNames = {"name", "planner.utility.name",
                                                    "planner.preset"};

// Of a function of the user's own: FILE.py:FUNCTION, and a hash.
constexpr std::string_view kFunction = "function";
constexpr std::string_view kText = "text";

/// All but the seed, and the utility's name unless asked for; the scenario by its title. A function
/// of the user's own is known by its label, its file and a hash of its text, and the views that it
/// gave are its answers, not its settings.
Values values_of(const RunRecord& run, bool has_utility = true) {
  Scenario scenario = run.scenario;
  scenario.seed = 0;
  const UtilityConfig utility = scenario.planner.utility;
  const UserFunctionConfig* const own = user_function(utility);
  if (own != nullptr) scenario.planner.routes.views.clear();
  if (!has_utility) scenario.planner.utility.name.clear();
  Values values = scenario_values(scenario);
  std::erase_if(
      values, [](const auto& value) { return value.first.starts_with("planner.utility.python."); });
  for (auto& [key, value] : values) {
    if (key == kNames[0]) value = scenario_title(scenario);
    if (key == kNames[1] && has_utility) value = utility_title(utility);
  }
  if (own != nullptr && has_utility) {
    constexpr std::size_t kDigits = 6;
    values.emplace_back(kFunction, fmt::format("{}:{}", own->file, own->function));
    values.emplace_back(kText, sha256_of(own->source).substr(0, kDigits));
  }
  return values;
}

using Members = std::vector<const Values*>;

/// The keys in which any two of them differ, in the order in which they are written.
std::vector<std::string_view> differing_keys(const Members& members) {
  struct Use {
    std::string_view first;
    std::size_t same = 0;  // members that have the first one's value
  };
  std::vector<std::string_view> keys;
  std::unordered_map<std::string_view, Use> uses;
  for (const Values* const values : members) {
    for (const auto& [key, value] : *values) {
      const auto [use, is_new] = uses.try_emplace(key, Use{.first = value});
      if (is_new) keys.push_back(key);
      use->second.same += use->second.first == value ? 1 : 0;
    }
  }
  std::erase_if(keys, [&](std::string_view key) { return uses[key].same == members.size(); });
  return keys;
}

std::string value_of(const Values& values, std::string_view key) {
  const auto at = std::find_if(values.begin(), values.end(),
                               [&](const auto& value) { return value.first == key; });
  return at == values.end() ? "" : at->second;
}

bool is_name(std::string_view key) {
  return std::find(kNames.begin(), kNames.end(), key) != kNames.end();
}

/// The last part of a key, or all of it where others end alike.
std::string_view short_key(std::string_view key, const std::vector<std::string_view>& keys) {
  const auto last = [](std::string_view k) { return k.substr(k.rfind('.') + 1); };
  const auto alike = std::count_if(keys.begin(), keys.end(),
                                   [&](std::string_view k) { return last(k) == last(key); });
  return alike > 1 ? key : last(key);
}

/// Different configurations, each with the folder where it was first found.
struct Configurations {
  std::vector<Values> values = {};
  std::vector<fs::path> folders = {};
  std::unordered_map<std::string, std::size_t> numbers = {};

  /// Its number, from 0 in the order of their first runs.
  std::size_t add(Values own, const fs::path& folder) {
    std::string text;
    for (const auto& [key, value] : own) text += key + '=' + value + '\n';
    const auto [at, is_new] = numbers.try_emplace(std::move(text), values.size());
    if (is_new) {
      values.push_back(std::move(own));
      folders.push_back(folder);
    }
    return at->second;
  }
};

using Classes = std::map<std::string, std::vector<std::size_t>>;

/// Which of them are called alike.
Classes classes_of(const std::vector<std::string>& names) {
  Classes classes;
  for (std::size_t i = 0; i < names.size(); ++i) classes[names[i]].push_back(i);
  return classes;
}

/// By names, as far as they differ in them, a function of the user's own as FILE.py:FUNCTION where
/// another one has its name; those that have them in common by the keys in which they differ, or by
/// their folders where these are too many to read. Nothing for one alone.
std::vector<std::string> labels_of(const Configurations& all) {
  constexpr std::size_t kReadable = 2;
  Members everybody;
  for (const Values& values : all.values) everybody.push_back(&values);
  std::vector<std::string_view> name_keys = differing_keys(everybody);
  std::erase_if(name_keys, [](std::string_view key) { return !is_name(key); });
  std::vector<std::string> labels(all.values.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const Values& own = all.values[i];
    const std::string function = value_of(own, kFunction);
    const bool has_namesake =
        !function.empty() &&
        std::any_of(all.values.begin(), all.values.end(), [&](const Values& other) {
          return value_of(other, kNames[1]) == value_of(own, kNames[1]) &&
                 value_of(other, kFunction) != function;
        });
    for (const std::string_view key : kNames) {
      const bool is_file = key == kNames[1] && has_namesake;
      if (!is_file && std::find(name_keys.begin(), name_keys.end(), key) == name_keys.end()) {
        continue;
      }
      labels[i] += (labels[i].empty() ? "" : ", ") + (is_file ? function : value_of(own, key));
    }
  }
  const std::vector<std::string> folder_names = run_names(all.folders);
  for (const auto& [names, numbers] : classes_of(labels)) {
    Members namesakes;
    for (const std::size_t i : numbers) namesakes.push_back(everybody[i]);
    std::vector<std::string_view> keys = differing_keys(namesakes);
    std::erase_if(keys, [](std::string_view key) { return is_name(key) || key == kFunction; });
    for (const std::size_t i : numbers) {
      std::vector<std::string> words;
      if (!names.empty()) words.push_back(names);
      if (keys.size() > kReadable) words.push_back(folder_names[i]);
      for (const std::string_view key : keys) {
        if (keys.size() > kReadable) break;
        words.push_back(fmt::format("{}={}", short_key(key, keys), value_of(all.values[i], key)));
      }
      labels[i] = fmt::format("{}", fmt::join(words, ", "));
    }
  }
  return labels;
}

/// Without "." and the slash at the end.
std::string plain(const fs::path& folder) {
  const fs::path normal = folder.lexically_normal();
  return (normal.has_filename() ? normal : normal.parent_path()).string();
}

/// The shortest ending of `folder` that none of the others has: "plain" of "/tmp/plain" beside
/// "/tmp/kept".
std::string own_ending(const std::string& folder, std::span<const std::string> others) {
  for (std::size_t at = folder.rfind('/'); at != std::string::npos && at > 0;
       at = folder.rfind('/', at - 1)) {
    const std::string ending = folder.substr(at + 1);
    const auto has_it = [&](const std::string& other) {
      return other == ending || other.ends_with("/" + ending);
    };
    if (std::none_of(others.begin(), others.end(), has_it)) return ending;
  }
  return folder;
}

/// Puts words behind the labels that several runs have; `words_of` says which, of the runs of one
/// label.
template <typename WordsOf>
void tell_apart(std::vector<std::string>& labels, const WordsOf& words_of) {
  for (const auto& [label, numbers] : classes_of(labels)) {
    if (numbers.size() < 2) continue;
    const std::vector<std::string> words = words_of(numbers);
    for (std::size_t k = 0; k < numbers.size(); ++k) labels[numbers[k]] += words[k];
  }
}

/// A label for each of some runs, each by a configuration of its own.
template <typename ValuesOf>
std::vector<std::string> labels_by(std::span<const RunRecord* const> runs,
                                   const ValuesOf& values_of_run) {
  Configurations different;
  std::vector<std::size_t> numbers;
  for (const RunRecord* const run : runs) {
    numbers.push_back(different.add(values_of_run(*run), run->folder));
  }
  const std::vector<std::string> of_different = labels_of(different);
  std::vector<std::string> labels;
  for (const std::size_t number : numbers) labels.push_back(of_different[number]);
  return labels;
}

}  // namespace

std::vector<RunGroup> group_runs(std::span<const RunRecord> runs, std::vector<std::string>& notes) {
  std::vector<const RunRecord*> all;
  for (const RunRecord& run : runs) all.push_back(&run);
  return group_runs(all, notes);
}

std::vector<RunGroup> group_runs(std::span<const RunRecord* const> runs,
                                 std::vector<std::string>& notes) {
  std::vector<RunGroup> groups;
  std::vector<std::string> methods;
  Configurations all;
  for (const RunRecord* const run : runs) {
    if (!run->figures || run->figures->curve.coverage.empty()) {
      notes.push_back(
          fmt::format("{}: has no figures: left out of coverage", run->folder.string()));
      continue;
    }
    const std::size_t number = all.add(values_of(*run), run->folder);
    if (number == groups.size()) {
      groups.emplace_back();
      methods.push_back(method_of(*run));
    }
    RunGroup& group = groups[number];
    const auto same = std::find_if(
        group.runs.begin(), group.runs.end(),
        [&](const RunRecord* other) { return other->scenario.seed == run->scenario.seed; });
    if (same != group.runs.end()) {
      notes.push_back(fmt::format("{}: the same mission as {}, counted once", run->folder.string(),
                                  (*same)->folder.string()));
      continue;
    }
    group.runs.push_back(run);
  }
  const std::vector<std::string> labels = labels_of(all);
  const std::vector<SeriesLook> looks = method_looks(methods);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    groups[i].label = labels[i].empty() ? run_title(*groups[i].runs.front()) : labels[i];
    groups[i].look = looks[i];
  }
  return groups;
}

std::vector<std::string> setting_labels(std::span<const RunGroup> groups) {
  std::vector<const RunRecord*> first;
  for (const RunGroup& group : groups) first.push_back(group.runs.front());
  return labels_by(first, [](const RunRecord& run) { return values_of(run, false); });
}

std::vector<std::string> run_labels(std::span<const RunRecord> runs) {
  using Numbers = std::vector<std::size_t>;
  std::vector<std::string> labels;
  for (const RunRecord& run : runs) labels.push_back(run_title(run));
  tell_apart(labels, [&](const Numbers& namesakes) {
    std::vector<const RunRecord*> alike;
    for (const std::size_t i : namesakes) alike.push_back(&runs[i]);
    auto words = labels_by(alike, [](const RunRecord& run) { return values_of(run); });
    for (std::string& word : words) word.insert(0, word.empty() ? "" : ", ");
    return words;
  });
  tell_apart(labels, [&](const Numbers& namesakes) {
    std::vector<std::string> words;
    for (const std::size_t i : namesakes) {
      words.push_back(fmt::format(", seed {}", runs[i].scenario.seed));
    }
    return words;
  });
  tell_apart(labels, [&](const Numbers& namesakes) {
    std::vector<std::string> words;
    for (const std::size_t i : namesakes) {
      std::vector<std::string> others;
      for (const std::size_t k : namesakes) {
        if (k != i) others.push_back(plain(runs[k].folder));
      }
      words.push_back(fmt::format(" ({})", own_ending(plain(runs[i].folder), others)));
    }
    return words;
  });
  return labels;
}

std::vector<std::string> run_names(std::span<const fs::path> folders) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const fs::path& folder : folders) {
    // the end of "x/run/" is an empty name, that of "." is no name; of no path at all, absolute()
    // would throw, and read_run() will say what is wrong
    const fs::path whole = folder.empty() ? folder : fs::absolute(folder) / ".";
    const std::string name = whole.lexically_normal().parent_path().filename();
    std::string free = name;
    for (int i = 2; !taken.insert(free).second; ++i) free = fmt::format("{}-{}", name, i);
    names.push_back(free);
  }
  return names;
}

std::string method_of(const RunRecord& run) {
  const PlannerConfig& planner = run.scenario.planner;
  return planner.preset == "released" ? planner.preset : utility_label(planner.utility);
}

std::string common_scenario(std::span<const RunGroup> groups) {
  const std::string first = scenario_title(groups.front().runs.front()->scenario);
  const bool is_common = std::all_of(groups.begin(), groups.end(), [&](const RunGroup& group) {
    return scenario_title(group.runs.front()->scenario) == first;
  });
  return is_common ? first : "";
}

std::string label_below(std::string_view title, const std::string& label) {
  const std::string said = std::string(title) + ", ";
  return !title.empty() && label.starts_with(said) ? label.substr(said.size()) : label;
}

}  // namespace gnbv
