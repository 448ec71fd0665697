// Which of a structure's surface can be seen from outside it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bench/score/surface_reference.hpp"

namespace gnbv {

/// Asks samples of a structure's surface whether they see out (kLeastOpenShare). The scene must
/// outlive it; any number of threads may ask at once.
class EscapeSearch {
 public:
  /// Throws BrokenInvariant for a config out of range.
  EscapeSearch(const TriangleMesh& mesh, const RayScene& scene, const ReferenceConfig& config);

  /// 1 for each sample that sees out.
  std::vector<std::uint8_t> ask(std::span<const SurfaceSample> samples) const;

 private:
  void leave_out_buried(std::span<const SurfaceSample> samples,
                        std::vector<std::size_t>& open) const;
  void end_at_obstacles(std::vector<Vec3f> origins, std::span<const Vec3f> directions,
                        std::vector<std::uint8_t>& blocked) const;
  template <typename Direction>
  void count_lines(std::span<const SurfaceSample> samples, std::span<const std::size_t> of,
                   const Direction& direction_of, std::vector<std::uint32_t>& lines) const;

  const RayScene& scene_;
  float near_m_;
  float obstacle_reach_m_;
  std::vector<Vec3f> normals_;
  std::vector<Vec3f> directions_;
};

/// 1 for each sample that sees out, 0 for the others.
std::vector<std::uint8_t> samples_seeing_out(const World& world, const RayScene& scene,
                                             std::span<const SurfaceSample> samples,
                                             const ReferenceConfig& config, int threads);

/// Unit vectors spread evenly over the sphere, the first few of them too.
std::vector<Vec3f> spread_directions(int count);

}  // namespace gnbv
