// SurfaceCloud's loops for any x86-64.
#include <emmintrin.h>

#include "planner/map/cloud_kernels.hpp"

namespace gnbv::cloud_scalar {
namespace {

inline std::uint32_t near_mask(const PointBlock& block, const float* p_m, float radius2_m2) {
  const __m128 px = _mm_set1_ps(p_m[0]);
  const __m128 py = _mm_set1_ps(p_m[1]);
  const __m128 pz = _mm_set1_ps(p_m[2]);
  const __m128 radius2 = _mm_set1_ps(radius2_m2);
  std::uint32_t mask = 0;
  for (std::uint32_t i = 0; i < kPointsPerBlock; i += 4) {
    const __m128 dx = _mm_sub_ps(_mm_load_ps(block.x_m + i), px);
    const __m128 dy = _mm_sub_ps(_mm_load_ps(block.y_m + i), py);
    const __m128 dz = _mm_sub_ps(_mm_load_ps(block.z_m + i), pz);
    const __m128 xy = _mm_add_ps(_mm_mul_ps(dx, dx), _mm_mul_ps(dy, dy));
    const __m128 d2 = _mm_add_ps(xy, _mm_mul_ps(dz, dz));
    mask |= static_cast<std::uint32_t>(_mm_movemask_ps(_mm_cmple_ps(d2, radius2))) << i;
  }
  return mask;
}

inline std::size_t find_in_lanes(const LeafTable&, const PixelColumns&, std::size_t begin,
                                 std::size_t, std::uint32_t*, std::size_t&) {
  return begin;
}

#include "planner/map/cloud_kernels.inl"

}  // namespace

const CloudKernels kKernels = {find_untaken, count_neighbours};

}  // namespace gnbv::cloud_scalar
