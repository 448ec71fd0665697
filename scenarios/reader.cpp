#include "scenarios/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "scenarios/flow_yaml.hpp"
#include "scenarios/old_keys.hpp"
#include "scenarios/values.hpp"
#include "scenarios/write.hpp"

namespace gnbv {
namespace {

using Kind = YamlNode::Kind;

class Reader final : public FieldVisitor {
 public:
  Reader(const YamlNode& root, const std::string& folder, const Scenario& scenario,
         ValidationErrors& errors, SourceLocations& locations)
      : folder_(folder), scenario_(scenario), errors_(errors), locations_(locations) {
    push("", &root);
    require_map();
  }

  /// Call last. The removed keys that were given, each at its former default.
  std::vector<std::string> finish() {
    pop();
    return std::move(removed_keys_);
  }

 private:
  /// The section, list or item being read. `node` is null where the tree names nothing.
  struct Level {
    const YamlNode* node = nullptr;
    std::string path;
    SourceLocation location;              // of the key
    std::vector<std::string_view> known;  // keys of a section
  };

  void leaf(const Field& field, const FieldValue& value) override {
    write_angles_once(field, value);
    const YamlEntry* entry = take(field.key);
    if (entry == nullptr) return;
    const std::string path = path_of(field.key);
    const auto errors = read_value(entry->value, field, folder_, value);
    for (const ValueError& error : errors) {
      const bool has_line = error.node->kind != Kind::null && error.node->kind != Kind::picks;
      errors_.add(has_line ? error.node->location : entry->location, path + error.item,
                  excerpt(*error.node), error.what);
    }
    if (errors.empty()) locations_[path] = entry->location;
  }

  Form form_of(std::string_view key, bool holds_section) override {
    const YamlEntry* entry = entry_of(key);
    if (entry == nullptr) return holds_section ? Form::section : Form::leaf;
    const bool is_map = entry->value.kind == Kind::map || entry->value.kind == Kind::picks;
    return is_map ? Form::section : Form::leaf;
  }

  void begin_section(std::string_view key, std::string_view) override {
    const YamlEntry* entry = take(key);
    push(path_of(key), entry == nullptr ? nullptr : &entry->value);
    if (entry == nullptr) return;
    levels_.back().location = entry->location;
    require_map();
  }
  void end_section() override { pop(); }

  std::optional<std::size_t> begin_list(std::string_view key, std::size_t size,
                                        const ListSize& allowed, std::string_view) override {
    const YamlEntry* entry = take(key);
    push(path_of(key), entry == nullptr ? nullptr : &entry->value);
    if (entry == nullptr) return std::nullopt;
    levels_.back().location = entry->location;
    const YamlNode& node = entry->value;
    if (node.kind == Kind::picks) {
      check_picks(node, size);
      return std::nullopt;
    }
    const std::size_t given = node.items.size();
    if (node.kind != Kind::list) {
      drop(fmt::format("expects a list{}", node.kind == Kind::null ? ", but has no value" : ""));
    } else if (given < allowed.min || given > allowed.max) {
      drop(fmt::format("has {} items (allowed: {})", given,
                       allowed.min == allowed.max
                           ? fmt::format("{}", allowed.min)
                           : fmt::format("from {} to {}", allowed.min, allowed.max)));
    } else {
      forget(levels_.back().path);
      locations_[levels_.back().path] = entry->location;
      return given;
    }
    return std::nullopt;
  }
  void end_list() override { levels_.pop_back(); }

  void begin_item(std::size_t index) override {
    const Level& list = levels_.back();
    const YamlNode* item = nullptr;
    if (list.node != nullptr && list.node->kind == Kind::picks) {
      item = list.node->find(std::to_string(index));
    } else if (list.node != nullptr) {
      item = &list.node->items[index];
    }
    const bool is_new = item != nullptr && list.node->kind == Kind::list;
    push(fmt::format("{}.{}", list.path, index), item);
    if (is_new) locations_[levels_.back().path] = item->location;
    require_map();
  }
  void end_item() override { pop(); }

  std::string path_of(std::string_view key) const {
    const std::string& above = levels_.back().path;
    return above.empty() ? std::string(key) : fmt::format("{}.{}", above, key);
  }

  /// The key's entry in the current section, noting that the key is known.
  const YamlEntry* take(std::string_view key) {
    levels_.back().known.push_back(key);
    const std::string_view old_name = old_name_of(path_of(key));
    if (!old_name.empty()) levels_.back().known.push_back(old_name);
    return entry_of(key);
  }
  const YamlEntry* entry_of(std::string_view key) const {
    const Level& level = levels_.back();
    if (level.node == nullptr) return nullptr;
    const std::string_view old_name = old_name_of(path_of(key));
    const auto entry =
        std::find_if(level.node->entries.begin(), level.node->entries.end(),
                     [&](const YamlEntry& e) { return e.key == key || e.key == old_name; });
    return entry == level.node->entries.end() ? nullptr : &*entry;
  }

  void push(std::string path, const YamlNode* node) {
    levels_.push_back(
        {node, std::move(path), node == nullptr ? SourceLocation{} : node->location, {}});
  }

  /// Leaves a section, item or the scenario: what was not taken is no key, or no more.
  void pop() {
    const Level level = std::move(levels_.back());
    levels_.pop_back();
    if (level.node == nullptr) return;
    for (const YamlEntry& entry : level.node->entries) {
      if (std::find(level.known.begin(), level.known.end(), entry.key) == level.known.end()) {
        refuse_or_pass_over(entry, level);
      }
    }
  }

  void refuse_or_pass_over(const YamlEntry& entry, const Level& level) {
    const std::string path = level.path.empty() ? entry.key : level.path + '.' + entry.key;
    if (const auto former = former_default(path, scenario_)) {
      if (is_same_value(entry.value, *former)) {
        removed_keys_.push_back(path);
      } else {
        errors_.add(entry.location, path, excerpt(entry.value),
                    fmt::format("the key was removed after version 0.1; only its former default, "
                                "{}, is still read",
                                *former));
      }
    } else if (holds_removed_keys(path) && !entry.value.entries.empty()) {
      for (const YamlEntry& below : entry.value.entries) {
        refuse_or_pass_over(below, {&entry.value, path, entry.location, level.known});
      }
    } else {  // the key is wrong, whatever its value
      errors_.add(entry.location, path, "",
                  fmt::format("is no known key ({})", hint(level, entry.key)));
    }
  }

  static std::string hint(const Level& level, const std::string& key) {
    const std::string above = level.path.empty() ? "" : level.path + '.';
    if (const auto near = nearest_name(key, level.known, 2)) {
      return fmt::format("did you mean '{}{}'?", above, *near);
    }
    const auto lacks_only_its_unit = [&](std::string_view known) {
      return known.starts_with(key + '_');
    };
    if (std::count_if(level.known.begin(), level.known.end(), lacks_only_its_unit) == 1) {
      return fmt::format(
          "did you mean '{}{}'?", above,
          *std::find_if(level.known.begin(), level.known.end(), lacks_only_its_unit));
    }
    Scenario one_camera;
    one_camera.cameras.resize(1);
    for (const auto& [path, text] : scenario_values(one_camera)) {
      const std::size_t at = fmt::format(".{}.", path).find(fmt::format(".{}.", key));
      if (at == std::string::npos) continue;
      return fmt::format("did you mean '{}'?", path.substr(0, at + key.size()));
    }
    if (const auto near = nearest_name(key, level.known, misspelling_limit(key))) {
      return fmt::format("did you mean '{}{}'?", above, *near);
    }
    return fmt::format("known here: {}", join(level.known));
  }

  /// Drops a node that should be a map, with an error.
  void require_map() {
    const YamlNode* node = levels_.back().node;
    if (node == nullptr || node->kind == Kind::map || node->kind == Kind::picks) return;
    drop(node->kind == Kind::null ? "has no value; expects a map of keys"
                                  : "expects a map of keys");
  }

  void drop(const std::string& what) {
    Level& level = levels_.back();
    errors_.add(level.location, level.path, excerpt(*level.node), what);
    level.node = nullptr;
  }

  void check_picks(const YamlNode& node, std::size_t size) {
    for (const YamlEntry& entry : node.entries) {
      std::size_t index = size;
      const char* end = entry.key.data() + entry.key.size();
      const auto [last, error] = std::from_chars(entry.key.data(), end, index);
      const bool is_index =
          error == std::errc{} && last == end && entry.key == std::to_string(index);
      if (is_index && index < size) continue;
      errors_.add(entry.location, path_of(entry.key), "",
                  size == 0 ? "the list is empty"
                            : fmt::format("is no item of the list (allowed: 0 to {})", size - 1));
    }
  }

  /// A new list knows nothing of where the old one's values came from.
  void forget(const std::string& path) {
    std::erase_if(locations_, [&](const auto& known) { return is_at_or_below(known.first, path); });
  }

  static void write_angles_once(const Field& field, const FieldValue& value) {
    if (field.kind != FieldKind::angle) return;
    if (auto* const* angle = std::get_if<double*>(&value)) **angle = written_angle_rad(**angle);
    if (auto* const* vector = std::get_if<Vec3*>(&value)) {
      for (double& component : **vector) component = written_angle_rad(component);
    }
  }

  const std::string& folder_;
  const Scenario& scenario_;
  ValidationErrors& errors_;
  SourceLocations& locations_;
  std::vector<std::string> removed_keys_;
  std::vector<Level> levels_;
};

}  // namespace

std::vector<std::string> read_scenario(const YamlNode& root, const std::string& folder,
                                       Scenario& scenario, ValidationErrors& errors,
                                       SourceLocations& locations) {
  Reader reader(root, folder, scenario, errors, locations);
  fields(reader, scenario);
  return reader.finish();
}

}  // namespace gnbv
