#include "bench/score/scored_points.hpp"

#include "bench/score/cloud_metrics.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {

std::vector<std::uint8_t> points_of_structure(const RayScene& scene,
                                              std::span<const Vec3f> points_world_m, int threads) {
  std::vector<std::uint8_t> is_kept(points_world_m.size(), 1);
  if (!scene.has_obstacles() && !scene.has_terrain()) return is_kept;
  constexpr std::size_t kPoints = 4096;  // a task
  parallel_for_chunks(threads, points_world_m.size(), kPoints,
                      [&](std::size_t begin, std::size_t end) {
                        for (std::size_t i = begin; i < end; ++i) {
                          const Vec3 p_m = points_world_m[i].cast<double>();
                          const double other_m = scene.distance_to_surroundings_m(p_m, kFarthest_m);
                          if (other_m > kFarthest_m) continue;
                          const double own_m = scene.distance_to_structure_m(p_m, kFarthest_m);
                          is_kept[i] = own_m <= other_m ? 1 : 0;
                        }
                      });
  return is_kept;
}

}  // namespace gnbv
