#include "tools/python/belief_view.hpp"

#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>

#include <utility>

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
  explicit Question(AskedTools& tools) : lock_(tools.is_asked) {}
  ~Question() { lock_.unlock(); }  // first: who waits for it holds Python's
  Question(const Question&) = delete;
  Question& operator=(const Question&) = delete;

 private:
  std::unique_lock<std::mutex> lock_;
  nb::gil_scoped_release other_threads_run_;
};

}  // namespace

BeliefView::BeliefView(const Belief& belief, AskedTools& tools, const ViewPose& current)
    : belief_(&belief), tools_(&tools), current_(current), lease_(nb::capsule(this)) {}

BeliefView::BeliefView(std::shared_ptr<const Belief> belief, std::shared_ptr<AskedTools> tools,
                       const ViewPose& current)
    : belief_(belief.get()),
      tools_(tools.get()),
      current_(current),
      kept_tools_(std::move(tools)),
      lease_(nb::capsule(
          new std::shared_ptr<const Belief>(std::move(belief)),
          [](void* p) noexcept { delete static_cast<std::shared_ptr<const Belief>*>(p); })) {}

void BeliefView::end() {
  const std::lock_guard lock(tools().is_asked);
  belief_ = nullptr;
  tools_ = nullptr;
}

const Belief& BeliefView::belief() const {
  if (belief_ == nullptr) raise_ended();
  return *belief_;
}

AskedTools& BeliefView::tools() const {
  if (tools_ == nullptr) raise_ended();
  return *tools_;
}

bool BeliefView::is_shared() const { return Py_REFCNT(lease_.ptr()) > 1; }

template <typename T>
nb::object BeliefView::grid_array(std::span<const T> values) const {
  return shared_array(values, grid_shape(belief()), lease_);
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
  auto [voxels, densities] = voxel_densities(belief());
  return nb::make_tuple(owned_array(std::move(voxels)), owned_array(std::move(densities)));
}

Point BeliefView::origin_m() const {
  const Vec3 low_m = grid_origin_m(belief());
  return {low_m.x(), low_m.y(), low_m.z()};
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
  return array_of(views_around(tools(), current_, scale));
}

nb::object BeliefView::sample_frontiers() const {
  return array_of(views_of_frontiers(tools(), belief()));
}

nb::tuple BeliefView::validate(const ViewRows& rows) const {
  const Belief& seen = belief();
  const std::vector<ViewPose> views = views_of(rows);
  std::vector<Candidate> checked;
  {
    const Question question(tools());
    checked = checked_views(tools(), seen, current_, views);
  }
  nb::list reasons;
  std::vector<double> path_m;
  for (const Candidate& candidate : checked) {
    const std::string_view name = candidate.rejected ? name_of(*candidate.rejected) : "";
    reasons.append(nb::str(name.data(), name.size()));
    path_m.push_back(candidate.path_m);
  }
  return nb::make_tuple(reasons, owned_array(std::move(path_m)));
}

nb::bytes BeliefView::evaluate(const ViewRows& rows) const {
  const Belief& seen = belief();
  const std::vector<ViewPose> views = views_of(rows);
  std::vector<ViewStats> stats;
  {
    const Question question(tools());
    stats = evaluated_views(tools(), seen, current_, views);
  }
  return nb::bytes(stats.data(), stats.size() * sizeof(ViewStats));
}

nb::object BeliefView::find_path(const Point& from_m, const Point& to_m) const {
  const FoundPath way = way_around(tools(), belief(), vec3(from_m), vec3(to_m));
  if (way.rejected) return nb::none();
  std::vector<double> rows;
  for (const Vec3& p_m : way.via_world_m) rows.insert(rows.end(), p_m.begin(), p_m.end());
  return owned_array(std::move(rows), 3);
}

/// NumPy's dtype of ViewStats as evaluate() fills it.
static nb::dict view_stats_dtype() {
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
      .def_prop_ro(
          "stats_dtype", [](const BeliefView&) { return view_stats_dtype(); },
          nb::sig("def stats_dtype(self) -> typing.Any"))
      .def("is_shared", &BeliefView::is_shared);
}

}  // namespace gnbv
