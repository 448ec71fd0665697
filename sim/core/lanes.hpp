// Several numbers side by side: the one set of words in which the vector loops are written. A
// source in this dialect is compiled once for each SimdLevel (gnbv_kernels() in CMakeLists.txt) and
// gets the widest vectors of that level; per lane, each word gives the same bits at all of them.
//
//   Floats, Ints, Mask, Doubles     kLanes float32, int32 (modulo 2^32), truths, float64
//   load, store, store_bytes        kLanes elements, at any address
//   all(x), ramp()                  x in every lane; 0, 1, 2, ...
//   + - * / & min max               lane by lane; min and max take the second where one is NaN
//   shift_left<n>, shift_right<n>, power_of_two(n)   zeros come in; 2^n, 0 <= n < 32
//   select(m, a, b)                 a where m, else b
//   add_where(m, a, b)              a + b where m, else a; of Doubles, too
//   equal, less, less_equal         false with NaN; with a mask before them: and m
//   has_bits(m, a, b), has_not_bits m, and whether a & b is something or nothing
//   equal_bytes(p, b)               which of kLanes bytes are b
//   a & b, a | b, without(a, b)     of masks; the last: a and not b
//   bits(m), any(m), count(m)       bit l is lane l; is one true; how many are
//   gather(m, p, at), load_where(m, p)   p[at], p[lane] where m, else 0; p[0] may be read
//   pack(m, a, to), pack(m, first, to)   the lanes of m of a, or their numbers from `first` on, one
//                                   after the other; returns how many, but may write kLanes
//   to_floats, as_floats, as_ints   converted; the same bits
//   nearest, truncated, floored     to integers, ties to even; only what fits 32 bits
//   widen, narrow                   between Floats and Doubles
//   floor_of, min, select_less(a, b, yes, no)   of Doubles
//
// Everything has internal linkage: no copy made for one processor can be linked into another's
// code. For the same reason the sources in this dialect include nothing of ours but this, each
// other and plain structs.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace gnbv {
namespace {

#if defined(__AVX512F__)
constexpr int kLanes = 16;
#elif defined(__AVX2__)
constexpr int kLanes = 8;
#else
constexpr int kLanes = 4;
#endif
constexpr std::uint32_t kAllLanes = (1U << kLanes) - 1U;

using FloatVector __attribute__((vector_size(4 * kLanes))) = float;
using WordVector __attribute__((vector_size(4 * kLanes))) = std::uint32_t;
using SignedVector __attribute__((vector_size(4 * kLanes))) = std::int32_t;
using DoubleVector __attribute__((vector_size(4 * kLanes))) = double;  // half of the lanes
// what intrinsics take and give; g++ 12 keeps constants of this type in memory, of others in short
// registers
using IntVector __attribute__((vector_size(4 * kLanes))) = long long;
using FloatsInMemory __attribute__((vector_size(4 * kLanes), aligned(4), may_alias)) = float;
using IntsInMemory __attribute__((vector_size(4 * kLanes), aligned(4), may_alias)) = long long;
using DoublesInMemory __attribute__((vector_size(4 * kLanes), aligned(8), may_alias)) = double;

struct Floats {
  FloatVector v;
};
struct Ints {
  IntVector v;
};
struct Doubles {
  DoubleVector low, high;
};

inline WordVector words(Ints a) { return reinterpret_cast<WordVector>(a.v); }
inline SignedVector signed_words(Ints a) { return reinterpret_cast<SignedVector>(a.v); }
template <typename Vector>
Ints ints(Vector a) {
  return {reinterpret_cast<IntVector>(a)};
}

inline Floats load(const float* p) { return {*reinterpret_cast<const FloatsInMemory*>(p)}; }
inline Ints load(const std::int32_t* p) { return {*reinterpret_cast<const IntsInMemory*>(p)}; }
inline Doubles load(const double* p) {
  return {*reinterpret_cast<const DoublesInMemory*>(p),
          *reinterpret_cast<const DoublesInMemory*>(p + kLanes / 2)};
}
inline void store(float* p, Floats a) { *reinterpret_cast<FloatsInMemory*>(p) = a.v; }
inline void store(std::int32_t* p, Ints a) { *reinterpret_cast<IntsInMemory*>(p) = a.v; }

// an operand that is no vector counts for every lane; x - 0 is x whatever x is
inline Floats all(float x) { return {x - FloatVector{}}; }
inline Ints all(std::uint32_t x) { return ints(x - WordVector{}); }
inline Ints all(std::int32_t x) { return all(static_cast<std::uint32_t>(x)); }
inline Doubles all(double x) { return {x - DoubleVector{}, x - DoubleVector{}}; }

inline Floats operator+(Floats a, Floats b) { return {a.v + b.v}; }
inline Floats operator-(Floats a, Floats b) { return {a.v - b.v}; }
inline Floats operator*(Floats a, Floats b) { return {a.v * b.v}; }
inline Floats operator/(Floats a, Floats b) { return {a.v / b.v}; }
inline Ints operator+(Ints a, Ints b) { return ints(words(a) + words(b)); }
inline Ints operator-(Ints a, Ints b) { return ints(words(a) - words(b)); }
inline Ints operator*(Ints a, Ints b) { return ints(words(a) * words(b)); }
inline Ints operator&(Ints a, Ints b) { return {a.v & b.v}; }
inline Doubles operator+(Doubles a, Doubles b) { return {a.low + b.low, a.high + b.high}; }
inline Doubles operator-(Doubles a, Doubles b) { return {a.low - b.low, a.high - b.high}; }
inline Doubles operator*(Doubles a, Doubles b) { return {a.low * b.low, a.high * b.high}; }
inline Doubles select_less(Doubles a, Doubles b, Doubles yes, Doubles no) {
  return {a.low < b.low ? yes.low : no.low, a.high < b.high ? yes.high : no.high};
}
inline Doubles min(Doubles a, Doubles b) { return select_less(a, b, a, b); }
template <int kBits>
Ints shift_left(Ints a) {
  return ints(words(a) << kBits);
}
template <int kBits>
Ints shift_right(Ints a) {
  return ints(words(a) >> kBits);
}
inline Ints as_ints(Floats a) { return ints(a.v); }
inline Floats as_floats(Ints a) { return {reinterpret_cast<FloatVector>(a.v)}; }
inline Floats to_floats(Ints a) { return {__builtin_convertvector(signed_words(a), FloatVector)}; }

alignas(64) constexpr float kRamp[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
inline Floats ramp() { return load(kRamp); }

#if !defined(__AVX512F__)

struct Mask {
  IntVector m;  // all bits of a lane or none
};

inline Mask no_lane() { return {IntVector{}}; }
inline Mask every_lane() { return {~IntVector{}}; }
inline Mask operator&(Mask a, Mask b) { return {a.m & b.m}; }
inline Mask operator|(Mask a, Mask b) { return {a.m | b.m}; }
inline Mask without(Mask a, Mask b) { return {a.m & ~b.m}; }
inline Mask equal(Mask m, Ints a, Ints b) { return {m.m & ints(words(a) == words(b)).v}; }
inline Mask less(Mask m, Ints a, Ints b) {
  return {m.m & ints(signed_words(a) < signed_words(b)).v};
}
inline Mask less(Mask m, Floats a, Floats b) { return {m.m & ints(a.v < b.v).v}; }
inline Mask less_equal(Mask m, Floats a, Floats b) { return {m.m & ints(a.v <= b.v).v}; }
inline Mask has_not_bits(Mask m, Ints a, Ints b) { return equal(m, a & b, all(0)); }
inline Mask has_bits(Mask m, Ints a, Ints b) { return without(m, has_not_bits(m, a, b)); }
inline Ints add_where(Mask m, Ints a, Ints b) { return a + Ints{m.m & b.v}; }
inline Floats add_where(Mask m, Floats a, Floats b) { return a + as_floats({m.m & as_ints(b).v}); }

#endif

}  // namespace
}  // namespace gnbv

#if defined(__AVX512F__)
#include "sim/core/lanes_avx512.hpp"
#elif defined(__AVX2__)
#include "sim/core/lanes_avx2.hpp"
#else
#include "sim/core/lanes_baseline.hpp"
#endif

namespace gnbv {
namespace {

inline Mask equal(Ints a, Ints b) { return equal(every_lane(), a, b); }
inline Mask less(Floats a, Floats b) { return less(every_lane(), a, b); }
inline Mask less_equal(Floats a, Floats b) { return less_equal(every_lane(), a, b); }

#if !defined(__AVX512F__)

inline int pack(Mask which, Ints a, std::int32_t* to) {
  alignas(64) std::int32_t lane[kLanes];
  store(lane, a);
  int packed = 0;
  for (std::uint32_t left = bits(which); left != 0; left &= left - 1) {
    to[packed++] = lane[__builtin_ctz(left)];
  }
  return packed;
}
inline int pack(Mask which, std::int32_t first, std::int32_t* to) {
  int packed = 0;
  for (std::uint32_t left = bits(which); left != 0; left &= left - 1) {
    to[packed++] = first + __builtin_ctz(left);
  }
  return packed;
}

#endif

/// The first `count` of kLanes elements, the others zero: a vector over the end of an array.
template <typename T>
struct Tail {
  T at[kLanes] = {};
  Tail() = default;
  Tail(const T* from, int count) {
    for (int i = 0; i < count; ++i) at[i] = from[i];
  }
  void copy_to(T* to, int count) const {
    for (int i = 0; i < count; ++i) to[i] = at[i];
  }
};

}  // namespace
}  // namespace gnbv
