#include "planner/map/fan_walker.hpp"

#include <algorithm>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace gnbv {
namespace {

constexpr std::uint8_t kUnmarked = 0;
constexpr std::uint8_t kMarked = 1;
constexpr std::uint8_t kFrame = 2;

constexpr std::size_t kLanes = 4;  // rays walked side by side, in pairs
constexpr VoxelPlace kNowhere = -1;

}  // namespace

/// Rays under way, in memory.
struct FanWalker::Lanes {
  struct alignas(16) Pair {
    double t_next[3][2];
    double t_voxel[3][2];
    double length_m[2];
    VoxelPlace place[2];
    VoxelPlace move[3][2];
    VoxelPlace end[2];
  };
  Pair pair[kLanes / 2];

  void set(std::size_t lane, const RaySteps& ray, const std::array<VoxelPlace, 3>& move,
           VoxelPlace place, VoxelPlace end) {
    Pair& p = pair[lane / 2];
    const std::size_t l = lane % 2;
    for (std::size_t a = 0; a < 3; ++a) {
      p.t_next[a][l] = ray.t_next[a];
      p.t_voxel[a][l] = ray.t_voxel[a];
      p.move[a][l] = ray.step[a] * move[a];
    }
    p.length_m[l] = ray.length_m;
    p.place[l] = place;
    p.end[l] = end;
  }
};

FanWalker::FanWalker(const GridGeometry& grid) : grid_(grid) {
  const Key& size = grid.size();
  const std::array<std::int64_t, 3> framed = {size[0] + 2, size[1] + 2, size[2] + 2};
  const std::array<std::int64_t, 3> stride = {1, framed[0], framed[0] * framed[1]};
  const std::array<std::int64_t, 3> voxel_stride = {1, size[0], std::int64_t{size[0]} * size[1]};
  for (std::size_t a = 0; a < 3; ++a)
    move_[a] = voxel_stride[a] * (std::int64_t{1} << 32) + stride[a];
  first_ = stride[0] + stride[1] + stride[2];
  const std::int64_t places = stride[2] * framed[2];
  marks_.assign(static_cast<std::size_t>(places) + 1, kFrame);
  for (std::int32_t z = 0; z < size[2]; ++z) {
    for (std::int32_t y = 0; y < size[1]; ++y) {
      const auto row = marks_.begin() + first_ + z * stride[2] + y * stride[1];
      std::fill(row, row + size[0], kUnmarked);
    }
  }
  marks_.back() = kMarked;  // where lanes without a ray rest
}

VoxelPlace FanWalker::place_of(const Key& key) const {
  const Key& min = grid_.min_key();
  return first_ + (key[0] - min[0]) * move_[0] + (key[1] - min[1]) * move_[1] +
         (key[2] - min[2]) * move_[2];
}

bool FanWalker::mark(VoxelPlace place) {
  std::uint8_t& m = marks_[static_cast<std::uint32_t>(place)];
  const bool is_new = m == kUnmarked;
  m = kMarked;
  return is_new;
}

void FanWalker::clear(std::span<const VoxelPlace> places) {
  for (const VoxelPlace place : places) marks_[static_cast<std::uint32_t>(place)] = kUnmarked;
}

bool FanWalker::enter(const Key& key_end, RaySteps& ray, Key& key) const {
  const Key& min = grid_.min_key();
  const Key& size = grid_.size();
  const auto misses_along = [&](std::size_t a) {
    return key[a] < min[a] ? ray.step[a] <= 0 : key[a] >= min[a] + size[a] && ray.step[a] >= 0;
  };
  while (!grid_.contains(key)) {
    if (misses_along(0) || misses_along(1) || misses_along(2)) return false;
    const std::size_t axis = next_axis(ray);
    key[axis] += ray.step[axis];
    ray.t_next[axis] += ray.t_voxel[axis];
    if (key == key_end || *std::min_element(ray.t_next.begin(), ray.t_next.end()) > ray.length_m) {
      return false;
    }
  }
  return true;
}

bool FanWalker::start_ray(const RayOrigin& origin, const Vec3f& end_m, Lanes& lanes,
                          std::size_t lane, std::vector<VoxelPlace>& places) {
  const Key key_end = grid_.key_of(end_m);
  if (key_end == origin.key) return false;
  RaySteps ray = make_ray_steps(grid_, origin, end_m);
  Key key = origin.key;
  if (!grid_.contains(key) && (!(ray.length_m > 0.0) || !enter(key_end, ray, key))) return false;
  const VoxelPlace start = place_of(key);
  if (mark(start)) places.push_back(start);
  if (!(ray.length_m > 0.0)) return false;
  lanes.set(lane, ray, move_, start, grid_.contains(key_end) ? place_of(key_end) : kNowhere);
  return true;
}

bool FanWalker::start_next(const RayOrigin& origin, std::span<const ScanRay>& rays, Lanes& lanes,
                           std::size_t lane, std::vector<VoxelPlace>& places) {
  while (!rays.empty()) {
    const Vec3f end_m = rays.front().end_world_m;
    rays = rays.subspan(1);
    if (start_ray(origin, end_m, lanes, lane, places)) return true;
  }
  RaySteps rest;  // steps nowhere, for ever
  rest.t_next = {0.0, 0.0, 0.0};
  rest.t_voxel = {0.0, 0.0, 0.0};
  rest.length_m = RaySteps::kNever;
  lanes.set(lane, rest, move_, static_cast<VoxelPlace>(marks_.size() - 1), kNowhere);
  return false;
}

#ifdef __SSE2__
namespace {

/// Two rays in registers. The same comparisons and additions as walk_ray, without its branches:
/// which axis comes next is as good as random, and a wrong guess costs more than three additions.
struct PairOfRays {
  __m128d t_next[3], t_voxel[3], length_m;
  __m128i place, move[3], end;

  template <typename Memory>
  void load(const Memory& memory) {
    const auto integers = [](const VoxelPlace* from) {
      return _mm_load_si128(reinterpret_cast<const __m128i*>(from));
    };
    for (int a = 0; a < 3; ++a) {
      t_next[a] = _mm_load_pd(memory.t_next[a]);
      t_voxel[a] = _mm_load_pd(memory.t_voxel[a]);
      move[a] = integers(memory.move[a]);
    }
    length_m = _mm_load_pd(memory.length_m);
    place = integers(memory.place);
    end = integers(memory.end);
  }
  template <typename Memory>
  void store(Memory& memory) const {
    for (int a = 0; a < 3; ++a) _mm_store_pd(memory.t_next[a], t_next[a]);
    _mm_store_si128(reinterpret_cast<__m128i*>(memory.place), place);
  }

  /// One step of both rays; bit l is set when ray l is at its end.
  unsigned step() {
    const __m128d x_before_y = _mm_cmplt_pd(t_next[0], t_next[1]);
    const __m128d x_before_z = _mm_cmplt_pd(t_next[0], t_next[2]);
    const __m128d y_before_z = _mm_cmplt_pd(t_next[1], t_next[2]);
    const __m128d along_x = _mm_and_pd(x_before_y, x_before_z);
    const __m128d along_y = _mm_andnot_pd(x_before_y, y_before_z);
    const __m128d along_xy = _mm_or_pd(along_x, along_y);
    t_next[0] = _mm_add_pd(t_next[0], _mm_and_pd(along_x, t_voxel[0]));
    t_next[1] = _mm_add_pd(t_next[1], _mm_and_pd(along_y, t_voxel[1]));
    t_next[2] = _mm_add_pd(t_next[2], _mm_andnot_pd(along_xy, t_voxel[2]));
    const __m128i x_or_y = _mm_or_si128(_mm_and_si128(_mm_castpd_si128(along_x), move[0]),
                                        _mm_and_si128(_mm_castpd_si128(along_y), move[1]));
    const __m128i z = _mm_andnot_si128(_mm_castpd_si128(along_xy), move[2]);
    place = _mm_add_epi64(place, _mm_or_si128(x_or_y, z));
    const __m128d nearest_m = _mm_min_pd(t_next[0], _mm_min_pd(t_next[1], t_next[2]));
    const __m128d is_beyond = _mm_cmpgt_pd(nearest_m, length_m);
    // the low half of a place is unique; its verdict moves to the sign of the lane
    const __m128i is_end = _mm_slli_epi64(_mm_cmpeq_epi32(place, end), 32);
    return static_cast<unsigned>(_mm_movemask_pd(_mm_or_pd(is_beyond, _mm_castsi128_pd(is_end))));
  }
};

}  // namespace

void FanWalker::walk(const RayOrigin& origin, std::span<const ScanRay> rays,
                     std::vector<VoxelPlace>& places) {
  Lanes lanes;
  std::size_t active = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    if (start_next(origin, rays, lanes, lane, places)) ++active;
  }
  std::uint8_t* const marks = marks_.data();
  const auto mark_of = [marks](VoxelPlace place) -> std::uint8_t& {
    return marks[static_cast<std::uint32_t>(place)];
  };
  // new places gather here, so that the loop calls nothing and keeps its registers
  std::array<VoxelPlace, 256> fresh;
  while (active > 0) {
    PairOfRays a;
    PairOfRays b;
    a.load(lanes.pair[0]);
    b.load(lanes.pair[1]);
    unsigned at_end = 0;
    std::size_t fresh_count = 0;
    bool is_at_frame = false;
    do {
      at_end = a.step() | b.step() << 2;
      const std::array<VoxelPlace, kLanes> place = {
          _mm_cvtsi128_si64(a.place), _mm_cvtsi128_si64(_mm_unpackhi_epi64(a.place, a.place)),
          _mm_cvtsi128_si64(b.place), _mm_cvtsi128_si64(_mm_unpackhi_epi64(b.place, b.place))};
      if (at_end != 0) break;
      const int all = mark_of(place[0]) & mark_of(place[1]) & mark_of(place[2]) & mark_of(place[3]);
      if ((all & kMarked) != 0) continue;
      for (const VoxelPlace p : place) {
        std::uint8_t& m = mark_of(p);
        is_at_frame |= m == kFrame;
        if (m != kUnmarked) continue;
        m = kMarked;
        fresh[fresh_count++] = p;
      }
    } while (!is_at_frame && fresh_count + kLanes <= fresh.size());
    places.insert(places.end(), fresh.data(), fresh.data() + fresh_count);
    a.store(lanes.pair[0]);
    b.store(lanes.pair[1]);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const VoxelPlace place = lanes.pair[lane / 2].place[lane % 2];
      if ((at_end >> lane & 1U) != 0 || mark_of(place) == kFrame) {
        if (!start_next(origin, rays, lanes, lane, places)) --active;
      } else if (mark(place)) {
        places.push_back(place);
      }
    }
  }
}
#else
void FanWalker::walk(const RayOrigin& origin, std::span<const ScanRay> rays,
                     std::vector<VoxelPlace>& places) {
  walk_one_by_one(origin, rays, places);
}
#endif

void FanWalker::walk_one_by_one(const RayOrigin& origin, std::span<const ScanRay> rays,
                                std::vector<VoxelPlace>& places) {
  for (const ScanRay& ray : rays) {
    bool was_inside = false;
    walk_ray(grid_, origin, ray.end_world_m, [&](const Key& key) {
      if (!grid_.contains(key)) return !was_inside;  // straight: once out, never in again
      was_inside = true;
      const VoxelPlace place = place_of(key);
      if (mark(place)) places.push_back(place);
      return true;
    });
  }
}

}  // namespace gnbv
