// Which patches a camera would see, by what is known of the surface.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/tour/cell_blocks.hpp"
#include "planner/tour/config.hpp"
#include "planner/tour/gain_calibration.hpp"
#include "sensors/camera_model.hpp"

namespace gnbv {

/// What may be seen, and what may hide it.
struct TourScene {
  const TourConfig& config;
  const SurfaceCells& cells;
  std::span<const Patch> patches;
};

/// Works out what cameras see: draws the surface as discs into an image of depths (splats), and
/// takes a patch for seen if it lies no deeper than what was drawn there. Has memory of its own, so
/// one a thread.
class PatchViewer {
 public:
  /// Appends what the camera sees. `blocks`: those near, with the radius of their spheres.
  void observe(const TourScene& scene, const CameraModel& camera, const Isometry& T_world_body,
               std::span<const CellBlocks::Block* const> blocks, float block_radius_m,
               std::vector<SeenPatch>& seen);

 private:
  struct Image {
    int width = 0, height = 0;
    float fx = 0.0F, fy = 0.0F, cx = 0.0F, cy = 0.0F;
    float range_max_m = 0.0F;
    Eigen::Matrix3f R_camera_world = Eigen::Matrix3f::Identity();
    Vec3f origin_m = Vec3f::Zero();  // world
  };
  void begin(const CameraModel& camera, const Isometry& T_world_camera);
  Vec3f to_camera(const Vec3f& p_world_m) const {
    return image_.R_camera_world * (p_world_m - image_.origin_m);
  }
  /// A ball reaches into a cone from farther beside it than its radius, at most by this factor.
  float slant() const { return 1.0F + std::max(image_.cx / image_.fx, image_.cy / image_.fy); }
  bool is_in_cone(const Vec3f& p_camera_m, float margin_m) const;
  bool is_in_image(const Vec3f& p_camera_m, float margin_m) const;
  void draw_cell(const TourScene& scene, const CellBlocks::Block& block,
                 const CellBlocks::Cell& cell);
  void draw(const Vec3f& p_camera_m, const Vec3f& normal, float radius_m);
  bool is_before(const Vec3f& p_camera_m, float cos_incidence, float bias_m) const;

  Image image_;
  std::vector<float> ray_x_, ray_y_;  // through the middles of columns and rows, at depth 1
  std::vector<float> depth_m_;
  std::vector<std::uint32_t> in_image_;  // cells
};

/// How far a camera reaches from the vehicle, in m.
double camera_reach_m(const CameraModel& camera);

}  // namespace gnbv
