#include "tools/run/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace gnbv {

std::string human_name(std::string_view name) {
  const bool is_plain = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
  std::string words(name);
  if (!is_plain || name.empty()) return words;
  if (name == "aep") return "AEP";
  std::replace(words.begin(), words.end(), '_', ' ');
  words.front() = static_cast<char>(std::toupper(words.front()));
  return words;
}

std::string counted(std::size_t count, std::string_view thing) {
  return fmt::format("{} {}{}", grouped(count), thing, count == 1 ? "" : "s");
}

double rounded_up_125(double value) {
  constexpr double kRounding = 1e-9;
  const double power = std::pow(10.0, std::floor(std::log10(value) + kRounding));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (value <= (factor + kRounding) * power) return factor * power;
  }
  return 10.0 * power;
}

double rounded_down_125(double value) { return 1.0 / rounded_up_125(1.0 / value); }

}  // namespace gnbv
