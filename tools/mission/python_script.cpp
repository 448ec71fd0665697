#include "tools/mission/python_script.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "sim/core/embed.hpp"
#include "sim/core/error.hpp"
#include "tools/mission/child_pipe.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;

GNBV_EMBED(python_script_py, GNBV_PYTHON_SCRIPT);

}  // namespace

Json ask_python(const PythonScript& script, const Json& request) {
  Json modules = Json::object();
  for (const auto& [name, source] : script.modules) modules[name] = source;
  const Json head = {{"modules", std::move(modules)},
                     {"entry", script.entry},
                     {"what", script.what},
                     {"apt", script.apt},
                     {"pip", script.pip}};
  ChildPipe child({python_program(), "-c", std::string(python_script_py())});
  const auto line = [](const Json& json) {  // ASCII, whatever Python takes for its locale
    return json.dump(-1, ' ', true, Json::error_handler_t::replace) + "\n";
  };
  child.write(line(head) + line(request));
  const Json answer = Json::parse(child.read_line(), nullptr, false);
  if (!answer.is_object()) {
    throw BadInput(fmt::format("{}: {} does not run ({}); GNBV_PYTHON names another", script.what,
                               python_program(), child.end()));
  }
  if (answer.contains("error")) throw BadInput(answer["error"].get<std::string>());
  return answer.at("answer");
}

}  // namespace gnbv
