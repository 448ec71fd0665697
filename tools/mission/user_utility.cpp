#include "tools/mission/user_utility.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <regex>

#include "planner/view/view_stats.hpp"
#include "scenarios/document.hpp"
#include "sim/core/child_process.hpp"
#include "sim/core/embed.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;

GNBV_EMBED(child_script, GNBV_UTILITY_CHILD);

/// NumPy's dtype of UserCandidate, with the fields that are computed; the others are not there, so
/// that nobody takes their zeros for counts.
Json dtype_of(const UtilityConfig& config) {
  const UtilityTraits needs = needs_of(config);
  const ViewFieldNeeds computed = needs.shadow ? ViewFieldNeeds::shadow
                                  : needs.rays ? ViewFieldNeeds::rays
                                               : ViewFieldNeeds::voxels;
  Json names = Json::array(), formats = Json::array(), offsets = Json::array();
  const auto add = [&](std::string_view name, std::string_view format, std::size_t offset) {
    names.push_back(name);
    formats.push_back(format);
    offsets.push_back(offset);
  };
  for (const ViewField& field : kViewFields) {
    if (field.needs <= computed) {
      add(field.name, field.format, offsetof(UserCandidate, stats) + field.offset);
    }
  }
  add("x_m", "<f8", offsetof(UserCandidate, x_m));
  add("y_m", "<f8", offsetof(UserCandidate, y_m));
  add("z_m", "<f8", offsetof(UserCandidate, z_m));
  add("yaw_rad", "<f8", offsetof(UserCandidate, yaw_rad));
  add("gimbal_pitch_rad", "<f8", offsetof(UserCandidate, gimbal_pitch_rad));
  return {{"names", names},
          {"formats", formats},
          {"offsets", offsets},
          {"itemsize", sizeof(UserCandidate)}};
}

class PythonUtility {
 public:
  explicit PythonUtility(const UtilityConfig& config)
      : function_(config.python.function),
        child_({python_program(), "-c", std::string(child_script())}, kTalks) {
    const Json hello = {
        {"function", function_}, {"source", config.python.source}, {"dtype", dtype_of(config)}};
    child_.write(hello.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
    const std::string line = child_.read_line();
    const Json answer = Json::parse(line, nullptr, false);
    if (!answer.is_object()) {
      throw BadInput(fmt::format("utility {}: {} does not run ({}); GNBV_PYTHON names another",
                                 function_, python_program(), child_.end().text()));
    }
    if (answer.contains("error")) {
      throw BadInput(fmt::format("utility {}: {}", function_, answer["error"].get<std::string>()));
    }
  }

  std::vector<double> operator()(const UserQuestion& question) {
    const std::size_t rows = question.rows.size();
    child_.write_number(static_cast<std::int64_t>(rows));
    child_.write(
        {reinterpret_cast<const char*>(question.rows.data()), rows * sizeof(UserCandidate)});
    const std::int64_t answered = child_.read_number();
    if (answered == static_cast<std::int64_t>(rows) && child_.is_open()) {
      std::vector<double> scores(rows);
      child_.read(reinterpret_cast<char*>(scores.data()), rows * sizeof(double));
      if (child_.is_open()) return scores;
    }
    fail(question);
  }

 private:
  [[noreturn]] void fail(const UserQuestion& question) {
    const std::int64_t row = child_.read_number();
    std::string text(static_cast<std::size_t>(std::max<std::int64_t>(child_.read_number(), 0)),
                     ' ');
    child_.read(text.data(), text.size());
    if (!child_.is_open()) {
      throw UserUtilityFailed(fmt::format("utility {}: iteration {}: its Python ended ({})",
                                          function_, question.iteration, child_.end().text()));
    }
    const std::string who =
        row < 0 ? fmt::format("all {} candidates together", question.rows.size())
                : fmt::format("candidate {}", question.indices[static_cast<std::size_t>(row)]);
    throw UserUtilityFailed(
        fmt::format("utility {}: iteration {}, {}: {}", function_, question.iteration, who, text));
  }

  static inline const ChildOptions kTalks = {.in = ChildStream::pipe, .out = ChildStream::pipe};

  std::string function_;
  ChildProcess child_;
};

}  // namespace

bool is_utility_file(std::string_view utility) {
  const std::string_view file = utility.substr(0, utility.rfind(':'));
  return utility.ends_with(".py") || file.ends_with(".py");
}

NamedUtility named_utility(const std::string& utility) {
  const std::string source = "--utility " + utility;
  if (!is_utility_file(utility)) {
    return {utility, {{.text = "planner.utility.name=" + utility, .source = source, .folder = {}}}};
  }
  const std::size_t colon = utility.ends_with(".py") ? utility.size() : utility.rfind(':');
  const std::string file = utility.substr(0, colon);
  std::string function = colon < utility.size() ? utility.substr(colon + 1) : "";
  const std::string text = read_file(file);
  std::vector<std::string> defined;
  const std::regex definition(R"((?:^|\n)(?:def[ \t]+(\w+)[ \t]*\(|(\w+)[ \t]*=))");
  for (auto it = std::sregex_iterator(text.begin(), text.end(), definition);
       it != std::sregex_iterator(); ++it) {
    const bool is_def = (*it)[1].matched;
    defined.push_back((*it)[is_def ? 1 : 2]);
    if (is_def && colon == utility.size()) function = defined.back();
  }
  if (std::find(defined.begin(), defined.end(), function) == defined.end()) {
    throw BadInput(fmt::format("{}: defines no function{} at its top level", file,
                               function.empty() ? "" : fmt::format(" '{}'", function)));
  }
  const auto set = [&](const char* key, const std::string& value) {
    return Override{
        .text = fmt::format("planner.utility.{}={}", key, value), .source = source, .folder = {}};
  };
  return {
      function,
      {set("name", std::string(kUserUtilityName)), set("python.function", yaml_in_quotes(function)),
       set("python.source", yaml_in_quotes(text))}};
}

UserScores start_user_utility(const UtilityConfig& config) {
  if (!is_user_utility(config.name)) return {};
  auto utility = std::make_shared<PythonUtility>(config);
  return [utility](const UserQuestion& question) { return (*utility)(question); };
}

UserScores lazy_user_utility(const UtilityConfig& config) {
  if (!is_user_utility(config.name)) return {};
  auto started = std::make_shared<UserScores>();
  return [started, config](const UserQuestion& question) {
    if (!*started) *started = start_user_utility(config);
    return (*started)(question);
  };
}

}  // namespace gnbv
