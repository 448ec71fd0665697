// The world as Embree holds it.
#pragma once

#include <embree3/rtcore.h>

#include <array>

#include "sensors/scene_faces.hpp"

namespace gnbv {

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
