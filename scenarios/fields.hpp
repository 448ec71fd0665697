// Every key of a scenario file, named once: its place, its allowed values and its meaning. Reading,
// writing, the JSON schema and --set are visitors of this one description. A new field is one line
// in the fields() of its struct (fields_*.cpp, by room).
#pragma once

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeindex>
#include <variant>
#include <vector>

#include "scenarios/scenario.hpp"
#include "sim/core/error.hpp"

namespace gnbv {

/// Allowed numbers. An open end is itself not allowed.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool is_min_open = false;
  bool is_max_open = false;
};
constexpr Range inside(double min, double max) { return {min, max, true, true}; }
constexpr Range positive(double max) { return {0.0, max, true, false}; }
constexpr bool contains(const Range& range, double value) {
  return (range.is_min_open ? value > range.min : value >= range.min) &&
         (range.is_max_open ? value < range.max : value <= range.max);
}

/// What a value of an enumeration is called in the file.
template <typename Enum>
struct Named {
  Enum value;
  std::string_view name;
};

enum class FieldKind {
  plain,
  angle,  // radians in the config, degrees in the file
  word,   // a name that may become part of a file name: kLongestWord letters, digits, '.', '_', '-'
  path    // a relative one begins at the file that names it
};

/// What a field does in the scenario at hand. A section's holds for all in it.
struct FieldUse {
  std::string unused_by;           // the key whose value takes the effect from it; empty: none
  bool is_papers_setting = false;  // the paper's figures depend on it, and the paper states it
};

struct Field {
  std::string_view key;
  std::string path;          // the keys from the root down to this one: "cameras.0.name"
  std::string_view meaning;  // one line, for the schema
  FieldKind kind = FieldKind::plain;
  Range allowed;                              // of numbers; of an angle in degrees
  std::span<const std::string_view> choices;  // all that a name may be; empty: any
  FieldUse use;
};

/// The place of a field's value. Vec3: three numbers or angles, each in Field::allowed. A vector:
/// one to kMostNumbers of them, no two of them equal.
using FieldValue =
    std::variant<double*, int*, std::uint64_t*, bool*, std::string*, Vec3*, std::vector<double>*>;

constexpr std::size_t kMostNumbers = 16;
constexpr std::size_t kLongestWord = 100;  // file systems allow names of 255 bytes

/// A section, a list, or an item of a list.
struct Group {
  enum class Kind { section, list, item };

  Kind kind = Kind::section;
  std::type_index config = typeid(Scenario);  // whose keys they are; of a list, its items'
  std::string key;                            // of an item its index
  std::string path;
  std::string_view meaning;
  std::size_t size = 0;  // list: its items
  Range allowed;         // list: how many items it may have
};

/// Is shown the keys of a config in the order of the file.
class FieldVisitor {
 public:
  /// Which form of an angle_or_section() the visitor is shown; both: one after the other.
  enum class Form { leaf, section, both };

  virtual ~FieldVisitor() = default;
  virtual void leaf(const Field& field, const FieldValue& value) = 0;
  /// Of a list: how many items at their defaults replace those that it has; nothing: none do.
  virtual std::optional<std::size_t> begin(const Group&) { return std::nullopt; }
  virtual void end(const Group&) {}
  /// Of a key that was shown before: what is wrong with its value.
  virtual void refuse(std::string_view /*key*/, const std::string& path, const std::string& what) {
    throw BadInput(path + ": " + what);
  }
  virtual Form form_of(std::string_view /*key*/, bool holds_section) {
    return holds_section ? Form::section : Form::leaf;
  }
};

/// The keys of one section, as its fields() names them to a visitor: key("name", where, what).
class Keys {
 public:
  /// `whole` answers the conditions that ask the whole scenario; without one, they hold.
  explicit Keys(FieldVisitor& visitor, const Scenario* whole = nullptr)
      : visitor_(visitor), whole_(whole) {}

  /// T: double, int, Vec3 or std::vector<double>.
  template <typename T>
  void operator()(std::string_view key, T& value, const Range& allowed,
                  std::string_view meaning) const {
    leaf(key, value, meaning, FieldKind::plain, allowed);
  }
  /// T: double or Vec3.
  template <typename T>
  void angle(std::string_view key_deg, T& value_rad, const Range& allowed_deg,
             std::string_view meaning) const {
    leaf(key_deg, value_rad, meaning, FieldKind::angle, allowed_deg);
  }
  /// T: std::uint64_t, bool, or std::string with any text.
  template <typename T>
  void operator()(std::string_view key, T& value, std::string_view meaning) const {
    leaf(key, value, meaning);
  }
  void word(std::string_view key, std::string& value, std::string_view meaning) const {
    leaf(key, value, meaning, FieldKind::word);
  }
  void path(std::string_view key, std::string& value, std::string_view meaning) const {
    leaf(key, value, meaning, FieldKind::path);
  }
  void operator()(std::string_view key, std::string& value,
                  std::span<const std::string_view> choices, std::string_view meaning) const {
    leaf(key, value, meaning, FieldKind::plain, {}, choices);
  }
  template <typename Enum>
  void operator()(std::string_view key, Enum& value,
                  std::initializer_list<Named<std::type_identity_t<Enum>>> names,
                  std::string_view meaning) const {
    std::vector<std::string_view> choices;
    std::string name;
    for (const Named<Enum>& known : names) {
      choices.push_back(known.name);
      if (known.value == value) name = known.name;
    }
    leaf(key, name, meaning, FieldKind::plain, {}, choices);
    for (const Named<Enum>& known : names) {
      if (known.name == name) value = known.value;
    }
  }

  template <typename Config>
  void section(std::string_view key, Config& config, std::string_view meaning) const {
    enter(Group::Kind::section, std::string(key), config, meaning);
  }
  /// A list of the user's own length: one given anew replaces the old one, its items at defaults.
  template <typename Config>
  void list(std::string_view key, std::vector<Config>& items, const Range& allowed,
            std::string_view meaning) const {
    const std::string path = path_of(key);
    const Group list = {Group::Kind::list, typeid(Config), std::string(key), path,
                        meaning,           items.size(),   allowed};
    if (const auto given = visitor_.begin(list)) items.assign(*given, Config{});
    for (std::size_t i = 0; i < items.size(); ++i) {
      below(path).enter(Group::Kind::item, std::to_string(i), items[i], "One of the list.");
    }
    visitor_.end(list);
  }
  /// An angle, or a section in its place: whichever the file gives, or the config holds.
  template <typename Config>
  void angle_or_section(std::string_view key_deg, double& value_rad, const Range& allowed_deg,
                        std::optional<Config>& config, std::string_view meaning,
                        std::string_view section_meaning) const {
    const FieldVisitor::Form form = visitor_.form_of(key_deg, config.has_value());
    if (form != FieldVisitor::Form::section) angle(key_deg, value_rad, allowed_deg, meaning);
    if (form == FieldVisitor::Form::leaf) return config.reset();
    if (!config) config.emplace();
    section(key_deg, *config, section_meaning);
  }

  void refuse(std::string_view key, const std::string& what) const {
    visitor_.refuse(key, path_of(key), what);
  }

  /// The same keys, with an effect only if this holds. `unused_by` is the key whose value takes it
  /// from them; ".key" is a key of this section.
  Keys only_if(bool has_effect, std::string_view unused_by) const {
    Keys keys = *this;
    if (!has_effect && use_.unused_by.empty()) {
      keys.use_.unused_by =
          unused_by.starts_with('.') ? path_of(unused_by.substr(1)) : std::string(unused_by);
    }
    return keys;
  }
  Keys only_if(bool (*has_effect)(const Scenario&), std::string_view unused_by) const {
    return only_if(whole_ == nullptr || has_effect(*whole_), unused_by);
  }
  /// The same keys, as part of the paper's setting.
  Keys of_papers_setting() const {
    Keys keys = *this;
    keys.use_.is_papers_setting = true;
    return keys;
  }

 private:
  std::string path_of(std::string_view key) const {
    return path_.empty() ? std::string(key) : path_ + '.' + std::string(key);
  }
  template <typename T>
  void leaf(std::string_view key, T& value, std::string_view meaning,
            FieldKind kind = FieldKind::plain, const Range& allowed = {},
            std::span<const std::string_view> choices = {}) const {
    visitor_.leaf({key, path_of(key), meaning, kind, allowed, choices, use_}, &value);
  }
  Keys below(const std::string& path) const {
    Keys keys = *this;
    keys.path_ = path;
    return keys;
  }
  template <typename Config>
  void enter(Group::Kind kind, const std::string& key, Config& config,
             std::string_view meaning) const {
    const Group group = {kind, typeid(Config), key, path_of(key), meaning, 0, {}};
    visitor_.begin(group);
    fields(below(group.path), config);
    visitor_.end(group);
  }

  FieldVisitor& visitor_;
  const Scenario* whole_;
  std::string path_;
  FieldUse use_;
};

// The fields() of these configs are called from other files than their own; Keys finds the rest.
void fields(const Keys& key, Scenario& c);
void fields(const Keys& key, Box3& c);
void fields(const Keys& key, CameraConfig& c);
void fields(const Keys& key, LidarConfig& c);
void fields(const Keys& key, VehicleConfig& c);
void fields(const Keys& key, GuidanceConfig& c);
void fields(const Keys& key, WindConfig& c);
void fields(const Keys& key, PlannerConfig& c);

}  // namespace gnbv
