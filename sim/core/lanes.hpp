// Vector loops over Google Highway. gnbv_kernels() (CMakeLists.txt) compiles a source once for each
// SimdLevel. A lane gets the same bits at every level: nothing here fuses a product with a sum, and
// no loop asks for what Highway leaves open, as a result that does not fit or an order of
// summation.
//
// Floats, Ints and Mask have kLanes float32, int32 (modulo 2^32) and truths. Other operations are
// Highway's own: + - * / & |, hn::Min, hn::Max (the second where one is NaN), hn::Abs, hn::Round
// (ties to even), hn::Trunc.
//
// Everything has internal linkage, so that no copy for one processor is linked into another's code.
// For the same reason these sources include nothing of ours but this, each other and plain structs.
#pragma once

#include <hwy/highway.h>

#include <cstdint>
#include <cstring>

namespace gnbv {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<float> kFloatTag;
constexpr hn::ScalableTag<std::int32_t> kIntTag;
constexpr hn::ScalableTag<double> kDoubleTag;
constexpr hn::Rebind<float, decltype(kDoubleTag)> kHalfFloatTag;
constexpr hn::Rebind<std::int32_t, decltype(kDoubleTag)> kHalfIntTag;
constexpr hn::Rebind<std::uint8_t, decltype(kFloatTag)> kByteTag;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(kFloatTag));

using Floats = hn::Vec<decltype(kFloatTag)>;
using Ints = hn::Vec<decltype(kIntTag)>;
using Mask = hn::Mask<decltype(kIntTag)>;

/// kLanes elements at any address; bytes from 0 to 255.
inline Floats load(const float* p) { return hn::LoadU(kFloatTag, p); }
inline Ints load(const std::int32_t* p) { return hn::LoadU(kIntTag, p); }
inline Ints load(const std::uint32_t* p) { return load(reinterpret_cast<const std::int32_t*>(p)); }
inline Ints load_bytes(const std::uint8_t* p) {
  return hn::PromoteTo(kIntTag, hn::LoadU(kByteTag, p));
}
inline void store(float* p, Floats a) { hn::StoreU(a, kFloatTag, p); }
inline void store(std::int32_t* p, Ints a) { hn::StoreU(a, kIntTag, p); }
inline void store_bytes(std::uint8_t* p, Ints a) {
  hn::StoreU(hn::DemoteTo(kByteTag, a), kByteTag, p);
}

/// x in every lane. ramp: 0, 1, 2, ...
inline Floats all(float x) { return hn::Set(kFloatTag, x); }
inline Ints all(std::int32_t x) { return hn::Set(kIntTag, x); }
inline Ints all(std::uint32_t x) { return all(static_cast<std::int32_t>(x)); }
inline Floats ramp() { return hn::Iota(kFloatTag, 0.0F); }
inline Ints int_ramp() { return hn::Iota(kIntTag, 0); }

/// Zeros come in.
template <int kBits>
Ints shift_right(Ints a) {
  constexpr hn::RebindToUnsigned<decltype(kIntTag)> kTag;
  return hn::BitCast(kIntTag, hn::ShiftRight<kBits>(hn::BitCast(kTag, a)));
}

/// as_*: the same bits. Else the same numbers, where they fit 32 bits: truncated toward zero,
/// floored down.
inline Ints as_ints(Floats a) { return hn::BitCast(kIntTag, a); }
inline Floats as_floats(Ints a) { return hn::BitCast(kFloatTag, a); }
inline Floats to_floats(Ints a) { return hn::ConvertTo(kFloatTag, a); }
inline Ints truncated(Floats a) { return hn::ConvertTo(kIntTag, a); }
inline Ints floored(Floats a) { return truncated(hn::Floor(a)); }

inline Mask no_lane() { return hn::MaskFromVec(hn::Zero(kIntTag)); }
inline Mask every_lane() { return hn::Not(no_lane()); }
inline Mask operator&(Mask a, Mask b) { return hn::And(a, b); }
inline Mask operator|(Mask a, Mask b) { return hn::Or(a, b); }
inline Mask without(Mask a, Mask b) { return hn::AndNot(b, a); }
inline Mask less(Floats a, Floats b) { return hn::RebindMask(kIntTag, a < b); }
inline Mask less_equal(Floats a, Floats b) { return hn::RebindMask(kIntTag, a <= b); }
inline Mask less(Ints a, Ints b) { return a < b; }
inline Mask equal(Ints a, Ints b) { return a == b; }
/// `bit` is a power of two.
inline Mask has_bit(Ints a, std::uint32_t bit) { return hn::TestBit(a, all(bit)); }
inline Mask has_none(Ints a, Ints bits) { return (a & bits) == hn::Zero(kIntTag); }
inline Mask equal_bytes(const std::uint8_t* p, std::uint8_t b) {
  return load_bytes(p) == all(std::uint32_t{b});
}

inline bool any(Mask m) { return !hn::AllFalse(kIntTag, m); }
inline int count(Mask m) { return static_cast<int>(hn::CountTrue(kIntTag, m)); }
/// Bit l is lane l.
inline std::uint32_t bits(Mask m) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(kIntTag, m, bytes);
  std::uint32_t lanes = 0;
  std::memcpy(&lanes, bytes, sizeof lanes);
  return lanes;
}

/// a where m, else b; a + b where m, else a.
inline Floats select(Mask m, Floats a, Floats b) {
  return hn::IfThenElse(hn::RebindMask(kFloatTag, m), a, b);
}
inline Ints select(Mask m, Ints a, Ints b) { return hn::IfThenElse(m, a, b); }
inline Floats add_where(Mask m, Floats a, Floats b) { return select(m, a + b, a); }
inline Ints add_where(Mask m, Ints a, Ints b) { return select(m, a + b, a); }

/// p[at]. With m: 0 in the other lanes, which may read p[0].
inline Floats gather(const float* p, Ints at) { return hn::GatherIndex(kFloatTag, p, at); }
inline Ints gather(Mask m, const std::uint32_t* p, Ints at) {
  const auto* const from = reinterpret_cast<const std::int32_t*>(p);
#if HWY_MAJOR > 1 || HWY_MINOR >= 1
  return hn::MaskedGatherIndex(m, kIntTag, from, at);
#elif HWY_TARGET == HWY_AVX3
  // Highway 1.0 gathers all lanes or none, which made the full walk 1.4 times as slow
  return Ints{_mm512_mask_i32gather_epi32(_mm512_setzero_si512(), m.raw, at.raw, from, 4)};
#else
  return hn::IfThenElseZero(m, hn::GatherIndex(kIntTag, from, hn::IfThenElseZero(m, at)));
#endif
}
inline Floats gather(Mask m, const float* p, Ints at) {
  return as_floats(gather(m, reinterpret_cast<const std::uint32_t*>(p), at));
}
/// Each lane gets the one before it, the first lane the last one.
inline Ints turn_up(Ints a) {
  const Ints from = hn::Iota(kIntTag, kLanes - 1) & all(kLanes - 1);
  return hn::TableLookupLanes(a, hn::IndicesFromVec(kIntTag, from));
}
/// Writes the lanes of m first, kLanes numbers in all. Returns how many lanes m has.
inline int pack(Mask m, Ints a, std::int32_t* to) {
  store(to, hn::Compress(a, m));
  return count(m);
}
/// Of all lanes, taken as unsigned.
inline std::int64_t sum_of(Ints a) {
  constexpr hn::Repartition<std::uint64_t, decltype(kIntTag)> kWideTag;
  const auto pairs = hn::BitCast(kWideTag, a);
  const auto sums = (pairs & hn::Set(kWideTag, 0xffffffffU)) + hn::ShiftRight<32>(pairs);
  return static_cast<std::int64_t>(hn::GetLane(hn::SumOfLanes(kWideTag, sums)));
}

/// kLanes float64 numbers.
struct Doubles {
  hn::Vec<decltype(kDoubleTag)> low, high;
};
inline Doubles all(double x) { return {hn::Set(kDoubleTag, x), hn::Set(kDoubleTag, x)}; }
inline Doubles load(const double* p) {
  return {hn::LoadU(kDoubleTag, p), hn::LoadU(kDoubleTag, p + kLanes / 2)};
}
inline Doubles operator+(Doubles a, Doubles b) { return {a.low + b.low, a.high + b.high}; }
inline Doubles operator-(Doubles a, Doubles b) { return {a.low - b.low, a.high - b.high}; }
inline Doubles operator*(Doubles a, Doubles b) { return {a.low * b.low, a.high * b.high}; }
inline Doubles operator/(Doubles a, Doubles b) { return {a.low / b.low, a.high / b.high}; }
inline Doubles magnitude(Doubles a) { return {hn::Abs(a.low), hn::Abs(a.high)}; }
inline Doubles min(Doubles a, Doubles b) {
  return {hn::Min(a.low, b.low), hn::Min(a.high, b.high)};
}
inline Doubles max(Doubles a, Doubles b) {
  return {hn::Max(a.low, b.low), hn::Max(a.high, b.high)};
}
inline Doubles select_less(Doubles a, Doubles b, Doubles yes, Doubles no) {
  return {hn::IfThenElse(a.low < b.low, yes.low, no.low),
          hn::IfThenElse(a.high < b.high, yes.high, no.high)};
}
inline Doubles widen(Floats a) {
  return {hn::PromoteTo(kDoubleTag, hn::LowerHalf(kHalfFloatTag, a)),
          hn::PromoteTo(kDoubleTag, hn::UpperHalf(kHalfFloatTag, a))};
}
inline Doubles widen(Ints a) {
  return {hn::PromoteTo(kDoubleTag, hn::LowerHalf(kHalfIntTag, a)),
          hn::PromoteTo(kDoubleTag, hn::UpperHalf(kHalfIntTag, a))};
}
inline Floats narrow(Doubles a) {
  return hn::Combine(kFloatTag, hn::DemoteTo(kHalfFloatTag, a.high),
                     hn::DemoteTo(kHalfFloatTag, a.low));
}
/// What does not fit becomes the nearest that does.
inline Ints truncated(Doubles a) {
  return hn::Combine(kIntTag, hn::DemoteTo(kHalfIntTag, a.high), hn::DemoteTo(kHalfIntTag, a.low));
}
inline Ints floored(Doubles a) { return truncated({hn::Floor(a.low), hn::Floor(a.high)}); }

/// Calls body(first, left) for `count` elements, kLanes at a time. `left` is the constant kLanes
/// but at the end.
template <typename Body>
__attribute__((flatten)) inline void for_lanes(int count, const Body& body) {
  int i = 0;
  for (; i + kLanes <= count; i += kLanes) body(i, kLanes);
  if (i < count) body(i, count - i);
}

/// The first `left` of kLanes elements, at the end of an array. Those read beyond are zeros.
template <typename T, typename Use>
HWY_INLINE auto read_end(const T* p, int left, const Use& use) {
  if (left >= kLanes) return use(p);
  T some[kLanes] = {};
  for (int i = 0; i < left; ++i) some[i] = p[i];
  return use(some);
}
template <typename T, typename Use>
HWY_INLINE void write_end(T* p, int left, const Use& use) {
  if (left >= kLanes) return use(p);
  T some[kLanes];
  use(some);
  for (int i = 0; i < left; ++i) p[i] = some[i];
}
inline Floats load(const float* p, int left) {
  return read_end(p, left, [](const float* q) { return load(q); });
}
inline Mask equal_bytes(const std::uint8_t* p, std::uint8_t b, int left) {
  return read_end(p, left, [b](const std::uint8_t* q) { return equal_bytes(q, b); });
}
inline void store(float* p, Floats a, int left) {
  write_end(p, left, [a](float* q) { store(q, a); });
}
inline void store_bytes(std::uint8_t* p, Ints a, int left) {
  write_end(p, left, [a](std::uint8_t* q) { store_bytes(q, a); });
}

}  // namespace
}  // namespace gnbv
