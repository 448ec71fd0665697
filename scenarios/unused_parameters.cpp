#include "scenarios/unused_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenarios/presets.hpp"
#include "scenarios/write.hpp"

namespace gnbv {
namespace {

using Texts = std::map<std::string, std::string>;

/// By the paths of the keys.
Texts texts_of(const Scenario& scenario) {
  Texts texts;
  for (auto& [path, text] : scenario_values(scenario)) texts.emplace(path, text);
  return texts;
}

/// What a file that names only its presets stands for.
Texts defaults_of(const Scenario& scenario) {
  Scenario plain;
  plain.planner.preset = scenario.planner.preset;
  set_preset_switches(plain.planner);
  plain.vehicle = vehicle_preset(scenario.vehicle.preset);
  return texts_of(plain);
}

/// "planner.fvs.enabled is false", "structure.files is not empty".
std::string state_of(const std::string& key, const Texts& texts) {
  const auto text = texts.lower_bound(key);  // of the key, or of the first item of the list
  if (text == texts.end() || !is_at_or_below(text->first, key)) return key + " is empty";
  if (text->first != key) return key + " is not empty";
  return fmt::format("{} is {}", key, text->second == "\"\"" ? "empty" : text->second);
}

}  // namespace

std::vector<std::string> unused_parameter_notes(const Scenario& scenario,
                                                const SourceLocations& locations) {
  const std::vector<ValueUse> values = value_uses(scenario);
  const auto given = [&](const ValueUse& value) { return locations.find(value.path); };
  const bool is_whole_file = std::all_of(values.begin(), values.end(), [&](const ValueUse& value) {
    return given(value) != locations.end() && given(value)->second.line > 0;
  });
  const Texts texts = texts_of(scenario);
  const Texts defaults = defaults_of(scenario);
  struct Note {
    SourceLocation location;
    std::string sentence;
  };
  std::vector<Note> notes;
  for (const ValueUse& value : values) {
    if (value.unused_by.empty() || given(value) == locations.end()) continue;
    const SourceLocation& location = given(value)->second;
    const auto plain = defaults.find(value.path);
    const bool is_default = plain != defaults.end() && plain->second == value.text;
    if (location.rank == 0 && (is_whole_file || is_default)) continue;
    notes.push_back({location, fmt::format("{} ({}) has no effect: {}", value.path,
                                           text_of(location), state_of(value.unused_by, texts))});
  }
  std::stable_sort(notes.begin(), notes.end(), [](const Note& a, const Note& b) {
    return std::pair(a.location.rank, a.location.line) <
           std::pair(b.location.rank, b.location.line);
  });
  std::vector<std::string> sentences;
  for (Note& note : notes) sentences.push_back(std::move(note.sentence));
  return sentences;
}

}  // namespace gnbv
