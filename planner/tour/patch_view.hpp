// Which patches a camera would see, by what is known of the surface.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

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

/// The cells in cubes of the workspace, for those near a place.
class CellBlocks {
 public:
  CellBlocks(const Box3& workspace_m, double cell_m);
  /// Takes up cells that are new since the last call.
  void follow(const SurfaceCells& cells);
  struct Block {
    Vec3f center_m;
    std::vector<std::uint32_t> cells;
  };
  /// Those within reach.
  std::vector<const Block*> near(const Vec3& p_world_m, double reach_m) const;
  /// Of the sphere around a block's cells.
  float radius_m() const { return static_cast<float>(0.9 * lattice_.resolution_m()); }

 private:
  GridGeometry lattice_;
  ZeroedArray<std::uint32_t> slot_;  // 1 + index into blocks_
  std::vector<Block> blocks_;
  std::size_t taken_ = 0;
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
  void draw_cell(const TourScene& scene, std::uint32_t cell);
  bool is_seen(const TourScene& scene, const Patch& patch, float cos_incidence) const;
  void draw(const Vec3f& p_camera_m, const Vec3f& normal, float radius_m);
  bool is_before(const Vec3f& p_camera_m, float cos_incidence, float bias_m) const;

  Image image_;
  std::vector<float> depth_m_;
  std::vector<std::uint32_t> in_image_;  // cells
};

/// Whether the line from the origin meets no occupied voxel but the target's and its neighbours.
bool is_hit_first(const OccupancyGrid& grid, const Vec3& origin_world_m,
                  const Vec3& target_world_m);

/// How far a camera reaches from the vehicle, in m.
double camera_reach_m(const CameraModel& camera);

}  // namespace gnbv
