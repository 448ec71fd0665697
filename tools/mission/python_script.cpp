#include "tools/mission/python_script.hpp"

#include <nlohmann/json.hpp>

#include "sim/core/child_process.hpp"
#include "sim/core/embed.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;

GNBV_EMBED(python_script_py, GNBV_PYTHON_SCRIPT);

Json answer_of(const std::string& program, const std::string& what, const Json& head,
               const Json& request) {
  ChildProcess child({program, "-c", std::string(python_script_py())},
                     {.in = ChildStream::pipe, .out = ChildStream::pipe});
  const auto line = [](const Json& json) {  // ASCII, whatever Python takes for its locale
    return json.dump(-1, ' ', true, Json::error_handler_t::replace) + "\n";
  };
  child.write(line(head) + line(request));
  Json answer = Json::parse(child.read_line(), nullptr, false);
  if (answer.is_object()) return answer;
  throw BadInput("{}: {} does not run ({}); GNBV_PYTHON names another", what, program,
                 child.end().text());
}

Json result_of(const Json& answer) {
  if (answer.value("errno", 0) != 0) {
    refuse_to_write(answer.value("file", ""), answer.value("errno", 0));
  }
  if (answer.contains("error")) throw BadInput(answer["error"].get<std::string>());
  return answer.at("answer");
}

}  // namespace

Json ask_python(const PythonScript& script, const Json& request) {
  Json modules = Json::object();
  for (const auto& [name, source] : script.modules) modules[name] = source;
  const Json head = {{"modules", std::move(modules)},
                     {"entry", script.entry},
                     {"what", script.what},
                     {"apt", script.apt},
                     {"pip", script.pip}};
  const std::string program = python_program();
  const Json answer = answer_of(program, script.what, head, request);
  if (answer.contains("missing") && program == "python3") {
    // another Python comes first in the path than the one that Debian's packages are for
    const Json of_debian = answer_of("/usr/bin/python3", script.what, head, request);
    if (!of_debian.contains("missing")) return result_of(of_debian);
  }
  return result_of(answer);
}

}  // namespace gnbv
