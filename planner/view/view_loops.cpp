// The view kernels, once for each SimdLevel.
#include "planner/view/prepare_loops.hpp"
#include "planner/view/tally_loops.hpp"
#include "planner/view/view_kernels.hpp"
#include "planner/view/walk_loops.hpp"

namespace gnbv::GNBV_SIMD_LEVEL {

const ViewKernels kViewKernels = {.prepare = prepare_rays,
                                  .walk_voxels = walk_rays<false>,
                                  .walk_full = walk_rays<true>,
                                  .tally_plane = tally_plane};

}  // namespace gnbv::GNBV_SIMD_LEVEL
