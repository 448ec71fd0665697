#include "tools/terminal/say.hpp"

#include <cstdio>

#include "sim/core/text.hpp"
#include "tools/terminal/streams.hpp"

namespace gnbv {

void print_to_stderr(std::string_view text) {
  std::fflush(stdout);  // where both go to one file, what was printed before stands before
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void say(std::string_view sentence) {
  while (sentence.ends_with('\n')) sentence.remove_suffix(1);
  const std::string line = fmt::format("gnbv: {}", printable(sentence));
  print_to_stderr(folded_text(line, stderr_columns()) + "\n");
}

}  // namespace gnbv
