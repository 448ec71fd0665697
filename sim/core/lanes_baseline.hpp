// Four lanes with what every x86-64 has (SSE2): what lanes.hpp leaves to the level. Included there,
// and nowhere else.
#pragma once

namespace gnbv {
namespace {

inline std::uint32_t bits(Mask a) {
  return static_cast<std::uint32_t>(_mm_movemask_ps(reinterpret_cast<__m128>(a.m)));
}
inline bool any(Mask a) { return bits(a) != 0; }
inline int count(Mask a) {
  constexpr std::uint64_t kCounts = 0x4332322132212110U;  // a digit for each value of bits()
  return static_cast<int>(kCounts >> (4 * bits(a)) & 7U);
}
inline Ints select(Mask m, Ints a, Ints b) { return {(a.v & m.m) | (b.v & ~m.m)}; }
inline Floats select(Mask m, Floats a, Floats b) {
  return as_floats(select(m, as_ints(a), as_ints(b)));
}
inline Mask equal_bytes(const std::uint8_t* p, std::uint8_t b) {
  std::int32_t four;
  __builtin_memcpy(&four, p, sizeof four);
  const __m128i is_equal =
      _mm_cmpeq_epi8(_mm_cvtsi32_si128(four), _mm_set1_epi8(static_cast<char>(b)));
  const __m128i pairs = _mm_unpacklo_epi8(is_equal, is_equal);
  return {ints(_mm_unpacklo_epi16(pairs, pairs)).v};
}
inline void store_bytes(std::uint8_t* p, Ints a) {
  const __m128i words = _mm_packs_epi32(a.v, a.v);
  const std::int32_t four = _mm_cvtsi128_si32(_mm_packus_epi16(words, words));
  __builtin_memcpy(p, &four, sizeof four);
}
inline Ints gather(Mask m, const std::uint32_t* p, Ints at) {
  const IntVector safe = at.v & m.m;  // reads p[0] for the others
  const auto low = static_cast<std::uint64_t>(_mm_cvtsi128_si64(safe));
  const auto high = static_cast<std::uint64_t>(_mm_cvtsi128_si64(_mm_unpackhi_epi64(safe, safe)));
  const WordVector found = {p[low & 0xffffffffU], p[low >> 32], p[high & 0xffffffffU],
                            p[high >> 32]};
  return {ints(found).v & m.m};
}
inline Floats gather(Mask m, const float* p, Ints at) {
  return as_floats(gather(m, reinterpret_cast<const std::uint32_t*>(p), at));
}
inline Ints load_where(Mask m, const std::uint32_t* p) {
  return gather(m, p, ints(WordVector{0, 1, 2, 3}));
}
inline Ints power_of_two(Ints n) {  // 2^31 does not fit, which gives just that bit
  return ints(_mm_cvttps_epi32(as_floats(shift_left<23>(n + all(127))).v));
}

inline Ints min(Ints a, Ints b) { return select(less(every_lane(), a, b), a, b); }
inline Floats min(Floats a, Floats b) { return {_mm_min_ps(a.v, b.v)}; }
inline Floats max(Floats a, Floats b) { return {_mm_max_ps(a.v, b.v)}; }
inline Ints nearest(Floats a) { return ints(_mm_cvtps_epi32(a.v)); }
inline Ints truncated(Floats a) { return ints(_mm_cvttps_epi32(a.v)); }
inline Ints floored(Floats a) {
  const Ints toward_zero = truncated(a);
  const Mask is_above = less(every_lane(), a, to_floats(toward_zero));
  return toward_zero + Ints{is_above.m};
}

inline Doubles widen(Floats a) {
  return {_mm_cvtps_pd(a.v), _mm_cvtps_pd(_mm_movehl_ps(a.v, a.v))};
}
inline Floats narrow(Doubles a) {
  return {_mm_movelh_ps(_mm_cvtpd_ps(a.low), _mm_cvtpd_ps(a.high))};
}
inline DoubleVector floor_of_two(DoubleVector a) {  // below 2^31
  const __m128d toward_zero = _mm_cvtepi32_pd(_mm_cvttpd_epi32(a));
  const __m128d is_above = _mm_cmpgt_pd(toward_zero, a);
  return _mm_sub_pd(toward_zero, _mm_and_pd(is_above, _mm_set1_pd(1.0)));
}
inline Doubles floor_of(Doubles a) { return {floor_of_two(a.low), floor_of_two(a.high)}; }
inline Mask less(Doubles a, Doubles b) {
  const __m128 low = _mm_castpd_ps(_mm_cmplt_pd(a.low, b.low));
  const __m128 high = _mm_castpd_ps(_mm_cmplt_pd(a.high, b.high));
  return {reinterpret_cast<IntVector>(_mm_shuffle_ps(low, high, _MM_SHUFFLE(2, 0, 2, 0)))};
}
inline DoubleVector add_where_two(__m128i m, DoubleVector a, DoubleVector b) {
  const __m128d is_there = _mm_castsi128_pd(m);
  return _mm_or_pd(_mm_and_pd(is_there, a + b), _mm_andnot_pd(is_there, a));
}
inline Doubles add_where(Mask m, Doubles a, Doubles b) {
  return {add_where_two(_mm_unpacklo_epi32(m.m, m.m), a.low, b.low),
          add_where_two(_mm_unpackhi_epi32(m.m, m.m), a.high, b.high)};
}
inline Ints truncated(Doubles a) {
  return ints(_mm_unpacklo_epi64(_mm_cvttpd_epi32(a.low), _mm_cvttpd_epi32(a.high)));
}

}  // namespace
}  // namespace gnbv
