// The world as sensors see it. Only ray_scene.cpp, embree_scene.* and exact_faces.* know Embree.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "sim/core/pose.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {

/// Parts of the world; a question names one, or several joined by |. Sensors see all of them.
constexpr unsigned kStructurePart = 1;
constexpr unsigned kObstaclePart = 2;
constexpr unsigned kTerrainPart = 4;
constexpr unsigned kGroundPart = 8;
constexpr unsigned kRisenTerrainPart =
    16;  // of distances: faces that reach above terrain_floor_z_m
constexpr unsigned kMeshParts = kStructurePart | kObstaclePart | kTerrainPart;
constexpr unsigned kAllParts = kMeshParts | kGroundPart;

/// The far end of a ray that has none.
constexpr float kEndless = std::numeric_limits<float>::infinity();

constexpr std::int32_t kNoFace = -1;
constexpr std::int32_t kGroundFace = -2;

struct RayHit {
  float distance_m = 0.0F;  // in lengths of the ray's direction; kNoReturn when nothing
  // index into the faces of structure, then obstacles, then terrain; or one of the two above
  std::int32_t face = kNoFace;
};

/// Directions of 16 rays that are traced at once, neighbours in space.
struct RayPacket {
  static constexpr std::size_t kRays = 16;
  alignas(64) std::array<float, kRays> x{};
  alignas(64) std::array<float, kRays> y{};
  alignas(64) std::array<float, kRays> z{};

  Vec3f direction(std::size_t ray) const { return {x[ray], y[ray], z[ray]}; }
};

/// Their hits.
struct HitPacket {
  std::array<float, RayPacket::kRays> distance_m{};
  std::array<std::int32_t, RayPacket::kRays> face{};
};

struct EmbreeScene;
}  // namespace gnbv
struct RTCRay16;  // Embree's
struct RTCRayHit16;
namespace gnbv {

/// Ray queries against the structure, its surroundings and the ground. Any number of threads may
/// query at once. An answer depends on its ray alone. As many answers as rays.
class RayScene {
 public:
  /// Of the world at rest: bodies that move are not there.
  explicit RayScene(const World& world);

  /// The same world with its moving bodies where they are then.
  RayScene at(double time_s) const;
  /// To the nearest body whose motion is known, then; infinity beyond `limit_m`.
  double distance_to_known_movers_m(const Vec3& p_world_m, double time_s, double limit_m) const;

  /// First hit of each ray in (near_m, far_m]. Directions need not be of unit length; distances are
  /// in multiples of them.
  void first_hits(const Vec3f& origin_world_m, std::span<const RayPacket> directions_world,
                  float near_m, float far_m, std::span<HitPacket> hits) const;
  /// Their distances alone, which is faster.
  void first_distances(const Vec3f& origin_world_m, std::span<const RayPacket> directions_world,
                       float near_m, float far_m,
                       std::span<std::array<float, RayPacket::kRays>> distances_m) const;
  /// First hits of any number of rays, each from its own origin or all from one. Sixteen neighbours
  /// in the span are traced at once.
  void first_hits(std::span<const Vec3f> origins_world_m, std::span<const Vec3f> directions_world,
                  float near_m, float far_m, std::span<RayHit> hits) const;
  void first_hits(const Vec3f& origin_world_m, std::span<const Vec3f> directions_world,
                  float near_m, float far_m, std::span<RayHit> hits) const {
    first_hits(std::span(&origin_world_m, 1), directions_world, near_m, far_m, hits);
  }

  /// For each ray, from its own origin or all from one, 1 where anything of the parts lies in
  /// (near_m, far_m), in lengths of the direction; else 0.
  void find_blocked(unsigned parts, std::span<const Vec3f> origins_world_m,
                    std::span<const Vec3f> directions_world, float near_m, float far_m,
                    std::span<std::uint8_t> blocked) const;

  /// Unit normal of a mesh's face, on the side where its corners run counter-clockwise, or of the
  /// ground. Zero for a face without area.
  Vec3f normal_world(std::int32_t face) const;
  /// Of a mesh's face.
  const Material& material(std::int32_t face) const;
  /// Linear colour of a mesh's face at a place on it: albedo() of sim/mesh/triangle_mesh.hpp.
  std::array<float, 3> albedo(std::int32_t face, const Vec3f& p_world_m,
                              const Vec3f& normal_world) const;

  bool has_obstacles() const;  // that stand, or move
  bool has_terrain() const;

  /// Distance from a point to the nearest surface of the parts, but of the ground, up to `limit_m`;
  /// infinity beyond.
  double distance_m(unsigned parts, const Vec3& p_world_m, double limit_m) const;
  double distance_to_structure_m(const Vec3& p_world_m, double limit_m) const {
    return distance_m(kStructurePart, p_world_m, limit_m);
  }
  /// To what is seen and not scored, moving bodies wherever they come.
  double distance_to_surroundings_m(const Vec3& p_world_m, double limit_m) const;
  /// To what the vehicle has to keep clear of.
  double clearance_m(const Vec3& p_world_m, double limit_m) const {
    return distance_m(kStructurePart | kObstaclePart | kRisenTerrainPart, p_world_m, limit_m);
  }

 private:
  struct Mover {
    std::shared_ptr<const EmbreeScene> body;  // its mesh where it stands at time 0, as obstacles
    BodyMotion motion;
    Vec3 offset_m;             // now
    std::uint32_t first_face;  // after those of the meshes and of the movers before
  };
  void trace_movers(std::span<const int, RayPacket::kRays> valid, float far_m,
                    RTCRayHit16& packet) const;
  void find_blocked_by_movers(std::span<const int, RayPacket::kRays> valid, RTCRay16& packet) const;
  /// The mesh of a face, and its number there.
  struct MeshFace {
    const TriangleMesh* mesh = nullptr;
    std::size_t index = 0;
    Vec3f offset_m = Vec3f::Zero();  // by which the mesh has moved
  };
  MeshFace mesh_of(std::int32_t face) const;

  std::shared_ptr<const EmbreeScene> embree_;
  std::vector<Mover> movers_;
  bool has_time_ = false;  // at()
};

}  // namespace gnbv
