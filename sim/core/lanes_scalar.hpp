// One ray at a time, in the words of the vector kernels: what every processor can do.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace gnbv {
namespace {

constexpr int kLanes = 1;

struct Mask {
  bool m;
};
struct Ints {
  std::int32_t v;
};
struct Floats {
  float v;
};

inline Mask no_lane() { return {false}; }
inline Mask every_lane() { return {true}; }
inline Mask operator&(Mask a, Mask b) { return {static_cast<bool>(a.m & b.m)}; }
inline Mask operator|(Mask a, Mask b) { return {static_cast<bool>(a.m | b.m)}; }
inline Mask without(Mask a, Mask b) { return {static_cast<bool>(a.m & !b.m)}; }
inline bool any(Mask a) { return a.m; }
inline std::uint32_t bits(Mask a) { return a.m ? 1 : 0; }
inline int count(Mask a) { return a.m ? 1 : 0; }

inline Ints all(std::int32_t x) { return {x}; }
inline Ints load(const std::int32_t* p) { return {*p}; }
inline void store(std::int32_t* p, Ints a) { *p = a.v; }
/// Modulo 2^32, as vectors add.
inline Ints add(Ints a, Ints b) {
  return {
      static_cast<std::int32_t>(static_cast<std::uint32_t>(a.v) + static_cast<std::uint32_t>(b.v))};
}
inline Ints sub(Ints a, Ints b) {
  return {
      static_cast<std::int32_t>(static_cast<std::uint32_t>(a.v) - static_cast<std::uint32_t>(b.v))};
}
inline Ints add_where(Mask m, Ints a, Ints b) { return add(a, {b.v & -static_cast<int>(m.m)}); }
inline Ints select(Mask m, Ints a, Ints b) { return {m.m ? a.v : b.v}; }
inline Ints min(Ints a, Ints b) { return {a.v < b.v ? a.v : b.v}; }
template <unsigned kBits>
Ints shift_right(Ints a) {
  return {static_cast<std::int32_t>(static_cast<std::uint32_t>(a.v) >> kBits)};
}
template <unsigned kBits>
Ints shift_left(Ints a) {
  return {static_cast<std::int32_t>(static_cast<std::uint32_t>(a.v) << kBits)};
}
inline Mask equal(Mask m, Ints a, Ints b) { return m & Mask{a.v == b.v}; }
inline Mask less(Mask m, Ints a, Ints b) { return m & Mask{a.v < b.v}; }
inline Mask has_bits(Mask m, Ints a, std::uint32_t mask_bits) {
  return m & Mask{(static_cast<std::uint32_t>(a.v) & mask_bits) != 0};
}
inline Mask has_not_bits(Mask m, Ints a, std::uint32_t mask_bits) {
  return m & Mask{(static_cast<std::uint32_t>(a.v) & mask_bits) == 0};
}
/// 0 where not asked for.
inline Ints gather(Mask m, const std::uint32_t* p, Ints at) {
  return {m.m ? static_cast<std::int32_t>(p[at.v]) : 0};
}
inline Floats gather(Mask m, const float* p, Ints at) { return {m.m ? p[at.v] : 0.0F}; }
inline Mask nonzero_bytes(const std::uint8_t* p) { return {*p != 0}; }
inline Ints load_where(Mask m, const std::uint32_t* p) { return gather(m, p, {0}); }

inline Floats all(float x) { return {x}; }
inline void store(float* p, Floats a) { *p = a.v; }
inline Floats add(Floats a, Floats b) { return {a.v + b.v}; }
inline Floats sub(Floats a, Floats b) { return {a.v - b.v}; }
inline Floats mul(Floats a, Floats b) { return {a.v * b.v}; }
inline Floats div(Floats a, Floats b) { return {a.v / b.v}; }
inline Floats min(Floats a, Floats b) { return {a.v < b.v ? a.v : b.v}; }
inline Floats max(Floats a, Floats b) { return {a.v > b.v ? a.v : b.v}; }
inline Floats add_where(Mask m, Floats a, Floats b) { return {a.v + (m.m ? b.v : 0.0F)}; }
inline Floats select(Mask m, Floats a, Floats b) { return {m.m ? a.v : b.v}; }
inline Floats to_floats(Ints a) { return {static_cast<float>(a.v)}; }
/// To nearest, ties to even.
inline Ints to_ints(Floats a) { return {static_cast<std::int32_t>(__builtin_lrintf(a.v))}; }
inline Ints bits_of(Floats a) { return {std::bit_cast<std::int32_t>(a.v)}; }
inline Floats floats_of(Ints a) { return {std::bit_cast<float>(a.v)}; }

}  // namespace
}  // namespace gnbv
