// The world as the sensors see it. What knows Embree is its .cpp, and embree_scene.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "sim/core/pose.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {

/// Parts of the world; a question names one, or several joined by |. Sensors see all of them.
constexpr unsigned kStructurePart = 1;
constexpr unsigned kGroundPart = 2;
constexpr unsigned kObstaclePart = 4;
constexpr unsigned kTerrainPart = 8;
constexpr unsigned kMeshParts = kStructurePart | kObstaclePart | kTerrainPart;
constexpr unsigned kRisenTerrainPart =
    16;  // of distances: faces that rise above the terrain's floor

/// The far end of a ray that has none.
constexpr float kEndless = std::numeric_limits<float>::infinity();

constexpr std::int32_t kNoFace = -1;
constexpr std::int32_t kGroundFace = -2;

struct RayHit {
  float distance_m = 0.0F;  // in units of the ray's direction length; kNoReturn when nothing
  // index into the faces of World::structure, then obstacles, then terrain; or one of the two above
  std::int32_t face = kNoFace;
};

/// Directions of 16 rays that are traced at once: neighbours in space.
struct RayPacket {
  static constexpr std::size_t kRays = 16;
  alignas(64) std::array<float, kRays> x{};
  alignas(64) std::array<float, kRays> y{};
  alignas(64) std::array<float, kRays> z{};

  Vec3f direction(std::size_t ray) const { return {x[ray], y[ray], z[ray]}; }
};

/// What they meet first, as in RayHit.
struct HitPacket {
  std::array<float, RayPacket::kRays> distance_m{};
  std::array<std::int32_t, RayPacket::kRays> face{};
};

/// Ray queries against the structure, what stands around it, and the ground. Const after
/// construction: any number of threads may query at once, and each query's answer depends on its
/// rays alone.
class RayScene {
 public:
  explicit RayScene(const World& world);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  /// First hit of each ray in (near_m, far_m]. Directions need not be of unit length; distances are
  /// in multiples of them. As many hits as rays.
  void first_hits(const Vec3f& origin_world_m, std::span<const RayPacket> directions_world,
                  float near_m, float far_m, std::span<HitPacket> hits) const;
  /// Their distances alone, which is faster.
  void first_distances(const Vec3f& origin_world_m, std::span<const RayPacket> directions_world,
                       float near_m, float far_m,
                       std::span<std::array<float, RayPacket::kRays>> distances_m) const;
  /// First hits of any number of rays, 16 neighbours in the span to a packet.
  void first_hits(const Vec3f& origin_world_m, std::span<const Vec3f> directions_world,
                  float near_m, float far_m, std::span<RayHit> hits) const;
  /// The same for rays that begin each at its own origin; as many origins as directions.
  void first_hits(std::span<const Vec3f> origins_world_m, std::span<const Vec3f> directions_world,
                  float near_m, float far_m, std::span<RayHit> hits) const;

  /// For each ray from its own origin: whether anything of the parts (kStructurePart and so on)
  /// lies in (near_m, far_m), in units of the direction's length. Sizes equal. blocked[i] is 0
  /// or 1.
  void find_blocked(unsigned parts, std::span<const Vec3f> origins_world_m,
                    std::span<const Vec3f> directions_world, float near_m, float far_m,
                    std::span<std::uint8_t> blocked) const;

  /// Unit normal of a face of a mesh, on the side its corners run counter-clockwise, or of the
  /// ground. Zero for a face without area.
  Vec3f normal_world(std::int32_t face) const;

  /// What a face of a mesh is made of.
  const Material& material(std::int32_t face) const;

  bool has_obstacles() const;
  bool has_terrain() const;

  /// Distance from a point to the structure's surface, up to `limit_m`; infinity beyond.
  double distance_to_structure_m(const Vec3& p_world_m, double limit_m) const;
  /// To what is seen and not scored: obstacles and terrain.
  double distance_to_surroundings_m(const Vec3& p_world_m, double limit_m) const;
  /// To what the vehicle has to keep clear of: the structure, the obstacles, and what of the
  /// terrain rises above World::terrain_floor_z_m; a face of it that does so anywhere does so
  /// everywhere.
  double clearance_m(const Vec3& p_world_m, double limit_m) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gnbv
