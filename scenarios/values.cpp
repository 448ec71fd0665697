#include "scenarios/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <type_traits>

#include "scenarios/flow_yaml.hpp"

namespace gnbv {
namespace {

using Kind = YamlNode::Kind;

/// The whole text as a number of type T; false otherwise. One leading '+' is allowed, as in YAML.
template <typename T>
std::errc parse_whole(std::string_view text, T& value) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size()) return std::errc::invalid_argument;
  return error;
}

/// A plain text that YAML itself would take for a number, a bool or nothing.
bool is_not_text(const std::string& text) {
  double number = 0.0;
  return text.empty() || text == "true" || text == "false" || text == "~" || text == "null" ||
         parse_whole(text, number) != std::errc::invalid_argument;
}

bool is_word(const std::string& text) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '_' || c == '-';
  };
  return !text.empty() && text[0] != '.' && text[0] != '-' &&
         std::all_of(text.begin(), text.end(), is_plain);
}

std::string expected(const YamlNode& node, std::string_view what) {
  switch (node.kind) {
    case Kind::null:
      return fmt::format("has no value; expects {}", what);
    case Kind::scalar:
      return fmt::format("{}expects {}", node.is_quoted ? "is text in quotes; " : "", what);
    case Kind::list:
      return fmt::format("is a list; expects {}", what);
    default:
      return fmt::format("is a map; expects {}", what);
  }
}

bool is_plain_scalar(const YamlNode& node) { return node.kind == Kind::scalar && !node.is_quoted; }

// Each read_one() returns what is wrong, or nothing.

std::string read_one(const YamlNode& node, const Field& field, double& value) {
  if (!is_plain_scalar(node)) return expected(node, "a number");
  double number = 0.0;
  std::string text = node.text;
  if (text.find_first_of("0123456789") == std::string::npos) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const bool is_special = text.ends_with("nan") || text.ends_with("inf");
    return expected(node, is_special ? "a finite number" : "a number");
  }
  const std::errc error = parse_whole(node.text, number);
  if (error == std::errc::result_out_of_range) return "is beyond what a number can hold";
  if (error != std::errc{}) return expected(node, "a number");
  if (!contains(field.allowed, number)) {
    return fmt::format("is out of range (allowed: {})", text_of(field.allowed));
  }
  value = field.kind == FieldKind::angle ? deg_to_rad(number) : number;
  return "";
}

template <typename Integer>
requires std::is_same_v<Integer, int> || std::is_same_v<Integer, std::uint64_t> std::string
read_one(const YamlNode& node, const Field& field, Integer& value) {
  if (!is_plain_scalar(node)) return expected(node, "a whole number");
  const std::string& text = node.text;
  const std::size_t first_digit = text.find_first_of("0123456789");
  if (first_digit != std::string::npos && first_digit + 1 < text.size() &&
      text[first_digit] == '0' && text.find_first_not_of("+-0123456789") == std::string::npos) {
    return "starts with 0, which some YAML readers take for an octal number; leave the 0 out";
  }
  Integer number = 0;
  const std::errc error = parse_whole(text, number);
  const bool is_negative = std::is_unsigned_v<Integer> && text.starts_with('-');
  if (error == std::errc::invalid_argument && !is_negative) return expected(node, "a whole number");
  if (error != std::errc{} || !contains(field.allowed, static_cast<double>(number))) {
    return std::is_unsigned_v<Integer>
               ? fmt::format("is out of range (allowed: from 0 to {})",
                             std::numeric_limits<Integer>::max())
               : fmt::format("is out of range (allowed: {})", text_of(field.allowed));
  }
  value = number;
  return "";
}

std::string read_one(const YamlNode& node, const Field&, bool& value) {
  if (!is_plain_scalar(node) || (node.text != "true" && node.text != "false")) {
    return expected(node, "true or false");
  }
  value = node.text == "true";
  return "";
}

std::string read_choice(const YamlNode& node, const Field& field, std::string& value) {
  if (node.kind != Kind::scalar) {
    return expected(node, fmt::format("one of: {}", join(field.choices)));
  }
  const auto known = std::find(field.choices.begin(), field.choices.end(), node.text);
  if (known != field.choices.end()) {
    value = node.text;
    return "";
  }
  return fmt::format("is no known name ({}allowed: {})", did_you_mean(node.text, field.choices),
                     join(field.choices));
}

std::string read_text(const YamlNode& node, const Field& field, const std::string& folder,
                      std::string& value) {
  if (field.kind == FieldKind::choice) return read_choice(node, field, value);
  if (node.kind != Kind::scalar) return expected(node, "text");
  if (!node.is_quoted && is_not_text(node.text)) {
    return fmt::format("expects text; to mean the text write \"{}\" with its quotes", node.text);
  }
  if (field.kind == FieldKind::word && !is_word(node.text)) {
    return "expects a name of letters, digits, '.', '_' and '-' that starts with neither '.' nor "
           "'-'";
  }
  value = node.text;
  if (field.kind == FieldKind::path && !value.empty()) {
    value = std::filesystem::absolute(std::filesystem::path(folder) / value)
                .lexically_normal()
                .string();
  }
  return "";
}

std::vector<ValueError> read_vector(const YamlNode& node, const Field& field, Vec3& value) {
  std::vector<ValueError> errors;
  Vec3 read = value;
  const auto component = [&](const YamlNode& item, std::size_t axis) {
    const std::string what = read_one(item, field, read[static_cast<Eigen::Index>(axis)]);
    if (!what.empty()) errors.push_back({&item, what, fmt::format(".{}", axis)});
  };
  if (node.kind == Kind::list && node.items.size() == 3) {
    for (std::size_t i = 0; i < 3; ++i) component(node.items[i], i);
  } else if (node.kind == Kind::list) {
    errors.push_back(
        {&node, fmt::format("has {} items; expects [x, y, z]", node.items.size()), ""});
  } else if (node.kind == Kind::picks) {
    for (const YamlEntry& entry : node.entries) {
      const std::size_t axis = std::string_view("012").find(entry.key);
      if (entry.key.size() == 1 && axis != std::string_view::npos) {
        component(entry.value, axis);
      } else {
        errors.push_back(
            {&entry.value, "is no item of [x, y, z] (allowed: 0 to 2)", '.' + entry.key});
      }
    }
  } else {
    errors.push_back({&node, expected(node, "three numbers, [x, y, z]"), ""});
  }
  if (errors.empty()) value = read;
  return errors;
}

std::vector<ValueError> read_numbers(const YamlNode& node, const Field& field,
                                     std::vector<double>& values) {
  if (node.kind != Kind::list || node.items.empty() || node.items.size() > kMostNumbers) {
    return {{&node, expected(node, fmt::format("a list of 1 to {} numbers", kMostNumbers)), ""}};
  }
  std::vector<ValueError> errors;
  std::vector<double> read;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    double number = 0.0;
    std::string what = read_one(node.items[i], field, number);
    if (what.empty() && std::find(read.begin(), read.end(), number) != read.end()) {
      what = "is there twice";
    }
    if (!what.empty()) errors.push_back({&node.items[i], what, fmt::format(".{}", i)});
    read.push_back(number);
  }
  if (errors.empty()) values = read;
  return errors;
}

std::string number_text(const Field& field, double value) {
  const bool is_angle = field.kind == FieldKind::angle;
  std::string text = fmt::format("{}", is_angle ? degrees_of(written_angle_rad(value)) : value);
  const std::size_t exponent = text.find('e');
  if (exponent != std::string::npos && text.find('.') == std::string::npos) {
    text.insert(exponent, ".0");  // YAML 1.1 takes 1e-06 for text, 1.0e-06 for a number
  }
  return text;
}

/// Plain where every YAML reader sees the same text in it, else in double quotes.
std::string plain_or_quoted(const std::string& text) {
  // yes, no, on and off are bools of YAML 1.1; whatever starts with a digit may become a number
  static constexpr std::array<std::string_view, 10> kBools = {
      "y", "n", "yes", "no", "on", "off", "true", "false", "null", "nan"};
  std::string lower = text;
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const bool is_plain =
      !text.empty() && (std::isalpha(static_cast<unsigned char>(text[0])) != 0 || text[0] == '/') &&
      std::all_of(text.begin(), text.end(), [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' ||
               c == '.' || c == '/';
      });
  if (is_plain && !is_not_text(text) &&
      std::find(kBools.begin(), kBools.end(), lower) == kBools.end()) {
    return text;
  }
  return yaml_in_quotes(text);
}

}  // namespace

double degrees_of(double angle_rad) {
  const double around = rad_to_deg(angle_rad);
  for (int digits = 1; digits <= 15; ++digits) {
    double rounded = 0.0;
    parse_whole(fmt::format("{:.{}g}", around, digits), rounded);
    if (deg_to_rad(rounded) == angle_rad) return rounded;
  }
  double candidate = std::nextafter(std::nextafter(around, -1e300), -1e300);
  for (int i = 0; i < 5; ++i, candidate = std::nextafter(candidate, 1e300)) {
    if (deg_to_rad(candidate) == angle_rad) return candidate;
  }
  return around;
}

double written_angle_rad(double angle_rad) { return deg_to_rad(degrees_of(angle_rad)); }

bool is_same_value(const YamlNode& node, const std::string& text) {
  double a = 0.0;
  double b = 0.0;
  if (node.kind != Kind::scalar) return false;
  return node.text == text || (parse_whole(node.text, a) == std::errc{} &&
                               parse_whole(text, b) == std::errc{} && a == b);
}

std::string yaml_text(const Field& field, const FieldValue& value) {
  return std::visit(
      [&](const auto* v) -> std::string {
        using T = std::remove_cvref_t<decltype(*v)>;
        if constexpr (std::is_same_v<T, double>) {
          return number_text(field, *v);
        } else if constexpr (std::is_same_v<T, Vec3>) {
          return fmt::format("[{}, {}, {}]", number_text(field, v->x()), number_text(field, v->y()),
                             number_text(field, v->z()));
        } else if constexpr (std::is_same_v<T, std::vector<double>>) {
          std::string text;
          for (const double number : *v) {
            text += (text.empty() ? "" : ", ") + number_text(field, number);
          }
          return '[' + text + ']';
        } else if constexpr (std::is_same_v<T, std::string>) {
          const bool is_relative = field.kind == FieldKind::path && !v->empty();
          return plain_or_quoted(
              is_relative ? std::filesystem::absolute(*v).lexically_normal().string() : *v);
        } else {
          return fmt::format("{}", *v);
        }
      },
      value);
}

std::vector<ValueError> read_value(const YamlNode& node, const Field& field,
                                   const std::string& folder, const FieldValue& value) {
  std::string what;
  if (auto* const* vector = std::get_if<Vec3*>(&value)) return read_vector(node, field, **vector);
  if (auto* const* numbers = std::get_if<std::vector<double>*>(&value)) {
    return read_numbers(node, field, **numbers);
  }
  if (auto* const* text = std::get_if<std::string*>(&value)) {
    what = read_text(node, field, folder, **text);
  } else if (auto* const* number = std::get_if<double*>(&value)) {
    what = read_one(node, field, **number);
  } else if (auto* const* integer = std::get_if<int*>(&value)) {
    what = read_one(node, field, **integer);
  } else if (auto* const* count = std::get_if<std::uint64_t*>(&value)) {
    what = read_one(node, field, **count);
  } else {
    what = read_one(node, field, *std::get<bool*>(value));
  }
  if (what.empty()) return {};
  return {{&node, what, ""}};
}

}  // namespace gnbv
