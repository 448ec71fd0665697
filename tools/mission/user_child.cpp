#include <bit>
#include <csignal>
#include <cstring>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>

#include "planner/view/view_stats.hpp"
#include "sim/core/child_process.hpp"
#include "sim/core/embed.hpp"
#include "sim/core/error.hpp"
#include "tools/mission/belief_questions.hpp"
#include "tools/mission/user_planner.hpp"
#include "tools/terminal/interrupt.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;

GNBV_EMBED(child_script, GNBV_USER_CHILD);
GNBV_EMBED(errors_module, GNBV_PYTHON_PACKAGE "/_errors.py");
GNBV_EMBED(planner_module, GNBV_PYTHON_PACKAGE "/_planner.py");

static_assert(std::endian::native == std::endian::little, "the other side reads little endian");

/// A line of JSON and the bytes that it announces.
struct Message {
  Json fields = Json::object();
  std::string bytes = {};
};

template <typename T>
std::string bytes_of(std::span<const T> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

template <typename T>
std::vector<T> values_of(const std::string& bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(static_cast<void*>(values.data()), bytes.data(), values.size() * sizeof(T));
  return values;
}

static_assert(sizeof(ViewPose) == 5 * sizeof(double), "a view is a row of x, y, z, yaw, pitch");

/// NumPy's dtype with the fields that are computed; the others are not there, so that nobody takes
/// their zeros for counts.
Json dtype_of(const UtilityConfig& config) {
  const bool is_planner = is_user_planner(config);
  const UtilityTraits needs = needs_of(config);
  const ViewFieldNeeds computed = is_planner     ? ViewFieldNeeds::rays
                                  : needs.shadow ? ViewFieldNeeds::shadow
                                  : needs.rays   ? ViewFieldNeeds::rays
                                                 : ViewFieldNeeds::voxels;
  Json dtype = {{"itemsize", is_planner ? sizeof(ViewStats) : sizeof(UserCandidate)}};
  const auto add = [&](std::string_view name, std::string_view format, std::size_t offset) {
    dtype["names"].push_back(name);
    dtype["formats"].push_back(format);
    dtype["offsets"].push_back(offset);
  };
  static_assert(offsetof(UserCandidate, stats) == 0);
  for (const ViewField& field : kViewFields) {
    if (field.needs <= computed) add(field.name, field.format, field.offset);
  }
  if (is_planner) return dtype;
  add("x_m", "<f8", offsetof(UserCandidate, x_m));
  add("y_m", "<f8", offsetof(UserCandidate, y_m));
  add("z_m", "<f8", offsetof(UserCandidate, z_m));
  add("yaw_rad", "<f8", offsetof(UserCandidate, yaw_rad));
  add("gimbal_pitch_rad", "<f8", offsetof(UserCandidate, gimbal_pitch_rad));
  return dtype;
}

/// A function in a Python of its own.
class UserChild {
 public:
  explicit UserChild(const UtilityConfig& config)
      : who_(fmt::format("{} {}", is_user_planner(config) ? "planner" : "utility",
                         utility_label(config))),
        child_({python_program(), "-c", std::string(child_script())},
               {.in = ChildStream::pipe, .out = ChildStream::pipe}) {
    const UserFunctionConfig& own = config.python;
    send({{{"kind", is_user_planner(config) ? "planner" : "utility"},
           {"function", own.function},
           {"file", own.file.empty() ? own.function + ".py" : own.file},
           {"source", own.source},
           {"dtype", dtype_of(config)},
           {"modules", {{"_errors", errors_module()}, {"_planner", planner_module()}}}}});
    const Message answer = receive();
    if (answer.fields.empty()) {
      throw BadInput("{}: {} does not run ({}); GNBV_PYTHON names another", who_, python_program(),
                     child_.end().text());
    }
    if (const auto error = answer.fields.find("error"); error != answer.fields.end()) {
      throw BadInput("{}: {}", who_, error->get<std::string>());
    }
  }

  const std::string& who() const { return who_; }

  void send(Message message) {
    message.fields["bytes"] = message.bytes.size();
    child_.write(message.fields.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
    child_.write(message.bytes);
  }

  /// Without any field when it has ended, or is ended because nobody waits any longer.
  Message receive() {
    while (!child_.speaks_within(std::chrono::milliseconds(100))) {
      if (!is_given_up()) continue;
      child_.send(SIGKILL);
      return {};
    }
    Message message{.fields = Json::parse(child_.read_line(), nullptr, false), .bytes = {}};
    if (!message.fields.is_object()) return {};
    message.bytes.resize(message.fields.value("bytes", std::size_t{0}));
    child_.read(message.bytes.data(), message.bytes.size());
    return child_.is_open() ? message : Message{};
  }

  /// That the answer is none. `of_row`: what is at fault when the function says which row is.
  [[noreturn]] void fail(const Message& answer, std::size_t iteration,
                         const std::function<std::string(std::int64_t row)>& of_row) {
    const std::string where = fmt::format("{}: iteration {}", who_, iteration);
    const auto error = answer.fields.find("error");
    if (error == answer.fields.end()) {
      if (is_given_up()) throw StopRequested();
      throw UserUtilityFailed(fmt::format("{}: its Python ended ({})", where, child_.end().text()));
    }
    throw UserUtilityFailed(fmt::format("{}{}: {}", where, of_row(answer.fields.value("row", -1)),
                                        error->get<std::string>()));
  }

 private:
  /// Asked to stop once, the mission ends after the answer; asked again, it waits for none.
  static bool is_given_up() { return InterruptGuard::requests() > 1; }

  std::string who_;
  ChildProcess child_;
};

class PythonUtility {
 public:
  explicit PythonUtility(const UtilityConfig& config) : child_(config) {}

  std::vector<double> operator()(const UserQuestion& question) {
    child_.send({.fields = Json::object(), .bytes = bytes_of(question.rows)});
    const Message answer = child_.receive();
    std::vector<double> scores = values_of<double>(answer.bytes);
    if (!answer.fields.empty() && scores.size() == question.rows.size()) return scores;
    child_.fail(answer, question.iteration, [&](std::int64_t row) {
      return row < 0
                 ? fmt::format(", all {} candidates together", question.rows.size())
                 : fmt::format(", candidate {}", question.indices[static_cast<std::size_t>(row)]);
    });
  }

 private:
  UserChild child_;
};

/// Asked for the next view, it asks the belief until it knows.
class PythonPlanner {
 public:
  PythonPlanner(const Scenario& scenario, int threads)
      : child_(scenario.planner.utility),
        tools_(scenario.planner, planner_model(scenario), threads) {}

  std::optional<ViewPose> plan(const Belief& belief) {
    child_.send({about(belief)});
    while (true) {
      const Message message = child_.receive();
      const auto asked = message.fields.find("ask");
      if (asked != message.fields.end()) {
        child_.send(answer(asked->get<std::string>(), message, belief));
        continue;
      }
      const std::vector<ViewPose> views = values_of<ViewPose>(message.bytes);
      if (!message.fields.contains("view")) {
        child_.fail(message, iterations_, [](std::int64_t) { return ""; });
      }
      return views.empty() ? std::nullopt : std::optional(views.front());
    }
  }

  void on_view(const ViewRecord& view) {
    ++iterations_;
    current_ = view.decision.view;
    const Vec3& p_m = current_.p_world_m;
    child_.send({{{"event", "view"},
                  {"iteration", view.iteration},
                  {"x", p_m.x()},
                  {"y", p_m.y()},
                  {"z", p_m.z()},
                  {"yaw", current_.yaw_rad},
                  {"gimbal_pitch", current_.gimbal_pitch_rad},
                  {"entropy_nat", view.entropy_nat},
                  {"cloud_points", view.cloud_points},
                  {"flown_m", view.flown_m},
                  {"time_s", view.time_s}}});
  }

  void on_refused(Rejection reason) {
    child_.send({{{"event", "refused"}, {"reason", name_of(reason)}}});
  }

 private:
  Json about(const Belief& belief) const {
    const auto list = [](const Vec3& p_m) { return Json{p_m.x(), p_m.y(), p_m.z()}; };
    const Box3& navigation_m = tools_.model.navigation_m;
    return {{"event", "plan"},
            {"shape", grid_shape(belief)},
            {"resolution_m", belief.grid.geometry().resolution_m()},
            {"origin_m", list(grid_origin_m(belief))},
            {"density_max", belief.cloud.density_max()},
            {"entropy_nat", belief.grid.total_entropy_nat()},
            {"navigation_m", {list(navigation_m.min()), list(navigation_m.max())}},
            {"current", values_of<double>(bytes_of<ViewPose>({&current_, 1}))}};
  }

  Message answer(const std::string& asked, const Message& question, const Belief& belief) {
    const auto views = [&] { return values_of<ViewPose>(question.bytes); };
    if (asked == "log_odds") return {{}, bytes_of(belief.grid.all_log_odds())};
    if (asked == "words") return {{}, bytes_of(belief.grid.words())};
    if (asked == "cloud") return {{}, bytes_of(belief.cloud.points_world_m())};
    if (asked == "density") {
      const auto [voxels, densities] = voxel_densities(belief);
      return {{}, bytes_of<std::int64_t>(voxels) + bytes_of<double>(densities)};
    }
    if (asked == "sample") {
      return {{}, bytes_of<ViewPose>(views_around(tools_, current_, question.fields.at("scale")))};
    }
    if (asked == "sample_frontiers") {
      return {{}, bytes_of<ViewPose>(views_of_frontiers(tools_, belief))};
    }
    if (asked == "evaluate") {
      return {{}, bytes_of<ViewStats>(evaluated_views(tools_, belief, current_, views()))};
    }
    if (asked == "validate") return checked(belief, views());
    GNBV_CHECK(asked == "find_path", "a planner asks for '{}'", asked);
    return way(belief, values_of<double>(question.bytes));
  }

  Message checked(const Belief& belief, std::span<const ViewPose> views) {
    Json reasons = Json::array();
    std::vector<double> path_m;
    for (const Candidate& candidate : checked_views(tools_, belief, current_, views)) {
      reasons.push_back(candidate.rejected ? name_of(*candidate.rejected) : "");
      path_m.push_back(candidate.path_m);
    }
    return {{{"reasons", reasons}}, bytes_of<double>(path_m)};
  }

  Message way(const Belief& belief, const std::vector<double>& ends) const {
    const FoundPath found = way_around(tools_, belief, Vec3(ends.at(0), ends.at(1), ends.at(2)),
                                       Vec3(ends.at(3), ends.at(4), ends.at(5)));
    return {{{"found", !found.rejected}}, bytes_of<Vec3>(found.via_world_m)};
  }

  UserChild child_;
  BeliefTools tools_;
  ViewPose current_;
  std::size_t iterations_ = 0;  // the view that is being decided
};

bool has_utility(const UtilityConfig& config) {
  return is_user_utility(config.name) && !is_user_planner(config);
}

}  // namespace

UserScores start_user_utility(const UtilityConfig& config) {
  if (!has_utility(config)) return {};
  auto utility = std::make_shared<PythonUtility>(config);
  return [utility](const UserQuestion& question) { return (*utility)(question); };
}

UserScores lazy_user_utility(const UtilityConfig& config) {
  if (!has_utility(config)) return {};
  auto started = std::make_shared<UserScores>();
  return [started, config](const UserQuestion& question) {
    if (!*started) *started = start_user_utility(config);
    return (*started)(question);
  };
}

std::unique_ptr<UserPlanner> start_user_planner(const Scenario& scenario, int threads) {
  if (!is_user_planner(scenario.planner.utility)) return nullptr;
  auto planner = std::make_shared<PythonPlanner>(scenario, threads);
  return std::make_unique<UserPlanner>(
      UserPlanner{.plan = [planner](const Belief& belief) { return planner->plan(belief); },
                  .on_view = [planner](const ViewRecord& view) { planner->on_view(view); },
                  .on_refused = [planner](Rejection reason) { planner->on_refused(reason); }});
}

}  // namespace gnbv
