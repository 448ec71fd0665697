#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <memory>

#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "tools/mission/execute.hpp"
#include "tools/mission/resolve.hpp"
#include "tools/python/belief_view.hpp"
#include "tools/python/bindings.hpp"
#include "tools/python/env_observation.hpp"
#include "tools/python/frame_arrays.hpp"
#include "tools/run/file_names.hpp"
#include "tools/terminal/interrupt.hpp"

namespace gnbv {
namespace {

/// What Python says, to be raised when the mission has ended in order.
struct Raised {
  std::unique_ptr<nb::python_error> error;
  void keep(nb::python_error& raised) {
    if (!error) error = std::make_unique<nb::python_error>(std::move(raised));
  }
};

nb::dict row_of(const ViewRecord& view) {
  nb::dict row;
  const ViewPose& pose = view.decision.view;
  row["iteration"] = view.iteration;
  row["x"] = pose.p_world_m.x();
  row["y"] = pose.p_world_m.y();
  row["z"] = pose.p_world_m.z();
  row["yaw"] = pose.yaw_rad;
  row["gimbal_pitch"] = pose.gimbal_pitch_rad;
  row["entropy_nat"] = view.entropy_nat;
  row["cloud_points"] = view.cloud_points;
  row["flown_m"] = view.flown_m;
  row["time_s"] = view.time_s;
  return row;
}

/// However a call ends: its belief answers no more, and whether arrays of it are still in use.
class EndOfCall {
 public:
  EndOfCall(BeliefView& view, bool& has_kept) : view_(view), has_kept_(has_kept) {}
  ~EndOfCall() {
    view_.end();
    has_kept_ = has_kept_ || view_.is_shared();
  }
  EndOfCall(const EndOfCall&) = delete;
  EndOfCall& operator=(const EndOfCall&) = delete;

 private:
  BeliefView& view_;
  bool& has_kept_;
};

/// Asks a Python object with the methods plan(belief), on_view(row) and on_refused(reason).
class AskedPlanner {
 public:
  AskedPlanner(nb::object planner, const Scenario& scenario, int threads, Raised& raised)
      : python_(std::move(planner)), raised_(raised) {
    tools_ = std::make_unique<AskedTools>(scenario.planner, planner_model(scenario), threads);
  }

  UserPlanner hooks() {
    return {
        .plan = [this](const Belief& belief) { return plan(belief); },
        .on_view = [this](const ViewRecord& view) { tell_view(view); },
        .on_sensed = [this](const SensedView& view) { seen_ = std::make_shared<KeptView>(view); },
        .on_refused =
            [this](Rejection reason) {
              tell("on_refused", [&] { return std::string(name_of(reason)); });
            }};
  }
  /// Whether arrays of the belief may be in use: in Python's hands, or its exception's.
  bool has_kept() const { return has_kept_; }

 private:
  std::optional<ViewPose> plan(const Belief& belief) {
    const nb::gil_scoped_acquire python_runs;
    if (raised_.error) return std::nullopt;
    auto* const view = new BeliefView(belief, *tools_, current_);
    const nb::object held = nb::cast(view, nb::rv_policy::take_ownership);
    const EndOfCall end(*view, has_kept_);
    try {
      const nb::object answer = python_.attr("plan")(held, frames());
      if (view->is_shared()) nb::module_::import_("gc").attr("collect")();
      if (view->is_shared()) python_.attr("kept")();
      if (answer.is_none()) return std::nullopt;
      const auto views = views_of(nb::cast<ViewRows>(answer));
      return views.empty() ? std::nullopt : std::optional(views.front());
    } catch (nb::python_error& error) {
      raised_.keep(error);
      return std::nullopt;
    }
  }

  /// Those of the latest view, when somebody calls for them.
  nb::object frames() const {
    return nb::cpp_function([seen = seen_, cameras = tools_->model.cameras] {
      return seen ? frames_of(*seen, cameras) : nb::list();
    });
  }

  void tell_view(const ViewRecord& view) {
    current_ = view.decision.view;
    tell("on_view", [&] { return row_of(view); });
  }

  /// Calls the method with what `made` makes while Python waits.
  template <typename Made>
  void tell(const char* method, const Made& made) {
    const nb::gil_scoped_acquire python_runs;
    try {
      python_.attr(method)(made());
    } catch (nb::python_error& error) {
      raised_.keep(error);
    }
  }

  nb::object python_;
  Raised& raised_;
  std::unique_ptr<AskedTools> tools_;
  ViewPose current_;
  std::shared_ptr<const KeptView> seen_;
  bool has_kept_ = false;
};

/// Tells a Python function of each view, with the map from above.
class ViewTeller final : public MissionObserver {
 public:
  ViewTeller(nb::object function, Raised& raised)
      : function_(std::move(function)), raised_(raised) {}

  void on_view(const ViewRecord& view, const Belief& belief) override {
    std::vector<float> top = top_view(belief.grid);
    const nb::gil_scoped_acquire python_runs;
    if (raised_.error) return;
    try {
      nb::dict row = row_of(view);
      put_top(belief.grid.geometry(), std::move(top), row);
      function_(row);
    } catch (nb::python_error& error) {
      raised_.keep(error);
    }
  }

 private:
  nb::object function_;
  Raised& raised_;
};

struct RunArguments {
  ScenarioOptions scenario;
  MissionOptions mission;
};

RunArguments arguments_of(const nb::dict& given) {
  const auto text = [&](const char* key) { return nb::cast<std::string>(given[key]); };
  const auto flag = [&](const char* key) { return nb::cast<bool>(given[key]); };
  RunArguments out;
  out.scenario = {.scenario = text("scenario"),
                  .mesh = text("mesh"),
                  .utility = text("utility"),
                  .preset = text("preset"),
                  .seed = text("seed"),
                  .overrides = nb::cast<std::vector<std::string>>(given["overrides"]),
                  .views = {},
                  .bounds_auto = flag("bounds_auto")};
  out.mission.out = text("out");
  out.mission.threads = nb::cast<int>(given["threads"]);
  out.mission.resume = flag("resume");
  out.mission.quiet = true;
  out.mission.candidates = flag("candidates");
  out.mission.frames = flag("frames");
  if (flag("ceiling")) out.mission.ceiling = CeilingFrom::search;
  return out;
}

/// folder, termination, failure.
nb::tuple run(const nb::dict& given, nb::object planner, nb::object on_progress,
              nb::object on_view) {
  RunArguments arguments = arguments_of(given);
  MissionOptions& options = arguments.mission;
  std::vector<std::string> unused_notes;
  Scenario scenario = resolve_scenario(arguments.scenario, &unused_notes);
  if (const auto begun = options.out / kScenarioFile;
      !planner.is_none() && options.resume && std::filesystem::exists(begun)) {
    // of a mission that was finished, which holds its views
    scenario.planner.routes.views = load_flown_scenario(begun.string()).planner.routes.views;
  }
  for (const std::string& note : unused_notes) fmt::print(stderr, "gnbv: {}\n", note);
  Raised raised;
  options.should_stop = [&raised] { return raised.error != nullptr; };
  if (!on_progress.is_none()) {
    options.on_progress = [&](double share, const std::string& note) {
      const nb::gil_scoped_acquire python_runs;
      try {
        on_progress(share, note);
      } catch (nb::python_error& error) {
        raised.keep(error);
      }
    };
  }
  std::optional<ViewTeller> teller;
  if (!on_view.is_none()) options.observer = &teller.emplace(on_view, raised);
  std::unique_ptr<AskedPlanner> asked;
  UserPlanner hooks;
  if (!planner.is_none()) {
    asked =
        std::make_unique<AskedPlanner>(planner, scenario, thread_count(options.threads), raised);
    hooks = asked->hooks();
    options.planner = &hooks;
  }
  std::unique_ptr<ExecutedMission> mission;
  {
    const nb::gil_scoped_release other_threads_run;
    const InterruptGuard interrupt(InterruptGuard::kGuest);
    mission = std::make_unique<ExecutedMission>(execute_mission(scenario, options));
    mission->interrupt.reset();  // arrays that are kept keep the mission
    const bool is_heard = mission->result.termination == Termination::interrupted;
    // it is for Python, then; a second one it has already
    if (InterruptGuard::requests() == 1 && !is_heard) PyErr_SetInterrupt();
  }
  const MissionResult& result = mission->result;
  const std::string_view ended = name_of(result.termination);
  nb::tuple out = nb::make_tuple(mission->folder.string(), std::string(ended), result.failure);
  if (raised.error) {
    if (asked && asked->has_kept()) mission.release();  // so that they stay readable
    throw nb::python_error(std::move(*raised.error));
  }
  return out;
}

}  // namespace

void bind_run(nb::module_& m) {
  m.def("run", &run, nb::arg("arguments"), nb::arg("planner").none(), nb::arg("on_progress").none(),
        nb::arg("on_view").none(),
        nb::sig("def run(arguments: dict[str, typing.Any], planner: object | None, on_progress: "
                "collections.abc.Callable[[float, str], None] | None, on_view: "
                "collections.abc.Callable[[dict[str, typing.Any]], None] | None) -> "
                "tuple[str, str, str]"));
  m.def("utilities", [] {
    std::vector<std::string> names;
    for (const std::string_view name : utility_names()) names.emplace_back(name);
    return names;
  });
}

}  // namespace gnbv
