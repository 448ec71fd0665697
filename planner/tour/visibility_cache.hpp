// What each view would see: worked out once, and again where the surface nearby has changed.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "planner/motion/roadmap.hpp"
#include "planner/tour/patch_view.hpp"

namespace gnbv {

class VisibilityCache {
 public:
  using Node = Roadmap::Node;

  /// `pitches_rad`: of the cameras' gimbal; one, whatever it is, without.
  VisibilityCache(const TourConfig& config, std::span<const CameraModel> cameras,
                  std::span<const double> pitches_rad, const Box3& workspace_m);

  /// Ways to look from a node: each yaw with each pitch.
  int headings() const { return yaws_ * static_cast<int>(pitches_.size()); }
  ViewPose pose(const Vec3& p_world_m, int heading) const;

  /// Observes from every reachable node that it never did, and from `most_again` of those
  /// around which the surface changed most since it did; `first` come before all others.
  /// `heed_stop` is called now and then, and may throw.
  void follow(const TourScene& scene, const Roadmap& roadmap, std::span<const Node> first,
              std::size_t most_again, int threads, const std::function<void()>& heed_stop);

  /// What was last seen from there at that heading, in ascending order.
  std::span<const SeenPatch> seen(Node node, int heading) const;

  /// What all cameras see from a pose, now.
  std::vector<SeenPatch> observe(const TourScene& scene, const ViewPose& view, int threads);

 private:
  struct AtNode {
    bool is_known = false;
    std::uint32_t update = 0;                  // of the cells, when it was last observed
    std::vector<std::vector<SeenPatch>> seen;  // by heading
  };
  struct Pitch {
    double rad = 0.0;
    std::vector<CameraModel> cameras;
  };
  std::uint32_t changes_near(const Vec3& p_world_m, std::uint32_t since) const;
  std::vector<Node> changed_nodes(const Roadmap& roadmap, std::span<const Node> first,
                                  int threads) const;
  void observe_around(const TourScene& scene, const Vec3& p_world_m, AtNode& at,
                      PatchViewer& viewer) const;
  void observe(const TourScene& scene, const ViewPose& view,
               std::span<const CellBlocks::Block* const> near, PatchViewer& viewer,
               std::vector<SeenPatch>& seen) const;

  std::vector<Pitch> pitches_;
  CellBlocks blocks_;
  double reach_m_ = 0.0;
  int yaws_ = 1;
  std::vector<AtNode> at_;
};

}  // namespace gnbv
