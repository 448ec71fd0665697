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

/// What a node that does not convert is wrong about.
struct ValueFault {
  const YamlNode* node = nullptr;
  std::string what;
  std::string item;  // ".1" when it is one number of three
};

/// Sets the value, or says what is wrong and leaves it alone. Vec3: a list of three, or picks.
/// Relative paths are taken from `folder`.
std::vector<ValueFault> read_value(const YamlNode& node, const Field& field,
                                   const std::string& folder, const FieldValue& value);

}  // namespace gnbv
