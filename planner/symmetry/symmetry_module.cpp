#include "planner/symmetry/symmetry_module.hpp"

#include "sim/core/module.hpp"

namespace gnbv {

const SymmetryModule& symmetry_module() {
  static const SymmetryModule module = [] {
    const ModulePlace place{GNBV_SYMMETRY_MODULE, GNBV_SYMMETRY_MODULE_AS_BUILT,
                            "PCL, Debian package libpcl-dev"};
    return SymmetryModule{
        reinterpret_cast<EstimateNormals*>(function_in_module(place, "gnbv_estimate_normals")),
        reinterpret_cast<MatchKeypoints*>(function_in_module(place, "gnbv_match_keypoints")),
        reinterpret_cast<RefinePlanes*>(function_in_module(place, "gnbv_refine_planes"))};
  }();
  return module;
}

}  // namespace gnbv
