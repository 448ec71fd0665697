// Every key of a scenario file, named once: its place, its allowed values and its meaning. Reading,
// writing, the JSON schema and --set are visitors of the same description, so that a new field is
// one line in the fields() of its struct (fields_*.cpp, by room).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "scenarios/scenario.hpp"
#include "sim/core/enum_names.hpp"
#include "sim/core/error.hpp"

namespace gnbv {

/// Allowed numbers. An open end is itself not allowed.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool is_min_open = false;
  bool is_max_open = false;
};
constexpr Range between(double min, double max) { return {min, max, false, false}; }
constexpr Range above_upto(double min, double max) { return {min, max, true, false}; }
constexpr Range inside(double min, double max) { return {min, max, true, true}; }
bool contains(const Range& range, double value);
/// "from 0 to 8", "above 0, up to 8".
std::string text_of(const Range& range);

enum class FieldKind {
  number,
  angle,  // radians in the config, degrees in the file
  integer,
  flag,
  word,   // a name that may become part of a file name: letters, digits, '.', '_', '-'
  text,   // anything, also of several lines
  path,   // relative ones mean: beside the file that names them
  choice  // one of a list of names
};

/// What a field does in the scenario at hand. A section's holds for all in it.
struct FieldUse {
  /// The key because of whose value this one has no effect, with a dot before it when it is of the
  /// same section; empty: it has one.
  std::string_view unused_by;
  bool is_papers_setting = false;  // the paper's figures depend on it, and the paper states it
};

struct Field {
  std::string_view key;
  FieldKind kind = FieldKind::number;
  Range allowed;                              // number, angle (degrees), integer
  std::span<const std::string_view> choices;  // choice
  std::string_view meaning;                   // one line, for the schema
  FieldUse use = {};
};

/// The place of a field's value. Vec3: three numbers or angles, each in Field::allowed; a vector:
/// one to kMostNumbers of them, of which none is there twice.
using FieldValue =
    std::variant<double*, int*, std::uint64_t*, bool*, std::string*, Vec3*, std::vector<double>*>;

constexpr std::size_t kMostNumbers = 16;

/// How many items a list may have.
struct ListSize {
  std::size_t min = 0;
  std::size_t max = 0;
};

/// Walks over the keys of a config in the order of the file. The struct's fields() calls the public
/// functions; a visitor implements the private ones.
class FieldVisitor {
 public:
  FieldVisitor() = default;
  virtual ~FieldVisitor() = default;
  FieldVisitor(const FieldVisitor&) = delete;
  FieldVisitor& operator=(const FieldVisitor&) = delete;

  /// T: double, Vec3 or std::vector<double>.
  template <typename T>
  void number(std::string_view key, T& value, const Range& allowed, std::string_view meaning) {
    visit({key, FieldKind::number, allowed, {}, meaning}, &value);
  }
  /// T: double or Vec3.
  template <typename T>
  void angle(std::string_view key_deg, T& value_rad, const Range& allowed_deg,
             std::string_view meaning) {
    visit({key_deg, FieldKind::angle, allowed_deg, {}, meaning}, &value_rad);
  }
  void integer(std::string_view key, int& value, const Range& allowed, std::string_view meaning) {
    visit({key, FieldKind::integer, allowed, {}, meaning}, &value);
  }
  void integer(std::string_view key, std::uint64_t& value, std::string_view meaning) {
    visit({key, FieldKind::integer, {}, {}, meaning}, &value);
  }
  void flag(std::string_view key, bool& value, std::string_view meaning) {
    visit({key, FieldKind::flag, {}, {}, meaning}, &value);
  }
  void word(std::string_view key, std::string& value, std::string_view meaning) {
    visit({key, FieldKind::word, {}, {}, meaning}, &value);
  }
  void text(std::string_view key, std::string& value, std::string_view meaning) {
    visit({key, FieldKind::text, {}, {}, meaning}, &value);
  }
  void path(std::string_view key, std::string& value, std::string_view meaning) {
    visit({key, FieldKind::path, {}, {}, meaning}, &value);
  }
  void choice(std::string_view key, std::string& value, std::span<const std::string_view> choices,
              std::string_view meaning) {
    visit({key, FieldKind::choice, {}, choices, meaning}, &value);
  }
  template <typename Enum, std::size_t count>
  void choice(std::string_view key, Enum& value, const EnumNames<Enum, count>& names,
              std::string_view meaning);

  /// An angle, or a section in its place: whichever the file gives, or the config holds.
  template <typename Config>
  void angle_or_section(std::string_view key_deg, double& value_rad, const Range& allowed_deg,
                        std::optional<Config>& config, std::string_view meaning,
                        std::string_view section_meaning);

  template <typename Config>
  void section(std::string_view key, Config& config, std::string_view meaning) {
    const FieldUse above = enter();
    begin_section(key, meaning);
    fields(*this, config);
    end_section();
    use_ = next_ = above;
  }
  /// A list of the user's own length: one given anew replaces the old one, its items at defaults.
  template <typename Config>
  void list(std::string_view key, std::vector<Config>& items, const ListSize& allowed,
            std::string_view meaning) {
    const FieldUse above = enter();
    const std::optional<std::size_t> given = begin_list(key, items.size(), allowed, meaning);
    if (given) items.assign(*given, Config{});
    for (std::size_t i = 0; i < items.size(); ++i) {
      begin_item(i);
      fields(*this, items[i]);
      end_item();
    }
    end_list();
    use_ = next_ = above;
  }

  /// The field, section or list that comes next has an effect only if this holds; FieldUse.
  FieldVisitor& only_if(bool has_effect, std::string_view unused_by) {
    if (!has_effect && next_.unused_by.empty()) next_.unused_by = unused_by;
    return *this;
  }
  /// The same by the scenario as a whole, where the visitor asks for it.
  FieldVisitor& only_if(bool (*has_effect)(const Scenario&), std::string_view unused_by) {
    return only_if(whole_ == nullptr || has_effect(*whole_), unused_by);
  }
  /// What comes next belongs to the paper's setting; FieldUse.
  FieldVisitor& in_papers_setting() {
    next_.is_papers_setting = true;
    return *this;
  }
  /// Called first by the fields() of a scenario.
  void begin_whole(const Scenario& scenario) { whole_ = asks_for_use_ ? &scenario : nullptr; }

 protected:
  enum class Form { leaf, section, both };
  bool asks_for_use_ = false;  // of Field::use, whose conditions take their time

 private:
  /// Which of the two the visitor looks at; both: one after the other.
  virtual Form form_of(std::string_view, bool holds_section) {
    return holds_section ? Form::section : Form::leaf;
  }
  virtual void leaf(const Field& field, const FieldValue& value) = 0;
  virtual void begin_section(std::string_view key, std::string_view meaning) = 0;
  virtual void end_section() = 0;
  /// The number of items to visit, if a new list is given.
  virtual std::optional<std::size_t> begin_list(std::string_view key, std::size_t size,
                                                const ListSize& allowed,
                                                std::string_view meaning) = 0;
  virtual void end_list() = 0;
  virtual void begin_item(std::size_t index) = 0;
  virtual void end_item() = 0;

  void visit(Field field, const FieldValue& value) {
    field.use = std::exchange(next_, use_);
    leaf(field, value);
  }
  /// Of a section or list: what only_if() and in_papers_setting() said holds for all in it.
  FieldUse enter() { return std::exchange(use_, next_); }

  FieldUse use_;   // of the section at hand
  FieldUse next_;  // of what comes next in it
  const Scenario* whole_ = nullptr;
};

// fields_sim.cpp
void fields(FieldVisitor& v, MeshFileConfig& c);
void fields(FieldVisitor& v, RotorMount& c);
void fields(FieldVisitor& v, AirframeParameters& c);
void fields(FieldVisitor& v, AutopilotParameters& c);
void fields(FieldVisitor& v, PowerParameters& c);
void fields(FieldVisitor& v, GnssOutage& c);
void fields(FieldVisitor& v, EstimateConfig& c);
void fields(FieldVisitor& v, VehicleConfig& c);
void fields(FieldVisitor& v, GuidanceConfig& c);
void fields(FieldVisitor& v, WindConfig& c);
// fields_sensors.cpp
void fields(FieldVisitor& v, DepthNoiseConfig& c);
void fields(FieldVisitor& v, GimbalConfig& c);
void fields(FieldVisitor& v, CameraConfig& c);
void fields(FieldVisitor& v, LidarConfig& c);
// fields_planner.cpp
void fields(FieldVisitor& v, OccupancyConfig& c);
void fields(FieldVisitor& v, CloudConfig& c);
void fields(FieldVisitor& v, ProfilingConfig& c);
void fields(FieldVisitor& v, AgvsConfig& c);
void fields(FieldVisitor& v, FrontierConfig& c);
void fields(FieldVisitor& v, FvsConfig& c);
void fields(FieldVisitor& v, PathSearchConfig& c);
void fields(FieldVisitor& v, ValidityConfig& c);
void fields(FieldVisitor& v, VolumeWeights& c);
void fields(FieldVisitor& v, ShadowConfig& c);
void fields(FieldVisitor& v, UtilityConfig& c);
void fields(FieldVisitor& v, ViewPose& c);
void fields(FieldVisitor& v, RouteConfig& c);
void fields(FieldVisitor& v, TourConfig& c);
void fields(FieldVisitor& v, SymmetryConfig& c);
void fields(FieldVisitor& v, TerminationConfig& c);
void fields(FieldVisitor& v, PlannerConfig& c);
// fields_scenario.cpp
void fields(FieldVisitor& v, Box3& c);
void fields(FieldVisitor& v, StructureConfig& c);
void fields(FieldVisitor& v, ObstacleConfig& c);
void fields(FieldVisitor& v, NoFlyConfig& c);
void fields(FieldVisitor& v, ScoreConfig& c);
void fields(FieldVisitor& v, StartConfig& c);
void fields(FieldVisitor& v, BenchmarkConfig& c);
void fields(FieldVisitor& v, Scenario& c);

template <typename Config>
void FieldVisitor::angle_or_section(std::string_view key_deg, double& value_rad,
                                    const Range& allowed_deg, std::optional<Config>& config,
                                    std::string_view meaning, std::string_view section_meaning) {
  const Form form = form_of(key_deg, config.has_value());
  if (form != Form::section) angle(key_deg, value_rad, allowed_deg, meaning);
  if (form == Form::leaf) return config.reset();
  if (!config) config.emplace();
  section(key_deg, *config, section_meaning);
}

template <typename Enum, std::size_t count>
void FieldVisitor::choice(std::string_view key, Enum& value, const EnumNames<Enum, count>& names,
                          std::string_view meaning) {
  std::array<std::string_view, count> choices;
  for (std::size_t i = 0; i < count; ++i) choices[i] = names[i].name;
  std::string name(name_of(value, names));
  choice(key, name, choices, meaning);
  value = *value_of(name, names);
}

}  // namespace gnbv
