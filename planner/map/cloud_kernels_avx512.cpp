// SurfaceCloud's loops for AVX-512: sixteen points at once.
#include <immintrin.h>

#include "planner/map/cloud_kernels.hpp"

namespace gnbv::cloud_avx512 {
namespace {

inline std::uint32_t near_mask(const PointBlock& block, const float* p_m, float radius2_m2) {
  const __m512 dx = _mm512_sub_ps(_mm512_load_ps(block.x_m), _mm512_set1_ps(p_m[0]));
  const __m512 dy = _mm512_sub_ps(_mm512_load_ps(block.y_m), _mm512_set1_ps(p_m[1]));
  const __m512 dz = _mm512_sub_ps(_mm512_load_ps(block.z_m), _mm512_set1_ps(p_m[2]));
  const __m512 xy = _mm512_add_ps(_mm512_mul_ps(dx, dx), _mm512_mul_ps(dy, dy));
  const __m512 d2 = _mm512_add_ps(xy, _mm512_mul_ps(dz, dz));
  return _mm512_cmp_ps_mask(d2, _mm512_set1_ps(radius2_m2), _CMP_LE_OQ);
}

/// along_axis() for sixteen points.
struct LanesAlongAxis {
  __m512i cell, in_bucket;
  LanesAlongAxis(const LeafTable& t, int axis, __m512 p_m) {
    constexpr int kDown = _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC;
    const __m512 scaled = _mm512_mul_ps(p_m, _mm512_set1_ps(t.inverse_leaf_1_m));
    const __m512i leaf = _mm512_cvttps_epi32(_mm512_roundscale_ps(scaled, kDown));
    const __m512i s = _mm512_sub_epi32(leaf, _mm512_set1_epi32(t.first_leaf[axis]));
    const __m512 middle = _mm512_add_ps(_mm512_cvtepi32_ps(s), _mm512_set1_ps(0.5F));
    const float inverse = 1.0F / static_cast<float>(t.leaves_per_bucket);
    cell = _mm512_cvttps_epi32(_mm512_mul_ps(middle, _mm512_set1_ps(inverse)));
    in_bucket =
        _mm512_sub_epi32(s, _mm512_mullo_epi32(cell, _mm512_set1_epi32(t.leaves_per_bucket)));
  }
};

inline __m512i combine(__m512i z, __m512i y, __m512i x, std::int32_t y_count,
                       std::int32_t x_count) {
  const __m512i zy = _mm512_add_epi32(_mm512_mullo_epi32(z, _mm512_set1_epi32(y_count)), y);
  return _mm512_add_epi32(_mm512_mullo_epi32(zy, _mm512_set1_epi32(x_count)), x);
}

inline __mmask16 within(__mmask16 wanted, __m512 p_m, float low_m, float high_m) {
  const __mmask16 above = _mm512_mask_cmp_ps_mask(wanted, p_m, _mm512_set1_ps(low_m), _CMP_GE_OQ);
  return _mm512_mask_cmp_ps_mask(above, p_m, _mm512_set1_ps(high_m), _CMP_LE_OQ);
}

/// Those of `wanted` whose leaf is not taken.
inline __mmask16 untaken_mask(const LeafTable& t, __m512 x_m, __m512 y_m, __m512 z_m,
                              __mmask16 wanted) {
  const LanesAlongAxis x(t, 0, x_m);
  const LanesAlongAxis y(t, 1, y_m);
  const LanesAlongAxis z(t, 2, z_m);
  const __m512i cell = combine(z.cell, y.cell, x.cell, t.cells_y, t.cells_x);
  const std::int32_t n = t.leaves_per_bucket;
  const __m512i bit = combine(z.in_bucket, y.in_bucket, x.in_bucket, n, n);
  const __m512i none = _mm512_setzero_si512();
  const __m512i bucket = _mm512_mask_i32gather_epi32(none, wanted, cell, t.bucket_at, 4);
  const __m512i word_at = _mm512_add_epi32(
      _mm512_mullo_epi32(bucket, _mm512_set1_epi32(t.words_per_bucket)), _mm512_srli_epi32(bit, 5));
  const __m512i word = _mm512_mask_i32gather_epi32(none, wanted, word_at, t.taken, 4);
  const __m512i one = _mm512_set1_epi32(1);
  const __m512i bit_mask = _mm512_sllv_epi32(one, _mm512_and_si512(bit, _mm512_set1_epi32(31)));
  return _mm512_mask_testn_epi32_mask(wanted, word, bit_mask);
}

inline std::size_t find_in_lanes(const LeafTable& t, const PixelColumns& pixels, std::size_t begin,
                                 std::size_t end, std::uint32_t* out, std::size_t& found) {
  const __m512i lane = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const __m128i hits = _mm_set1_epi8(static_cast<char>(pixels.hits));
  std::size_t i = begin;
  for (; i + 16 <= end; i += 16) {
    const __m128i kinds = _mm_loadu_si128(reinterpret_cast<const __m128i*>(pixels.kind + i));
    __mmask16 wanted = _mm_cmpeq_epi8_mask(kinds, hits);
    if (wanted == 0) continue;
    const __m512 x_m = _mm512_loadu_ps(pixels.x_m + i);
    const __m512 y_m = _mm512_loadu_ps(pixels.y_m + i);
    const __m512 z_m = _mm512_loadu_ps(pixels.z_m + i);
    wanted = within(wanted, x_m, t.low_m[0], t.high_m[0]);
    wanted = within(wanted, y_m, t.low_m[1], t.high_m[1]);
    wanted = within(wanted, z_m, t.low_m[2], t.high_m[2]);
    const __mmask16 untaken = untaken_mask(t, x_m, y_m, z_m, wanted);
    const __m512i index = _mm512_add_epi32(lane, _mm512_set1_epi32(static_cast<int>(i)));
    // packed in a register first: a packing store is slow on some processors
    _mm512_storeu_si512(out + found, _mm512_maskz_compress_epi32(untaken, index));
    found += static_cast<std::size_t>(__builtin_popcount(untaken));
  }
  return i;
}

#include "planner/map/cloud_kernels.inl"

}  // namespace

const CloudKernels kKernels = {find_untaken, count_neighbours};

}  // namespace gnbv::cloud_avx512
