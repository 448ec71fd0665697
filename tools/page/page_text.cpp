#include "tools/page/page_text.hpp"

#include <array>

#include "sim/core/sha256.hpp"
#include "sim/core/text.hpp"

namespace gnbv {

std::string html_escaped(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kEscapes = {
      {{"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}, {"'", "&#39;"}}};
  return escaped(text, kEscapes);
}

std::string script_json(std::string_view json) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kEscapes = {
      {{"<", "\\u003c"}, {">", "\\u003e"}, {"&", "\\u0026"}}};
  return escaped(json, kEscapes);
}

std::string policy_hash(std::string_view text) {
  Sha256 hash;
  hash.add(text);
  return "'sha256-" + base64(hash.digest()) + "'";
}

}  // namespace gnbv
