// One value between its text and its type, exactly: nothing is rounded, widened or guessed.
#pragma once

#include <string>
#include <vector>

#include "scenarios/document.hpp"
#include "scenarios/fields.hpp"

namespace gnbv {

/// Degrees that deg_to_rad() turns into `angle_rad`, in the fewest digits. For an angle between two
/// such degrees, one of the two.
double degrees_of(double angle_rad);
/// What is read back when the angle is written: itself, or the neighbour that degrees_of() takes.
double written_angle_rad(double angle_rad);

/// "is out of range (allowed: from 0 to 8)", "... above 0, up to 8", "... above 0, below 8".
std::string out_of_range(const Range& range);

/// The value as YAML, in the fewest digits that read back exactly; relative paths made absolute.
std::string yaml_text(const Field& field, const FieldValue& value);

/// Whether the node is a scalar that says the same as the text: equal numbers, or equal letters.
bool is_same_value(const YamlNode& node, const std::string& text);

/// Why a node does not convert.
struct ValueError {
  const YamlNode* node = nullptr;
  std::string what;
  std::string item = {};  // ".1" when it is one number of several
};

/// Sets the value, or says what is wrong and leaves it alone. Vec3: a list of three, or picks.
/// Relative paths begin at `folder`.
std::vector<ValueError> read_value(const YamlNode& node, const Field& field,
                                   const std::string& folder, const FieldValue& value);

}  // namespace gnbv
