// gnbv._core: what the Python package gnbv calls.
#include <nanobind/nanobind.h>

#include <filesystem>

#include "scenarios/validation_error.hpp"
#include "sim/core/error.hpp"
#include "tools/python/belief_view.hpp"
#include "tools/python/env_bindings.hpp"
#include "tools/python/map_file.hpp"
#include "tools/python/run_mission.hpp"

namespace {

namespace nb = nanobind;

/// gnbv.BadInput(message, [(file, line, key, value, what), ...]).
void raise_bad_input(const char* text, std::span<const gnbv::ValidationError> errors) {
  nb::list faults;
  for (const auto& [location, key, value, what] : errors) {
    faults.append(nb::make_tuple(nb::str(location.source.c_str()), location.line,
                                 nb::str(key.c_str()), nb::str(value.c_str()),
                                 nb::str(what.c_str())));
  }
  const nb::object type = nb::module_::import_("gnbv._errors").attr("BadInput");
  PyErr_SetObject(type.ptr(), type(nb::str(text), faults).ptr());
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
    PyErr_SetString(nb::module_::import_("gnbv._errors").attr("BrokenInvariant").ptr(),
                    error.what());
  }
}

}  // namespace

NB_MODULE(_core, m) {
  nb::set_leak_warnings(false);  // an array that a planner kept is never freed: run_mission.cpp
  m.attr("__version__") = GNBV_VERSION;
  nb::register_exception_translator(translate);
  gnbv::bind_belief(m);
  gnbv::bind_run(m);
  gnbv::bind_env(m);
  gnbv::bind_map_file(m);
}
