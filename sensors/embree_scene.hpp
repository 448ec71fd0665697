// The world as Embree holds it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "sensors/embree.hpp"
#include "sensors/exact_faces.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {

template <auto kRelease>
struct Releases {
  template <typename Object>
  void operator()(Object* object) const {
    kRelease(object);
  }
};

/// One committed scene of a world's meshes and its ground. Queries may run on any number of threads
/// at once.
struct EmbreeScene {
  /// Ids of Embree's geometries, and places in `first_face`. The mask of a part is 1 << id.
  enum Id : unsigned { structure, obstacles, terrain, ground };

  // One build thread: on several the tree, and with it the last bit of a distance, could depend on
  // how they shared the work.
  std::unique_ptr<RTCDeviceTy, Releases<rtcReleaseDevice>> device;
  std::unique_ptr<RTCSceneTy, Releases<rtcReleaseScene>> scene;
  TriangleMesh meshes;  // of structure, obstacles and terrain, one after the other
  std::array<std::uint32_t, 4> first_face{};  // of each of them in `meshes`, and the end
  float terrain_floor_z_m;
  bool is_portable;
  // of a portable world, by id; else none
  std::array<std::vector<FaceCorners>, 4> exact_faces;

  /// Throws std::bad_alloc for want of memory, BrokenInvariant for an Embree that cannot be used
  /// and for faces and materials that point nowhere.
  explicit EmbreeScene(const World& world);

  /// To the nearest face of the parts (kStructurePart and so on), up to `limit_m`; infinity beyond.
  double distance_m(unsigned parts, const Vec3& p_world_m, double limit_m) const;
};

}  // namespace gnbv
