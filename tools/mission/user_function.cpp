#include "tools/mission/user_function.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>

#include "planner/guided/utility.hpp"
#include "scenarios/document.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// The parts of [NAME=]FILE.py[:FUNCTION], or of [NAME=]UTILITY, empty where they are not said.
struct FunctionWords {
  std::string name, file, function;
  std::string utility = {};
};

FunctionWords parts_of(std::string_view text) {
  FunctionWords parts;
  const std::size_t equals = text.find_first_of("=/.");  // a NAME is one word
  if (equals != std::string_view::npos && text[equals] == '=') {
    parts.name = text.substr(0, equals);
    text.remove_prefix(equals + 1);
  }
  if (const std::size_t colon = text.rfind(':');
      colon != std::string_view::npos && text.substr(0, colon).ends_with(".py")) {
    parts.function = text.substr(colon + 1);
    text = text.substr(0, colon);
  }
  (text.ends_with(".py") ? parts.file : parts.utility) = text;
  return parts;
}

/// How many parameters, from behind the bracket on, have to be given by their places.
int needed_parameters(std::string_view text) {
  int depth = 0;
  int needed = 0;
  char quote = '\0';
  std::string parameter;  // without blanks
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != '\0') {
      if (c == quote) quote = '\0';
      continue;
    }
    if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
    } else if (depth == 0 && (c == ',' || c == ')')) {
      needed += parameter.empty() || parameter == "/" ? 0 : 1;
      if (c == ')') return needed;
      parameter.clear();
    } else if (depth == 0 && (c == '=' || (c == '*' && parameter.empty()))) {
      return needed;  // those that follow have defaults, or are given by name
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (std::string_view(" \t\r\n\\").find(c) == std::string_view::npos) {
      depth += c == '(' || c == '[' || c == '{' ? 1 : 0;
      depth -= c == ')' || c == ']' || c == '}' ? 1 : 0;
      parameter += c;
    }
  }
  return needed;
}

struct Definition {
  std::string name;
  bool is_def = false;  // or assigned
  UserFunctionKind kind = UserFunctionKind::utility;
};

/// At the top level of the source, each name as it was defined last.
std::vector<Definition> definitions_in(const std::string& source) {
  std::vector<Definition> all;
  const std::regex definition(R"((?:^|\n)(?:def[ \t]+(\w+)[ \t]*\(|(\w+)[ \t]*=))");
  for (auto it = std::sregex_iterator(source.begin(), source.end(), definition);
       it != std::sregex_iterator(); ++it) {
    Definition found{.name = (*it)[1].matched ? (*it)[1] : (*it)[2], .is_def = (*it)[1].matched};
    const auto behind = static_cast<std::size_t>(it->position() + it->length());
    if (found.is_def && needed_parameters(std::string_view(source).substr(behind)) == 2) {
      found.kind = UserFunctionKind::planner;
    }
    std::erase_if(all, [&](const Definition& other) { return other.name == found.name; });
    all.push_back(found);
  }
  return all;
}

Definition chosen(const FunctionWords& named, const std::string& source) {
  std::vector<Definition> all = definitions_in(source);
  if (!named.function.empty()) {
    const auto at = std::find_if(all.begin(), all.end(), [&](const Definition& definition) {
      return definition.name == named.function;
    });
    if (at != all.end()) return *at;
    throw BadInput("{}: defines no function '{}' at its top level", named.file, named.function);
  }
  std::erase_if(all, [](const Definition& definition) { return !definition.is_def; });
  if (all.empty()) throw BadInput(named.file + ": defines no function at its top level");
  if (all.size() == 1) return all.front();
  std::vector<std::string> names;
  for (const Definition& definition : all) names.push_back(definition.name);
  throw BadInput("{}: defines several functions ({}): name one, as in {}:{}", named.file,
                 fmt::join(names, ", "), named.file, names.back());
}

}  // namespace

std::vector<Override> overrides_of(const std::vector<std::string>& sets) {
  std::vector<Override> overrides;
  for (const std::string& set : sets) overrides.push_back({set});
  return overrides;
}

NamedMethod named_method(const std::string& text, const std::string& option,
                         const fs::path& folder) {
  const std::string given_by = option + " " + text;
  const FunctionWords named = parts_of(text);
  const auto set = [&](const std::string& key, const std::string& value) {
    return Override{.text = fmt::format("planner.utility.{}={}", key, value), .source = given_by};
  };
  if (named.file.empty()) {
    return {named.name.empty() ? named.utility : named.name, {set("name", named.utility)}};
  }
  const fs::path file = folder / named.file;
  const std::string source = read_file(file);
  const Definition function =
      chosen({named.name, file.lexically_normal().string(), named.function}, source);
  const std::string file_name = file.filename().string();
  const bool is_planner = function.kind == UserFunctionKind::planner;
  NamedMethod method{named.name.empty() ? function.name : named.name,
                     {set("name", std::string(kUserUtilityName)),
                      set("python.kind", is_planner ? "planner" : "utility"),
                      set("python.label", yaml_in_quotes(named.name)),
                      set("python.file", yaml_in_quotes(file_name)),
                      set("python.function", yaml_in_quotes(function.name)),
                      set("python.source", yaml_in_quotes(source))}};
  if (named.name.empty()) {
    method.longer_names = {file_name + ":" + function.name, named.file + ":" + function.name};
  }
  return method;
}

void tell_apart(std::vector<NamedMethod>& methods) {
  for (std::size_t level = 0; level < 2; ++level) {
    std::map<std::string, int> counts;
    for (const NamedMethod& method : methods) ++counts[method.name];
    for (NamedMethod& method : methods) {
      if (counts[method.name] < 2 || level >= method.longer_names.size()) continue;
      method.name = method.longer_names[level];
    }
  }
}

std::vector<NamedMethod> named_methods(const std::vector<std::string>& texts,
                                       const std::string& option) {
  std::vector<NamedMethod> methods;
  for (const std::string& text : texts) methods.push_back(named_method(text, option));
  tell_apart(methods);
  return methods;
}

}  // namespace gnbv
