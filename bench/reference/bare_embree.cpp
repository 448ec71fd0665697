#include "bench/reference/bare_embree.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "sensors/embree.hpp"
#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kPacket = 16;

struct alignas(64) Directions {
  std::array<float, kPacket> x;
  std::array<float, kPacket> y;
  std::array<float, kPacket> z;
};

void attach(RTCDevice device, RTCScene scene, std::span<const Vec3f> vertices_m,
            std::span<const std::array<std::uint32_t, 3>> faces) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* vertex = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                         sizeof(Vec3f), vertices_m.size());
  void* index = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                        sizeof(faces[0]), faces.size());
  std::copy(vertices_m.begin(), vertices_m.end(), static_cast<Vec3f*>(vertex));
  std::copy(faces.begin(), faces.end(), static_cast<std::array<std::uint32_t, 3>*>(index));
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

}  // namespace

struct BareEmbree::Impl {
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = rtcNewScene(device);
  Vec3f origin_world_m = Vec3f::Zero();
  std::vector<Directions> packets;

  ~Impl() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }

  std::size_t trace_some(std::span<const Directions> some, float far_m) const {
    alignas(64) std::array<int, kPacket> valid{};
    valid.fill(-1);
    RTCRayHit16 packet{};
    std::fill_n(packet.ray.org_x, kPacket, origin_world_m.x());
    std::fill_n(packet.ray.org_y, kPacket, origin_world_m.y());
    std::fill_n(packet.ray.org_z, kPacket, origin_world_m.z());
    std::fill_n(packet.ray.mask, kPacket, ~0U);
    std::size_t hits = 0;
    for (const Directions& directions : some) {
      std::copy(directions.x.begin(), directions.x.end(), packet.ray.dir_x);
      std::copy(directions.y.begin(), directions.y.end(), packet.ray.dir_y);
      std::copy(directions.z.begin(), directions.z.end(), packet.ray.dir_z);
      std::fill_n(packet.ray.tfar, kPacket, far_m);
      std::fill_n(packet.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
      intersect16(valid.data(), scene, packet);
      for (const unsigned id : packet.hit.geomID) hits += id != RTC_INVALID_GEOMETRY_ID ? 1 : 0;
    }
    return hits;
  }
};

BareEmbree::BareEmbree(const World& world) : impl_(std::make_unique<Impl>()) {
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(impl_->scene, RTC_BUILD_QUALITY_HIGH);
  attach(impl_->device, impl_->scene, world.structure.vertices_m, world.structure.faces);
  if (world.has_ground) {
    const std::array<Vec3f, 4> corners = {Vec3f(-1000, -1000, 0), Vec3f(1000, -1000, 0),
                                          Vec3f(1000, 1000, 0), Vec3f(-1000, 1000, 0)};
    attach(impl_->device, impl_->scene, corners,
           std::array<std::array<std::uint32_t, 3>, 2>{{{0, 1, 2}, {0, 2, 3}}});
  }
  rtcCommitScene(impl_->scene);
  GNBV_CHECK(rtcGetDeviceError(impl_->device) == RTC_ERROR_NONE, "Embree built no scene");
}

BareEmbree::~BareEmbree() = default;

void BareEmbree::prepare(const Vec3f& origin_world_m, std::span<const Vec3f> directions_world) {
  GNBV_CHECK(directions_world.size() % kPacket == 0, "{} rays do not fill packets",
             directions_world.size());
  impl_->origin_world_m = origin_world_m;
  impl_->packets.resize(directions_world.size() / kPacket);
  for (std::size_t i = 0; i < directions_world.size(); ++i) {
    Directions& packet = impl_->packets[i / kPacket];
    packet.x[i % kPacket] = directions_world[i].x();
    packet.y[i % kPacket] = directions_world[i].y();
    packet.z[i % kPacket] = directions_world[i].z();
  }
}

std::size_t BareEmbree::trace(float far_m, std::size_t packets_per_task, int threads) const {
  const std::span<const Directions> packets = impl_->packets;
  std::vector<std::size_t> hits((packets.size() + packets_per_task - 1) / packets_per_task);
  parallel_for(threads, hits.size(), [&](std::size_t task) {
    const std::size_t begin = task * packets_per_task;
    const std::size_t count = std::min(packets_per_task, packets.size() - begin);
    hits[task] = impl_->trace_some(packets.subspan(begin, count), far_m);
  });
  return std::accumulate(hits.begin(), hits.end(), std::size_t{0});
}

}  // namespace gnbv
