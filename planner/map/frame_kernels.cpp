#include "planner/map/frame_kernels.hpp"

#include "sim/core/simd.hpp"

namespace gnbv {

const FrameKernels& frame_kernels() {
  switch (simd_level()) {
    case SimdLevel::avx512:
      return kFrameKernelsAvx512;
    case SimdLevel::avx2:
      return kFrameKernelsAvx2;
    case SimdLevel::scalar:
      break;
  }
  return kFrameKernelsSse2;
}

}  // namespace gnbv
