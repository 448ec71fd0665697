#include <fmt/format.h>

#include <algorithm>

#include "scenarios/builtin.hpp"
#include "scenarios/load.hpp"
#include "scenarios/reader.hpp"
#include "scenarios/values.hpp"

namespace gnbv {
namespace {

using Texts = std::map<std::string, std::string>;

/// Block style, two spaces a level; vectors on one line.
class YamlWriter final : public FieldVisitor {
 public:
  std::string text;

  void leaf(const Field& field, const FieldValue& value) override {
    line(fmt::format("{}: {}", field.key, yaml_text(field, value)));
  }
  std::optional<std::size_t> begin(const Group& group) override {
    const bool is_list = group.kind == Group::Kind::list;
    if (group.kind == Group::Kind::item) {
      is_first_of_item_ = true;
    } else {
      line(group.key + (is_list && group.size == 0 ? ": []" : ":"));
    }
    depth_ += 1;
    return std::nullopt;
  }
  void end(const Group&) override { depth_ -= 1; }

 private:
  void line(const std::string& content) {
    std::string indent(2 * depth_, ' ');
    if (is_first_of_item_) indent[indent.size() - 2] = '-';
    is_first_of_item_ = false;
    text += indent + content + '\n';
  }

  std::size_t depth_ = 0;
  bool is_first_of_item_ = false;
};

/// Every value as YAML, and what the scenario makes of it.
struct ValueUse {
  std::string path;
  std::string text;
  FieldUse use;
};

class ValueLister final : public FieldVisitor {
 public:
  std::vector<ValueUse> values;

  void leaf(const Field& field, const FieldValue& value) override {
    values.push_back({field.path, yaml_text(field, value), field.use});
  }
};

/// With their uses if those are asked for; they may not be for a scenario of no known planner.
std::vector<ValueUse> listed(Scenario scenario, bool with_uses) {
  ValueLister lister;
  fields(Keys(lister, with_uses ? &scenario : nullptr), scenario);
  return std::move(lister.values);
}

/// What the paper's figures depend on and the paper states, or does not have.
Texts papers_values(const Scenario& scenario) {
  Texts stated;
  for (const ValueUse& value : listed(scenario, true)) {
    if (value.use.is_papers_setting) stated.emplace(value.path, value.text);
  }
  return stated;
}

/// What a file that names only the scenario's presets stands for.
Texts defaults_of(const Scenario& scenario) {
  Scenario plain;
  plain.planner.preset = scenario.planner.preset;
  set_preset_switches(plain.planner);
  set_preset_flight(plain, {});
  plain.vehicle = vehicle_preset(scenario.vehicle.preset);
  const auto values = scenario_values(plain);
  return {values.begin(), values.end()};
}

/// "planner.fvs.enabled is false", "structure.files is not empty".
std::string state_of(const std::string& key, const std::vector<ValueUse>& values) {
  const auto value = std::ranges::find_if(
      values, [&](const ValueUse& each) { return is_at_or_below(each.path, key); });
  if (value == values.end()) return key + " is empty";
  if (value->path != key) return key + " is not empty";
  return fmt::format("{} is {}", key, value->text == "\"\"" ? "empty" : value->text);
}

}  // namespace

std::string to_yaml(const Scenario& scenario) {
  Scenario copy = scenario;  // visitors may write, this one does not
  YamlWriter writer;
  fields(Keys(writer), copy);
  return writer.text;
}

std::string views_override(std::span<const ViewPose> views) {
  std::string text = "planner.routes.views=[";
  for (const ViewPose& view : views) {
    const Vec3& p = view.p_world_m;
    text += fmt::format("{}{{position_m: [{}, {}, {}], yaw_deg: {}, pitch_deg: {}}}",
                        text.back() == '[' ? "" : ", ", p.x(), p.y(), p.z(),
                        degrees_of(view.yaw_rad), degrees_of(view.gimbal_pitch_rad));
  }
  return text + ']';
}

std::vector<std::pair<std::string, std::string>> scenario_values(const Scenario& scenario) {
  std::vector<std::pair<std::string, std::string>> values;
  for (ValueUse& value : listed(scenario, false)) {
    values.emplace_back(std::move(value.path), std::move(value.text));
  }
  return values;
}

Scenario usual_beside(const Scenario& scenario) {
  Scenario usual;
  usual.cameras.resize(scenario.cameras.size());
  usual.lidars.resize(scenario.lidars.size());
  return usual;
}

bool has_papers_setting(const Scenario& scenario) {
  return std::ranges::count(builtin_names("scenarios"), scenario.name) == 1 &&
         papers_values(scenario) == papers_values(load_scenario(scenario.name, {}));
}

std::vector<std::string> unused_parameter_notes(const Scenario& scenario,
                                                const SourceLocations& locations) {
  const std::vector<ValueUse> values = listed(scenario, true);
  const bool is_whole_file = std::ranges::all_of(values, [&](const ValueUse& value) {
    const auto given = locations.find(value.path);
    return given != locations.end() && given->second.line > 0;
  });
  const Texts defaults = defaults_of(scenario);
  std::vector<std::pair<SourceLocation, std::string>> notes;
  for (const auto& [path, text, use] : values) {
    const auto given = locations.find(path);
    if (use.unused_by.empty() || given == locations.end()) continue;
    const auto plain = defaults.find(path);
    const bool is_default = plain != defaults.end() && plain->second == text;
    const SourceLocation& location = given->second;
    if (location.rank == 0 && (is_whole_file || is_default)) continue;
    notes.emplace_back(location, fmt::format("{} ({}) has no effect: {}", path, text_of(location),
                                             state_of(use.unused_by, values)));
  }
  std::ranges::stable_sort(notes, {}, [](const auto& note) { return note.first.order(); });
  std::vector<std::string> sentences;
  for (auto& [location, sentence] : notes) sentences.push_back(std::move(sentence));
  return sentences;
}

}  // namespace gnbv
