// Eight lanes with AVX2. See lanes.hpp for what each name means.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace gnbv {
namespace {

constexpr int kLanes = 8;
constexpr std::uint32_t kAllLanes = (1U << kLanes) - 1U;

struct Floats {
  __m256 v;
};
struct Ints {
  __m256i v;
};
struct Mask {
  __m256 v;
};
struct Doubles {
  __m256d low, high;
};

inline Floats load(const float* from) { return {_mm256_loadu_ps(from)}; }
inline Ints load(const std::int32_t* from) {
  return {_mm256_loadu_si256(reinterpret_cast<const __m256i*>(from))};
}
inline Doubles load(const double* from) {
  return {_mm256_loadu_pd(from), _mm256_loadu_pd(from + 4)};
}
inline Ints load_bytes(const std::uint8_t* from) {
  return {_mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from)))};
}
inline void store(float* to, Floats a) { _mm256_storeu_ps(to, a.v); }
inline void store(std::int32_t* to, Ints a) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), a.v);
}
inline void store_bytes(std::uint8_t* to, Ints a) {
  const __m128i words =
      _mm_packs_epi32(_mm256_castsi256_si128(a.v), _mm256_extracti128_si256(a.v, 1));
  _mm_storel_epi64(reinterpret_cast<__m128i*>(to), _mm_packus_epi16(words, words));
}
inline Floats all(float a) { return {_mm256_set1_ps(a)}; }
inline Ints all(std::int32_t a) { return {_mm256_set1_epi32(a)}; }
inline Doubles all(double a) { return {_mm256_set1_pd(a), _mm256_set1_pd(a)}; }
inline Floats ramp() { return {_mm256_setr_ps(0, 1, 2, 3, 4, 5, 6, 7)}; }
inline Floats gather(const float* from, Ints at) { return {_mm256_i32gather_ps(from, at.v, 4)}; }

inline Floats operator+(Floats a, Floats b) { return {_mm256_add_ps(a.v, b.v)}; }
inline Floats operator-(Floats a, Floats b) { return {_mm256_sub_ps(a.v, b.v)}; }
inline Floats operator*(Floats a, Floats b) { return {_mm256_mul_ps(a.v, b.v)}; }
inline Floats operator/(Floats a, Floats b) { return {_mm256_div_ps(a.v, b.v)}; }
inline Floats lesser(Floats a, Floats b) { return {_mm256_min_ps(a.v, b.v)}; }
inline Floats greater(Floats a, Floats b) { return {_mm256_max_ps(a.v, b.v)}; }
inline Floats magnitude(Floats a) { return {_mm256_andnot_ps(_mm256_set1_ps(-0.0F), a.v)}; }
inline Floats power_of_two_at_most(Floats a) {
  return {_mm256_and_ps(a.v, _mm256_castsi256_ps(_mm256_set1_epi32(0x7f800000)))};
}
inline Ints exponent(Floats a) {
  return {
      _mm256_sub_epi32(_mm256_srli_epi32(_mm256_castps_si256(a.v), 23), _mm256_set1_epi32(127))};
}
inline Mask less(Floats a, Floats b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)}; }
inline Mask less_equal(Floats a, Floats b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)}; }
inline Mask equal(Ints a, Ints b) { return {_mm256_castsi256_ps(_mm256_cmpeq_epi32(a.v, b.v))}; }
inline Mask operator&(Mask a, Mask b) { return {_mm256_and_ps(a.v, b.v)}; }
inline Mask operator|(Mask a, Mask b) { return {_mm256_or_ps(a.v, b.v)}; }
inline Mask and_not(Mask a, Mask b) { return {_mm256_andnot_ps(b.v, a.v)}; }
inline std::uint32_t bits(Mask a) { return static_cast<std::uint32_t>(_mm256_movemask_ps(a.v)); }
inline Floats select(Mask which, Floats a, Floats b) {
  return {_mm256_blendv_ps(b.v, a.v, which.v)};
}
inline Ints select(Mask which, Ints a, Ints b) {
  return {_mm256_blendv_epi8(b.v, a.v, _mm256_castps_si256(which.v))};
}
inline Ints nearest(Floats a) { return {_mm256_cvtps_epi32(a.v)}; }
inline Ints truncated(Floats a) { return {_mm256_cvttps_epi32(a.v)}; }
inline Floats floats(Ints a) { return {_mm256_cvtepi32_ps(a.v)}; }

inline Doubles widen(Floats a) {
  return {_mm256_cvtps_pd(_mm256_castps256_ps128(a.v)),
          _mm256_cvtps_pd(_mm256_extractf128_ps(a.v, 1))};
}
inline Floats narrow(Doubles a) {
  return {_mm256_insertf128_ps(_mm256_castps128_ps256(_mm256_cvtpd_ps(a.low)),
                               _mm256_cvtpd_ps(a.high), 1)};
}
inline Doubles operator+(Doubles a, Doubles b) {
  return {_mm256_add_pd(a.low, b.low), _mm256_add_pd(a.high, b.high)};
}
inline Doubles operator-(Doubles a, Doubles b) {
  return {_mm256_sub_pd(a.low, b.low), _mm256_sub_pd(a.high, b.high)};
}
inline Doubles operator*(Doubles a, Doubles b) {
  return {_mm256_mul_pd(a.low, b.low), _mm256_mul_pd(a.high, b.high)};
}
inline Doubles floor_of(Doubles a) { return {_mm256_floor_pd(a.low), _mm256_floor_pd(a.high)}; }
inline Mask less(Doubles a, Doubles b) {
  const __m256 low = _mm256_castpd_ps(_mm256_cmp_pd(a.low, b.low, _CMP_LT_OQ));
  const __m256 high = _mm256_castpd_ps(_mm256_cmp_pd(a.high, b.high, _CMP_LT_OQ));
  const __m256 mixed = _mm256_shuffle_ps(low, high, _MM_SHUFFLE(2, 0, 2, 0));
  return {
      _mm256_castpd_ps(_mm256_permute4x64_pd(_mm256_castps_pd(mixed), _MM_SHUFFLE(3, 1, 2, 0)))};
}
inline Doubles select_less(Doubles a, Doubles b, Doubles yes, Doubles no) {
  return {_mm256_blendv_pd(no.low, yes.low, _mm256_cmp_pd(a.low, b.low, _CMP_LT_OQ)),
          _mm256_blendv_pd(no.high, yes.high, _mm256_cmp_pd(a.high, b.high, _CMP_LT_OQ))};
}
inline Ints truncated(Doubles a) {
  return {_mm256_inserti128_si256(_mm256_castsi128_si256(_mm256_cvttpd_epi32(a.low)),
                                  _mm256_cvttpd_epi32(a.high), 1)};
}

}  // namespace
}  // namespace gnbv
