// How fast Embree is with nothing around it: rays prepared beforehand, answers thrown away.
#pragma once

#include <memory>
#include <span>

#include "sim/mesh/world.hpp"

namespace gnbv {

/// Traces packets of 16 coherent rays through the same scene as RayScene, built the same way.
class BareEmbree {
 public:
  explicit BareEmbree(const World& world);
  ~BareEmbree();
  BareEmbree(const BareEmbree&) = delete;
  BareEmbree& operator=(const BareEmbree&) = delete;

  /// The rays of trace(): neighbours in the span share a packet. Their number is a multiple of 16.
  void prepare(const Vec3f& origin_world_m, std::span<const Vec3f> directions_world);

  /// Traces what was prepared from its origin up to `far_m`, in tasks of `packets_per_task` on this
  /// many threads. Returns how many rays hit, so that nothing can be left out.
  std::size_t trace(float far_m, std::size_t packets_per_task, int threads) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gnbv
