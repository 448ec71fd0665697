// SurfaceCloud's loops for AVX2: eight points at once.
#include <immintrin.h>

#include "planner/map/cloud_kernels.hpp"

namespace gnbv::cloud_avx2 {
namespace {

inline std::uint32_t near_mask(const PointBlock& block, const float* p_m, float radius2_m2) {
  const __m256 px = _mm256_set1_ps(p_m[0]);
  const __m256 py = _mm256_set1_ps(p_m[1]);
  const __m256 pz = _mm256_set1_ps(p_m[2]);
  const __m256 radius2 = _mm256_set1_ps(radius2_m2);
  std::uint32_t mask = 0;
  for (std::uint32_t i = 0; i < kPointsPerBlock; i += 8) {
    const __m256 dx = _mm256_sub_ps(_mm256_load_ps(block.x_m + i), px);
    const __m256 dy = _mm256_sub_ps(_mm256_load_ps(block.y_m + i), py);
    const __m256 dz = _mm256_sub_ps(_mm256_load_ps(block.z_m + i), pz);
    const __m256 xy = _mm256_add_ps(_mm256_mul_ps(dx, dx), _mm256_mul_ps(dy, dy));
    const __m256 d2 = _mm256_add_ps(xy, _mm256_mul_ps(dz, dz));
    const int near = _mm256_movemask_ps(_mm256_cmp_ps(d2, radius2, _CMP_LE_OQ));
    mask |= static_cast<std::uint32_t>(near) << i;
  }
  return mask;
}

/// along_axis() for eight points.
struct LanesAlongAxis {
  __m256i cell, in_bucket;
  LanesAlongAxis(const LeafTable& t, int axis, __m256 p_m) {
    const __m256 scaled = _mm256_mul_ps(p_m, _mm256_set1_ps(t.inverse_leaf_1_m));
    const __m256i leaf = _mm256_cvttps_epi32(_mm256_floor_ps(scaled));
    const __m256i s = _mm256_sub_epi32(leaf, _mm256_set1_epi32(t.first_leaf[axis]));
    const __m256 middle = _mm256_add_ps(_mm256_cvtepi32_ps(s), _mm256_set1_ps(0.5F));
    const float inverse = 1.0F / static_cast<float>(t.leaves_per_bucket);
    cell = _mm256_cvttps_epi32(_mm256_mul_ps(middle, _mm256_set1_ps(inverse)));
    in_bucket =
        _mm256_sub_epi32(s, _mm256_mullo_epi32(cell, _mm256_set1_epi32(t.leaves_per_bucket)));
  }
};

inline __m256i combine(const __m256i z, const __m256i y, const __m256i x, std::int32_t y_count,
                       std::int32_t x_count) {
  const __m256i zy = _mm256_add_epi32(_mm256_mullo_epi32(z, _mm256_set1_epi32(y_count)), y);
  return _mm256_add_epi32(_mm256_mullo_epi32(zy, _mm256_set1_epi32(x_count)), x);
}

inline __m256 within(__m256 p_m, float low_m, float high_m) {
  return _mm256_and_ps(_mm256_cmp_ps(p_m, _mm256_set1_ps(low_m), _CMP_GE_OQ),
                       _mm256_cmp_ps(p_m, _mm256_set1_ps(high_m), _CMP_LE_OQ));
}

/// A bit for each of the lanes of `wanted` whose leaf is not taken.
inline std::uint32_t untaken_mask(const LeafTable& t, __m256 x_m, __m256 y_m, __m256 z_m,
                                  __m256i wanted) {
  const LanesAlongAxis x(t, 0, x_m);
  const LanesAlongAxis y(t, 1, y_m);
  const LanesAlongAxis z(t, 2, z_m);
  const __m256i cell = combine(z.cell, y.cell, x.cell, t.cells_y, t.cells_x);
  const std::int32_t n = t.leaves_per_bucket;
  const __m256i bit = combine(z.in_bucket, y.in_bucket, x.in_bucket, n, n);
  const __m256i none = _mm256_setzero_si256();
  const __m256i bucket =
      _mm256_mask_i32gather_epi32(none, reinterpret_cast<const int*>(t.bucket_at), cell, wanted, 4);
  const __m256i word_at = _mm256_add_epi32(
      _mm256_mullo_epi32(bucket, _mm256_set1_epi32(t.words_per_bucket)), _mm256_srli_epi32(bit, 5));
  const __m256i word =
      _mm256_mask_i32gather_epi32(none, reinterpret_cast<const int*>(t.taken), word_at, wanted, 4);
  const __m256i at_sign = _mm256_sllv_epi32(
      word, _mm256_sub_epi32(_mm256_set1_epi32(31), _mm256_and_si256(bit, _mm256_set1_epi32(31))));
  const int free = _mm256_movemask_ps(_mm256_castsi256_ps(_mm256_andnot_si256(at_sign, wanted)));
  return static_cast<std::uint32_t>(free);
}

inline std::size_t find_in_lanes(const LeafTable& t, const PixelColumns& pixels, std::size_t begin,
                                 std::size_t end, std::uint32_t* out, std::size_t& found) {
  std::size_t i = begin;
  for (; i + 8 <= end; i += 8) {
    const __m128i kinds = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(pixels.kind + i));
    const __m128i is_hit = _mm_cmpeq_epi8(kinds, _mm_set1_epi8(static_cast<char>(pixels.hits)));
    if ((_mm_movemask_epi8(is_hit) & 0xff) == 0) continue;
    const __m256 x_m = _mm256_loadu_ps(pixels.x_m + i);
    const __m256 y_m = _mm256_loadu_ps(pixels.y_m + i);
    const __m256 z_m = _mm256_loadu_ps(pixels.z_m + i);
    const __m256 inside = _mm256_and_ps(
        within(x_m, t.low_m[0], t.high_m[0]),
        _mm256_and_ps(within(y_m, t.low_m[1], t.high_m[1]), within(z_m, t.low_m[2], t.high_m[2])));
    const __m256i wanted =
        _mm256_and_si256(_mm256_cvtepi8_epi32(is_hit), _mm256_castps_si256(inside));
    for (std::uint32_t m = untaken_mask(t, x_m, y_m, z_m, wanted); m != 0; m &= m - 1) {
      out[found++] = static_cast<std::uint32_t>(i) + static_cast<std::uint32_t>(__builtin_ctz(m));
    }
  }
  return i;
}

#include "planner/map/cloud_kernels.inl"

}  // namespace

const CloudKernels kKernels = {find_untaken, count_neighbours};

}  // namespace gnbv::cloud_avx2
