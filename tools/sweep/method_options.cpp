#include <fmt/format.h>

#include <set>
#include <string_view>

#include "sim/core/error.hpp"
#include "tools/sweep/compare_missions.hpp"

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

class Methods {
 public:
  void add(SweepMethod method) {
    if (!names_.insert(method.name).second) {
      add_fault(fmt::format("method '{}': named twice", method.name));
    }
    methods_.push_back(std::move(method));
  }

  void add_variant(const std::string& text) {
    const std::size_t colon = text.substr(0, text.find('=')).find(':');
    const bool is_named = colon != std::string::npos;
    SweepMethod method{.name = text.substr(0, colon)};
    if (!is_named) method.name = text;
    for (std::string& part : split_at_commas(is_named ? text.substr(colon + 1) : text)) {
      if (!is_assignment(part) || method.name.empty()) {
        return add_fault(
            fmt::format("--variant: value '{}': expected [NAME:]KEY=VALUE[,KEY=VALUE]...", text));
      }
      if (sets_seed(part)) return add_seed_fault("--variant", text);
      method.overrides.push_back({std::move(part)});
    }
    add(std::move(method));
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
      add({assignment, {{assignment}}});
    }
  }

  std::vector<SweepMethod> all(const MethodOptions& options) && {
    if (faults_.empty() && methods_.size() < 2) {
      // a name that nobody knows is told before that there is nothing to compare it with
      const bool has_name = !options.utilities.empty() || !options.presets.empty();
      if (has_name) load_with_overrides("smoke", methods_.at(0).overrides);
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

std::vector<SweepMethod> methods_of(const MethodOptions& options) {
  Methods methods;
  const bool only_variants = options.utilities.empty() && options.presets.empty() &&
                             options.varies.empty() && !options.variants.empty();
  if (only_variants) methods.add({.name = "default"});
  for (SweepMethod& method : named_methods(options.utilities, "--utilities")) {
    methods.add(std::move(method));
  }
  for (const std::string& preset : options.presets) {
    methods.add({preset, {{"planner.preset=" + preset, "--presets " + preset}}});
  }
  for (const std::string& variant : options.variants) methods.add_variant(variant);
  for (const std::string& varied : options.varies) methods.add_varied(varied);
  return std::move(methods).all(options);
}

}  // namespace gnbv
