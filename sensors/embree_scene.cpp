#include "sensors/embree_scene.hpp"

#include <algorithm>
#include <cstdint>
#include <new>
#include <span>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr float kGroundHalfWidth_m = 1000.0F;

void check_device(RTCDevice device, const char* doing) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  GNBV_CHECK(error == RTC_ERROR_NONE, "Embree error {} while {}", static_cast<int>(error), doing);
}

/// Copies the triangles into a new geometry of `scene`; its id. Embree pads its own buffers.
unsigned attach_triangles(RTCDevice device, RTCScene scene, std::span<const Vec3f> vertices_m,
                          std::span<const std::array<std::uint32_t, 3>> faces, unsigned mask) {
  const Owner<RTCGeometry, rtcReleaseGeometry> geometry(
      rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX,
                                                             0, RTC_FORMAT_FLOAT3,
                                                             3 * sizeof(float), vertices_m.size()));
  auto* index = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), faces.size()));
  check_device(device, "allocating geometry");
  for (const Vec3f& v : vertices_m) vertex = std::copy_n(v.data(), 3, vertex);
  for (const auto& face : faces) index = std::copy_n(face.data(), 3, index);
  rtcSetGeometryBuildQuality(geometry.get(), RTC_BUILD_QUALITY_HIGH);
  rtcSetGeometryMask(geometry.get(), mask);
  rtcCommitGeometry(geometry.get());
  return rtcAttachGeometry(scene, geometry.get());
}

unsigned attach(RTCDevice device, RTCScene scene, const TriangleMesh& mesh, unsigned mask) {
  if (mesh.faces.empty()) return RTC_INVALID_GEOMETRY_ID;
  return attach_triangles(device, scene, mesh.vertices_m, mesh.faces, mask);
}

RTCScene new_scene(RTCDevice device) {
  if (device == nullptr) {
    const RTCError error = rtcGetDeviceError(nullptr);
    if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    GNBV_CHECK(false, "Embree error {} while opening a device", static_cast<int>(error));
  }
  return rtcNewScene(device);
}

}  // namespace

EmbreeScene::EmbreeScene(const World& world)
    : device(rtcNewDevice("threads=1")), scene(new_scene(device.get())) {
  GNBV_CHECK(rtcGetDeviceProperty(device.get(), RTC_DEVICE_PROPERTY_RAY_MASK_SUPPORTED) != 0,
             "this Embree was built without ray masks");
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
  geometries = {attach(device.get(), scene.get(), world.structure, kStructureMask),
                attach(device.get(), scene.get(), world.obstacles, kObstacleMask),
                attach(device.get(), scene.get(), world.terrain, kTerrainMask)};
  if (world.has_ground) {
    constexpr float w = kGroundHalfWidth_m;
    const std::array<Vec3f, 4> corners = {Vec3f(-w, -w, 0), Vec3f(w, -w, 0), Vec3f(w, w, 0),
                                          Vec3f(-w, w, 0)};
    const std::array<std::array<std::uint32_t, 3>, 2> halves = {{{0, 1, 2}, {0, 2, 3}}};
    ground_id = attach_triangles(device.get(), scene.get(), corners, halves, kGroundMask);
  }
  rtcCommitScene(scene.get());
  check_device(device.get(), "building the scene");
}

}  // namespace gnbv
