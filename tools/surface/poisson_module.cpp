#include "tools/surface/poisson_module.hpp"

#include "sim/core/module.hpp"

namespace gnbv {

PoissonSurface& poisson_module() {
  static void* const function = function_in_module(
      {GNBV_POISSON_MODULE, GNBV_POISSON_MODULE_AS_BUILT, "PCL, Debian package libpcl-dev"},
      "gnbv_poisson_surface");
  return *reinterpret_cast<PoissonSurface*>(function);
}

}  // namespace gnbv
