// Eight lanes with AVX2: what lanes.hpp leaves to the level. Included there, and nowhere else.
#pragma once

namespace gnbv {
namespace {

inline std::uint32_t bits(Mask a) {
  return static_cast<std::uint32_t>(_mm256_movemask_ps(reinterpret_cast<__m256>(a.m)));
}
inline bool any(Mask a) { return _mm256_testz_si256(a.m, a.m) == 0; }
inline int count(Mask a) { return __builtin_popcount(bits(a)); }
inline Ints select(Mask m, Ints a, Ints b) { return ints(_mm256_blendv_epi8(b.v, a.v, m.m)); }
inline Floats select(Mask m, Floats a, Floats b) {
  return {_mm256_blendv_ps(b.v, a.v, reinterpret_cast<__m256>(m.m))};
}
inline Mask equal_bytes(const std::uint8_t* p, std::uint8_t b) {
  const __m128i bytes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(p));
  const __m128i is_equal = _mm_cmpeq_epi8(bytes, _mm_set1_epi8(static_cast<char>(b)));
  return {ints(_mm256_cvtepi8_epi32(is_equal)).v};
}
inline void store_bytes(std::uint8_t* p, Ints a) {
  const __m128i words =
      _mm_packs_epi32(_mm256_castsi256_si128(a.v), _mm256_extracti128_si256(a.v, 1));
  _mm_storel_epi64(reinterpret_cast<__m128i*>(p), _mm_packus_epi16(words, words));
}
inline Ints gather(Mask m, const std::uint32_t* p, Ints at) {
  return ints(_mm256_mask_i32gather_epi32(_mm256_setzero_si256(), reinterpret_cast<const int*>(p),
                                          at.v, m.m, 4));
}
inline Floats gather(Mask m, const float* p, Ints at) {
  return {_mm256_mask_i32gather_ps(_mm256_setzero_ps(), p, at.v, reinterpret_cast<__m256>(m.m), 4)};
}
inline Ints load_where(Mask m, const std::uint32_t* p) {
  return ints(_mm256_maskload_epi32(reinterpret_cast<const int*>(p), m.m));
}
inline Ints power_of_two(Ints n) { return ints(_mm256_sllv_epi32(_mm256_set1_epi32(1), n.v)); }

inline Ints min(Ints a, Ints b) { return ints(_mm256_min_epi32(a.v, b.v)); }
inline Floats min(Floats a, Floats b) { return {_mm256_min_ps(a.v, b.v)}; }
inline Floats max(Floats a, Floats b) { return {_mm256_max_ps(a.v, b.v)}; }
inline Ints nearest(Floats a) { return ints(_mm256_cvtps_epi32(a.v)); }
inline Ints truncated(Floats a) { return ints(_mm256_cvttps_epi32(a.v)); }
inline Ints floored(Floats a) { return ints(_mm256_cvttps_epi32(_mm256_floor_ps(a.v))); }

inline Doubles widen(Floats a) {
  return {_mm256_cvtps_pd(_mm256_castps256_ps128(a.v)),
          _mm256_cvtps_pd(_mm256_extractf128_ps(a.v, 1))};
}
inline Floats narrow(Doubles a) {
  return {_mm256_insertf128_ps(_mm256_castps128_ps256(_mm256_cvtpd_ps(a.low)),
                               _mm256_cvtpd_ps(a.high), 1)};
}
inline Doubles floor_of(Doubles a) { return {_mm256_floor_pd(a.low), _mm256_floor_pd(a.high)}; }
inline Mask less(Doubles a, Doubles b) {
  const __m256 low = _mm256_castpd_ps(_mm256_cmp_pd(a.low, b.low, _CMP_LT_OQ));
  const __m256 high = _mm256_castpd_ps(_mm256_cmp_pd(a.high, b.high, _CMP_LT_OQ));
  const __m256 mixed = _mm256_shuffle_ps(low, high, _MM_SHUFFLE(2, 0, 2, 0));
  const __m256d in_order = _mm256_permute4x64_pd(_mm256_castps_pd(mixed), _MM_SHUFFLE(3, 1, 2, 0));
  return {reinterpret_cast<IntVector>(in_order)};
}
inline Doubles add_where(Mask m, Doubles a, Doubles b) {
  const __m256i low = _mm256_cvtepi32_epi64(_mm256_castsi256_si128(m.m));
  const __m256i high = _mm256_cvtepi32_epi64(_mm256_extracti128_si256(m.m, 1));
  return {_mm256_blendv_pd(a.low, a.low + b.low, _mm256_castsi256_pd(low)),
          _mm256_blendv_pd(a.high, a.high + b.high, _mm256_castsi256_pd(high))};
}
inline Ints truncated(Doubles a) {
  return ints(_mm256_inserti128_si256(_mm256_castsi128_si256(_mm256_cvttpd_epi32(a.low)),
                                      _mm256_cvttpd_epi32(a.high), 1));
}

}  // namespace
}  // namespace gnbv
