// Text for a shell.
#pragma once

#include <string>

namespace gnbv {

/// One word of a shell command, whatever it holds; plain text stays as it is.
std::string shell_word(const std::string& text);

}  // namespace gnbv
