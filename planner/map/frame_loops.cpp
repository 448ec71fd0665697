// The frame kernels, once for each SimdLevel.
#include "planner/map/pixel_loops.hpp"
#include "planner/map/voxel_loops.hpp"

namespace gnbv::GNBV_SIMD_LEVEL {

const FrameKernels kFrameKernels = {.rays_of_row = rays_of_row,
                                    .ends_of_row = ends_of_row,
                                    .invert_row = invert_row,
                                    .project_layer = project_layer};

}  // namespace gnbv::GNBV_SIMD_LEVEL
