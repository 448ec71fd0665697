#include "tools/python/belief_view.hpp"

#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <utility>

#include "planner/core/plan.hpp"
#include "planner/guided/view_sampling.hpp"
#include "planner/map/frontiers.hpp"
#include "planner/motion/paths.hpp"
#include "planner/view/view_stats.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

Vec3 vec3(const Point& p) { return {p[0], p[1], p[2]}; }

[[noreturn]] void raise_ended() {
  PyErr_SetString(PyExc_ReferenceError,
                  "belief: answers only during the call of the planner that it was handed to");
  throw nb::python_error();
}

/// Python's other threads run while one asks; none of them asks as well.
class Question {
 public:
  explicit Question(BeliefTools& tools) : lock_(tools.is_asked) {}
  ~Question() { lock_.unlock(); }  // first: who waits for it holds Python's
  Question(const Question&) = delete;
  Question& operator=(const Question&) = delete;

 private:
  std::unique_lock<std::mutex> lock_;
  nb::gil_scoped_release other_threads_run_;
};

}  // namespace

BeliefView::BeliefView(const Belief& belief, BeliefTools& tools, const ViewPose& current)
    : belief_(&belief), tools_(&tools), current_(current), lease_(nb::capsule(this)) {}

void BeliefView::end() {
  const std::lock_guard lock(tools().is_asked);
  belief_ = nullptr;
  tools_ = nullptr;
}

const Belief& BeliefView::belief() const {
  if (belief_ == nullptr) raise_ended();
  return *belief_;
}

BeliefTools& BeliefView::tools() const {
  if (tools_ == nullptr) raise_ended();
  return *tools_;
}

bool BeliefView::is_shared() const { return Py_REFCNT(lease_.ptr()) > 1; }

template <typename T>
nb::object BeliefView::grid_array(std::span<const T> values) const {
  const Key& size = belief().grid.geometry().size();
  const std::array<std::size_t, 3> shape = {static_cast<std::size_t>(size[2]),
                                            static_cast<std::size_t>(size[1]),
                                            static_cast<std::size_t>(size[0])};
  return shared_array(values, shape, lease_);
}

nb::object BeliefView::log_odds() const { return grid_array(belief().grid.all_log_odds()); }
nb::object BeliefView::words() const { return grid_array(belief().grid.words()); }

nb::object BeliefView::cloud() const {
  static_assert(sizeof(Vec3f) == 3 * sizeof(float));
  const std::span<const Vec3f> points = belief().cloud.points_world_m();
  const std::array<std::size_t, 2> shape = {points.size(), 3};
  const float* const first = points.empty() ? nullptr : points.front().data();
  return shared_array(std::span<const float>(first, 3 * points.size()), shape, lease_);
}

nb::tuple BeliefView::density() const {
  const std::span<const VoxelIndex> voxels = belief().cloud.voxels();
  std::vector<std::int64_t> indices(voxels.begin(), voxels.end());
  std::vector<double> densities;
  for (const VoxelIndex v : voxels) densities.push_back(belief().cloud.density(v));
  return nb::make_tuple(owned_array(std::move(indices)), owned_array(std::move(densities)));
}

Point BeliefView::origin_m() const {
  const Key& low = belief().grid.geometry().min_key();
  return {low[0] * resolution_m(), low[1] * resolution_m(), low[2] * resolution_m()};
}

nb::object BeliefView::current() const {
  static_cast<void>(belief());  // it is the place of its time
  return array_of(std::span(&current_, 1));
}

nb::object BeliefView::navigation_m() const {
  const Box3& box_m = tools().model.navigation_m;
  return owned_array(std::vector<double>{box_m.min().x(), box_m.min().y(), box_m.min().z(),
                                         box_m.max().x(), box_m.max().y(), box_m.max().z()},
                     3);
}

nb::object BeliefView::sample(double scale) const {
  return array_of(sample_agvs(tools().config.agvs, current_, scale, tools().model.pitches_rad));
}

nb::object BeliefView::sample_frontiers() const {
  const FvsConfig& fvs = tools().config.fvs;
  std::vector<ViewPose> views;
  for (const FrontierCluster& cluster : find_frontiers(fvs.frontier, belief().grid, belief().cloud,
                                                       tools().scratch.frontier_marks)) {
    const std::vector<ViewPose> around =
        sample_fvs(fvs, cluster.centroid_world_m, tools().model.pitches_rad);
    views.insert(views.end(), around.begin(), around.end());
  }
  return array_of(views);
}

nb::tuple BeliefView::validate(const ViewRows& rows) const {
  const Belief& seen = belief();
  std::vector<Candidate> candidates;
  for (const ViewPose& view : views_of(rows))
    candidates.push_back({.view = view, .sampler = Sampler::route});
  {
    const Question question(tools());
    const PlannerModel& model = tools().model;
    ViewChecker checker(model.validity_around, model.navigation_m, model.no_fly, seen.grid, {},
                        current_);
    for (Candidate& candidate : candidates) check(checker, model, candidate);
  }
  nb::list reasons;
  std::vector<double> path_m;
  for (const Candidate& candidate : candidates) {
    const std::string_view name = candidate.rejected ? name_of(*candidate.rejected) : "";
    reasons.append(nb::str(name.data(), name.size()));
    path_m.push_back(candidate.path_m);
  }
  return nb::make_tuple(reasons, owned_array(std::move(path_m)));
}

nb::bytes BeliefView::evaluate(const ViewRows& rows) const {
  const Belief& seen = belief();
  BeliefTools& with = tools();
  const PlannerModel& model = with.model;
  const std::vector<ViewPose> views = views_of(rows);
  std::vector<ViewStats> stats(views.size());
  const ViewOptions options = {
      .detail = ViewDetail::rays,
      .sparse_below = with.config.fvs.frontier.density_share * density_max()};
  {
    const Question question(with);
    std::vector<VisitMarks>& marks = with.scratch.marks;
    parallel_for(with.scratch.threads, marks.size(), [&](std::size_t share) {
      for (std::size_t i = share; i < views.size(); i += marks.size()) {
        stats[i] = evaluate_view(seen.grid, seen.cloud, model.rays_at(views[i].gimbal_pitch_rad),
                                 views[i], marks[share], options);
        stats[i].density_max = seen.cloud.density_max();
        stats[i].path_m = (views[i].p_world_m - current_.p_world_m).norm();
      }
    });
  }
  return nb::bytes(stats.data(), stats.size() * sizeof(ViewStats));
}

nb::object BeliefView::find_path(const Point& from_m, const Point& to_m) const {
  const PlannerModel& model = tools().model;
  const ValidityConfig& validity = model.validity;
  const FoundPath way = gnbv::find_path(validity.path_search,
                                        {belief().grid, model.navigation_m, model.no_fly,
                                         validity.collision_radius_m, validity.allow_unknown},
                                        vec3(from_m), vec3(to_m));
  if (way.rejected) return nb::none();
  std::vector<double> rows;
  for (const Vec3& p_m : way.via_world_m) rows.insert(rows.end(), p_m.begin(), p_m.end());
  return owned_array(std::move(rows), 3);
}

nb::dict view_stats_dtype() {
  nb::list names, formats, offsets;
  for (const ViewField& field : kViewFields) {
    if (field.needs == ViewFieldNeeds::shadow) continue;
    names.append(nb::str(field.name.data(), field.name.size()));
    formats.append(nb::str(field.format.data(), field.format.size()));
    offsets.append(field.offset);
  }
  nb::dict dtype;
  dtype["names"] = names;
  dtype["formats"] = formats;
  dtype["offsets"] = offsets;
  dtype["itemsize"] = sizeof(ViewStats);
  return dtype;
}

void bind_belief(nb::module_& m) {
  nb::class_<BeliefView>(m, "BeliefView")
      .def_prop_ro("log_odds", &BeliefView::log_odds,
                   nb::sig("def log_odds(self) -> numpy.typing.NDArray[numpy.float32]"))
      .def_prop_ro("words", &BeliefView::words,
                   nb::sig("def words(self) -> numpy.typing.NDArray[numpy.uint32]"))
      .def_prop_ro("cloud", &BeliefView::cloud,
                   nb::sig("def cloud(self) -> numpy.typing.NDArray[numpy.float32]"))
      .def_prop_ro("density", &BeliefView::density,
                   nb::sig("def density(self) -> tuple[numpy.typing.NDArray[numpy.int64], "
                           "numpy.typing.NDArray[numpy.float64]]"))
      .def_prop_ro("resolution_m", &BeliefView::resolution_m)
      .def_prop_ro("origin_m", &BeliefView::origin_m)
      .def_prop_ro("density_max", &BeliefView::density_max)
      .def_prop_ro("entropy_nat", &BeliefView::entropy_nat)
      .def_prop_ro("current", &BeliefView::current,
                   nb::sig("def current(self) -> numpy.typing.NDArray[numpy.float64]"))
      .def_prop_ro("navigation_m", &BeliefView::navigation_m,
                   nb::sig("def navigation_m(self) -> numpy.typing.NDArray[numpy.float64]"))
      .def("sample", &BeliefView::sample, nb::arg("scale"),
           nb::sig("def sample(self, scale: float) -> numpy.typing.NDArray[numpy.float64]"))
      .def("sample_frontiers", &BeliefView::sample_frontiers,
           nb::sig("def sample_frontiers(self) -> numpy.typing.NDArray[numpy.float64]"))
      .def("validate", &BeliefView::validate, nb::arg("views"),
           nb::sig("def validate(self, views: numpy.typing.NDArray[numpy.float64]) -> "
                   "tuple[list[str], numpy.typing.NDArray[numpy.float64]]"))
      .def("evaluate", &BeliefView::evaluate, nb::arg("views"),
           nb::sig("def evaluate(self, views: numpy.typing.NDArray[numpy.float64]) -> bytes"))
      .def(
          "find_path", &BeliefView::find_path, nb::arg("from_m"), nb::arg("to_m"),
          nb::sig("def find_path(self, from_m: collections.abc.Sequence[float], to_m: "
                  "collections.abc.Sequence[float]) -> numpy.typing.NDArray[numpy.float64] | None"))
      .def("is_shared", &BeliefView::is_shared);
  m.def("view_stats_dtype", &view_stats_dtype, nb::sig("def view_stats_dtype() -> typing.Any"));
}

}  // namespace gnbv
