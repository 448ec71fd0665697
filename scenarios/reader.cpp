#include "scenarios/reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenarios/load.hpp"
#include "scenarios/values.hpp"

namespace gnbv {
namespace {

using Kind = YamlNode::Kind;

class Reader final : public FieldVisitor {
 public:
  Reader(const YamlNode& root, const std::string& folder, const Scenario& scenario,
         ValidationErrors& errors, SourceLocations& locations)
      : folder_(folder), scenario_(scenario), errors_(errors), locations_(locations) {
    levels_.push_back({&root, root.location, {}});
    require_map(kRoot);
  }

  /// Call last. The removed keys that were given, each at its former default.
  std::vector<std::string> finish() {
    end(kRoot);
    return std::move(removed_keys_);
  }

  void leaf(const Field& field, const FieldValue& value) override {
    write_angles_once(field, value);
    const YamlEntry* entry = take(field.key);
    if (entry == nullptr) return;
    auto* const* const text = std::get_if<std::string*>(&value);
    const std::string before = text != nullptr ? **text : "";
    const auto errors = read_value(entry->value, field, folder_, value);
    for (const ValueError& error : errors) {
      const bool has_line = error.node->kind != Kind::null;  // a missing value has none
      errors_.add(has_line ? error.node->location : entry->location, field.path + error.item,
                  excerpt(*error.node), error.what);
    }
    if (errors.empty()) locations_[field.path] = entry->location;
    if (text == nullptr || **text == before || **text == "own") return;
    std::erase_if(locations_, [&](const auto& known) {  // another preset's values now
      return known.first != field.path && preset_over(known.first) == field.path;
    });
  }

  void refuse(std::string_view key, const std::string& path, const std::string& what) override {
    const YamlEntry* entry = entry_of(key);
    errors_.add(entry != nullptr ? entry->location : levels_.back().location, path,
                entry != nullptr ? excerpt(entry->value) : "", what);
  }

  Form form_of(std::string_view key, bool holds_section) override {
    const YamlEntry* entry = entry_of(key);
    if (entry == nullptr) return FieldVisitor::form_of(key, holds_section);
    const bool is_map = entry->value.kind == Kind::map || entry->value.kind == Kind::picks;
    return is_map ? Form::section : Form::leaf;
  }

  std::optional<std::size_t> begin(const Group& group) override {
    const Level& above = levels_.back();
    Level level;
    const bool is_new =
        group.kind == Group::Kind::item && above.node != nullptr && above.node->kind == Kind::list;
    if (is_new) {
      level.node = &above.node->items[std::stoul(group.key)];
      level.location = locations_[group.path] = level.node->location;
    } else if (const YamlEntry* entry = take(group.key)) {
      level.node = &entry->value;
      level.location = entry->location;
    }
    levels_.push_back(std::move(level));
    if (group.kind == Group::Kind::list) return new_items(group);
    require_map(group);
    return std::nullopt;
  }

  /// Refuses what was not taken: it is no key, or none any more, or no item.
  void end(const Group& group) override {
    const Level level = std::move(levels_.back());
    levels_.pop_back();
    if (level.node == nullptr) return;
    for (const YamlEntry& entry : level.node->entries) {
      if (std::ranges::find(level.known, entry.key) != level.known.end()) continue;
      const std::string path = group.path.empty() ? entry.key : group.path + '.' + entry.key;
      if (group.kind != Group::Kind::list) {
        refuse_or_pass_over(entry, path, group.path, level.known);
      } else if (group.size == 0) {
        errors_.add(entry.location, path, "", "the list is empty");
      } else {
        errors_.add(entry.location, path, "",
                    fmt::format("is no item of the list (allowed: 0 to {})", group.size - 1));
      }
    }
  }

 private:
  /// What the tree says of a section, list or item. `node` is null where it names nothing.
  struct Level {
    const YamlNode* node = nullptr;
    SourceLocation location;         // of the key
    std::vector<std::string> known;  // keys, or indices
  };

  const YamlEntry* entry_of(std::string_view key) const {
    const Level& level = levels_.back();
    if (level.node == nullptr) return nullptr;
    const auto entry = std::ranges::find(level.node->entries, key, &YamlEntry::key);
    return entry == level.node->entries.end() ? nullptr : &*entry;
  }
  /// The key's entry at this level, noting that the key is known.
  const YamlEntry* take(std::string_view key) {
    levels_.back().known.emplace_back(key);
    return entry_of(key);
  }

  std::optional<std::size_t> new_items(const Group& list) {
    const Level& level = levels_.back();
    if (level.node == nullptr || level.node->kind == Kind::picks) return std::nullopt;
    const std::size_t given = level.node->items.size();
    if (level.node->kind != Kind::list) {
      const bool is_null = level.node->kind == Kind::null;
      drop(list, fmt::format("expects a list{}", is_null ? ", but has no value" : ""));
    } else if (!contains(list.allowed, static_cast<double>(given))) {
      drop(list, fmt::format("has {} items (allowed: from {} to {})", given, list.allowed.min,
                             list.allowed.max));
    } else {  // the new list knows nothing of where the old one's values came from
      std::erase_if(locations_,
                    [&](const auto& known) { return is_at_or_below(known.first, list.path); });
      locations_[list.path] = level.location;
      return given;
    }
    return std::nullopt;
  }

  /// Drops a node that is no map, with an error.
  void require_map(const Group& group) {
    const YamlNode* node = levels_.back().node;
    if (node == nullptr || node->kind == Kind::map || node->kind == Kind::picks) return;
    drop(group, node->kind == Kind::null ? "has no value; expects a map of keys"
                                         : "expects a map of keys");
  }
  void drop(const Group& group, const std::string& what) {
    Level& level = levels_.back();
    errors_.add(level.location, group.path, excerpt(*level.node), what);
    level.node = nullptr;
  }

  void refuse_or_pass_over(const YamlEntry& entry, const std::string& path,
                           const std::string& above, const std::vector<std::string>& known) {
    if (const auto former = former_default(path, scenario_)) {
      if (is_same_value(entry.value, *former)) return removed_keys_.push_back(path);
      errors_.add(entry.location, path, excerpt(entry.value),
                  fmt::format("the key was removed after version 0.1; only its former default, {}, "
                              "is still read",
                              *former));
    } else if (holds_removed_keys(path) && !entry.value.entries.empty()) {
      for (const YamlEntry& below : entry.value.entries) {
        refuse_or_pass_over(below, path + '.' + below.key, path, known);
      }
    } else {  // the key is wrong, whatever its value
      errors_.add(entry.location, path, "",
                  fmt::format("is no known key ({})", hint(entry.key, above, known)));
    }
  }

  static std::string hint(const std::string& key, const std::string& above,
                          const std::vector<std::string>& known) {
    if (key.find('.') != key.npos) return "--set alone joins keys by dots: nest them in the file";
    const std::vector<std::string_view> names(known.begin(), known.end());
    const auto meant = [](const std::string& path) {
      return fmt::format("did you mean '{}'?", path);
    };
    const auto meant_here = [&](std::string_view name) {
      return meant(above.empty() ? std::string(name) : fmt::format("{}.{}", above, name));
    };
    const auto near = nearest_name(key, names);
    if (near && edit_distance(key, *near) <= 2) return meant_here(*near);
    const auto lacks_its_unit = [&](std::string_view name) { return name.starts_with(key + '_'); };
    if (std::ranges::count_if(names, lacks_its_unit) == 1) {
      return meant_here(*std::ranges::find_if(names, lacks_its_unit));
    }
    Scenario one_camera;
    one_camera.cameras.resize(1);
    for (const auto& [path, text] : scenario_values(one_camera)) {  // in another section
      const std::size_t at = fmt::format(".{}.", path).find(fmt::format(".{}.", key));
      if (at != std::string::npos) return meant(path.substr(0, at + key.size()));
    }
    return near ? meant_here(*near) : fmt::format("known here: {}", join(names));
  }

  static void write_angles_once(const Field& field, const FieldValue& value) {
    if (field.kind != FieldKind::angle) return;
    if (auto* const* angle = std::get_if<double*>(&value)) **angle = written_angle_rad(**angle);
    if (auto* const* vector = std::get_if<Vec3*>(&value)) {
      for (double& component : **vector) component = written_angle_rad(component);
    }
  }

  static inline const Group kRoot = {};
  const std::string& folder_;
  const Scenario& scenario_;
  ValidationErrors& errors_;
  SourceLocations& locations_;
  std::vector<std::string> removed_keys_;
  std::vector<Level> levels_;
};

}  // namespace

std::string preset_over(std::string_view path) {
  const auto upto_dot = [&](std::size_t from) {
    return std::min(path.find('.', from), path.size());
  };
  const auto is_one_of = [](std::string_view key, std::initializer_list<std::string_view> keys) {
    return std::ranges::find(keys, key) != keys.end();
  };
  std::size_t end = upto_dot(0);
  const std::string_view section = path.substr(0, end);
  const bool is_sensor = is_one_of(section, {"cameras", "lidars"});
  if (is_sensor && end < path.size()) end = upto_dot(end + 1);  // with the index
  if (end == path.size()) return "";
  const std::string_view key = path.substr(end + 1, upto_dot(end + 1) - end - 1);
  const bool is_set =
      section == "vehicle" || (section == "start" && is_one_of(key, {"position_m", "yaw_deg"})) ||
      (is_sensor && !is_one_of(key, {"name", "p_body_m", "roll_deg", "pitch_deg", "yaw_deg"}));
  return is_set ? std::string(path.substr(0, end)) + ".preset" : "";
}

std::vector<std::string> read_scenario(const YamlNode& root, const std::string& folder,
                                       Scenario& scenario, ValidationErrors& errors,
                                       SourceLocations& locations) {
  Reader reader(root, folder, scenario, errors, locations);
  fields(Keys(reader), scenario);
  return reader.finish();
}

}  // namespace gnbv
