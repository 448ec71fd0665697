#include "planner/map/fan_walker.hpp"

#include <emmintrin.h>

#include <algorithm>

namespace gnbv {
namespace {

constexpr std::uint8_t kUnmarked = 0;
constexpr std::uint8_t kMarked = 1;
constexpr std::uint8_t kFrame = 2;

constexpr std::size_t kRays = 4;  // walked side by side, in pairs
constexpr std::int64_t kNowhere = -1;

}  // namespace

/// Rays under way, in memory.
struct FanWalker::Rays {
  struct alignas(16) Pair {
    double t_next[3][2];
    double t_voxel[3][2];
    double length_m[2];
    Place place[2];
    Place move[3][2];
    Place end[2];
  };
  Pair pair[kRays / 2];

  void set(std::size_t which, const RaySteps& ray, const std::array<Place, 3>& move, Place place,
           Place end) {
    Pair& p = pair[which / 2];
    const std::size_t l = which % 2;
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
  marks_.back() = kMarked;  // where nothing is left to walk
}

FanWalker::Place FanWalker::place_of(const Key& key) const {
  const Key& min = grid_.min_key();
  return first_ + (key[0] - min[0]) * move_[0] + (key[1] - min[1]) * move_[1] +
         (key[2] - min[2]) * move_[2];
}

void FanWalker::list(Place place, std::vector<Place>& places) {
  std::uint8_t& m = marks_[static_cast<std::uint32_t>(place)];
  if (m == kUnmarked) places.push_back(place);
  m = kMarked;
}

std::vector<VoxelIndex> FanWalker::take(const std::vector<Place>& places) {
  std::vector<VoxelIndex> voxels;
  voxels.reserve(places.size());
  for (const Place place : places) {
    marks_[static_cast<std::uint32_t>(place)] = kUnmarked;
    voxels.push_back(static_cast<VoxelIndex>(place >> 32));
  }
  return voxels;
}

ScanUpdate FanWalker::compute_update(const Vec3f& origin_world_m, std::span<const ScanRay> rays) {
  occupied_.clear();
  free_.clear();
  for (const ScanRay& ray : rays) {
    if (!ray.hit) continue;
    const Key key = grid_.key_of(ray.end_world_m);
    if (grid_.contains(key)) list(place_of(key), occupied_);
  }
  // occupied wins: its voxels are marked, so no walk lists them
  walk(make_ray_origin(grid_, origin_world_m), rays);
  return {.free = take(free_), .occupied = take(occupied_)};
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

bool FanWalker::start_ray(const RayOrigin& origin, const Vec3f& end_m, Rays& under_way,
                          std::size_t which) {
  const Key key_end = grid_.key_of(end_m);
  if (key_end == origin.key) return false;
  RaySteps ray = make_ray_steps(grid_, origin, end_m);
  Key key = origin.key;
  if (!grid_.contains(key) && (!(ray.length_m > 0.0) || !enter(key_end, ray, key))) return false;
  const Place start = place_of(key);
  list(start, free_);
  if (!(ray.length_m > 0.0)) return false;
  under_way.set(which, ray, move_, start, grid_.contains(key_end) ? place_of(key_end) : kNowhere);
  return true;
}

bool FanWalker::start_next(const RayOrigin& origin, std::span<const ScanRay>& rays, Rays& under_way,
                           std::size_t which) {
  while (!rays.empty()) {
    const Vec3f end_m = rays.front().end_world_m;
    rays = rays.subspan(1);
    if (start_ray(origin, end_m, under_way, which)) return true;
  }
  RaySteps rest;  // steps nowhere, for ever
  rest.t_next = {0.0, 0.0, 0.0};
  rest.t_voxel = {0.0, 0.0, 0.0};
  rest.length_m = RaySteps::kNever;
  under_way.set(which, rest, move_, static_cast<Place>(marks_.size() - 1), kNowhere);
  return false;
}

namespace {

/// Two rays in registers. The same comparisons and additions as walk_ray, without its branches:
/// which axis comes next is as good as random, and a wrong guess costs more than three additions.
struct PairOfRays {
  __m128d t_next[3], t_voxel[3], length_m;
  __m128i place, move[3], end;

  template <typename Memory>
  void load(const Memory& memory) {
    const auto integers = [](const std::int64_t* from) {
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
    // the low half of a place is unique; its verdict moves to the sign of the whole
    const __m128i is_end = _mm_slli_epi64(_mm_cmpeq_epi32(place, end), 32);
    return static_cast<unsigned>(_mm_movemask_pd(_mm_or_pd(is_beyond, _mm_castsi128_pd(is_end))));
  }
};

}  // namespace

void FanWalker::walk(const RayOrigin& origin, std::span<const ScanRay> rays) {
  Rays under_way;
  std::size_t active = 0;
  for (std::size_t which = 0; which < kRays; ++which) {
    if (start_next(origin, rays, under_way, which)) ++active;
  }
  std::uint8_t* const marks = marks_.data();
  const auto mark_of = [marks](Place place) -> std::uint8_t& {
    return marks[static_cast<std::uint32_t>(place)];
  };
  // new places gather here, so that the loop calls nothing and keeps its registers
  std::array<Place, 256> fresh;
  while (active > 0) {
    PairOfRays a;
    PairOfRays b;
    a.load(under_way.pair[0]);
    b.load(under_way.pair[1]);
    unsigned at_end = 0;
    std::size_t fresh_count = 0;
    bool is_at_frame = false;
    do {
      at_end = a.step() | b.step() << 2;
      const std::array<Place, kRays> place = {
          _mm_cvtsi128_si64(a.place), _mm_cvtsi128_si64(_mm_unpackhi_epi64(a.place, a.place)),
          _mm_cvtsi128_si64(b.place), _mm_cvtsi128_si64(_mm_unpackhi_epi64(b.place, b.place))};
      if (at_end != 0) break;
      const int all = mark_of(place[0]) & mark_of(place[1]) & mark_of(place[2]) & mark_of(place[3]);
      if ((all & kMarked) != 0) continue;
      for (const Place p : place) {
        std::uint8_t& m = mark_of(p);
        is_at_frame |= m == kFrame;
        if (m != kUnmarked) continue;
        m = kMarked;
        fresh[fresh_count++] = p;
      }
    } while (!is_at_frame && fresh_count + kRays <= fresh.size());
    free_.insert(free_.end(), fresh.data(), fresh.data() + fresh_count);
    a.store(under_way.pair[0]);
    b.store(under_way.pair[1]);
    for (std::size_t which = 0; which < kRays; ++which) {
      const Place place = under_way.pair[which / 2].place[which % 2];
      if ((at_end >> which & 1U) != 0 || mark_of(place) == kFrame) {
        if (!start_next(origin, rays, under_way, which)) --active;
      } else {
        list(place, free_);
      }
    }
  }
}

}  // namespace gnbv
