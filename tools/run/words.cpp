#include "tools/run/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

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

}  // namespace gnbv
