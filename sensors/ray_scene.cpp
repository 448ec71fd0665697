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

/// Rays that begin `near_m` from their origin and see everything; all else is still to be set.
/// (Embree writes only tfar and the hit.)
RTCRayHit16 packet_from(const Vec3f& origin_world_m, float near_m) {
  RTCRayHit16 packet{};
  std::fill_n(packet.ray.org_x, kPacket, origin_world_m.x());
  std::fill_n(packet.ray.org_y, kPacket, origin_world_m.y());
  std::fill_n(packet.ray.org_z, kPacket, origin_world_m.z());
  std::fill_n(packet.ray.tnear, kPacket, near_m);
  std::fill_n(packet.ray.mask, kPacket, kAllMask);
  return packet;
}

/// Embree searches in float around the rounded point: the ball is kept a little larger than the
/// distance found so far, which is measured in double.
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

  /// Traces `count` packets: load(i, packet.ray, valid) sets directions, and origins unless they
  /// are set already, and clears the lanes of `valid` that hold no ray; store(i, packet) takes the
  /// answers.
  template <typename Load, typename Store>
  void trace(std::size_t count, RTCRayHit16& packet, float far_m, const Load& load,
             const Store& store) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    alignas(64) std::array<int, kPacket> valid{};
    valid.fill(-1);
    for (std::size_t i = 0; i < count; ++i) {
      std::fill_n(packet.ray.tfar, kPacket, far_m);
      std::fill_n(packet.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
      load(i, packet.ray, valid);
      rtcIntersect16(valid.data(), scene.get(), &context, &packet);
      store(i, packet);
    }
  }

  template <typename Store>
  void trace_packets(const Vec3f& origin_world_m, std::span<const RayPacket> directions_world,
                     float near_m, float far_m, const Store& store) const {
    const auto load = [&](std::size_t i, RTCRay16& ray, std::array<int, kPacket>&) {
      // memcpy, which unlike copy_n becomes a few moves in place
      std::memcpy(ray.dir_x, directions_world[i].x.data(), sizeof ray.dir_x);
      std::memcpy(ray.dir_y, directions_world[i].y.data(), sizeof ray.dir_y);
      std::memcpy(ray.dir_z, directions_world[i].z.data(), sizeof ray.dir_z);
    };
    RTCRayHit16 packet = packet_from(origin_world_m, near_m);
    trace(directions_world.size(), packet, far_m, load, store);
  }

  /// Traces rays given one by one; set_origin(ray, lane) puts a ray's origin into `packet`. The
  /// last packet repeats its last ray in the lanes left over, which are not traced.
  template <typename SetOrigin>
  void trace_each(RTCRayHit16& packet, const SetOrigin& set_origin,
                  std::span<const Vec3f> directions_world, float far_m,
                  std::span<RayHit> hits) const {
    GNBV_CHECK(hits.size() == directions_world.size(), "{} hits for {} rays", hits.size(),
               directions_world.size());
    const auto load = [&](std::size_t i, RTCRay16& ray, std::array<int, kPacket>& valid) {
      const std::size_t rays = std::min(kPacket, hits.size() - i * kPacket);
      std::fill(valid.begin() + static_cast<std::ptrdiff_t>(rays), valid.end(), 0);
      for (std::size_t lane = 0; lane < kPacket; ++lane) {
        const std::size_t from = i * kPacket + std::min(lane, rays - 1);
        set_origin(from, lane);
        ray.dir_x[lane] = directions_world[from].x();
        ray.dir_y[lane] = directions_world[from].y();
        ray.dir_z[lane] = directions_world[from].z();
      }
    };
    const auto store = [&](std::size_t i, const RTCRayHit16& answer) {
      const auto some = hits.subspan(i * kPacket, std::min(kPacket, hits.size() - i * kPacket));
      for (std::size_t lane = 0; lane < some.size(); ++lane) {
        some[lane] = {distance_m(answer, lane), face(answer, lane)};
      }
    };
    trace((hits.size() + kPacket - 1) / kPacket, packet, far_m, load, store);
  }

  /// To the nearest face of the masks, up to `limit_m`; infinity beyond.
  double distance_m(unsigned asked, const Vec3& p_world_m, double limit_m) const;

  // Written so that 16 lanes at a time can be computed: everything is read, then chosen from.
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
  RTCRayHit16 packet = packet_from(origin_world_m, near_m);
  const auto keep_origin = [](std::size_t, std::size_t) {};
  impl_->trace_each(packet, keep_origin, directions_world, far_m, hits);
}

void RayScene::first_hits(std::span<const Vec3f> origins_world_m,
                          std::span<const Vec3f> directions_world, float near_m, float far_m,
                          std::span<RayHit> hits) const {
  GNBV_CHECK(origins_world_m.size() == hits.size(), "{} origins for {} hits",
             origins_world_m.size(), hits.size());
  RTCRayHit16 packet = packet_from(Vec3f::Zero(), near_m);
  const auto set_origin = [&](std::size_t ray, std::size_t lane) {
    packet.ray.org_x[lane] = origins_world_m[ray].x();
    packet.ray.org_y[lane] = origins_world_m[ray].y();
    packet.ray.org_z[lane] = origins_world_m[ray].z();
  };
  impl_->trace_each(packet, set_origin, directions_world, far_m, hits);
}

namespace {

/// Whether anything of the masks lies on each ray; blocked[i] is 0 or 1.
void find_blocked(RTCScene scene, unsigned mask, std::span<const Vec3f> origins_world_m,
                  std::span<const Vec3f> directions_world, float near_m, float far_m,
                  std::span<std::uint8_t> blocked) {
  GNBV_CHECK(origins_world_m.size() == blocked.size() && directions_world.size() == blocked.size(),
             "{} origins and {} directions for {} answers", origins_world_m.size(),
             directions_world.size(), blocked.size());
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  RTCRay16 packet{};
  alignas(64) std::array<int, kPacket> valid{};
  for (std::size_t begin = 0; begin < blocked.size(); begin += kPacket) {
    const std::size_t count = std::min(kPacket, blocked.size() - begin);
    for (std::size_t i = 0; i < kPacket; ++i) {
      const std::size_t ray = begin + std::min(i, count - 1);
      valid[i] = i < count ? -1 : 0;
      packet.org_x[i] = origins_world_m[ray].x();
      packet.org_y[i] = origins_world_m[ray].y();
      packet.org_z[i] = origins_world_m[ray].z();
      packet.dir_x[i] = directions_world[ray].x();
      packet.dir_y[i] = directions_world[ray].y();
      packet.dir_z[i] = directions_world[ray].z();
      packet.tnear[i] = near_m;
      packet.tfar[i] = far_m;
      packet.mask[i] = mask;
    }
    rtcOccluded16(valid.data(), scene, &context, &packet);
    // Embree marks an occluded ray with tfar = -infinity
    for (std::size_t i = 0; i < count; ++i) blocked[begin + i] = packet.tfar[i] < 0.0F ? 1 : 0;
  }
}

}  // namespace

void RayScene::structure_blocks(std::span<const Vec3f> origins_world_m,
                                std::span<const Vec3f> directions_world, float near_m, float far_m,
                                std::span<std::uint8_t> blocked) const {
  find_blocked(impl_->scene.get(), kStructureMask, origins_world_m, directions_world, near_m, far_m,
               blocked);
}

void RayScene::obstacles_block(std::span<const Vec3f> origins_world_m,
                               std::span<const Vec3f> directions_world, float near_m, float far_m,
                               std::span<std::uint8_t> blocked) const {
  find_blocked(impl_->scene.get(), kObstacleMask, origins_world_m, directions_world, near_m, far_m,
               blocked);
}

void RayScene::terrain_blocks(std::span<const Vec3f> origins_world_m,
                              std::span<const Vec3f> directions_world, float near_m, float far_m,
                              std::span<std::uint8_t> blocked) const {
  find_blocked(impl_->scene.get(), kTerrainMask, origins_world_m, directions_world, near_m, far_m,
               blocked);
}

void RayScene::anything_blocks(std::span<const Vec3f> origins_world_m,
                               std::span<const Vec3f> directions_world, float near_m, float far_m,
                               std::span<std::uint8_t> blocked) const {
  find_blocked(impl_->scene.get(), kStructureMask | kObstacleMask | kTerrainMask, origins_world_m,
               directions_world, near_m, far_m, blocked);
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
  return impl_->distance_m(kStructureMask, p_world_m, limit_m);
}

double RayScene::distance_to_surroundings_m(const Vec3& p_world_m, double limit_m) const {
  return impl_->distance_m(kObstacleMask | kTerrainMask, p_world_m, limit_m);
}

double RayScene::clearance_m(const Vec3& p_world_m, double limit_m) const {
  return impl_->distance_m(kStructureMask | kObstacleMask | kRisenTerrainMask, p_world_m, limit_m);
}

}  // namespace gnbv
