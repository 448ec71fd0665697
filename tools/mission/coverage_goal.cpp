#include "tools/mission/coverage_goal.hpp"

#include <memory>

#include "bench/score/coverage_curve.hpp"

namespace gnbv {

std::function<bool(const Belief&)> coverage_goal(const BenchmarkConfig& benchmark,
                                                 const SurfaceReference& reference) {
  const double goal = benchmark.stop_at_coverage;
  if (goal <= 0.0) return [](const Belief&) { return false; };
  const auto meter = std::make_shared<CoverageMeter>(reference.outside[0], kCoverageSizes_m[0]);
  return [meter, goal](const Belief& belief) {
    return meter->share_of(belief.cloud.points_world_m()) >= goal;
  };
}

}  // namespace gnbv
