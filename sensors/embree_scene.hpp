// The world as Embree holds it, and its faces as a ray scene names them.
#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <cstdint>

#include "sim/mesh/world.hpp"

namespace gnbv {

/// The faces of all meshes of a world, one after the other, by which a ray scene names what it met.
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

/// Owns one reference of an Embree handle.
template <typename Handle, void (*Release)(Handle)>
class Owner {
 public:
  explicit Owner(Handle handle) : handle_(handle) {}
  ~Owner() {
    if (handle_ != nullptr) Release(handle_);
  }
  Owner(const Owner&) = delete;
  Owner& operator=(const Owner&) = delete;
  Handle get() const { return handle_; }

 private:
  Handle handle_;
};

/// A device and one committed scene of a world's meshes and its ground. Queries may run on any
/// number of threads at once.
struct EmbreeScene {
  // One build thread: the tree, and with it the last bit of a distance, then never depends on how
  // a build happened to be shared out among threads.
  Owner<RTCDevice, rtcReleaseDevice> device;
  Owner<RTCScene, rtcReleaseScene> scene;
  std::array<unsigned, SceneFaces::kParts> geometries;  // none where a mesh has no faces
  unsigned ground_id = RTC_INVALID_GEOMETRY_ID;

  /// Throws std::bad_alloc for want of memory, BrokenInvariant for an Embree that cannot be used.
  explicit EmbreeScene(const World& world);
};

}  // namespace gnbv
