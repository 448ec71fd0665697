// gnbv.run: one mission in this process, with a planner of Python's if there is one.
#pragma once

#include <nanobind/nanobind.h>

namespace gnbv {

void bind_run(nanobind::module_& m);

}  // namespace gnbv
