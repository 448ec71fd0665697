// The faces of all meshes of a world, one after the other, by which a ray scene names what it met.
#pragma once

#include <array>
#include <cstdint>

#include "sim/mesh/world.hpp"

namespace gnbv {

// Sensors see all; questions about one part leave the others out.
constexpr unsigned kStructureMask = 1;
constexpr unsigned kGroundMask = 2;
constexpr unsigned kObstacleMask = 4;
constexpr unsigned kTerrainMask = 8;
constexpr unsigned kAllMask = kStructureMask | kGroundMask | kObstacleMask | kTerrainMask;
// Of faces that are asked for their distance only where they rise above the terrain's floor
constexpr unsigned kRisenTerrainMask = 16;

class SceneFaces {
 public:
  /// Structure, obstacles and terrain.
  static constexpr std::size_t kParts = 3;

  /// Throws BrokenInvariant for faces and materials that point nowhere.
  explicit SceneFaces(const World& world);

  /// Of a part, among all faces.
  std::uint32_t first_face(std::size_t part) const { return first_face_[part]; }

  /// Whether the masks ask for a face of the part.
  bool is_asked(std::size_t part, std::uint32_t face, unsigned masks) const;
  /// From a point to the face.
  double distance_m(std::uint32_t face, const Vec3& p_world_m) const;

  /// Unit normal, on the side the corners run counter-clockwise. Zero for a face without area.
  Vec3f normal_world(std::int32_t face) const;
  const Material& material(std::int32_t face) const;

 private:
  void add(std::size_t part, const TriangleMesh& mesh);

  TriangleMesh meshes_;
  std::array<std::uint32_t, kParts> first_face_{};
  float terrain_floor_z_m_;
};

}  // namespace gnbv
