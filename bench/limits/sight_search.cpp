#include "bench/limits/sight_search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bench/score/escape_search.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

constexpr std::uint32_t kNoPosition = 0xffffffffU;
constexpr std::size_t kFewPositions = 48;  // of the lattice
constexpr std::size_t kPointsOfFew = 2;    // asked from each of them, of an item
// what is nearer to the point is its own face
constexpr float kOwnFace_m = 1e-3F;

}  // namespace

SightSearch::SightSearch(const RayScene& scene, std::span<const CameraModel> cameras,
                         const LegalViewpoints& legal, const Box3& navigation_m, double radius_m)
    : scene_(scene), legal_(legal), navigation_m_(navigation_m), radius_m_(radius_m) {
  for (const CameraModel& camera : cameras) {
    for (const CameraModel& fixed : at_all_pitches(camera)) cameras_.emplace_back(fixed);
  }
  for (const FreeYawCamera& camera : cameras_) reach_m_ = std::max(reach_m_, camera.reach_m());
  map_lattice();
  std::vector<std::size_t> order(legal.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [](std::size_t a, std::size_t b) { return mix_bits(a) < mix_bits(b); });
  for (const std::size_t i : order) shuffled_m_.push_back(legal.p_world_m[i]);

  const std::vector<Vec3f> spread = spread_directions(static_cast<int>(kTurns * kDirections));
  for (std::size_t turn = 0; turn < kTurns; ++turn) {
    std::vector<Vec3f> some;
    for (std::size_t i = turn; i < spread.size(); i += kTurns) some.push_back(spread[i]);
    add_packets(some);
  }
}

std::size_t SightSearch::node(const Cell& cell) const {
  std::size_t node = 0;
  for (const std::size_t a : {2U, 1U, 0U}) {
    node = node * static_cast<std::size_t>(nodes_[a] + 2) + static_cast<std::size_t>(cell[a] + 1);
  }
  return node;
}

void SightSearch::map_lattice() {
  for (const Cell& cell : legal_.cell) {
    for (std::size_t a = 0; a < 3; ++a) nodes_[a] = std::max(nodes_[a], cell[a] + 1);
  }
  position_at_.assign(node(nodes_) + 1, kNoPosition);
  is_near_.assign(position_at_.size(), 0);
  for (std::size_t i = 0; i < legal_.size(); ++i) {
    const Cell& c = legal_.cell[i];
    position_at_[node(c)] = static_cast<std::uint32_t>(i);
    corner_m_ = legal_.p_world_m[i] - legal_.step_m * Vec3(c[0], c[1], c[2]);
    for (int corner = 0; corner < 8; ++corner) {
      is_near_[node({c[0] - (corner & 1), c[1] - ((corner >> 1) & 1), c[2] - (corner >> 2)})] = 1;
    }
  }
}

/// Neighbours into one packet, which then traces fast: by bands of height, in these by bearing.
void SightSearch::add_packets(std::vector<Vec3f> directions) {
  constexpr std::size_t kBand = 4 * RayPacket::kRays;
  std::sort(directions.begin(), directions.end(),
            [](const Vec3f& a, const Vec3f& b) { return a.z() < b.z(); });
  for (std::size_t band = 0; band < directions.size(); band += kBand) {
    const auto first = directions.begin() + static_cast<std::ptrdiff_t>(band);
    const auto bearing = [](const Vec3f& d) { return std::atan2(d.y(), d.x()); };
    std::sort(first, first + kBand,
              [&](const Vec3f& a, const Vec3f& b) { return bearing(a) < bearing(b); });
  }
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const std::size_t ray = i % RayPacket::kRays;
    if (ray == 0) directions_.emplace_back();
    directions_.back().x[ray] = directions[i].x();
    directions_.back().y[ray] = directions[i].y();
    directions_.back().z[ray] = directions[i].z();
  }
}

std::vector<Vec3> SightSearch::positions_near(const Eigen::AlignedBox3d& box_world_m) const {
  std::vector<Vec3> near;
  for (const Vec3& p : shuffled_m_) {
    if (box_world_m.squaredExteriorDistance(p) <= reach_m_ * reach_m_) near.push_back(p);
  }
  return near;
}

void SightSearch::look_from_lattice(std::span<const Vec3> near_world_m, Positions which,
                                    std::span<SightItem> items) const {
  if (items.empty()) return;
  const std::size_t few = std::min(near_world_m.size(), kFewPositions);
  if (which == Positions::first_few) {
    for (std::size_t i = 0; i < few; ++i) {
      look(near_world_m[i], i * kPointsOfFew, kPointsOfFew, items);
    }
    return;
  }
  for (std::size_t i = few; i < near_world_m.size(); ++i) look(near_world_m[i], i, 1, items);
}

void SightSearch::look(const Vec3& position_m, std::size_t first_point, std::size_t points,
                       std::span<SightItem> items) const {
  struct Asked {
    std::size_t item, point;
  };
  std::vector<Vec3f> origins, directions;
  std::vector<Asked> asked;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const SightItem& item = items[i];
    if (item.is_seen()) continue;
    const std::size_t count = item.points_world_m.size();
    for (std::size_t k = 0; k < std::min(points, count); ++k) {
      const std::size_t point = (first_point + k) % count;
      const Vec3 point_m = item.points_world_m[point].cast<double>();
      for (const FreeYawCamera& camera : cameras_) {
        const auto origin_m = camera.origin_world_m(position_m, point_m);
        if (!origin_m) continue;
        origins.push_back(origin_m->cast<float>());
        directions.emplace_back((point_m - *origin_m).cast<float>());
        asked.push_back({i, point});
      }
    }
  }
  std::vector<std::uint8_t> blocked(asked.size());
  scene_.find_blocked(kMeshParts, origins, directions, 0.0F, kSightEnd, blocked);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (blocked[i] == 0) items[asked[i].item].seen = asked[i].point;
  }
}

SightSearch::Look SightSearch::look_out(const Vec3f& point_world_m, std::size_t turn) const {
  if (legal_.size() == 0) return Look::closed;
  constexpr std::size_t kPackets = kDirections / RayPacket::kRays;
  const std::span<const RayPacket> packets =
      std::span(directions_).subspan(turn % kTurns * kPackets, kPackets);
  std::array<std::array<float, RayPacket::kRays>, kPackets> free_m{};
  scene_.first_distances(point_world_m, packets, kOwnFace_m, static_cast<float>(reach_m_), free_m);
  Look look = Look::closed;
  for (std::size_t p = 0; p < kPackets; ++p) {
    for (std::size_t ray = 0; ray < RayPacket::kRays; ++ray) {
      const double length_m = std::min(static_cast<double>(free_m[p][ray]), reach_m_);
      if (length_m == reach_m_) look = Look::open;
      if (is_seen_along(point_world_m, packets[p].direction(ray), length_m)) return Look::seen;
    }
  }
  return look;
}

bool SightSearch::is_seen_along(const Vec3f& point_m, const Vec3f& direction, double free_m) const {
  const Vec3 from_m = point_m.cast<double>();
  const Vec3 along = direction.cast<double>();
  const double step_m = 0.5 * legal_.step_m;
  const Vec3 from = (from_m - corner_m_) / legal_.step_m;  // in cells
  // no place within the radius of the point is legal
  const double first_m = step_m * std::max(1.0, std::ceil(radius_m_ / step_m));
  for (double at_m = first_m; at_m < free_m; at_m += step_m) {
    const Vec3 at = (from + at_m / legal_.step_m * along).array().floor();
    const Vec3 last = Vec3(nodes_[0], nodes_[1], nodes_[2]).array() - 1.0;
    if (!Box3(Vec3::Constant(-1.0), last).contains(at)) continue;
    const Cell low = {static_cast<std::int32_t>(at.x()), static_cast<std::int32_t>(at.y()),
                      static_cast<std::int32_t>(at.z())};
    if (is_near_[node(low)] == 0) continue;
    const Vec3 vehicle_m = from_m + at_m * along;
    if (!navigation_m_.contains(vehicle_m)) continue;
    for (const FreeYawCamera& camera : cameras_) {
      const auto origin_m = camera.origin_world_m(vehicle_m, from_m);
      if (!origin_m || !is_legal(vehicle_m, low)) continue;
      const std::array<Vec3f, 1> origin = {origin_m->cast<float>()};
      const std::array<Vec3f, 1> to = {(from_m - *origin_m).cast<float>()};
      std::array<std::uint8_t, 1> blocked{};
      scene_.find_blocked(kMeshParts, origin, to, 0.0F, kSightEnd, blocked);
      if (blocked[0] == 0) return true;
    }
  }
  return false;
}

/// Calls use(position) for the legal ones at the corners of the lattice's cell above `low`, until
/// one is true.
template <typename Use>
bool SightSearch::any_corner(const Cell& low, const Use& use) const {
  for (int corner = 0; corner < 8; ++corner) {
    const std::uint32_t position = position_at_[node(
        {low[0] + (corner & 1), low[1] + ((corner >> 1) & 1), low[2] + (corner >> 2)})];
    if (position != kNoPosition && use(legal_.p_world_m[position])) return true;
  }
  return false;
}

bool SightSearch::is_legal(const Vec3& vehicle_m, const Cell& low) const {
  const NoFly& no_fly = legal_.no_fly;
  return no_fly.allows(vehicle_m) && scene_.clearance_m(vehicle_m, radius_m_) >= radius_m_ &&
         any_corner(low, [&](const Vec3& position_m) {
           return no_fly.allows_leg(vehicle_m, position_m) &&
                  is_leg_clear(scene_, vehicle_m, position_m, radius_m_);
         });
}

}  // namespace gnbv
