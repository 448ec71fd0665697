// Sixteen lanes with AVX-512 (F, BW, DQ, VL). See lanes.hpp for what each name means.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace gnbv {
namespace {

constexpr int kLanes = 16;
constexpr std::uint32_t kAllLanes = (1U << kLanes) - 1U;

struct Floats {
  __m512 v;
};
struct Ints {
  __m512i v;
};
struct Mask {
  __mmask16 v;
};
struct Doubles {
  __m512d low, high;
};

inline Floats load(const float* from) { return {_mm512_loadu_ps(from)}; }
inline Ints load(const std::int32_t* from) { return {_mm512_loadu_si512(from)}; }
inline Doubles load(const double* from) {
  return {_mm512_loadu_pd(from), _mm512_loadu_pd(from + 8)};
}
inline Ints load_bytes(const std::uint8_t* from) {
  return {_mm512_cvtepu8_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from)))};
}
inline void store(float* to, Floats a) { _mm512_storeu_ps(to, a.v); }
inline void store(std::int32_t* to, Ints a) { _mm512_storeu_si512(to, a.v); }
inline void store_bytes(std::uint8_t* to, Ints a) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm512_cvtepi32_epi8(a.v));
}
inline Floats all(float a) { return {_mm512_set1_ps(a)}; }
inline Ints all(std::int32_t a) { return {_mm512_set1_epi32(a)}; }
inline Doubles all(double a) { return {_mm512_set1_pd(a), _mm512_set1_pd(a)}; }
inline Floats ramp() {
  return {_mm512_setr_ps(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)};
}
inline Floats gather(const float* from, Ints at) { return {_mm512_i32gather_ps(at.v, from, 4)}; }

inline Floats operator+(Floats a, Floats b) { return {_mm512_add_ps(a.v, b.v)}; }
inline Floats operator-(Floats a, Floats b) { return {_mm512_sub_ps(a.v, b.v)}; }
inline Floats operator*(Floats a, Floats b) { return {_mm512_mul_ps(a.v, b.v)}; }
inline Floats operator/(Floats a, Floats b) { return {_mm512_div_ps(a.v, b.v)}; }
inline Floats lesser(Floats a, Floats b) { return {_mm512_min_ps(a.v, b.v)}; }
inline Floats greater(Floats a, Floats b) { return {_mm512_max_ps(a.v, b.v)}; }
inline Floats magnitude(Floats a) { return {_mm512_abs_ps(a.v)}; }
inline Floats power_of_two_at_most(Floats a) {
  return {_mm512_castsi512_ps(
      _mm512_and_si512(_mm512_castps_si512(a.v), _mm512_set1_epi32(0x7f800000)))};
}
inline Ints exponent(Floats a) {
  return {
      _mm512_sub_epi32(_mm512_srli_epi32(_mm512_castps_si512(a.v), 23), _mm512_set1_epi32(127))};
}
inline Mask less(Floats a, Floats b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ)}; }
inline Mask less_equal(Floats a, Floats b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ)}; }
inline Mask equal(Ints a, Ints b) { return {_mm512_cmpeq_epi32_mask(a.v, b.v)}; }
inline Mask operator&(Mask a, Mask b) { return {static_cast<__mmask16>(a.v & b.v)}; }
inline Mask operator|(Mask a, Mask b) { return {static_cast<__mmask16>(a.v | b.v)}; }
inline Mask and_not(Mask a, Mask b) { return {static_cast<__mmask16>(a.v & ~b.v)}; }
inline std::uint32_t bits(Mask a) { return a.v; }
inline Floats select(Mask which, Floats a, Floats b) {
  return {_mm512_mask_blend_ps(which.v, b.v, a.v)};
}
inline Ints select(Mask which, Ints a, Ints b) {
  return {_mm512_mask_blend_epi32(which.v, b.v, a.v)};
}
inline Ints nearest(Floats a) { return {_mm512_cvtps_epi32(a.v)}; }
inline Ints truncated(Floats a) { return {_mm512_cvttps_epi32(a.v)}; }
inline Floats floats(Ints a) { return {_mm512_cvtepi32_ps(a.v)}; }

inline Doubles widen(Floats a) {
  return {_mm512_cvtps_pd(_mm512_castps512_ps256(a.v)),
          _mm512_cvtps_pd(_mm512_extractf32x8_ps(a.v, 1))};
}
inline Floats narrow(Doubles a) {
  return {_mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps(a.low)),
                             _mm512_cvtpd_ps(a.high), 1)};
}
inline Doubles operator+(Doubles a, Doubles b) {
  return {_mm512_add_pd(a.low, b.low), _mm512_add_pd(a.high, b.high)};
}
inline Doubles operator-(Doubles a, Doubles b) {
  return {_mm512_sub_pd(a.low, b.low), _mm512_sub_pd(a.high, b.high)};
}
inline Doubles operator*(Doubles a, Doubles b) {
  return {_mm512_mul_pd(a.low, b.low), _mm512_mul_pd(a.high, b.high)};
}
inline Doubles floor_of(Doubles a) {
  constexpr int kDown = _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC;
  return {_mm512_roundscale_pd(a.low, kDown), _mm512_roundscale_pd(a.high, kDown)};
}
inline Mask less(Doubles a, Doubles b) {
  return {static_cast<__mmask16>(_mm512_cmp_pd_mask(a.low, b.low, _CMP_LT_OQ) |
                                 _mm512_cmp_pd_mask(a.high, b.high, _CMP_LT_OQ) << 8)};
}
inline Doubles select_less(Doubles a, Doubles b, Doubles yes, Doubles no) {
  return {_mm512_mask_blend_pd(_mm512_cmp_pd_mask(a.low, b.low, _CMP_LT_OQ), no.low, yes.low),
          _mm512_mask_blend_pd(_mm512_cmp_pd_mask(a.high, b.high, _CMP_LT_OQ), no.high, yes.high)};
}
inline Ints truncated(Doubles a) {
  return {_mm512_inserti32x8(_mm512_castsi256_si512(_mm512_cvttpd_epi32(a.low)),
                             _mm512_cvttpd_epi32(a.high), 1)};
}

}  // namespace
}  // namespace gnbv
