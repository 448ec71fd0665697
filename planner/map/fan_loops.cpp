// The fan kernels, once for each SimdLevel.
#include "planner/map/fan_kernels.hpp"
#include "sim/core/lanes.hpp"

namespace gnbv {
namespace {

static_assert(kFanBundle % kLanes == 0);

/// Rays side by side, as many as there are lanes.
struct Side {
  Doubles t_next[3], t_voxel[3], length_m;
  Ints place, move[3], end;
  Mask moving = every_lane();
};

inline Side load_side(const FanRays& rays, std::size_t first) {
  Side s;
  for (int a = 0; a < 3; ++a) {
    s.t_next[a] = load(rays.t_next[a] + first);
    s.t_voxel[a] = load(rays.t_voxel[a] + first);
    s.move[a] = load(rays.move[a] + first);
  }
  s.length_m = load(rays.length_m + first);
  s.place = load(rays.place + first);
  s.end = load(rays.end + first);
  return s;
}

/// One step of every ray: the comparisons and additions of walk_ray(), without its branches. Those
/// at their end are moving no more.
inline void take_step(Side& s) {
  const Mask x = less(s.t_next[0], min(s.t_next[1], s.t_next[2]));
  const Mask x_or_y = less(min(s.t_next[0], s.t_next[1]), s.t_next[2]);
  const Mask y = without(x_or_y, x);
  const Mask z = without(every_lane(), x_or_y);
  s.t_next[0] = add_where(x, s.t_next[0], s.t_voxel[0]);
  s.t_next[1] = add_where(y, s.t_next[1], s.t_voxel[1]);
  s.t_next[2] = add_where(z, s.t_next[2], s.t_voxel[2]);
  s.place = add_where(z, add_where(y, add_where(x, s.place, s.move[0]), s.move[1]), s.move[2]);
  const Doubles nearest_m = min(s.t_next[0], min(s.t_next[1], s.t_next[2]));
  s.moving = without(without(s.moving, less(s.length_m, nearest_m)), equal(s.place, s.end));
}

/// Where the rays are, in memory: the others rest.
struct Places {
  alignas(64) std::int32_t at[kLanes];

  void set(const Side& s, Ints resting) {
    store(at, select(s.moving, s.place, resting));
    // through memory: the compiler would take the lanes out of the register, at twice the cost
    __asm__("" : "+m"(at));
  }
};

inline Mask at_frame(const Places& places, const std::uint8_t* marks) {
  alignas(64) std::int32_t is_frame[kLanes];
  for (int l = 0; l < kLanes; ++l) {
    is_frame[l] = marks[static_cast<std::uint32_t>(places.at[l])] & kFanFrame;
  }
  return has_bits(every_lane(), load(is_frame), all(std::uint32_t{kFanFrame}));
}

std::size_t walk_side(Side s, std::int32_t resting, std::uint8_t* marks, std::int32_t* listed) {
  std::size_t count = 0;
  Places places;
  while (true) {
    take_step(s);
    if (!any(s.moving)) return count;
    places.set(s, all(resting));
    unsigned every = kFanListed;
    unsigned some = 0;
    for (int l = 0; l < kLanes; ++l) {
      const std::uint8_t mark = marks[static_cast<std::uint32_t>(places.at[l])];
      every &= mark;
      some |= mark;
    }
    if (every != 0) continue;  // near the sensor mostly
    if ((some & kFanFrame) != 0) {
      s.moving = without(s.moving, at_frame(places, marks));
      places.set(s, all(resting));
    }
    for (int l = 0; l < kLanes; ++l) {
      std::uint8_t& mark = marks[static_cast<std::uint32_t>(places.at[l])];
      listed[count] = places.at[l];
      count += static_cast<std::size_t>(mark == kFanUnlisted);
      mark = kFanListed;
    }
  }
}

std::size_t walk_fan(const FanRays& rays, std::int32_t resting, std::uint8_t* marks,
                     std::int32_t* listed) {
  std::size_t count = 0;
  for (std::size_t first = 0; first < kFanBundle; first += static_cast<std::size_t>(kLanes)) {
    count += walk_side(load_side(rays, first), resting, marks, listed + count);
  }
  return count;
}

}  // namespace

namespace GNBV_SIMD_LEVEL {

const FanKernels kFanKernels = {.walk = walk_fan};

}  // namespace GNBV_SIMD_LEVEL
}  // namespace gnbv
