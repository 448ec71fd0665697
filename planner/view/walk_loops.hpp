// The walk of a view's rays. For view_loops.cpp alone.
//
// A ray leaves its voxel at the least of t_next, crosses the border along that axis into the next
// voxel, and crosses its next border along it t_voxel later. It ends at the first occupied voxel,
// at the border of the grid (t_leave) or when it has visited the voxels within its range. Rays of a
// bundle are lanes: each takes the same float32 operations in the same order at every level.
#pragma once

#include "planner/map/voxel_word.hpp"
#include "planner/view/ray_bundle.hpp"

namespace gnbv {
namespace {

/// A sum in each lane that may exceed 32 bits: 369 terms of ln 2, the largest there are, would.
/// carry() has to come after kTermsPerCarry terms at the latest.
struct LongSum {
  static constexpr int kTermsPerCarry = 256;
  Ints low = all(0), high = all(0);

  void carry() {
    high = high + shift_right<16>(low);
    low = low & all(0xffff);
  }
  std::int64_t total(Mask m) const {
    return sum_of(select(m, low, all(0))) + (sum_of(select(m, high, all(0))) << 16);
  }
};

/// When the rays leave their voxels.
inline Ints exit_time(const Bundle& b) {
  return hn::Min(b.t_next[0], hn::Min(b.t_next[1], b.t_next[2]));
}

/// Takes every moving ray into its next voxel. Of axes with equal times the last goes first, as in
/// walk_ray().
inline void take_step(Bundle& b, Ints t_exit) {
  b.voxels_left = b.voxels_left - all(1);
  b.moving = b.moving & less(all(0), b.voxels_left) & less(t_exit, b.t_leave);
  const Mask z = b.moving & equal(b.t_next[2], t_exit);
  const Mask not_z = without(b.moving, z);
  const Mask y = not_z & equal(b.t_next[1], t_exit);
  const Mask x = without(not_z, y);
  b.t_next[0] = add_where(x, b.t_next[0], b.t_voxel[0]);
  b.t_next[1] = add_where(y, b.t_next[1], b.t_voxel[1]);
  b.t_next[2] = add_where(z, b.t_next[2], b.t_voxel[2]);
  b.voxel = add_where(x, b.voxel, b.move[0]);
  b.voxel = add_where(y, b.voxel, b.move[1]);
  b.voxel = add_where(z, b.voxel, b.move[2]);
}

inline void mark(std::uint8_t* marks, Mask seeing, Ints voxel, Ints resting_voxel) {
  alignas(64) std::int32_t at[kLanes];
  store(at, select(seeing, voxel, resting_voxel));
  // through memory: the compiler would take the lanes out of the register, at twice the cost
  __asm__("" : "+m"(at));
  for (const std::int32_t voxel_at : at) marks[static_cast<std::uint32_t>(voxel_at)] = kMarked;
}

/// What the full walk keeps of each ray.
struct RayMetrics {
  Floats visibility = all(1.0F);  // P_v
  Floats occlusion_aware = all(0.0F);
  Floats unobserved = all(0.0F);
  Floats unknown_run = all(0.0F);  // P_v H since the last known voxel
  Floats rear_side = all(0.0F);
  Floats volume = all(0.0F);  // sum of cubes of times, over the unknown voxels
  Ints t_enter = all(0);
  Ints visits = all(0);  // voxels of the rays that hit, the hit one included
  Mask after_unknown = no_lane();
  Mask hit = no_lane();
  Mask rear_hit = no_lane();
  Mask front_hit = no_lane();
  Mask shadow = no_lane();
};

/// 1 / (1 + e^l) = 1 - P, from x = l log2(e). Within 2e-6 for every x.
inline Floats free_probability(Floats x) {
  constexpr float kRounder = 12582912.0F;  // 1.5 * 2^23: its neighbours are the integers
  const Floats bounded = hn::Min(hn::Max(x, all(-100.0F)), all(100.0F));
  const Floats shifted = bounded + all(kRounder);
  const Floats r = bounded - (shifted - all(kRounder));
  // 2^r for |r| <= 0.5, relative error 3e-6
  Floats power = all(0.00958285388F);
  power = power * r + all(0.0559064336F);
  power = power * r + all(0.240240991F);
  power = power * r + all(0.693124175F);
  power = power * r + all(1.0F);
  const Floats odds = as_floats(as_ints(power) + hn::ShiftLeft<23>(as_ints(shifted)));
  return all(1.0F) / (all(1.0F) + odds);
}

inline Floats cube(Ints t) {
  const Floats f = to_floats(t);
  return f * f * f;
}

/// Rays that meet a surface at their voxel number `step`, from 0.
inline void measure_hits(Mask occupied, Floats visible, int step, RayMetrics& m) {
  const Mask rear = occupied & m.after_unknown;
  m.rear_side = select(rear, m.unknown_run + visible, m.rear_side);
  m.rear_hit = m.rear_hit | rear;
  if (step > 0) m.front_hit = m.front_hit | without(occupied, rear);
  m.hit = m.hit | occupied;
  m.visits = select(occupied, all(step + 1), m.visits);
}

inline void measure_unknown(Mask unknown, Ints word, Floats visible, Ints t_exit, RayMetrics& m) {
  m.unobserved = add_where(unknown, m.unobserved, visible);
  m.unknown_run = select(unknown, m.unknown_run + visible, all(0.0F));
  m.volume = add_where(unknown, m.volume, cube(t_exit) - cube(m.t_enter));
  m.shadow = m.shadow | (unknown & has_bit(word, kShadowBit));
}

/// The factors by which the visibility falls.
struct Odds {
  float power;     // log2(e), negative for the legacy visibility
  Floats settled;  // the factor of a voxel of the settled word
};

// less adds nothing to any sum, and numbers that follow from it would be denormal, hence slow
constexpr float kLeastVisibility = 0x1p-60F;

/// Adds the voxels at hand if all have the settled word: they have no entropy.
inline void measure_settled(Ints t_exit, const Odds& odds, RayMetrics& m) {
  m.unknown_run = all(0.0F);
  m.after_unknown = no_lane();
  m.t_enter = t_exit;
  m.visibility = hn::Max(m.visibility * odds.settled, all(kLeastVisibility));
}

/// Adds the voxels at hand. The branches only skip what would change nothing.
inline void measure(const ViewMaps& maps, const Bundle& b, Ints word, Ints known, Mask occupied,
                    Ints t_exit, const Odds& odds, int step, RayMetrics& m) {
  // most of the space before a camera has been looked at often
  if (!any(without(b.seeing, equal(word, all(maps.settled_word))))) {
    measure_settled(t_exit, odds, m);
    return;
  }
  const Mask unknown = b.seeing & has_none(word, all(kStateMask));
  const Floats entropy = to_floats(all(kLn2Units) - known);
  const Floats visible = m.visibility * entropy;
  m.occlusion_aware = add_where(b.seeing, m.occlusion_aware, visible);
  if (any(occupied)) measure_hits(occupied, visible, step, m);
  if (any(unknown)) {
    measure_unknown(unknown, word, visible, t_exit, m);
  } else {
    m.unknown_run = all(0.0F);
  }
  m.after_unknown = unknown;
  m.t_enter = t_exit;
  const Mask measured = b.seeing & has_bit(word, kMeasuredBit);
  Floats factor = all(0.5F);  // of log-odds 0
  if (any(measured)) {
    const Floats log_odds = gather(measured, maps.log_odds, b.voxel);
    factor = free_probability(log_odds * all(odds.power));
  }
  m.visibility = hn::Max(m.visibility * factor, all(kLeastVisibility));
}

/// Adds what the rays of a bundle sum up to. No term is negative, and each ray's is rounded, so
/// that the order of the rays leaves no trace.
void add_rays(const RayMetrics& m, const LongSum& known, RaySums& sums) {
  constexpr float kCubeShare = 0x1p-57F;  // times are 2^-29 of the ray, shares 2^-30
  sums.rays_occupied += count(m.hit);
  sums.rear_side_rays += count(m.rear_hit);
  sums.shadow_rays += count(m.shadow);
  sums.front_rays += count(without(m.front_hit, m.shadow));
  sums.visits_occupied += sum_of(m.visits);
  sums.occlusion_aware += sum_of(hn::NearestInt(m.occlusion_aware));
  sums.unobserved += sum_of(hn::NearestInt(m.unobserved));
  sums.rear_side += sum_of(hn::NearestInt(m.rear_side));
  sums.unknown_share += sum_of(hn::NearestInt(m.volume * all(kCubeShare)));
  sums.known_occupied += known.total(m.hit);
}

template <bool kFull>
void walk_bundle(Bundle b, const Odds& odds, ViewMaps& maps, RaySums& sums) {
  const ViewMaps local = maps;  // a mark might be any byte in memory to the compiler
  const Ints resting_voxel = all(local.resting_voxel);
  RayMetrics metrics;
  LongSum known_sum;
  Mask foresees = b.seeing;  // rays that have met no predicted voxel
  std::int64_t visits = 0;
  sums.rays += count(b.seeing);
  for (int step = 0; any(b.seeing); ++step) {
    mark(local.marks, b.seeing, b.voxel, resting_voxel);
    const Ints word = gather(b.moving, local.words, b.voxel);  // waits for no earlier word
    const Ints known = shift_right<kKnownShift>(word);
    known_sum.low = add_where(b.seeing, known_sum.low, known);
    visits += count(b.seeing);
    const Mask occupied =
        b.seeing & has_bit(word, static_cast<std::uint32_t>(VoxelState::occupied));
    const Mask predicted = b.seeing & foresees & has_bit(word, kPredictedBit);
    if (any(predicted)) {
      maps.predicted_count +=
          static_cast<std::size_t>(pack(predicted, b.voxel, maps.predicted + maps.predicted_count));
      foresees = without(foresees, predicted);
    }
    const Ints t_exit = exit_time(b);
    if constexpr (kFull) {
      measure(local, b, word, known, occupied, t_exit, odds, step, metrics);
    }
    take_step(b, t_exit);
    b.seeing = without(b.seeing & b.moving, occupied);
    if (step % LongSum::kTermsPerCarry == LongSum::kTermsPerCarry - 1) known_sum.carry();
  }
  sums.visits += visits;
  sums.known += known_sum.total(every_lane());
  if constexpr (kFull) add_rays(metrics, known_sum, sums);
}

template <bool kFull>
void walk_rays(const RayFanFrame& frame, const RayEnds& ends, float odds_power, ViewMaps& maps,
               RaySums& sums) {
  const Odds odds = {.power = odds_power,
                     .settled = free_probability(all(maps.settled_log_odds) * all(odds_power))};
  for (std::size_t first = 0; first < ends.count; first += kLanes) {
    walk_bundle<kFull>(make_bundle(frame, ends, first), odds, maps, sums);
  }
}

}  // namespace
}  // namespace gnbv
