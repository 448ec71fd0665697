// gnbv._core: what the Python package gnbv calls.
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <filesystem>

#include "planner/map/octomap_io.hpp"
#include "scenarios/validation_error.hpp"
#include "sim/core/error.hpp"
#include "tools/python/arrays.hpp"
#include "tools/python/belief_view.hpp"
#include "tools/python/bindings.hpp"
#include "tools/python/frame_arrays.hpp"
#include "tools/run/cloud_file.hpp"

namespace {

namespace nb = nanobind;

/// As the program prints it: bytes that are no UTF-8 as \xNN.
nb::object text_of(const std::string& bytes) {
  return nb::steal(PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()),
                                        "backslashreplace"));
}

/// gnbv.BadInput(message, [(file, line, key, value, what), ...]).
void raise_bad_input(const char* text, std::span<const gnbv::ValidationError> errors) {
  nb::list faults;
  for (const auto& [location, key, value, what] : errors) {
    faults.append(nb::make_tuple(text_of(location.source), location.line, text_of(key),
                                 text_of(value), text_of(what)));
  }
  const nb::object type = nb::module_::import_("gnbv._errors").attr("BadInput");
  PyErr_SetObject(type.ptr(), type(text_of(text), faults).ptr());
}

void translate(const std::exception_ptr& thrown, void*) {
  try {
    std::rethrow_exception(thrown);
  } catch (const gnbv::BadScenario& error) {
    raise_bad_input(error.what(), error.errors);
  } catch (const gnbv::BadInput& error) {
    raise_bad_input(error.what(), {});
  } catch (const std::filesystem::filesystem_error& error) {
    raise_bad_input((error.path1().string() + ": " + error.code().message()).c_str(), {});
  } catch (const gnbv::BrokenInvariant& error) {
    PyErr_SetObject(nb::module_::import_("gnbv._errors").attr("BrokenInvariant").ptr(),
                    text_of(error.what()).ptr());
  }
}

/// x, y, z of its centre, size, log-odds of each leaf; m, world ENU.
nb::object read_map(const std::string& path) {
  const gnbv::OctomapLeaves read = gnbv::read_octomap(path);
  std::vector<double> rows;
  for (const gnbv::OctomapLeaf& leaf : read.leaves) {
    const double half_m = 0.5 * leaf.edge_voxels * read.voxel_m;
    for (const std::int32_t low : leaf.first) rows.push_back(low * read.voxel_m + half_m);
    rows.insert(rows.end(), {2.0 * half_m, static_cast<double>(leaf.log_odds)});
  }
  return gnbv::owned_array(std::move(rows), 5);
}

/// x, y, z of each point; m, world ENU.
nb::object read_cloud(const std::string& path) {
  std::vector<float> rows;
  for (const gnbv::Vec3f& p_m : gnbv::read_cloud(path))
    rows.insert(rows.end(), p_m.begin(), p_m.end());
  return gnbv::owned_array(std::move(rows), 3);
}

}  // namespace

NB_MODULE(_core, m) {
  nb::set_leak_warnings(false);  // an array that a planner kept is never freed: run_mission.cpp
  m.attr("__version__") = GNBV_VERSION;
  nb::register_exception_translator(translate);
  gnbv::bind_belief(m);
  gnbv::bind_run(m);
  gnbv::bind_env(m);
  gnbv::bind_frames(m);
  m.def("read_map", &read_map, nb::arg("path"),
        nb::sig("def read_map(path: str) -> numpy.typing.NDArray[numpy.float64]"));
  m.def("read_cloud", &read_cloud, nb::arg("path"),
        nb::sig("def read_cloud(path: str) -> numpy.typing.NDArray[numpy.float32]"));
}
