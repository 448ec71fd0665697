// The walk of a scan's rays, kLanes side by side. At time t (metres from the sensor) a ray is in
// one voxel of the grid. It crosses its next border along axis a at t_next[a], and one more every
// t_voxel[a] after that. The least of the three t_next says along which axis it steps (Amanatides
// and Woo 1987). A ray stops at its end voxel, when all t_next lie beyond its length, or on the
// frame around the grid.
#include "planner/map/map_kernels.hpp"
#include "sim/core/lanes.hpp"

namespace gnbv {
namespace {

constexpr hn::Rebind<std::int64_t, decltype(kDoubleTag)> kPlaceTag;
constexpr std::size_t kRays = kLanes;         // walked side by side, in two vectors
constexpr std::size_t kHalfRays = kRays / 2;  // of so many
static_assert(kFanBundle % kRays == 0);

struct HalfSide {
  hn::Vec<decltype(kDoubleTag)> t_next[3], t_voxel[3], length_m;
  hn::Vec<decltype(kPlaceTag)> place, move[3], end;
  hn::Mask<decltype(kPlaceTag)> moving;
};

inline HalfSide load_half(const FanRays& rays, std::size_t first) {
  HalfSide s;
  for (int a = 0; a < 3; ++a) {
    s.t_next[a] = hn::LoadU(kDoubleTag, rays.t_next[a] + first);
    s.t_voxel[a] = hn::LoadU(kDoubleTag, rays.t_voxel[a] + first);
    s.move[a] = hn::LoadU(kPlaceTag, rays.move[a] + first);
  }
  s.length_m = hn::LoadU(kDoubleTag, rays.length_m + first);
  s.place = hn::LoadU(kPlaceTag, rays.place + first);
  s.end = hn::LoadU(kPlaceTag, rays.end + first);
  s.moving = hn::MaskFromVec(hn::Set(kPlaceTag, -1));
  return s;
}

/// One step of every ray: the comparisons and additions of walk_ray(), without its branches. Rays
/// at their end stop moving.
inline void take_step(HalfSide& s) {
  const auto as_places = [](auto mask) { return hn::RebindMask(kPlaceTag, mask); };
  const auto x = s.t_next[0] < hn::Min(s.t_next[1], s.t_next[2]);
  const auto x_or_y = hn::Min(s.t_next[0], s.t_next[1]) < s.t_next[2];
  const auto move_xy = hn::IfThenElse(as_places(x), s.move[0], s.move[1]);
  s.place = s.place + hn::IfThenElse(as_places(x_or_y), move_xy, s.move[2]);
  s.t_next[0] = hn::IfThenElse(x, s.t_next[0] + s.t_voxel[0], s.t_next[0]);
  s.t_next[1] = hn::IfThenElse(hn::AndNot(x, x_or_y), s.t_next[1] + s.t_voxel[1], s.t_next[1]);
  s.t_next[2] = hn::IfThenElse(x_or_y, s.t_next[2], s.t_next[2] + s.t_voxel[2]);
  const auto nearest_m = hn::Min(s.t_next[0], hn::Min(s.t_next[1], s.t_next[2]));
  const auto is_past = hn::Or(as_places(s.length_m < nearest_m), s.place == s.end);
  s.moving = hn::AndNot(is_past, s.moving);
}

inline bool is_moving(const HalfSide& s) { return !hn::AllFalse(kPlaceTag, s.moving); }

/// Where the moving rays are, in memory; the others rest.
struct Places {
  alignas(64) std::int64_t at[kRays];

  void set(const HalfSide (&side)[2], std::int64_t resting) {
    const auto rest = hn::Set(kPlaceTag, resting);
    for (std::size_t h = 0; h < 2; ++h) {
      const auto place = hn::IfThenElse(side[h].moving, side[h].place, rest);
      hn::Store(place, kPlaceTag, at + h * kHalfRays);
    }
    // through memory: the compiler would take the lanes out of the registers, at twice the cost
    __asm__("" : "+m"(at));
  }
};

/// Stops the rays that have reached the frame.
inline void stop_at_frame(const Places& places, const std::uint8_t* marks, HalfSide (&side)[2]) {
  alignas(64) std::int64_t is_frame[kRays];
  for (std::size_t l = 0; l < kRays; ++l) is_frame[l] = marks[places.at[l]] & kFanFrame;
  for (std::size_t h = 0; h < 2; ++h) {
    const auto frame = hn::Load(kPlaceTag, is_frame + h * kHalfRays);
    side[h].moving = hn::And(side[h].moving, frame == hn::Zero(kPlaceTag));
  }
}

std::size_t walk_side(const FanRays& rays, std::size_t first, std::int32_t resting,
                      std::uint8_t* marks, std::int32_t* listed) {
  HalfSide side[2] = {load_half(rays, first), load_half(rays, first + kHalfRays)};
  std::size_t count = 0;
  Places places;
  while (true) {
    take_step(side[0]);
    take_step(side[1]);
    if (!is_moving(side[0]) && !is_moving(side[1])) return count;
    places.set(side, resting);
    unsigned every = kFanListed;
    unsigned some = 0;
    for (std::size_t l = 0; l < kRays; ++l) {
      const std::uint8_t mark = marks[places.at[l]];
      every &= mark;
      some |= mark;
    }
    if (every != 0) continue;  // all are listed, as most are near the sensor
    if ((some & kFanFrame) != 0) {
      stop_at_frame(places, marks, side);
      places.set(side, resting);
    }
    for (std::size_t l = 0; l < kRays; ++l) {
      std::uint8_t& mark = marks[places.at[l]];
      listed[count] = static_cast<std::int32_t>(places.at[l]);
      count += static_cast<std::size_t>(mark == kFanUnlisted);
      mark = kFanListed;
    }
  }
}

std::size_t walk_fan(const FanRays& rays, std::int32_t resting, std::uint8_t* marks,
                     std::int32_t* listed) {
  std::size_t count = 0;
  for (std::size_t first = 0; first < kFanBundle; first += kRays) {
    count += walk_side(rays, first, resting, marks, listed + count);
  }
  return count;
}

}  // namespace

namespace GNBV_SIMD_LEVEL {

const FanKernels kFanKernels = {.walk = walk_fan};

}  // namespace GNBV_SIMD_LEVEL
}  // namespace gnbv
