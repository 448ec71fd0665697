#include "tools/sweep/method_options.hpp"

#include <fmt/format.h>

#include <set>
#include <string_view>

#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "tools/mission/user_function.hpp"

namespace gnbv {
namespace {

/// The parts between the commas that no bracket, brace or quote holds.
std::vector<std::string> split_at_commas(std::string_view text) {
  std::vector<std::string> parts(1);
  int depth = 0;
  char quote = '\0';
  for (const char c : text) {
    if (quote != '\0') {
      quote = c == quote ? '\0' : quote;
    } else if (c == '\'' || c == '"') {
      quote = c;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == ',' && depth == 0) {
      parts.emplace_back();
      continue;
    }
    parts.back() += c;
  }
  return parts;
}

bool is_assignment(std::string_view text) {
  const std::size_t equals = text.find('=');
  return equals != std::string_view::npos && equals > 0 && equals + 1 < text.size();
}

bool sets_seed(std::string_view assignment) {
  const std::string_view key = assignment.substr(0, assignment.find('='));
  return key.substr(std::min(key.find_first_not_of(' '), key.size())) == "seed";
}

/// A name that nobody knows is told before that there is nothing to compare it with.
void need_known_names(const MethodOptions& options) {
  std::vector<Override> sets;
  for (const std::string& utility : options.utilities) {
    if (!is_user_function(utility)) {
      sets.push_back(named_method(utility, "--utilities").overrides.front());
    }
  }
  for (const std::string& preset : options.presets) {
    sets.push_back(
        {.text = "planner.preset=" + preset, .source = "--presets " + preset, .folder = {}});
  }
  for (const Override& set : sets) load_with_overrides("smoke", {set});
}

class Methods {
 public:
  void add(SweepMethod method) { add(method.name, std::move(method.overrides)); }
  void add(const std::string& name, std::vector<std::string> overrides) {
    if (!names_.insert(name).second) add_fault(fmt::format("method '{}': named twice", name));
    methods_.push_back({name, std::move(overrides)});
  }

  void add_variant(const std::string& text) {
    const std::size_t colon = text.substr(0, text.find('=')).find(':');
    const bool is_named = colon != std::string::npos;
    const std::string name = is_named ? text.substr(0, colon) : text;
    const std::vector<std::string> parts =
        split_at_commas(is_named ? std::string_view(text).substr(colon + 1) : text);
    for (const std::string& part : parts) {
      if (!is_assignment(part) || name.empty()) {
        return add_fault(
            fmt::format("--variant: value '{}': expected [NAME:]KEY=VALUE[,KEY=VALUE]...", text));
      }
      if (sets_seed(part)) return add_seed_fault("--variant", text);
    }
    add(name, parts);
  }

  void add_varied(const std::string& text) {
    if (sets_seed(text)) return add_seed_fault("--vary", text);
    const std::size_t equals = text.find('=');
    for (const std::string& value :
         split_at_commas(std::string_view(text).substr(std::min(equals + 1, text.size())))) {
      const std::string assignment = text.substr(0, equals) + "=" + value;
      if (equals == std::string::npos || !is_assignment(assignment)) {
        return add_fault(fmt::format("--vary: value '{}': expected KEY=VALUE[,VALUE]...", text));
      }
      add(assignment, {assignment});
    }
  }

  std::vector<SweepMethod> all(const MethodOptions& options) && {
    if (faults_.empty() && methods_.size() < 2) {
      need_known_names(options);
      add_fault(fmt::format(
          "{}: nothing to compare with; name more by --utilities, --presets, --variant or --vary",
          methods_.empty() ? "no method" : "one method, '" + methods_[0].name + "'"));
    }
    if (!faults_.empty()) throw BadInput(faults_);
    return std::move(methods_);
  }

 private:
  void add_fault(const std::string& fault) { faults_ += (faults_.empty() ? "" : "\n") + fault; }

  void add_seed_fault(const std::string& option, const std::string& text) {
    add_fault(fmt::format("{}: value '{}': seeds are no method; --seed and --seeds give them",
                          option, text));
  }

  std::vector<SweepMethod> methods_;
  std::set<std::string> names_;
  std::string faults_;
};

}  // namespace

std::vector<SweepMethod> methods_of_utilities(const std::vector<std::string>& utilities) {
  std::vector<NamedMethod> named;
  for (const std::string& utility : utilities) {
    named.push_back(named_method(utility, "--utilities"));
  }
  tell_apart(named);
  std::vector<SweepMethod> methods;
  for (NamedMethod& one : named) {
    methods.push_back({.name = std::move(one.label), .overrides = {}});
    for (Override& set : one.overrides) methods.back().overrides.push_back(std::move(set.text));
  }
  return methods;
}

std::vector<SweepMethod> methods_of(const MethodOptions& options) {
  Methods methods;
  const bool only_variants = options.utilities.empty() && options.presets.empty() &&
                             options.varies.empty() && !options.variants.empty();
  if (only_variants) methods.add("default", {});
  for (SweepMethod& method : methods_of_utilities(options.utilities)) {
    methods.add(std::move(method));
  }
  for (const std::string& preset : options.presets) {
    methods.add(preset, {"planner.preset=" + preset});
  }
  for (const std::string& variant : options.variants) methods.add_variant(variant);
  for (const std::string& varied : options.varies) methods.add_varied(varied);
  return std::move(methods).all(options);
}

}  // namespace gnbv
