// Sixteen rays side by side. For one translation unit compiled with AVX-512, see view_kernel.hpp.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace gnbv {
namespace {

constexpr int kLanes = 16;

struct Mask {
  __mmask16 m;
};
struct Ints {
  __m512i v;
};
struct Floats {
  __m512 v;
};

inline Mask no_lane() { return {0}; }
inline Mask every_lane() { return {0xffff}; }
inline Mask operator&(Mask a, Mask b) { return {_kand_mask16(a.m, b.m)}; }
inline Mask operator|(Mask a, Mask b) { return {_kor_mask16(a.m, b.m)}; }
inline Mask without(Mask a, Mask b) { return {_kandn_mask16(b.m, a.m)}; }
inline bool any(Mask a) { return a.m != 0; }
inline std::uint32_t bits(Mask a) { return a.m; }
inline int count(Mask a) { return __builtin_popcount(a.m); }

inline Ints all(std::int32_t x) { return {_mm512_set1_epi32(x)}; }
inline Ints load(const std::int32_t* p) { return {_mm512_loadu_si512(p)}; }
inline void store(std::int32_t* p, Ints a) { _mm512_storeu_si512(p, a.v); }
inline Ints add(Ints a, Ints b) { return {_mm512_add_epi32(a.v, b.v)}; }
inline Ints sub(Ints a, Ints b) { return {_mm512_sub_epi32(a.v, b.v)}; }
inline Ints add_where(Mask m, Ints a, Ints b) {
  return {_mm512_mask_add_epi32(a.v, m.m, a.v, b.v)};
}
inline Ints select(Mask m, Ints a, Ints b) { return {_mm512_mask_mov_epi32(b.v, m.m, a.v)}; }
inline Ints min(Ints a, Ints b) { return {_mm512_min_epi32(a.v, b.v)}; }
template <unsigned kBits>
Ints shift_right(Ints a) {
  return {_mm512_srli_epi32(a.v, kBits)};
}
template <unsigned kBits>
Ints shift_left(Ints a) {
  return {_mm512_slli_epi32(a.v, kBits)};
}
inline Mask equal(Mask m, Ints a, Ints b) { return {_mm512_mask_cmpeq_epi32_mask(m.m, a.v, b.v)}; }
inline Mask less(Mask m, Ints a, Ints b) { return {_mm512_mask_cmplt_epi32_mask(m.m, a.v, b.v)}; }
inline Mask has_bits(Mask m, Ints a, std::uint32_t mask_bits) {
  return {_mm512_mask_test_epi32_mask(m.m, a.v, _mm512_set1_epi32(static_cast<int>(mask_bits)))};
}
inline Mask has_not_bits(Mask m, Ints a, std::uint32_t mask_bits) {
  return {_mm512_mask_testn_epi32_mask(m.m, a.v, _mm512_set1_epi32(static_cast<int>(mask_bits)))};
}
/// 0 where not asked for.
inline Ints gather(Mask m, const std::uint32_t* p, Ints at) {
  return {_mm512_mask_i32gather_epi32(_mm512_setzero_si512(), m.m, at.v, p, 4)};
}
inline Floats gather(Mask m, const float* p, Ints at) {
  return {_mm512_mask_i32gather_ps(_mm512_setzero_ps(), m.m, at.v, p, 4)};
}
inline Mask nonzero_bytes(const std::uint8_t* p) {
  const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
  return {_mm_test_epi8_mask(bytes, bytes)};
}
inline Ints load_where(Mask m, const std::uint32_t* p) {
  return {_mm512_maskz_loadu_epi32(m.m, p)};
}

inline Floats all(float x) { return {_mm512_set1_ps(x)}; }
inline void store(float* p, Floats a) { _mm512_storeu_ps(p, a.v); }
inline Floats add(Floats a, Floats b) { return {_mm512_add_ps(a.v, b.v)}; }
inline Floats sub(Floats a, Floats b) { return {_mm512_sub_ps(a.v, b.v)}; }
inline Floats mul(Floats a, Floats b) { return {_mm512_mul_ps(a.v, b.v)}; }
inline Floats div(Floats a, Floats b) { return {_mm512_div_ps(a.v, b.v)}; }
inline Floats min(Floats a, Floats b) { return {_mm512_min_ps(a.v, b.v)}; }
inline Floats max(Floats a, Floats b) { return {_mm512_max_ps(a.v, b.v)}; }
inline Floats add_where(Mask m, Floats a, Floats b) {
  return {_mm512_mask_add_ps(a.v, m.m, a.v, b.v)};
}
inline Floats select(Mask m, Floats a, Floats b) { return {_mm512_mask_mov_ps(b.v, m.m, a.v)}; }
inline Floats to_floats(Ints a) { return {_mm512_cvtepi32_ps(a.v)}; }
/// To nearest, ties to even.
inline Ints to_ints(Floats a) { return {_mm512_cvtps_epi32(a.v)}; }
inline Ints bits_of(Floats a) { return {_mm512_castps_si512(a.v)}; }
inline Floats floats_of(Ints a) { return {_mm512_castsi512_ps(a.v)}; }

}  // namespace
}  // namespace gnbv
