#include "sensors/ray_scene.hpp"

#include <algorithm>
#include <cstring>

#include "sensors/embree_scene.hpp"
#include "sensors/frames.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kPacket = RayPacket::kRays;

using Lanes = std::array<int, kPacket>;  // -1 for those that Embree traces

RTCIntersectContext coherent_context() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

void trace(const EmbreeScene& world, const Lanes& valid, float far_m, RTCIntersectContext& context,
           RTCRayHit16& packet) {
  std::fill_n(packet.ray.tfar, kPacket, far_m);
  std::fill_n(packet.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
  rtcIntersect16(valid.data(), world.scene.get(), &context, &packet);
}

// These two read everything first and then choose, so that the compiler can do 16 lanes at once.
float distance_of(const RTCRayHit16& answer, std::size_t lane) {
  const float tfar = answer.ray.tfar[lane];
  return answer.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID ? kNoReturn : tfar;
}
std::int32_t face_of(const EmbreeScene& world, const RTCRayHit16& answer, std::size_t lane) {
  const unsigned id = answer.hit.geomID[lane];
  const std::uint32_t obstacle = id == EmbreeScene::obstacles ? world.first_face[1] : 0;
  const std::uint32_t terrain = id == EmbreeScene::terrain ? world.first_face[2] : 0;
  const auto hit = static_cast<std::int32_t>(answer.hit.primID[lane] + obstacle + terrain);
  const std::int32_t of_something = id == EmbreeScene::ground ? kGroundFace : hit;
  return id == RTC_INVALID_GEOMETRY_ID ? kNoFace : of_something;
}

/// Calls store(i, answer) for each packet of rays from the origin.
template <typename Store>
void trace_packets(const EmbreeScene& world, const Vec3f& origin_world_m,
                   std::span<const RayPacket> directions_world, float near_m, float far_m,
                   const Store& store) {
  RTCIntersectContext context = coherent_context();
  RTCRayHit16 packet{};  // Embree writes only tfar and the hit
  std::fill_n(packet.ray.org_x, kPacket, origin_world_m.x());
  std::fill_n(packet.ray.org_y, kPacket, origin_world_m.y());
  std::fill_n(packet.ray.org_z, kPacket, origin_world_m.z());
  std::fill_n(packet.ray.tnear, kPacket, near_m);
  std::fill_n(packet.ray.mask, kPacket, kAllParts);
  alignas(64) Lanes valid{};
  valid.fill(-1);
  for (std::size_t i = 0; i < directions_world.size(); ++i) {
    // memcpy, which unlike copy_n becomes a few moves in place
    std::memcpy(packet.ray.dir_x, directions_world[i].x.data(), sizeof packet.ray.dir_x);
    std::memcpy(packet.ray.dir_y, directions_world[i].y.data(), sizeof packet.ray.dir_y);
    std::memcpy(packet.ray.dir_z, directions_world[i].z.data(), sizeof packet.ray.dir_z);
    trace(world, valid, far_m, context, packet);
    store(i, packet);
  }
}

/// Loads the rays of the parts into `ray`, up to 16 at a time, calls trace(valid), and store(i,
/// lane) for each of them. Lanes left over repeat the last ray, and `valid` leaves them out.
template <typename Trace, typename Store>
void for_each_ray(std::span<const Vec3f> origins_world_m, std::span<const Vec3f> directions_world,
                  float near_m, unsigned parts, RTCRay16& ray, const Trace& trace,
                  const Store& store) {
  const std::size_t count = directions_world.size();
  GNBV_CHECK(origins_world_m.size() == count || origins_world_m.size() == 1,
             "{} origins for {} directions", origins_world_m.size(), count);
  std::fill_n(ray.tnear, kPacket, near_m);
  std::fill_n(ray.mask, kPacket, parts);
  alignas(64) Lanes valid{};
  for (std::size_t begin = 0; begin < count; begin += kPacket) {
    for (std::size_t lane = 0; lane < kPacket; ++lane) {
      const std::size_t i = std::min(begin + lane, count - 1);
      valid[lane] = begin + lane < count ? -1 : 0;
      const Vec3f& origin = origins_world_m[origins_world_m.size() == 1 ? 0 : i];
      ray.org_x[lane] = origin.x();
      ray.org_y[lane] = origin.y();
      ray.org_z[lane] = origin.z();
      ray.dir_x[lane] = directions_world[i].x();
      ray.dir_y[lane] = directions_world[i].y();
      ray.dir_z[lane] = directions_world[i].z();
    }
    trace(valid);
    for (std::size_t lane = 0; lane < std::min(kPacket, count - begin); ++lane) {
      store(begin + lane, lane);
    }
  }
}

void need_answers(std::size_t answers, std::size_t questions) {
  GNBV_CHECK(answers == questions, "{} answers for {} rays or packets", answers, questions);
}

}  // namespace

RayScene::RayScene(const World& world) : embree_(std::make_unique<EmbreeScene>(world)) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

void RayScene::first_hits(const Vec3f& origin_world_m, std::span<const RayPacket> directions_world,
                          float near_m, float far_m, std::span<HitPacket> hits) const {
  need_answers(hits.size(), directions_world.size());
  trace_packets(*embree_, origin_world_m, directions_world, near_m, far_m,
                [&](std::size_t i, const RTCRayHit16& answer) {
                  HitPacket& out = hits[i];
                  for (std::size_t lane = 0; lane < kPacket; ++lane) {
                    out.distance_m[lane] = distance_of(answer, lane);
                    out.face[lane] = face_of(*embree_, answer, lane);
                  }
                });
}

void RayScene::first_distances(const Vec3f& origin_world_m,
                               std::span<const RayPacket> directions_world, float near_m,
                               float far_m,
                               std::span<std::array<float, kPacket>> distances_m) const {
  need_answers(distances_m.size(), directions_world.size());
  trace_packets(*embree_, origin_world_m, directions_world, near_m, far_m,
                [&](std::size_t i, const RTCRayHit16& answer) {
                  std::array<float, kPacket>& out = distances_m[i];
                  for (std::size_t lane = 0; lane < kPacket; ++lane) {
                    out[lane] = distance_of(answer, lane);
                  }
                });
}

void RayScene::first_hits(std::span<const Vec3f> origins_world_m,
                          std::span<const Vec3f> directions_world, float near_m, float far_m,
                          std::span<RayHit> hits) const {
  need_answers(hits.size(), directions_world.size());
  RTCIntersectContext context = coherent_context();
  RTCRayHit16 packet{};
  for_each_ray(
      origins_world_m, directions_world, near_m, kAllParts, packet.ray,
      [&](const Lanes& valid) { trace(*embree_, valid, far_m, context, packet); },
      [&](std::size_t i, std::size_t lane) {
        hits[i] = {distance_of(packet, lane), face_of(*embree_, packet, lane)};
      });
}

void RayScene::find_blocked(unsigned parts, std::span<const Vec3f> origins_world_m,
                            std::span<const Vec3f> directions_world, float near_m, float far_m,
                            std::span<std::uint8_t> blocked) const {
  need_answers(blocked.size(), directions_world.size());
  RTCIntersectContext context = coherent_context();
  RTCRay16 packet{};
  for_each_ray(
      origins_world_m, directions_world, near_m, parts, packet,
      [&](const Lanes& valid) {
        std::fill_n(packet.tfar, kPacket, far_m);
        rtcOccluded16(valid.data(), embree_->scene.get(), &context, &packet);
      },
      [&](std::size_t i, std::size_t lane) {
        blocked[i] = packet.tfar[lane] < 0.0F ? 1 : 0;  // occluded: Embree says -infinity
      });
}

bool RayScene::has_obstacles() const { return embree_->first_face[2] > embree_->first_face[1]; }
bool RayScene::has_terrain() const { return embree_->first_face[3] > embree_->first_face[2]; }

Vec3f RayScene::normal_world(std::int32_t face) const {
  if (face == kGroundFace) return Vec3f::UnitZ();
  GNBV_CHECK(face >= 0, "the normal of nothing");
  const auto& [a, b, c] = embree_->meshes.faces[static_cast<std::size_t>(face)];
  const std::vector<Vec3f>& p = embree_->meshes.vertices_m;
  return (p[b] - p[a]).cross(p[c] - p[a]).stableNormalized();
}

const Material& RayScene::material(std::int32_t face) const {
  const TriangleMesh& meshes = embree_->meshes;
  return meshes.materials[material_of(meshes, static_cast<std::size_t>(face))];
}

std::array<float, 3> RayScene::albedo(std::int32_t face, const Vec3f& p_world_m,
                                      const Vec3f& normal_world) const {
  return gnbv::albedo(embree_->meshes, static_cast<std::size_t>(face), p_world_m, normal_world);
}

double RayScene::distance_m(unsigned parts, const Vec3& p_world_m, double limit_m) const {
  return embree_->distance_m(parts, p_world_m, limit_m);
}

}  // namespace gnbv
