#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "sim/core/error.hpp"
#include "tools/python/arrays.hpp"
#include "tools/python/belief_view.hpp"
#include "tools/python/bindings.hpp"
#include "tools/python/env_mission.hpp"

namespace gnbv {
namespace {

template <typename Values>
nb::object floats(const Values& values) {
  return owned_array(std::vector<float>(values.begin(), values.end()));
}

nb::dict dict_of(const EnvState& state, const EnvStage& stage) {
  nb::dict out;
  out["ended"] = state.ended;
  out["termination"] = state.termination;
  out["refused"] = state.refused;
  out["coverage"] = state.coverage;
  out["entropy_nat"] = state.entropy_nat;
  out["cloud_points"] = state.cloud_points;
  out["flown_m"] = state.flown_m;
  out["time_s"] = state.time_s;
  out["view"] = array_of(std::span(&state.pose, 1));
  out["map"] = floats(state.seen.map);
  out["pose"] = floats(state.seen.pose);
  out["entropy_left"] = state.seen.entropy_left;
  if (!state.top.empty()) put_top(state.grid, state.top, out);
  if (!state.crop.empty()) out["crop"] = floats(state.crop);
  if (state.frames) out["frames"] = frames_of(*state.frames, camera_models(stage.scenario));
  out["views"] = owned_array(state.seen.views, 5);
  out["mask"] = owned_array(state.seen.mask);
  out["candidates"] = owned_array(state.seen.candidates, kCandidateFeatures);
  return out;
}

nb::dict description(const EnvStage& stage) {
  const Scenario& scenario = stage.scenario;
  const PlannerModel model = planner_model(scenario);
  const EnvObserver observer(scenario.planner, model, stage.scales);
  const Box3& box_m = model.navigation_m;
  nb::dict out;
  out["ceiling"] = stage.ceiling;
  out["max_iterations"] = scenario.planner.termination.max_iterations;
  out["low_m"] = nb::make_tuple(box_m.min().x(), box_m.min().y(), box_m.min().z());
  out["high_m"] = nb::make_tuple(box_m.max().x(), box_m.max().y(), box_m.max().z());
  out["candidates"] = observer.candidate_count();
  out["features"] = kCandidateFeatures;
  nb::list cameras;
  for (const CameraConfig& camera : scenario.cameras) {
    cameras.append(
        nb::make_tuple(camera.name, camera.height_px, camera.width_px, camera.range_max_m));
  }
  out["cameras"] = cameras;
  out["map_shape"] = nb::make_tuple(3, kCoarseCells[0], kCoarseCells[1], kCoarseCells[2]);
  if (model.gimbal)
    out["gimbal_rad"] = nb::make_tuple(model.gimbal->min_rad, model.gimbal->max_rad);
  return out;
}

void act(EnvMission& env, const ViewRows& rows) {
  if (rows.shape(0) != 1) throw BadInput("env: expected one view");
  env.act(views_of(rows).front());
}

/// Asks until there is an answer, without the GIL; between two slices Python's signals are seen, so
/// that Ctrl-C raises.
auto until_answered(const auto& ask) {
  while (true) {
    {
      const nb::gil_scoped_release other_threads_run;
      if (const auto answer = ask()) return answer;
    }
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
  }
}

nb::dict wait(EnvMission& env) {
  return dict_of(*until_answered([&env] { return env.wait(); }), env.stage());
}

/// What is believed now, apart from the mission.
nb::object belief(EnvMission& env) {
  std::shared_ptr<const Belief> kept;
  std::shared_ptr<AskedTools> tools;
  ViewPose current;
  {
    const nb::gil_scoped_release other_threads_run;
    const auto moment = env.keep();
    current = moment->state.pose;
    kept = moment->mission
               ? std::shared_ptr<const Belief>(moment->mission, &belief_of(*moment->mission))
               : std::shared_ptr<const Belief>(moment->state.result, &moment->state.result->belief);
    const Scenario& scenario = env.stage().scenario;
    tools = std::make_shared<AskedTools>(scenario.planner, planner_model(scenario), 1);
  }
  return nb::cast(new BeliefView(std::move(kept), std::move(tools), current),
                  nb::rv_policy::take_ownership);
}

void close(EnvMission& env) {
  until_answered([&env] { return env.close(); });
}

template <typename Where>
void begin(EnvMission& env, Where where) {
  close(env);
  env.begin(std::move(where));
}

}  // namespace

void bind_env(nb::module_& m) {
  using Free = nb::call_guard<nb::gil_scoped_release>;
  nb::class_<EnvStage>(m, "EnvStage")
      .def(nb::init<const std::string&, const std::vector<std::string>&, double, std::size_t>(),
           nb::arg("scenario"), nb::arg("overrides"), nb::arg("goal"), nb::arg("seeds"), Free())
      .def_prop_ro("description", &description,
                   nb::sig("def description(self) -> dict[str, typing.Any]"));
  nb::class_<EnvMoment>(m, "EnvMoment");
  nb::class_<EnvWishes>(m, "EnvWishes")
      .def(nb::init<bool, bool, bool, bool, int>(), nb::arg("candidates"), nb::arg("top"),
           nb::arg("frames"), nb::arg("colour"), nb::arg("crop"));
  nb::class_<Permits>(m, "Permits").def(nb::init<int>(), nb::arg("count"));
  nb::class_<EnvMission>(m, "EnvMission")
      .def(nb::init<std::shared_ptr<const EnvStage>, std::shared_ptr<Permits>, const EnvWishes&>(),
           nb::arg("stage"), nb::arg("permits"), nb::arg("wishes"))
      .def("begin", &begin<std::uint64_t>, nb::arg("seed"))
      .def("resume", &begin<std::shared_ptr<const EnvMoment>>, nb::arg("moment"))
      .def("keep", &EnvMission::keep, Free())
      .def("belief", &belief, nb::sig("def belief(self) -> BeliefView"))
      .def("result_sha256", &EnvMission::result_sha256, Free())
      .def("act", &act, nb::arg("view"),
           nb::sig("def act(self, view: numpy.typing.NDArray[numpy.float64]) -> None"))
      .def("wait", &wait, nb::sig("def wait(self) -> dict[str, typing.Any]"))
      .def("close", &close);
}

}  // namespace gnbv
