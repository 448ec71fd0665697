// Parts of the program that are Python: they are within it, and go to `python3` through a pipe.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnbv {

struct PythonScript {
  std::string what;  // "figures": of whom an error speaks
  std::vector<std::pair<std::string, std::string_view>> modules;  // name, source; in import order
  std::string entry;     // the module whose main(request) is called
  std::string apt = {};  // packages of Debian's that hold what it imports; empty: none do
  std::string pip = {};  // and of the Python package index
};

/// What main() returns, of `python3` (Debian's, where another that comes first in the path lacks
/// the packages), or of what GNBV_PYTHON names. Throws BadInput with the one line that installs
/// what is missing there, or with what went wrong.
nlohmann::ordered_json ask_python(const PythonScript& script,
                                  const nlohmann::ordered_json& request);

}  // namespace gnbv
