#include "scenarios/values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>

namespace gnbv {
namespace {

using Kind = YamlNode::Kind;

std::string expected(const YamlNode& node, std::string_view what) {
  constexpr std::array<const char*, 5> kIs = {"has no value; ", "", "is a list; ", "is a map; ",
                                              "is a map; "};  // by YamlNode::Kind
  const char* const is = kIs[static_cast<std::size_t>(node.kind)];
  return fmt::format("{}expects {}", node.is_quoted ? "is text in quotes; " : is, what);
}

/// The text as a number of type T. One leading '+' is allowed, as in YAML.
template <typename T>
std::errc parse_whole(std::string_view text, T& value) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return end == text.data() + text.size() ? error : std::errc::invalid_argument;
}

/// Whether YAML takes the plain text for a number, a bool or nothing.
bool is_not_text(const std::string& text) {
  double number = 0.0;
  return text.empty() || text == "true" || text == "false" || text == "~" || text == "null" ||
         parse_whole(text, number) != std::errc::invalid_argument;
}

bool is_word(std::string_view text, std::string_view more = "._-") {
  return std::ranges::all_of(text, [&](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || more.find(c) != more.npos;
  });
}

/// Whether the text is a word for NaN or infinity, as .inf and nan are.
bool is_not_finite(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text.ends_with("nan") || text.ends_with("inf");
}

// Each read_one() sets the value and returns "", or returns what is wrong.

std::string read_one(const YamlNode& node, const Field& field, double& value) {
  double number = 0.0;
  const bool is_plain = node.kind == Kind::scalar && !node.is_quoted;
  const std::errc error = is_plain ? parse_whole(node.text, number) : std::errc::invalid_argument;
  if (error == std::errc::result_out_of_range) return "is beyond what a number can hold";
  if (error != std::errc{} || !std::isfinite(number)) {
    return expected(node, is_plain && is_not_finite(node.text) ? "a finite number" : "a number");
  }
  const bool is_angle = field.kind == FieldKind::angle;
  const double read = is_angle ? deg_to_rad(number) : number;
  // of an angle also what is written of it: the smallest become 0
  if (!contains(field.allowed, number) ||
      (is_angle && !contains(field.allowed, degrees_of(read)))) {
    return out_of_range(field.allowed);
  }
  value = read;
  return "";
}

/// Integer: int, or std::uint64_t with its whole range.
template <typename Integer>
std::string read_one(const YamlNode& node, const Field& field, Integer& value) {
  constexpr bool is_signed = std::is_signed_v<Integer>;
  const std::string& text = node.text;
  const std::size_t digit = text.find_first_of("0123456789");
  if (node.kind != Kind::scalar || node.is_quoted) return expected(node, "a whole number");
  if (digit != text.npos && digit + 1 < text.size() && text[digit] == '0' &&
      text.find_first_not_of("+-0123456789") == text.npos) {
    return "starts with 0, which some YAML readers take for an octal number; leave the 0 out";
  }
  Integer number = 0;
  std::errc error = parse_whole(text, number);
  if (!is_signed && text.starts_with('-')) error = std::errc::result_out_of_range;
  if (error == std::errc::invalid_argument) return expected(node, "a whole number");
  if (error != std::errc{} || !contains(field.allowed, static_cast<double>(number))) {
    return is_signed ? out_of_range(field.allowed)
                     : fmt::format("is out of range (allowed: from 0 to {})", ~std::uint64_t{0});
  }
  value = number;
  return "";
}

std::string read_one(const YamlNode& node, const Field&, bool& value) {
  if (node.kind != Kind::scalar || node.is_quoted ||
      (node.text != "true" && node.text != "false")) {
    return expected(node, "true or false");
  }
  value = node.text == "true";
  return "";
}

std::string read_one(const YamlNode& node, const Field& field, std::string& value) {
  const std::string& text = node.text;
  if (!field.choices.empty()) {
    const std::string allowed = join(field.choices);
    if (node.kind != Kind::scalar) return expected(node, "one of: " + allowed);
    if (std::ranges::find(field.choices, text) == field.choices.end()) {
      return fmt::format("is no known name ({}allowed: {})", did_you_mean(text, field.choices),
                         allowed);
    }
  } else if (node.kind != Kind::scalar) {
    return expected(node, "text");
  } else if (!node.is_quoted && is_not_text(text)) {
    return fmt::format("expects text; to mean the text write \"{}\" with its quotes", text);
  } else if (field.kind == FieldKind::word &&
             (text.empty() || text.size() > kLongestWord || text[0] == '.' || text[0] == '-' ||
              !is_word(text))) {
    return fmt::format(
        "expects a name of up to {} letters, digits, '.', '_' and '-' that starts "
        "with neither '.' nor '-'",
        kLongestWord);
  }
  value = text;
  return "";
}

std::vector<ValueError> read_numbers(const YamlNode& node, const Field& field, Vec3& value) {
  std::vector<ValueError> errors;
  Vec3 read = value;
  const auto read_axis = [&](const YamlNode& item, std::size_t axis) {
    const std::string what = read_one(item, field, read[static_cast<Eigen::Index>(axis)]);
    if (!what.empty()) errors.push_back({&item, what, fmt::format(".{}", axis)});
  };
  if (node.kind == Kind::list && node.items.size() != 3) {
    return {{&node, fmt::format("has {} items; expects [x, y, z]", node.items.size())}};
  }
  if (node.kind != Kind::list && node.kind != Kind::picks) {
    return {{&node, expected(node, "three numbers, [x, y, z]")}};
  }
  for (std::size_t axis = 0; axis < node.items.size(); ++axis) read_axis(node.items[axis], axis);
  for (const YamlEntry& entry : node.entries) {
    if (entry.key == "0" || entry.key == "1" || entry.key == "2") {
      read_axis(entry.value, static_cast<std::size_t>(entry.key[0] - '0'));
    } else {
      errors.push_back(
          {&entry.value, "is no item of [x, y, z] (allowed: 0 to 2)", '.' + entry.key});
    }
  }
  if (errors.empty()) value = read;
  return errors;
}

std::vector<ValueError> read_numbers(const YamlNode& node, const Field& field,
                                     std::vector<double>& values) {
  if (node.kind != Kind::list || node.items.empty() || node.items.size() > kMostNumbers) {
    return {{&node, expected(node, fmt::format("a list of 1 to {} numbers", kMostNumbers))}};
  }
  std::vector<ValueError> errors;
  std::vector<double> read;
  for (const YamlNode& item : node.items) {
    double number = 0.0;
    std::string what = read_one(item, field, number);
    if (what.empty() && std::ranges::find(read, number) != read.end()) what = "is there twice";
    if (!what.empty()) errors.push_back({&item, what, fmt::format(".{}", read.size())});
    read.push_back(number);
  }
  if (errors.empty()) values = read;
  return errors;
}

std::string number_text(const Field& field, double value) {
  const bool is_angle = field.kind == FieldKind::angle;
  std::string text = fmt::format("{}", is_angle ? degrees_of(written_angle_rad(value)) : value);
  const std::size_t exponent = text.find('e');
  if (exponent != text.npos && text.find('.') == text.npos) {
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
      !is_not_text(text) &&
      (std::isalpha(static_cast<unsigned char>(text[0])) != 0 || text[0] == '/') &&
      is_word(text, "._-/") && std::ranges::find(kBools, lower) == kBools.end();
  return is_plain ? text : yaml_in_quotes(text);
}

}  // namespace

std::string out_of_range(const Range& range) {
  return fmt::format(
      "is out of range (allowed: {} {}{} {})", range.is_min_open ? "above" : "from", range.min,
      range.is_max_open ? ", below" : (range.is_min_open ? ", up to" : " to"), range.max);
}

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
        } else if constexpr (std::is_same_v<T, Vec3> || std::is_same_v<T, std::vector<double>>) {
          std::vector<std::string> texts;
          for (const double number : *v) texts.push_back(number_text(field, number));
          return fmt::format("[{}]", fmt::join(texts, ", "));
        } else if constexpr (std::is_same_v<T, std::string>) {
          const bool is_path = field.kind == FieldKind::path && !v->empty();
          return plain_or_quoted(is_path ? std::filesystem::absolute(*v).lexically_normal().string()
                                         : *v);
        } else {
          return fmt::format("{}", *v);
        }
      },
      value);
}

std::vector<ValueError> read_value(const YamlNode& node, const Field& field,
                                   const std::string& folder, const FieldValue& value) {
  return std::visit(
      [&](auto* v) -> std::vector<ValueError> {
        using T = std::remove_cvref_t<decltype(*v)>;
        if constexpr (std::is_same_v<T, Vec3> || std::is_same_v<T, std::vector<double>>) {
          return read_numbers(node, field, *v);
        } else {
          const std::string what = read_one(node, field, *v);
          if (!what.empty()) return {{&node, what}};
          if constexpr (std::is_same_v<T, std::string>) {
            if (field.kind == FieldKind::path && !v->empty()) {
              *v = std::filesystem::absolute(std::filesystem::path(folder) / *v)
                       .lexically_normal()
                       .string();
            }
          }
          return {};
        }
      },
      value);
}

}  // namespace gnbv
