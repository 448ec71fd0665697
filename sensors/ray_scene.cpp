#include "sensors/ray_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "sensors/embree_scene.hpp"
#include "sensors/frames.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kPacket = RayPacket::kRays;

/// Rays that begin `near_m` from their origin and see all parts. Directions, tfar and geomID are
/// still to be set. (Embree writes only tfar and the hit.)
RTCRayHit16 packet_from(const Vec3f& origin_world_m, float near_m) {
  RTCRayHit16 packet{};
  std::fill_n(packet.ray.org_x, kPacket, origin_world_m.x());
  std::fill_n(packet.ray.org_y, kPacket, origin_world_m.y());
  std::fill_n(packet.ray.org_z, kPacket, origin_world_m.z());
  std::fill_n(packet.ray.tnear, kPacket, near_m);
  std::fill_n(packet.ray.mask, kPacket, kMeshParts | kGroundPart);
  return packet;
}

/// Loads the rays from `begin` on, up to a packet of them. The lanes left over repeat the last ray,
/// and `valid` leaves them out.
void load_rays(std::span<const Vec3f> origins_world_m, std::span<const Vec3f> directions_world,
               std::size_t begin, RTCRay16& ray, std::array<int, kPacket>& valid) {
  for (std::size_t lane = 0; lane < kPacket; ++lane) {
    const std::size_t i = std::min(begin + lane, directions_world.size() - 1);
    valid[lane] = begin + lane < directions_world.size() ? -1 : 0;
    ray.org_x[lane] = origins_world_m[i].x();
    ray.org_y[lane] = origins_world_m[i].y();
    ray.org_z[lane] = origins_world_m[i].z();
    ray.dir_x[lane] = directions_world[i].x();
    ray.dir_y[lane] = directions_world[i].y();
    ray.dir_z[lane] = directions_world[i].z();
  }
}

RTCIntersectContext coherent_context() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

/// Embree searches in floats around the rounded point, while we measure distances in doubles: the
/// ball that it searches is a little larger than the distance found so far.
float search_radius_m(double distance_m) {
  return static_cast<float>(distance_m * 1.000001 + 1e-5);
}

struct NearestQuery {
  const SceneFaces* faces;
  std::span<const unsigned, SceneFaces::kParts> geometries;
  unsigned asked;  // masks
  Vec3 p_world_m;
  double distance_m;
};

bool visit_nearest(RTCPointQueryFunctionArguments* arguments) {
  auto& query = *static_cast<NearestQuery*>(arguments->userPtr);
  const auto geometry =
      std::find(query.geometries.begin(), query.geometries.end(), arguments->geomID);
  if (geometry == query.geometries.end()) return false;
  const auto part = static_cast<std::size_t>(geometry - query.geometries.begin());
  const std::uint32_t face = query.faces->first_face(part) + arguments->primID;
  if (!query.faces->is_asked(part, face, query.asked)) return false;
  const double distance_m = query.faces->distance_m(face, query.p_world_m);
  if (!(distance_m < query.distance_m)) return false;
  query.distance_m = distance_m;
  arguments->query->radius = search_radius_m(distance_m);
  return true;
}

}  // namespace

struct RayScene::Impl : EmbreeScene {
  SceneFaces faces;

  explicit Impl(const World& world) : EmbreeScene(world), faces(world) {}

  void trace(const std::array<int, kPacket>& valid, float far_m, RTCIntersectContext& context,
             RTCRayHit16& packet) const {
    std::fill_n(packet.ray.tfar, kPacket, far_m);
    std::fill_n(packet.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
    rtcIntersect16(valid.data(), scene.get(), &context, &packet);
  }

  /// Calls store(i, packet) with the answers of packet i.
  template <typename Store>
  void trace_packets(const Vec3f& origin_world_m, std::span<const RayPacket> directions_world,
                     float near_m, float far_m, const Store& store) const {
    RTCIntersectContext context = coherent_context();
    RTCRayHit16 packet = packet_from(origin_world_m, near_m);
    alignas(64) std::array<int, kPacket> valid{};
    valid.fill(-1);
    for (std::size_t i = 0; i < directions_world.size(); ++i) {
      // memcpy, which unlike copy_n becomes a few moves in place
      std::memcpy(packet.ray.dir_x, directions_world[i].x.data(), sizeof packet.ray.dir_x);
      std::memcpy(packet.ray.dir_y, directions_world[i].y.data(), sizeof packet.ray.dir_y);
      std::memcpy(packet.ray.dir_z, directions_world[i].z.data(), sizeof packet.ray.dir_z);
      trace(valid, far_m, context, packet);
      store(i, packet);
    }
  }

  /// To the nearest face of the masks, up to `limit_m`; infinity beyond.
  double distance_m(unsigned asked, const Vec3& p_world_m, double limit_m) const;

  // These two read everything first and then choose, so that the compiler can do 16 lanes at once.
  static float distance_m(const RTCRayHit16& answer, std::size_t lane) {
    const float tfar = answer.ray.tfar[lane];
    return answer.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID ? kNoReturn : tfar;
  }
  std::int32_t face(const RTCRayHit16& answer, std::size_t lane) const {
    const unsigned id = answer.hit.geomID[lane];
    const std::uint32_t obstacle = id == geometries[1] ? faces.first_face(1) : 0;
    const std::uint32_t terrain = id == geometries[2] ? faces.first_face(2) : 0;
    const auto hit = static_cast<std::int32_t>(answer.hit.primID[lane] + obstacle + terrain);
    const std::int32_t of_something = id == ground_id ? kGroundFace : hit;
    return id == RTC_INVALID_GEOMETRY_ID ? kNoFace : of_something;
  }
};

RayScene::RayScene(const World& world) : impl_(std::make_unique<Impl>(world)) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

void RayScene::first_hits(const Vec3f& origin_world_m, std::span<const RayPacket> directions_world,
                          float near_m, float far_m, std::span<HitPacket> hits) const {
  GNBV_CHECK(hits.size() == directions_world.size(), "{} hits for {} packets of rays", hits.size(),
             directions_world.size());
  impl_->trace_packets(origin_world_m, directions_world, near_m, far_m,
                       [&](std::size_t i, const RTCRayHit16& answer) {
                         HitPacket& out = hits[i];
                         for (std::size_t lane = 0; lane < kPacket; ++lane) {
                           out.distance_m[lane] = Impl::distance_m(answer, lane);
                           out.face[lane] = impl_->face(answer, lane);
                         }
                       });
}

void RayScene::first_distances(const Vec3f& origin_world_m,
                               std::span<const RayPacket> directions_world, float near_m,
                               float far_m,
                               std::span<std::array<float, kPacket>> distances_m) const {
  GNBV_CHECK(distances_m.size() == directions_world.size(), "{} distances for {} packets of rays",
             distances_m.size(), directions_world.size());
  impl_->trace_packets(origin_world_m, directions_world, near_m, far_m,
                       [&](std::size_t i, const RTCRayHit16& answer) {
                         std::array<float, kPacket>& out = distances_m[i];
                         for (std::size_t lane = 0; lane < kPacket; ++lane) {
                           out[lane] = Impl::distance_m(answer, lane);
                         }
                       });
}

void RayScene::first_hits(const Vec3f& origin_world_m, std::span<const Vec3f> directions_world,
                          float near_m, float far_m, std::span<RayHit> hits) const {
  const std::vector<Vec3f> origins_world_m(directions_world.size(), origin_world_m);
  first_hits(origins_world_m, directions_world, near_m, far_m, hits);
}

void RayScene::first_hits(std::span<const Vec3f> origins_world_m,
                          std::span<const Vec3f> directions_world, float near_m, float far_m,
                          std::span<RayHit> hits) const {
  GNBV_CHECK(origins_world_m.size() == hits.size() && directions_world.size() == hits.size(),
             "{} origins and {} directions for {} hits", origins_world_m.size(),
             directions_world.size(), hits.size());
  RTCIntersectContext context = coherent_context();
  RTCRayHit16 packet = packet_from(Vec3f::Zero(), near_m);
  alignas(64) std::array<int, kPacket> valid{};
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const std::size_t lane = i % kPacket;
    if (lane == 0) {
      load_rays(origins_world_m, directions_world, i, packet.ray, valid);
      impl_->trace(valid, far_m, context, packet);
    }
    hits[i] = {Impl::distance_m(packet, lane), impl_->face(packet, lane)};
  }
}

void RayScene::find_blocked(unsigned parts, std::span<const Vec3f> origins_world_m,
                            std::span<const Vec3f> directions_world, float near_m, float far_m,
                            std::span<std::uint8_t> blocked) const {
  GNBV_CHECK(origins_world_m.size() == blocked.size() && directions_world.size() == blocked.size(),
             "{} origins and {} directions for {} answers", origins_world_m.size(),
             directions_world.size(), blocked.size());
  RTCIntersectContext context = coherent_context();
  RTCRay16 packet{};
  std::fill_n(packet.tnear, kPacket, near_m);
  std::fill_n(packet.mask, kPacket, parts);
  alignas(64) std::array<int, kPacket> valid{};
  for (std::size_t i = 0; i < blocked.size(); ++i) {
    const std::size_t lane = i % kPacket;
    if (lane == 0) {
      load_rays(origins_world_m, directions_world, i, packet, valid);
      std::fill_n(packet.tfar, kPacket, far_m);
      rtcOccluded16(valid.data(), impl_->scene.get(), &context, &packet);
    }
    blocked[i] = packet.tfar[lane] < 0.0F ? 1 : 0;  // occluded: Embree says -infinity
  }
}

bool RayScene::has_obstacles() const { return impl_->geometries[1] != RTC_INVALID_GEOMETRY_ID; }
bool RayScene::has_terrain() const { return impl_->geometries[2] != RTC_INVALID_GEOMETRY_ID; }

Vec3f RayScene::normal_world(std::int32_t face) const {
  return face == kGroundFace ? Vec3f(Vec3f::UnitZ()) : impl_->faces.normal_world(face);
}

const Material& RayScene::material(std::int32_t face) const { return impl_->faces.material(face); }

double RayScene::Impl::distance_m(unsigned asked, const Vec3& p_world_m, double limit_m) const {
  NearestQuery nearest{&faces, geometries, asked, p_world_m,
                       std::numeric_limits<double>::infinity()};
  RTCPointQuery query{};
  query.x = static_cast<float>(p_world_m.x());
  query.y = static_cast<float>(p_world_m.y());
  query.z = static_cast<float>(p_world_m.z());
  query.radius = search_radius_m(limit_m);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene.get(), &query, &context, visit_nearest, &nearest);
  return nearest.distance_m <= limit_m ? nearest.distance_m
                                       : std::numeric_limits<double>::infinity();
}

double RayScene::distance_to_structure_m(const Vec3& p_world_m, double limit_m) const {
  return impl_->distance_m(kStructurePart, p_world_m, limit_m);
}

double RayScene::distance_to_surroundings_m(const Vec3& p_world_m, double limit_m) const {
  return impl_->distance_m(kObstaclePart | kTerrainPart, p_world_m, limit_m);
}

double RayScene::clearance_m(const Vec3& p_world_m, double limit_m) const {
  return impl_->distance_m(kStructurePart | kObstaclePart | kRisenTerrainPart, p_world_m, limit_m);
}

}  // namespace gnbv
