#include "planner/map/frame_kernels.hpp"

#include "sim/core/simd.hpp"

namespace gnbv {

const FrameKernels& frame_kernels() {
  return at_simd_level(at_baseline::kFrameKernels, at_avx2::kFrameKernels,
                       at_avx512::kFrameKernels);
}

}  // namespace gnbv
