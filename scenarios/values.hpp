// One value between its text and its type, exactly: nothing is rounded, widened or guessed.
#pragma once

#include <string>
#include <vector>

#include "scenarios/document.hpp"
#include "scenarios/fields.hpp"

namespace gnbv {

/// Degrees that deg_to_rad() turns into `angle_rad`, in the fewest digits. Some angles lie between
/// two such degrees; they get one of the neighbours.
double degrees_of(double angle_rad);
/// The angle that is read back when this one is written: itself, or its neighbour of degrees_of().
double written_angle_rad(double angle_rad);

/// The value as YAML, in the fewest digits that read back exactly; relative paths made absolute.
std::string yaml_text(const Field& field, const FieldValue& value);

/// Why a node does not convert.
struct ValueError {
  const YamlNode* node = nullptr;
  std::string what;
  std::string item;  // ".1" when it is one number of three
};

/// Whether the node is a scalar that says the same as the text: equal numbers, or equal letters.
bool is_same_value(const YamlNode& node, const std::string& text);

/// Sets the value, or says what is wrong and leaves it alone. Vec3: a list of three, or picks.
/// Relative paths are taken from `folder`.
std::vector<ValueError> read_value(const YamlNode& node, const Field& field,
                                   const std::string& folder, const FieldValue& value);

}  // namespace gnbv
