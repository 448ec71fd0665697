// Eight rays side by side. For one translation unit compiled with AVX2, see view_kernel.hpp.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace gnbv {
namespace {

constexpr int kLanes = 8;

struct Mask {
  __m256i m;  // all bits of a lane or none
};
struct Ints {
  __m256i v;
};
struct Floats {
  __m256 v;
};

inline Mask no_lane() { return {_mm256_setzero_si256()}; }
inline Mask every_lane() { return {_mm256_set1_epi32(-1)}; }
inline Mask operator&(Mask a, Mask b) { return {_mm256_and_si256(a.m, b.m)}; }
inline Mask operator|(Mask a, Mask b) { return {_mm256_or_si256(a.m, b.m)}; }
inline Mask without(Mask a, Mask b) { return {_mm256_andnot_si256(b.m, a.m)}; }
inline std::uint32_t bits(Mask a) {
  return static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(a.m)));
}
inline bool any(Mask a) { return _mm256_testz_si256(a.m, a.m) == 0; }
inline int count(Mask a) { return __builtin_popcount(bits(a)); }

inline Ints all(std::int32_t x) { return {_mm256_set1_epi32(x)}; }
inline Ints load(const std::int32_t* p) {
  return {_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p))};
}
inline void store(std::int32_t* p, Ints a) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), a.v);
}
inline Ints add(Ints a, Ints b) { return {_mm256_add_epi32(a.v, b.v)}; }
inline Ints sub(Ints a, Ints b) { return {_mm256_sub_epi32(a.v, b.v)}; }
inline Ints add_where(Mask m, Ints a, Ints b) {
  return {_mm256_add_epi32(a.v, _mm256_and_si256(m.m, b.v))};
}
inline Ints select(Mask m, Ints a, Ints b) { return {_mm256_blendv_epi8(b.v, a.v, m.m)}; }
inline Ints min(Ints a, Ints b) { return {_mm256_min_epi32(a.v, b.v)}; }
template <unsigned kBits>
Ints shift_right(Ints a) {
  return {_mm256_srli_epi32(a.v, kBits)};
}
template <unsigned kBits>
Ints shift_left(Ints a) {
  return {_mm256_slli_epi32(a.v, kBits)};
}
inline Mask equal(Mask m, Ints a, Ints b) { return m & Mask{_mm256_cmpeq_epi32(a.v, b.v)}; }
inline Mask less(Mask m, Ints a, Ints b) { return m & Mask{_mm256_cmpgt_epi32(b.v, a.v)}; }
inline Mask has_not_bits(Mask m, Ints a, std::uint32_t mask_bits) {
  const __m256i tested = _mm256_and_si256(a.v, _mm256_set1_epi32(static_cast<int>(mask_bits)));
  return m & Mask{_mm256_cmpeq_epi32(tested, _mm256_setzero_si256())};
}
inline Mask has_bits(Mask m, Ints a, std::uint32_t mask_bits) {
  return without(m, has_not_bits(m, a, mask_bits));
}
/// 0 where not asked for.
inline Ints gather(Mask m, const std::uint32_t* p, Ints at) {
  return {_mm256_mask_i32gather_epi32(_mm256_setzero_si256(), reinterpret_cast<const int*>(p), at.v,
                                      m.m, 4)};
}
inline Floats gather(Mask m, const float* p, Ints at) {
  return {_mm256_mask_i32gather_ps(_mm256_setzero_ps(), p, at.v, _mm256_castsi256_ps(m.m), 4)};
}
inline Mask nonzero_bytes(const std::uint8_t* p) {
  const __m256i bytes = _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p)));
  return {_mm256_cmpgt_epi32(bytes, _mm256_setzero_si256())};
}
inline Ints load_where(Mask m, const std::uint32_t* p) {
  return {_mm256_maskload_epi32(reinterpret_cast<const int*>(p), m.m)};
}

inline Floats all(float x) { return {_mm256_set1_ps(x)}; }
inline void store(float* p, Floats a) { _mm256_storeu_ps(p, a.v); }
inline Floats add(Floats a, Floats b) { return {_mm256_add_ps(a.v, b.v)}; }
inline Floats sub(Floats a, Floats b) { return {_mm256_sub_ps(a.v, b.v)}; }
inline Floats mul(Floats a, Floats b) { return {_mm256_mul_ps(a.v, b.v)}; }
inline Floats div(Floats a, Floats b) { return {_mm256_div_ps(a.v, b.v)}; }
inline Floats min(Floats a, Floats b) { return {_mm256_min_ps(a.v, b.v)}; }
inline Floats max(Floats a, Floats b) { return {_mm256_max_ps(a.v, b.v)}; }
inline Floats select(Mask m, Floats a, Floats b) {
  return {_mm256_blendv_ps(b.v, a.v, _mm256_castsi256_ps(m.m))};
}
inline Floats add_where(Mask m, Floats a, Floats b) {
  return {_mm256_add_ps(a.v, _mm256_and_ps(_mm256_castsi256_ps(m.m), b.v))};
}
inline Floats to_floats(Ints a) { return {_mm256_cvtepi32_ps(a.v)}; }
/// To nearest, ties to even.
inline Ints to_ints(Floats a) { return {_mm256_cvtps_epi32(a.v)}; }
inline Ints bits_of(Floats a) { return {_mm256_castps_si256(a.v)}; }
inline Floats floats_of(Ints a) { return {_mm256_castsi256_ps(a.v)}; }

}  // namespace
}  // namespace gnbv
