// The view kernels: the walk of a view's rays, and the count of the voxels that they have marked.
// Each ray takes the same operations in the same order at every SimdLevel.
#include "planner/view/ray_bundle.hpp"

namespace gnbv {
namespace {

/// A sum in each lane that may exceed 32 bits, as 369 terms of ln 2, the largest term, would. Call
/// carry() after kTermsPerCarry terms at the latest.
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

inline Mask has_state(Ints word, VoxelState state) {
  return has_bit(word, static_cast<std::uint32_t>(state));
}

inline void mark(std::uint8_t* marks, Mask seeing, Ints voxel, Ints resting_voxel) {
  alignas(64) std::int32_t at[kLanes];
  store(at, select(seeing, voxel, resting_voxel));
  // through memory: the compiler would take the lanes out of the register, at twice the cost
  __asm__("" : "+m"(at));
  for (const std::int32_t voxel_at : at) marks[static_cast<std::uint32_t>(voxel_at)] = kMarked;
}

/// What the full walk keeps of each ray; see ViewStats.
struct RayMetrics {
  Floats visibility = all(1.0F);  // P_v
  Floats occlusion_aware = all(0.0F), unobserved = all(0.0F), rear_side = all(0.0F);
  Floats unknown_run = all(0.0F);  // P_v H since the last known voxel
  Floats volume = all(0.0F);       // sum of cubes of times, over the unknown voxels
  Ints t_enter = all(0);
  Ints visits = all(0);  // voxels of the rays that hit, the hit one included
  Mask after_unknown = no_lane(), shadow = no_lane();
  Mask hit = no_lane(), rear_hit = no_lane(), front_hit = no_lane();
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

/// Adds rays that meet a surface at their voxel number `step`, from 0.
inline void measure_hits(Mask occupied, Floats visible, int step, RayMetrics& m) {
  const Mask rear = occupied & m.after_unknown;
  m.rear_side = select(rear, m.unknown_run + visible, m.rear_side);
  m.rear_hit = m.rear_hit | rear;
  if (step > 0) m.front_hit = m.front_hit | without(occupied, rear);
  m.hit = m.hit | occupied;
  m.visits = select(occupied, all(step + 1), m.visits);
}

/// The factors by which the visibility falls.
struct Odds {
  float power;     // log2(e), negative for the legacy visibility
  Floats settled;  // the factor of a voxel of the settled word
};

// less adds nothing to any sum, and numbers that follow from it would be denormal, hence slow
constexpr float kLeastVisibility = 0x1p-60F;

/// Adds the voxels at hand. Branches only skip what would change nothing.
inline void measure(const ViewMaps& maps, const Bundle& b, Ints word, Ints known, Mask occupied,
                    Ints t_exit, const Odds& odds, int step, RayMetrics& m) {
  // most of the space before a camera has been looked at often: settled, without entropy
  if (!any(without(b.seeing, equal(word, all(maps.settled_word))))) {
    m.unknown_run = all(0.0F);
    m.after_unknown = no_lane();
    m.t_enter = t_exit;
    m.visibility = hn::Max(m.visibility * odds.settled, all(kLeastVisibility));
    return;
  }
  const Mask unknown = b.seeing & has_none(word, all(kStateMask | kOutsideBit));
  const Floats entropy = to_floats(all(kLn2Units) - known);
  const Floats visible = m.visibility * entropy;
  m.occlusion_aware = add_where(b.seeing, m.occlusion_aware, visible);
  const Mask hit = without(occupied, has_bit(word, kOutsideBit));
  if (any(hit)) measure_hits(hit, visible, step, m);
  if (any(unknown)) {
    m.unobserved = add_where(unknown, m.unobserved, visible);
    m.unknown_run = select(unknown, m.unknown_run + visible, all(0.0F));
    m.volume = add_where(unknown, m.volume, cube(t_exit) - cube(m.t_enter));
    m.shadow = m.shadow | (unknown & has_bit(word, kShadowBit));
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

/// Adds the sums of a bundle's rays. Each ray's term is rounded to an integer, so that no sum
/// depends on the order of the rays.
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
    const Mask occupied = b.seeing & has_state(word, VoxelState::occupied);
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

// ---- the count ----------------------------------------------------------------------------------

constexpr std::size_t kTallyChunk = 64;
// a chunk adds kTallyChunk / kLanes terms to each lane of LongSum
constexpr int kChunksPerCarry = LongSum::kTermsPerCarry * kLanes / static_cast<int>(kTallyChunk);

void tally_group(const ViewMaps& maps, std::size_t first, Mask seen, VoxelSums& sums,
                 LongSum& known_sum) {
  const Ints words = load(maps.words + first);
  const Mask marked = without(seen, has_bit(words, kOutsideBit));
  const Ints word = hn::IfThenElseZero(marked, words);
  known_sum.low = known_sum.low + shift_right<kKnownShift>(word);
  sums.visited += count(marked);
  sums.free += count(marked & has_state(word, VoxelState::free));
  const Mask occupied = marked & has_state(word, VoxelState::occupied);
  if (any(occupied)) {
    const Ints voxel = all(static_cast<std::int32_t>(first)) + int_ramp();
    std::int32_t* const to = sums.occupied + sums.occupied_count;
    sums.occupied_count += static_cast<std::size_t>(pack(occupied, voxel, to));
  }
  const Mask shadow = marked & has_bit(word, kShadowBit);
  if (maps.shadow_steps != nullptr && any(shadow)) {
    sums.shadow += count(shadow);
    sums.shadow_steps += sum_of(select(shadow, load_bytes(maps.shadow_steps + first), all(0)));
  }
}

inline bool is_blank(const std::uint8_t* marks) {
  std::uint64_t eights[kTallyChunk / 8];
  __builtin_memcpy(eights, marks, kTallyChunk);
  std::uint64_t some = 0;
  for (const std::uint64_t eight : eights) some |= eight;
  return some == 0;
}

void tally(const ViewMaps& maps, const VoxelBox& box, VoxelSums& sums) {
  LongSum known_sum;
  int chunks = 0;
  for (std::size_t row = 0; row < box.count[1] * box.count[2]; ++row) {
    const std::size_t first =
        box.first + row % box.count[1] * box.stride[1] + row / box.count[1] * box.stride[2];
    for (std::size_t at = first; at < first + box.count[0]; at += kTallyChunk) {
      if (is_blank(maps.marks + at)) continue;
      for (std::size_t group = at; group < at + kTallyChunk; group += kLanes) {
        const Mask marked = equal_bytes(maps.marks + group, kMarked);
        if (any(marked)) tally_group(maps, group, marked, sums, known_sum);
      }
      __builtin_memset(maps.marks + at, 0, kTallyChunk);
      if (++chunks % kChunksPerCarry == 0) known_sum.carry();
    }
  }
  sums.known += known_sum.total(every_lane());
}

}  // namespace

namespace GNBV_SIMD_LEVEL {

const ViewKernels kViewKernels = {
    .walk_voxels = walk_rays<false>, .walk_full = walk_rays<true>, .tally = tally};

}  // namespace GNBV_SIMD_LEVEL
}  // namespace gnbv
