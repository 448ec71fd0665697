#include "tools/terminal/say.hpp"

#include <cstdio>

#include "sim/core/utf8.hpp"

namespace gnbv {

void print_to_stderr(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void say(std::string_view sentence) {
  while (sentence.ends_with('\n')) sentence.remove_suffix(1);
  print_to_stderr(fmt::format("gnbv: {}\n", printable(sentence)));
}

}  // namespace gnbv
