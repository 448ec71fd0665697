// The parts of gnbv._core, beside belief_view.hpp.
#pragma once

#include <nanobind/nanobind.h>

namespace gnbv {

/// gnbv.run: one mission in this process, with a planner of Python's if there is one.
void bind_run(nanobind::module_& m);
/// The environments of gnbv.gym.
void bind_env(nanobind::module_& m);

}  // namespace gnbv
