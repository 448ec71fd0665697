// Four lanes with what every x86-64 has. See lanes.hpp for what each name means.
#pragma once

#include <emmintrin.h>

#include <cstdint>

namespace gnbv {
namespace {

constexpr int kLanes = 4;
constexpr std::uint32_t kAllLanes = (1U << kLanes) - 1U;

struct Floats {
  __m128 v;
};
struct Ints {
  __m128i v;
};
struct Mask {
  __m128 v;
};
struct Doubles {
  __m128d low, high;
};

inline Floats load(const float* from) { return {_mm_loadu_ps(from)}; }
inline Ints load(const std::int32_t* from) {
  return {_mm_loadu_si128(reinterpret_cast<const __m128i*>(from))};
}
inline Doubles load(const double* from) { return {_mm_loadu_pd(from), _mm_loadu_pd(from + 2)}; }
inline Ints load_bytes(const std::uint8_t* from) {
  return {_mm_setr_epi32(from[0], from[1], from[2], from[3])};
}
inline void store(float* to, Floats a) { _mm_storeu_ps(to, a.v); }
inline void store(std::int32_t* to, Ints a) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to), a.v);
}
inline void store_bytes(std::uint8_t* to, Ints a) {
  const __m128i words = _mm_packs_epi32(a.v, a.v);
  const std::int32_t bytes = _mm_cvtsi128_si32(_mm_packus_epi16(words, words));
  for (int i = 0; i < 4; ++i) to[i] = static_cast<std::uint8_t>(bytes >> (8 * i));
}
inline Floats all(float a) { return {_mm_set1_ps(a)}; }
inline Ints all(std::int32_t a) { return {_mm_set1_epi32(a)}; }
inline Doubles all(double a) { return {_mm_set1_pd(a), _mm_set1_pd(a)}; }
inline Floats ramp() { return {_mm_setr_ps(0, 1, 2, 3)}; }
inline Floats gather(const float* from, Ints at) {
  alignas(16) std::int32_t i[4];
  _mm_store_si128(reinterpret_cast<__m128i*>(i), at.v);
  return {_mm_setr_ps(from[i[0]], from[i[1]], from[i[2]], from[i[3]])};
}

inline Floats operator+(Floats a, Floats b) { return {_mm_add_ps(a.v, b.v)}; }
inline Floats operator-(Floats a, Floats b) { return {_mm_sub_ps(a.v, b.v)}; }
inline Floats operator*(Floats a, Floats b) { return {_mm_mul_ps(a.v, b.v)}; }
inline Floats operator/(Floats a, Floats b) { return {_mm_div_ps(a.v, b.v)}; }
inline Floats lesser(Floats a, Floats b) { return {_mm_min_ps(a.v, b.v)}; }
inline Floats greater(Floats a, Floats b) { return {_mm_max_ps(a.v, b.v)}; }
inline Floats magnitude(Floats a) { return {_mm_andnot_ps(_mm_set1_ps(-0.0F), a.v)}; }
inline Floats power_of_two_at_most(Floats a) {
  return {_mm_and_ps(a.v, _mm_castsi128_ps(_mm_set1_epi32(0x7f800000)))};
}
inline Ints exponent(Floats a) {
  return {_mm_sub_epi32(_mm_srli_epi32(_mm_castps_si128(a.v), 23), _mm_set1_epi32(127))};
}
inline Mask less(Floats a, Floats b) { return {_mm_cmplt_ps(a.v, b.v)}; }
inline Mask less_equal(Floats a, Floats b) { return {_mm_cmple_ps(a.v, b.v)}; }
inline Mask equal(Ints a, Ints b) { return {_mm_castsi128_ps(_mm_cmpeq_epi32(a.v, b.v))}; }
inline Mask operator&(Mask a, Mask b) { return {_mm_and_ps(a.v, b.v)}; }
inline Mask operator|(Mask a, Mask b) { return {_mm_or_ps(a.v, b.v)}; }
inline Mask and_not(Mask a, Mask b) { return {_mm_andnot_ps(b.v, a.v)}; }
inline std::uint32_t bits(Mask a) { return static_cast<std::uint32_t>(_mm_movemask_ps(a.v)); }
inline Floats select(Mask which, Floats a, Floats b) {
  return {_mm_or_ps(_mm_and_ps(which.v, a.v), _mm_andnot_ps(which.v, b.v))};
}
inline Ints select(Mask which, Ints a, Ints b) {
  const __m128i w = _mm_castps_si128(which.v);
  return {_mm_or_si128(_mm_and_si128(w, a.v), _mm_andnot_si128(w, b.v))};
}
inline Ints nearest(Floats a) { return {_mm_cvtps_epi32(a.v)}; }
inline Ints truncated(Floats a) { return {_mm_cvttps_epi32(a.v)}; }
inline Floats floats(Ints a) { return {_mm_cvtepi32_ps(a.v)}; }

inline Doubles widen(Floats a) {
  return {_mm_cvtps_pd(a.v), _mm_cvtps_pd(_mm_movehl_ps(a.v, a.v))};
}
inline Floats narrow(Doubles a) {
  return {_mm_movelh_ps(_mm_cvtpd_ps(a.low), _mm_cvtpd_ps(a.high))};
}
inline Doubles operator+(Doubles a, Doubles b) {
  return {_mm_add_pd(a.low, b.low), _mm_add_pd(a.high, b.high)};
}
inline Doubles operator-(Doubles a, Doubles b) {
  return {_mm_sub_pd(a.low, b.low), _mm_sub_pd(a.high, b.high)};
}
inline Doubles operator*(Doubles a, Doubles b) {
  return {_mm_mul_pd(a.low, b.low), _mm_mul_pd(a.high, b.high)};
}
inline __m128d floor_of_two(__m128d a) {  // below 2^31
  const __m128d toward_zero = _mm_cvtepi32_pd(_mm_cvttpd_epi32(a));
  const __m128d is_above = _mm_cmpgt_pd(toward_zero, a);
  return _mm_sub_pd(toward_zero, _mm_and_pd(is_above, _mm_set1_pd(1.0)));
}
inline Doubles floor_of(Doubles a) { return {floor_of_two(a.low), floor_of_two(a.high)}; }
inline Mask less(Doubles a, Doubles b) {
  return {_mm_shuffle_ps(_mm_castpd_ps(_mm_cmplt_pd(a.low, b.low)),
                         _mm_castpd_ps(_mm_cmplt_pd(a.high, b.high)), _MM_SHUFFLE(2, 0, 2, 0))};
}
inline __m128d select_of_two(__m128d which, __m128d a, __m128d b) {
  return _mm_or_pd(_mm_and_pd(which, a), _mm_andnot_pd(which, b));
}
inline Doubles select_less(Doubles a, Doubles b, Doubles yes, Doubles no) {
  return {select_of_two(_mm_cmplt_pd(a.low, b.low), yes.low, no.low),
          select_of_two(_mm_cmplt_pd(a.high, b.high), yes.high, no.high)};
}
inline Ints truncated(Doubles a) {
  return {_mm_unpacklo_epi64(_mm_cvttpd_epi32(a.low), _mm_cvttpd_epi32(a.high))};
}

}  // namespace
}  // namespace gnbv
