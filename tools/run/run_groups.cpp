#include "tools/run/run_groups.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "planner/guided/utility.hpp"
#include "scenarios/load.hpp"
#include "sim/core/sha256.hpp"
#include "tools/run/run_names.hpp"
#include "tools/run/words.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

using Values = std::vector<std::pair<std::string, std::string>>;

constexpr std::array<std::string_view, 3> kNames = {"name", "planner.utility.name",
                                                    "planner.preset"};
// Of a function of the user's own: FILE.py:FUNCTION, and a hash.
constexpr const char* kFunction = "function";
constexpr const char* kText = "text";

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
  std::erase_if(values, [&](const auto& value) {
    return value.first.starts_with("planner.utility.python.");
  });
  for (auto& [key, value] : values) {
    if (key == kNames[0]) value = scenario_title(scenario);
    if (key == kNames[1]) value = own != nullptr ? utility_label(utility) : human_name(value);
  }
  if (own != nullptr && has_utility) {
    Sha256 hash;
    hash.add(own->source);
    values.emplace_back(kFunction, fmt::format("{}:{}", own->file, own->function));
    values.emplace_back(kText, hash.hex().substr(0, 6));
  }
  return values;
}

std::string value_of(const Values& values, std::string_view key) {
  const auto at = std::find_if(values.begin(), values.end(),
                               [&](const auto& value) { return value.first == key; });
  return at == values.end() ? "" : at->second;
}

bool differ_in(const std::vector<Values>& groups, std::string_view key) {
  return std::any_of(groups.begin(), groups.end(), [&](const Values& values) {
    return value_of(values, key) != value_of(groups.front(), key);
  });
}

/// The keys, names apart, in which any two of the groups differ.
std::vector<std::string> differing_keys(const std::vector<Values>& groups) {
  std::vector<std::string> keys;
  for (const Values& values : groups) {
    for (const auto& [key, value] : values) {
      const bool is_known = key == kFunction ||
                            std::find(keys.begin(), keys.end(), key) != keys.end() ||
                            std::find(kNames.begin(), kNames.end(), key) != kNames.end();
      if (!is_known && differ_in(groups, key)) keys.push_back(key);
    }
  }
  return keys;
}

/// What everybody knows methods by, as far as they differ in it; a function of the user's own as
/// FILE.py:FUNCTION where another one has its name.
std::string names_of(const Values& own, const std::vector<Values>& groups) {
  const std::string function = value_of(own, kFunction);
  const bool has_namesake = std::any_of(groups.begin(), groups.end(), [&](const Values& other) {
    return value_of(other, kNames[1]) == value_of(own, kNames[1]) &&
           value_of(other, kFunction) != function;
  });
  std::vector<std::string> names;
  for (const std::string_view key : kNames) {
    const bool is_file = key == kNames[1] && has_namesake && !function.empty();
    if (is_file || differ_in(groups, key)) names.push_back(is_file ? function : value_of(own, key));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

/// The last part of a key, or all of it where others end alike.
std::string short_key(const std::string& key, const std::vector<std::string>& keys) {
  const auto last = [](const std::string& k) { return k.substr(k.rfind('.') + 1); };
  const auto alike = std::count_if(keys.begin(), keys.end(),
                                   [&](const std::string& k) { return last(k) == last(key); });
  return alike > 1 ? key : last(key);
}

/// By names; those that have them in common by the keys in which they differ, or by their folders
/// where these are too many to read. Nothing for one alone.
std::vector<std::string> labels_of(const std::vector<Values>& groups,
                                   const std::vector<fs::path>& folders) {
  const std::vector<std::string> folder_names = run_names(folders);
  constexpr std::size_t kReadable = 2;
  std::vector<std::string> labels;
  for (const Values& own : groups) {
    const std::string names = names_of(own, groups);
    std::vector<Values> namesakes;
    std::copy_if(groups.begin(), groups.end(), std::back_inserter(namesakes),
                 [&](const Values& other) { return names_of(other, groups) == names; });
    const std::vector<std::string> keys = differing_keys(namesakes);
    std::vector<std::string> words;
    if (!names.empty()) words.push_back(names);
    if (keys.size() > kReadable) words.push_back(folder_names[labels.size()]);
    for (const std::string& key : keys) {
      if (keys.size() > kReadable) break;
      words.push_back(short_key(key, keys) + "=" + value_of(own, key));
    }
    labels.push_back(fmt::format("{}", fmt::join(words, ", ")));
  }
  return labels;
}

/// Different configurations, each with the folder where it was first found.
struct Configurations {
  std::vector<Values> values = {};
  std::vector<fs::path> folders = {};

  /// Its number, from 0 in the order of their first runs.
  std::size_t add(const Values& own, const fs::path& folder) {
    const auto at = std::find(values.begin(), values.end(), own) - values.begin();
    if (at == std::ssize(values)) {
      values.push_back(own);
      folders.push_back(folder);
    }
    return static_cast<std::size_t>(at);
  }
};

/// Without "." and the slash at the end.
fs::path plain(const fs::path& folder) {
  const fs::path normal = folder.lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

/// The shortest ending of `folder` that none of the others has: "plain" of "/tmp/plain" beside
/// "/tmp/kept".
std::string own_ending(const fs::path& folder, std::span<const fs::path> others) {
  const fs::path own = plain(folder);
  fs::path ending;
  for (auto part = own.end(); part != own.begin();) {
    --part;
    ending = ending.empty() ? *part : *part / ending;
    const auto has_it = [&](const fs::path& other) {
      const fs::path theirs = plain(other);
      const auto size = std::distance(ending.begin(), ending.end());
      return std::distance(theirs.begin(), theirs.end()) >= size &&
             std::equal(ending.begin(), ending.end(), std::prev(theirs.end(), size));
    };
    if (std::none_of(others.begin(), others.end(), has_it)) return ending.string();
  }
  return own.string();
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
  Configurations all;
  for (const RunRecord* const run : runs) {
    if (!run->figures || run->figures->curve.coverage.empty()) {
      notes.push_back(
          fmt::format("{}: has no figures: left out of coverage", run->folder.string()));
      continue;
    }
    const std::size_t number = all.add(values_of(*run), run->folder);
    if (number == groups.size()) groups.emplace_back();
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
  const std::vector<std::string> labels = labels_of(all.values, all.folders);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    groups[i].label = labels[i].empty() ? run_title(*groups[i].runs.front()) : labels[i];
  }
  return groups;
}

std::vector<std::string> setting_labels(std::span<const RunGroup> groups) {
  Configurations settings;
  std::vector<std::size_t> numbers;
  for (const RunGroup& group : groups) {
    const RunRecord& run = *group.runs.front();
    numbers.push_back(settings.add(values_of(run, false), run.folder));
  }
  const std::vector<std::string> of_settings = labels_of(settings.values, settings.folders);
  std::vector<std::string> labels;
  for (const std::size_t number : numbers) labels.push_back(of_settings[number]);
  return labels;
}

std::vector<std::string> run_labels(std::span<const RunRecord> runs) {
  std::vector<std::string> labels;
  for (const RunRecord& run : runs) labels.push_back(run_title(run));
  const auto add_where_shared = [&](const auto& word_of) {
    const std::vector<std::string> before = labels;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      std::vector<std::size_t> namesakes;
      for (std::size_t k = 0; k < runs.size(); ++k) {
        if (before[k] == before[i]) namesakes.push_back(k);
      }
      if (namesakes.size() > 1) labels[i] += word_of(i, namesakes);
    }
  };
  add_where_shared([&](std::size_t i, const std::vector<std::size_t>& namesakes) {
    Configurations different;
    for (const std::size_t k : namesakes) different.add(values_of(runs[k]), runs[k].folder);
    const std::size_t own = different.add(values_of(runs[i]), runs[i].folder);
    const std::string label = labels_of(different.values, different.folders)[own];
    return label.empty() ? "" : ", " + label;
  });
  add_where_shared(
      [&](std::size_t i, const auto&) { return fmt::format(", seed {}", runs[i].scenario.seed); });
  add_where_shared([&](std::size_t i, const std::vector<std::size_t>& namesakes) {
    std::vector<fs::path> others;
    for (const std::size_t k : namesakes) {
      if (k != i) others.push_back(runs[k].folder);
    }
    return fmt::format(" ({})", own_ending(runs[i].folder, others));
  });
  return labels;
}

}  // namespace gnbv
