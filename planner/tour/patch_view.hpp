// Which patches a camera would see, by what is known of the surface.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/tour/cell_blocks.hpp"
#include "planner/tour/config.hpp"
#include "planner/tour/patches.hpp"
#include "sensors/camera_model.hpp"

namespace gnbv {

struct SeenPatch {
  PatchId patch = 0;
  std::uint8_t incidence = 0;  // incidence_bin()
};

/// What may be seen, and what may hide it.
struct TourScene {
  const TourConfig& config;
  const SurfaceCells& cells;
  std::span<const Patch> patches;
  const OccupancyGrid& grid;
};

/// Works out what cameras see; memory of its own, so one a thread.
class PatchViewer {
 public:
  /// Appends what the camera sees. `blocks`: those near, with the radius of their spheres.
  void look(const TourScene& scene, const CameraModel& camera, const Isometry& T_world_body,
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
  bool is_seen(const TourScene& scene, const Patch& patch, float cos_incidence) const;
  void draw(const Vec3f& p_camera_m, const Vec3f& normal, float radius_m);
  bool is_before(const Vec3f& p_camera_m, float cos_incidence, float bias_m) const;

  Image image_;
  std::vector<float> ray_x_, ray_y_;  // through the middles of columns and rows, at depth 1
  std::vector<float> depth_m_;
  std::vector<std::uint32_t> in_image_;  // cells
};

/// Whether the line from the origin meets no occupied voxel but the target's and its neighbours.
bool is_hit_first(const OccupancyGrid& grid, const Vec3& origin_world_m,
                  const Vec3& target_world_m);

/// How far a camera reaches from the vehicle, in m.
double camera_reach_m(const CameraModel& camera);

}  // namespace gnbv
