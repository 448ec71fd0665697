// Sixteen lanes with AVX-512 (F, BW, DQ, VL): what lanes.hpp leaves to the level, and masks that
// are registers of their own. Included there, and nowhere else.
#pragma once

namespace gnbv {
namespace {

struct Mask {
  __mmask16 m;
};

inline Mask no_lane() { return {0}; }
inline Mask every_lane() { return {0xffff}; }
inline Mask operator&(Mask a, Mask b) { return {_kand_mask16(a.m, b.m)}; }
inline Mask operator|(Mask a, Mask b) { return {_kor_mask16(a.m, b.m)}; }
inline Mask without(Mask a, Mask b) { return {_kandn_mask16(b.m, a.m)}; }
inline std::uint32_t bits(Mask a) { return a.m; }
inline bool any(Mask a) { return a.m != 0; }
inline int count(Mask a) { return __builtin_popcount(a.m); }
inline Mask equal(Mask m, Ints a, Ints b) { return {_mm512_mask_cmpeq_epi32_mask(m.m, a.v, b.v)}; }
inline Mask less(Mask m, Ints a, Ints b) { return {_mm512_mask_cmplt_epi32_mask(m.m, a.v, b.v)}; }
inline Mask less(Mask m, Floats a, Floats b) {
  return {_mm512_mask_cmp_ps_mask(m.m, a.v, b.v, _CMP_LT_OQ)};
}
inline Mask less_equal(Mask m, Floats a, Floats b) {
  return {_mm512_mask_cmp_ps_mask(m.m, a.v, b.v, _CMP_LE_OQ)};
}
inline Mask has_bits(Mask m, Ints a, Ints b) {
  return {_mm512_mask_test_epi32_mask(m.m, a.v, b.v)};
}
inline Mask has_not_bits(Mask m, Ints a, Ints b) {
  return {_mm512_mask_testn_epi32_mask(m.m, a.v, b.v)};
}
inline Ints add_where(Mask m, Ints a, Ints b) {
  return ints(_mm512_mask_add_epi32(a.v, m.m, a.v, b.v));
}
inline Floats add_where(Mask m, Floats a, Floats b) {
  return {_mm512_mask_add_ps(a.v, m.m, a.v, b.v)};
}
inline Ints select(Mask m, Ints a, Ints b) { return ints(_mm512_mask_mov_epi32(b.v, m.m, a.v)); }
inline Floats select(Mask m, Floats a, Floats b) { return {_mm512_mask_mov_ps(b.v, m.m, a.v)}; }
inline Mask equal_bytes(const std::uint8_t* p, std::uint8_t b) {
  const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
  return {_mm_cmpeq_epi8_mask(bytes, _mm_set1_epi8(static_cast<char>(b)))};
}
inline void store_bytes(std::uint8_t* p, Ints a) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(p), _mm512_cvtepi32_epi8(a.v));
}
inline Ints gather(Mask m, const std::uint32_t* p, Ints at) {
  return ints(_mm512_mask_i32gather_epi32(_mm512_setzero_si512(), m.m, at.v, p, 4));
}
inline Floats gather(Mask m, const float* p, Ints at) {
  return {_mm512_mask_i32gather_ps(_mm512_setzero_ps(), m.m, at.v, p, 4)};
}
inline Ints load_where(Mask m, const std::uint32_t* p) {
  return ints(_mm512_maskz_loadu_epi32(m.m, p));
}
// packed in a register first: a packing store is slow on some processors
inline int pack(Mask which, Ints a, std::int32_t* to) {
  store(to, ints(_mm512_maskz_compress_epi32(which.m, a.v)));
  return count(which);
}
inline int pack(Mask which, std::int32_t first, std::int32_t* to) {
  const __m512i lane = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  return pack(which, all(first) + ints(lane), to);
}
inline Ints power_of_two(Ints n) { return ints(_mm512_sllv_epi32(_mm512_set1_epi32(1), n.v)); }

inline Ints min(Ints a, Ints b) { return ints(_mm512_min_epi32(a.v, b.v)); }
inline Floats min(Floats a, Floats b) { return {_mm512_min_ps(a.v, b.v)}; }
inline Floats max(Floats a, Floats b) { return {_mm512_max_ps(a.v, b.v)}; }
inline Ints nearest(Floats a) { return ints(_mm512_cvtps_epi32(a.v)); }
inline Ints truncated(Floats a) { return ints(_mm512_cvttps_epi32(a.v)); }
constexpr int kDown = _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC;
inline Ints floored(Floats a) {
  return ints(_mm512_cvttps_epi32(_mm512_roundscale_ps(a.v, kDown)));
}

inline Doubles widen(Floats a) {
  return {_mm512_cvtps_pd(_mm512_castps512_ps256(a.v)),
          _mm512_cvtps_pd(_mm512_extractf32x8_ps(a.v, 1))};
}
inline Floats narrow(Doubles a) {
  return {_mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps(a.low)),
                             _mm512_cvtpd_ps(a.high), 1)};
}
inline Doubles floor_of(Doubles a) {
  return {_mm512_roundscale_pd(a.low, kDown), _mm512_roundscale_pd(a.high, kDown)};
}
inline Mask less(Doubles a, Doubles b) {
  return {static_cast<__mmask16>(_mm512_cmp_pd_mask(a.low, b.low, _CMP_LT_OQ) |
                                 _mm512_cmp_pd_mask(a.high, b.high, _CMP_LT_OQ) << 8)};
}
inline Doubles add_where(Mask m, Doubles a, Doubles b) {
  return {_mm512_mask_add_pd(a.low, static_cast<__mmask8>(m.m), a.low, b.low),
          _mm512_mask_add_pd(a.high, static_cast<__mmask8>(m.m >> 8), a.high, b.high)};
}
inline Ints truncated(Doubles a) {
  return ints(_mm512_inserti32x8(_mm512_castsi256_si512(_mm512_cvttpd_epi32(a.low)),
                                 _mm512_cvttpd_epi32(a.high), 1));
}

}  // namespace
}  // namespace gnbv
