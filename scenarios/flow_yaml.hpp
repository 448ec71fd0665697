// A tree back as text, on one line.
#pragma once

#include <string>

#include "scenarios/document.hpp"

namespace gnbv {

/// The value as YAML in flow style, which parse_override() reads as the same value.
std::string flow_yaml(const YamlNode& node);

/// The value as a message shows it; long ones are cut.
std::string excerpt(const YamlNode& node);

/// The text as a double-quoted scalar.
std::string yaml_in_quotes(const std::string& text);

}  // namespace gnbv
