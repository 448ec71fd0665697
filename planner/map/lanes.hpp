// The widest vectors that this translation unit is compiled for, under one set of names:
//   Floats, Ints, Mask, Doubles   kLanes float32, int32, truths, float64
//   load, store, load_bytes, store_bytes   unaligned, kLanes elements; all(x): x in every lane
//   lesser, greater               the second where one is NaN; comparisons with NaN are false
//   and_not(a, b)                 a and not b; bits(m): bit l is lane l
//   select(m, a, b)               a where m, else b; select_less(a, b, yes, no) by a < b
//   nearest, truncated            to integers, ties to even; only what fits 32 bits
//   power_of_two_at_most, exponent   of numbers of at least 1: 2^floor(log2), floor(log2)
// Everything has internal linkage: no copy made for one processor can be linked into another's
// code. For the same reason this is for the loops of *_loops.hpp alone, which include nothing
// of ours but plain structs.
#pragma once

#if defined(__AVX512F__)
#include "planner/map/lanes_avx512.hpp"
#elif defined(__AVX2__)
#include "planner/map/lanes_avx2.hpp"
#else
#include "planner/map/lanes_sse2.hpp"
#endif
