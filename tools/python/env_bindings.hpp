// The environments of gnbv.gym.
#pragma once

#include <nanobind/nanobind.h>

namespace gnbv {

void bind_env(nanobind::module_& m);

}  // namespace gnbv
