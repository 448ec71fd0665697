// map.ot as arrays.
#pragma once

#include <nanobind/nanobind.h>

namespace gnbv {

void bind_map_file(nanobind::module_& m);

}  // namespace gnbv
