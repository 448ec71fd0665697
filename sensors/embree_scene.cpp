#include "sensors/embree_scene.hpp"

#include <algorithm>
#include <cstdint>
#include <new>
#include <span>

#include "sensors/ray_scene.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr float kGroundHalfWidth_m = 1000.0F;
constexpr std::array<unsigned, SceneFaces::kParts> kMasks = {kStructurePart, kObstaclePart,
                                                             kTerrainPart};

/// Closest point of triangle abc to p: the region of p among vertices, edges and face decides
/// (Ericson, Real-Time Collision Detection 2005, section 5.1.5).
Vec3 closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const double d1 = ab.dot(p - a);
  const double d2 = ac.dot(p - a);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const double d3 = ab.dot(p - b);
  const double d4 = ac.dot(p - b);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + d1 / (d1 - d3) * ab;
  const double d5 = ab.dot(p - c);
  const double d6 = ac.dot(p - c);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  const double along_b = d4 - d3;
  const double along_c = d5 - d6;
  if (va <= 0.0 && along_b >= 0.0 && along_c >= 0.0) {
    return b + along_b / (along_b + along_c) * (c - b);
  }
  const double scale = 1.0 / (va + vb + vc);
  return a + vb * scale * ab + vc * scale * ac;
}

void need_indices(const TriangleMesh& mesh) {
  for (const auto& face : mesh.faces) {
    for (const std::uint32_t i : face) {
      GNBV_CHECK(i < mesh.vertices_m.size(), "face vertex {} of {}", i, mesh.vertices_m.size());
    }
  }
  GNBV_CHECK(mesh.face_material.empty() || mesh.face_material.size() == mesh.faces.size(),
             "{} materials of {} faces", mesh.face_material.size(), mesh.faces.size());
  for (const std::uint16_t i : mesh.face_material) {
    GNBV_CHECK(i < mesh.materials.size(), "material {} of {}", i, mesh.materials.size());
  }
  GNBV_CHECK(!mesh.materials.empty() || mesh.faces.empty(), "a mesh without materials");
}

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
  geometries = {attach(device.get(), scene.get(), world.structure, kStructurePart),
                attach(device.get(), scene.get(), world.obstacles, kObstaclePart),
                attach(device.get(), scene.get(), world.terrain, kTerrainPart)};
  if (world.has_ground) {
    constexpr float w = kGroundHalfWidth_m;
    const std::array<Vec3f, 4> corners = {Vec3f(-w, -w, 0), Vec3f(w, -w, 0), Vec3f(w, w, 0),
                                          Vec3f(-w, w, 0)};
    const std::array<std::array<std::uint32_t, 3>, 2> halves = {{{0, 1, 2}, {0, 2, 3}}};
    ground_id = attach_triangles(device.get(), scene.get(), corners, halves, kGroundPart);
  }
  rtcCommitScene(scene.get());
  check_device(device.get(), "building the scene");
}

SceneFaces::SceneFaces(const World& world)
    : meshes_(world.structure), terrain_floor_z_m_(static_cast<float>(world.terrain_floor_z_m)) {
  need_indices(world.structure);
  add(1, world.obstacles);
  add(2, world.terrain);
}

void SceneFaces::add(std::size_t part, const TriangleMesh& mesh) {
  need_indices(mesh);
  first_face_[part] = static_cast<std::uint32_t>(meshes_.faces.size());
  if (!mesh.faces.empty()) append(meshes_, mesh);
}

bool SceneFaces::is_asked(std::size_t part, std::uint32_t face, unsigned masks) const {
  if ((masks & kMasks[part]) != 0) return true;
  if (kMasks[part] != kTerrainPart || (masks & kRisenTerrainPart) == 0) return false;
  const auto& corners = meshes_.faces[face];
  return std::any_of(corners.begin(), corners.end(), [&](std::uint32_t vertex) {
    return meshes_.vertices_m[vertex].z() > terrain_floor_z_m_;
  });
}

double SceneFaces::distance_m(std::uint32_t face, const Vec3& p_world_m) const {
  const auto corner = [&](std::size_t i) -> Vec3 {
    return meshes_.vertices_m[meshes_.faces[face][i]].cast<double>();
  };
  return (closest_on_triangle(p_world_m, corner(0), corner(1), corner(2)) - p_world_m).norm();
}

Vec3f SceneFaces::normal_world(std::int32_t face) const {
  GNBV_CHECK(face >= 0, "the normal of nothing");
  const auto& [a, b, c] = meshes_.faces[static_cast<std::size_t>(face)];
  const std::vector<Vec3f>& p = meshes_.vertices_m;
  return (p[b] - p[a]).cross(p[c] - p[a]).stableNormalized();
}

const Material& SceneFaces::material(std::int32_t face) const {
  const std::vector<std::uint16_t>& of_face = meshes_.face_material;
  return meshes_.materials[of_face.empty() ? 0 : of_face[static_cast<std::size_t>(face)]];
}

}  // namespace gnbv
