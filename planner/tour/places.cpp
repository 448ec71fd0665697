#include "planner/tour/places.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace gnbv {
namespace {

constexpr double kLongestLegSteps = 4.0;  // of the lattice: longer ones take long to check
constexpr std::uint32_t kRowFollows = 6;  // that a row is kept for

}  // namespace

TourPlaces::TourPlaces(const GridGeometry& geometry, const Box3& navigation_m, double step_m)
    : geometry_(geometry) {
  const double voxel_m = geometry.resolution_m();
  const int voxels = std::max(1, static_cast<int>(std::lround(step_m / voxel_m)));
  step_m_ = voxels * voxel_m;
  p_world_m_.push_back(navigation_m.center());  // here
  std::array<std::vector<double>, 3> along_m;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    const double low_m = navigation_m.min()[axis];
    const double high_m = navigation_m.max()[axis];
    if (high_m - low_m < voxel_m) {  // thinner than a voxel
      along_m[a].push_back(geometry.center_m(geometry.key_of(0.5 * (low_m + high_m))));
      lattice_size_[a] = 1;
      continue;
    }
    const double rest_m = std::fmod(high_m - low_m, step_m_);
    // the lowest places see the undersides
    for (double at_m = low_m + (a == 2 ? 0.0 : 0.5 * rest_m); at_m <= high_m + 1e-9;
         at_m += step_m_) {
      const double inside_m = std::clamp(at_m, low_m + 0.5 * voxel_m, high_m - 0.5 * voxel_m);
      along_m[a].push_back(geometry.center_m(geometry.key_of(inside_m)));
    }
    lattice_size_[a] = static_cast<std::int32_t>(along_m[a].size());
  }
  for (const double z : along_m[2]) {
    for (const double y : along_m[1]) {
      for (const double x : along_m[0]) p_world_m_.emplace_back(x, y, z);
    }
  }
}

TourPlaces::Place TourPlaces::add(const Vec3& p_world_m) {
  p_world_m_.push_back(geometry_.center_m(geometry_.key_of(geometry_.nearest_inside(p_world_m))));
  return static_cast<Place>(p_world_m_.size() - 1);
}

void TourPlaces::link(Place a, Place b) {
  if (is_open_[b] == 0 || !space_->is_line_open(*grid_, p_world_m_[a], p_world_m_[b])) return;
  legs_[a].push_back(b);
  legs_[b].push_back(a);
}

void TourPlaces::link_all() {
  const auto& n = lattice_size_;
  const auto node = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
    return static_cast<Place>(1 + (z * n[1] + y) * n[0] + x);
  };
  const auto lattice = static_cast<Place>(1 + n[0] * n[1] * n[2]);
  for (std::int32_t z = 0; z < n[2]; ++z) {
    for (std::int32_t y = 0; y < n[1]; ++y) {
      for (std::int32_t x = 0; x < n[0]; ++x) {
        if (is_open_[node(x, y, z)] == 0) continue;
        for (int to = 14; to < 27; ++to) {  // the 13 neighbours that come later
          const std::int32_t tx = x + to % 3 - 1;
          const std::int32_t ty = y + to / 3 % 3 - 1;
          const std::int32_t tz = z + to / 9 - 1;
          if (tx < 0 || ty < 0 || tx >= n[0] || ty >= n[1] || tz >= n[2]) continue;
          link(node(x, y, z), node(tx, ty, tz));
        }
      }
    }
  }
  const double reach_m = 1.01 * std::sqrt(3.0) * step_m_;
  for (Place place = lattice; place <= p_world_m_.size(); ++place) {
    const Place from = place == p_world_m_.size() ? here() : place;
    if (from != here() && is_open_[from] == 0) continue;
    for (Place to = 1; to < place; ++to) {
      if ((p_world_m_[to] - p_world_m_[from]).squaredNorm() <= reach_m * reach_m) link(from, to);
    }
  }
}

void TourPlaces::follow(const OccupancyGrid& grid, const OpenSpace& space,
                        const Vec3& here_world_m) {
  grid_ = &grid;
  space_ = &space;
  ++follows_;
  rows_.erase(here());
  p_world_m_[here()] = here_world_m;
  is_open_.resize(size(), 0);
  opened_.resize(size(), 0);
  for (Place place = 1; place < size(); ++place) {
    const bool is_open = space.is_open(grid, geometry_.key_of(p_world_m_[place]));
    if (is_open && is_open_[place] == 0) opened_[place] = follows_;
    is_open_[place] = is_open ? 1 : 0;
  }
  legs_.assign(size(), {});
  link_all();
  is_reachable_.assign(size(), 0);
  std::vector<Place> open = {here()};
  is_reachable_[here()] = 1;
  while (!open.empty()) {
    const Place place = open.back();
    open.pop_back();
    for (const Place next : legs_[place]) {
      if (is_reachable_[next] != 0) continue;
      is_reachable_[next] = 1;
      open.push_back(next);
    }
  }
}

/// Lazy Theta* (Nash, Koenig, Tovey 2010) from one place to all: a way may cut across the lattice
/// wherever the straight line is open, which is asked once a place, when the place is reached.
TourPlaces::Row TourPlaces::search(Place from) const {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  Row row{std::vector<float>(size(), kFar), std::vector<Place>(size(), kNone)};
  std::vector<std::uint8_t> is_done(size(), 0);
  const auto longest_m = static_cast<float>(kLongestLegSteps * step_m_);
  const auto leg_m = [&](Place a, Place b) {
    return static_cast<float>((p_world_m_[a] - p_world_m_[b]).norm());
  };
  using Open = std::pair<float, Place>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  row.length_m[from] = 0.0F;
  row.before[from] = from;
  open.push({0.0F, from});
  while (!open.empty()) {
    const auto [length_m, place] = open.top();
    open.pop();
    if (is_done[place] != 0 || length_m > row.length_m[place]) continue;
    const Place guess = row.before[place];
    const bool is_far = leg_m(guess, place) > longest_m;
    if (guess != place &&
        (is_far || !space_->is_line_open(*grid_, p_world_m_[guess], p_world_m_[place]))) {
      row.length_m[place] = kFar;
      for (const Place near : legs_[place]) {
        if (is_done[near] == 0) continue;
        const float by_m = row.length_m[near] + leg_m(near, place);
        if (by_m >= row.length_m[place]) continue;
        row.length_m[place] = by_m;
        row.before[place] = near;
      }
      if (row.length_m[place] > length_m) {
        open.push({row.length_m[place], place});
        continue;
      }
    }
    if (place == here() && from != here()) continue;  // it moves on, while the row is kept
    is_done[place] = 1;
    const Place before = row.before[place];
    for (const Place next : legs_[place]) {
      if (is_done[next] != 0) continue;
      const float next_m = row.length_m[before] + leg_m(before, next);
      if (next_m >= row.length_m[next]) continue;
      row.length_m[next] = next_m;
      row.before[next] = before;
      open.push({next_m, next});
    }
  }
  return row;
}

/// Ways to places that have opened since, over the legs to them.
void TourPlaces::extend(Row& row) const {
  row.length_m.resize(size(), std::numeric_limits<float>::infinity());
  row.before.resize(size(), kNone);
  for (bool has_more = true; has_more;) {
    has_more = false;
    for (Place place = 1; place < size(); ++place) {
      if (opened_[place] <= row.followed || is_open_[place] == 0) continue;
      for (const Place near : legs_[place]) {
        if (near == here()) continue;
        const auto leg_m = static_cast<float>((p_world_m_[near] - p_world_m_[place]).norm());
        if (row.length_m[near] + leg_m >= row.length_m[place]) continue;
        row.length_m[place] = row.length_m[near] + leg_m;
        row.before[place] = near;
        has_more = true;
      }
    }
  }
  row.followed = follows_;
}

const TourPlaces::Row& TourPlaces::row(Place from) {
  const auto [at, is_new] = rows_.try_emplace(from);
  Row& row = at->second;
  if (is_new || row.made + kRowFollows < follows_) {
    row = search(from);
    row.made = row.followed = follows_;
  }
  if (row.followed < follows_) extend(row);
  return row;
}

std::span<const float> TourPlaces::row_m(Place from) { return row(from).length_m; }

std::vector<Vec3> TourPlaces::via_world_m(Place from, Place to) {
  const Row& found = row(from);
  std::vector<Vec3> via_m;
  for (Place at = found.before[to]; at != from; at = found.before[at]) {
    via_m.push_back(p_world_m_[at]);
  }
  std::reverse(via_m.begin(), via_m.end());
  return via_m;
}

}  // namespace gnbv
