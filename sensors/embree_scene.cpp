#include "sensors/embree_scene.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <new>
#include <span>
#include <string>

#include "sensors/ray_scene.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr float kGroundHalfWidth_m = 1000.0F;

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
  GNBV_CHECK(mesh.face_looks.empty() || mesh.face_looks.size() == mesh.faces.size(),
             "looks of {} of {} faces", mesh.face_looks.size(), mesh.faces.size());
  for (const std::uint16_t i : mesh.face_material) {
    GNBV_CHECK(i < mesh.materials.size(), "material {} of {}", i, mesh.materials.size());
  }
  GNBV_CHECK(!mesh.materials.empty() || mesh.faces.empty(), "a mesh without materials");
}

void check_device(RTCDevice device, const char* doing) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  GNBV_CHECK(device != nullptr && error == RTC_ERROR_NONE, "Embree error {} while {}",
             static_cast<int>(error), doing);
}

using Faces = std::span<const std::array<std::uint32_t, 3>>;

/// Copies the triangles into the geometry. Embree pads its own buffers.
void set_triangles(RTCDevice device, RTCGeometry geometry, std::span<const Vec3f> vertices_m,
                   Faces faces) {
  auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                             RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                             vertices_m.size()));
  auto* index = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), faces.size()));
  check_device(device, "allocating geometry");
  for (const Vec3f& v : vertices_m) vertex = std::copy_n(v.data(), 3, vertex);
  for (const auto& face : faces) index = std::copy_n(face.data(), 3, index);
}

void attach(EmbreeScene& to, unsigned id, std::span<const Vec3f> vertices_m, Faces faces) {
  const std::unique_ptr<RTCGeometryTy, Releases<rtcReleaseGeometry>> geometry(rtcNewGeometry(
      to.device.get(), to.is_portable ? RTC_GEOMETRY_TYPE_USER : RTC_GEOMETRY_TYPE_TRIANGLE));
  if (to.is_portable) {
    std::vector<FaceCorners>& exact = to.exact_faces[id];
    for (const auto& [a, b, c] : faces) {
      exact.push_back({vertices_m[a], vertices_m[b], vertices_m[c]});
    }
    set_exact_faces(geometry.get(), exact);
  } else {
    set_triangles(to.device.get(), geometry.get(), vertices_m, faces);
  }
  rtcSetGeometryBuildQuality(geometry.get(), RTC_BUILD_QUALITY_HIGH);
  rtcSetGeometryMask(geometry.get(), 1U << id);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(to.scene.get(), geometry.get(), id);
}

/// Embree searches in floats around the rounded point, while we measure in doubles: it searches a
/// ball a little larger than the distance found so far.
float search_radius_m(double distance_m) {
  return static_cast<float>(distance_m * 1.000001 + 1e-5);
}

struct NearestQuery {
  const EmbreeScene& scene;
  unsigned parts;
  Vec3 p_world_m;
  double distance_m = std::numeric_limits<double>::infinity();

  /// Whether the parts hold the face; its corners.
  bool asks(unsigned id, const std::array<Vec3, 3>& corners_m) const {
    if ((parts >> id & 1U) != 0) return true;
    return id == EmbreeScene::terrain && (parts & kRisenTerrainPart) != 0 &&
           std::any_of(corners_m.begin(), corners_m.end(), [&](const Vec3& p_m) {
             return p_m.z() > static_cast<double>(scene.terrain_floor_z_m);
           });
  }
};

bool visit_nearest(RTCPointQueryFunctionArguments* arguments) {
  auto& query = *static_cast<NearestQuery*>(arguments->userPtr);
  const unsigned id = arguments->geomID;
  if (id == EmbreeScene::ground) return false;
  const std::size_t face = query.scene.first_face[id] + arguments->primID;
  const auto corners_m = face_corners_m(query.scene.meshes, face);
  if (!query.asks(id, corners_m)) return false;
  const auto& [a, b, c] = corners_m;
  const double distance_m =
      (closest_on_triangle(query.p_world_m, a, b, c) - query.p_world_m).norm();
  if (!(distance_m < query.distance_m)) return false;
  query.distance_m = distance_m;
  arguments->query->radius = search_radius_m(distance_m);
  return true;
}

/// GNBV_EMBREE adds to it, for tests: max_isa=avx2, say.
std::string device_config() {
  const char* const more = std::getenv("GNBV_EMBREE");
  return std::string("threads=1") + (more == nullptr ? "" : std::string(",") + more);
}

}  // namespace

EmbreeScene::EmbreeScene(const World& world)
    : device(rtcNewDevice(device_config().c_str())),
      meshes(world.structure),
      terrain_floor_z_m(static_cast<float>(world.terrain_floor_z_m)),
      is_portable(world.is_portable) {
  check_device(device.get(), "opening a device");
  GNBV_CHECK(rtcGetDeviceProperty(device.get(), RTC_DEVICE_PROPERTY_RAY_MASK_SUPPORTED) != 0,
             "this Embree was built without ray masks");
  scene.reset(rtcNewScene(device.get()));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
  unsigned id = structure;
  for (const TriangleMesh* part : {&world.structure, &world.obstacles, &world.terrain}) {
    need_indices(*part);
    if (id != structure && !part->faces.empty()) append(meshes, *part);
    if (!part->faces.empty()) attach(*this, id, part->vertices_m, part->faces);
    first_face[++id] = static_cast<std::uint32_t>(meshes.faces.size());
  }
  if (world.has_ground) {
    constexpr float w = kGroundHalfWidth_m;
    const std::array<Vec3f, 4> corners = {Vec3f(-w, -w, 0), Vec3f(w, -w, 0), Vec3f(w, w, 0),
                                          Vec3f(-w, w, 0)};
    const std::array<std::array<std::uint32_t, 3>, 2> halves = {{{0, 1, 2}, {0, 2, 3}}};
    attach(*this, ground, corners, halves);
  }
  rtcCommitScene(scene.get());
  check_device(device.get(), "building the scene");
}

double EmbreeScene::distance_m(unsigned parts, const Vec3& p_world_m, double limit_m) const {
  NearestQuery nearest{*this, parts, p_world_m};
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

}  // namespace gnbv
