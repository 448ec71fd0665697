#include "tools/page/page_text.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "sim/core/sha256.hpp"
#include "sim/core/text.hpp"

namespace gnbv {
namespace {

using Escape = std::pair<std::string_view, std::string_view>;

template <std::size_t N>
std::string escaped(std::string_view text, const std::array<Escape, N>& escapes) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const auto escape = std::find_if(escapes.begin(), escapes.end(),
                                     [&](const Escape& e) { return text.starts_with(e.first); });
    const std::string_view from = escape == escapes.end() ? text.substr(0, 1) : escape->first;
    out += escape == escapes.end() ? from : escape->second;
    text.remove_prefix(from.size());
  }
  return out;
}

}  // namespace

std::string html_escaped(std::string_view text) {
  return escaped(
      text, std::array<Escape, 5>{
                {{"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}, {"'", "&#39;"}}});
}

std::string script_json(std::string_view json) {
  return escaped(json,
                 std::array<Escape, 3>{{{"<", "\\u003c"}, {">", "\\u003e"}, {"&", "\\u0026"}}});
}

std::string policy_hash(std::string_view text) {
  Sha256 hash;
  hash.add(text);
  return "'sha256-" + base64(hash.digest()) + "'";
}

}  // namespace gnbv
