// Which patches a camera would see, by what is known of the surface.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "planner/tour/config.hpp"
#include "planner/tour/disc_loops.hpp"
#include "planner/tour/gains.hpp"
#include "sensors/camera_model.hpp"

namespace gnbv {

/// The cells of the surface as they are drawn: packed, by cubes of the workspace.
class CellBlocks {
 public:
  /// A cell that hides something, or that has something to be seen.
  struct Cell {
    Vec3f middle_m;                // of its discs; of a boundary on its plane
    Vec3f normal = Vec3f::Zero();  // zero: no plane, its discs face whoever looks
    std::uint32_t index = 0;       // of the cell
    std::uint32_t changed = 0;     // SurfaceCell's
    std::uint32_t first_disc = 0;  // of the block's
    std::uint32_t discs = 0;
  };
  struct Block {
    Vec3f center_m;
    std::uint32_t changed = 0;                // the newest of its cells
    std::vector<std::uint32_t> members = {};  // all its cells
    std::vector<Cell> cells = {};             // those to be drawn
    std::vector<Vec3f> discs_m = {};
  };

  CellBlocks(const Box3& workspace_m, double cell_m);

  /// The cells as they are now; nothing to do when they have not changed since the last call.
  void follow(const SurfaceCells& cells, int threads);

  /// Those within reach.
  std::vector<const Block*> near(const Vec3& p_world_m, double reach_m) const;

  /// Of the sphere around a block's cells.
  float radius_m() const { return static_cast<float>(0.9 * lattice_.resolution_m()); }

 private:
  GridGeometry lattice_;
  ZeroedArray<std::uint32_t> slot_;  // 1 + index into blocks_
  std::vector<Block> blocks_;
  std::size_t taken_ = 0;      // cells that have a block
  std::uint32_t version_ = 0;  // of the cells, when they were packed
};

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
  void begin(const CameraModel& camera, const Isometry& T_world_camera);
  Vec3f to_camera(const Vec3f& p_world_m) const {
    return R_camera_world_ * (p_world_m - origin_world_m_);
  }
  /// A ball reaches into the cone of sight from farther beside it than its radius, measured across
  /// the axis: at most by this factor.
  float slant() const { return 1.0F + std::max(cx_ / fx_, cy_ / fy_); }
  bool is_in_cone(const Vec3f& p_camera_m, float margin_m) const {
    return std::fabs(p_camera_m.x()) <= cx_ / fx_ * p_camera_m.z() + margin_m &&
           std::fabs(p_camera_m.y()) <= cy_ / fy_ * p_camera_m.z() + margin_m;
  }
  bool is_in_image(const Vec3f& p_camera_m, float margin_m) const {
    return p_camera_m.z() > 0.05F && p_camera_m.z() <= range_max_m_ + margin_m &&
           is_in_cone(p_camera_m, margin_m);
  }
  void draw_cell(const TourScene& scene, const CellBlocks::Block& block,
                 const CellBlocks::Cell& cell);
  void draw(const Vec3f& p_camera_m, const Vec3f& normal, float radius_m);
  bool is_before(const Vec3f& p_camera_m, float cos_incidence, float bias_m) const;

  int width_ = 0, height_ = 0;  // pixels
  float fx_ = 0.0F, fy_ = 0.0F, cx_ = 0.0F, cy_ = 0.0F;
  float range_max_m_ = 0.0F;
  Eigen::Matrix3f R_camera_world_ = Eigen::Matrix3f::Identity();
  Vec3f origin_world_m_ = Vec3f::Zero();
  std::vector<float> ray_x_, ray_y_;  // through the middles of columns and rows, at depth 1
  std::vector<float> depth_m_;
  std::vector<std::uint32_t> in_image_;  // cells
  std::vector<Disc> discs_;              // of them, to be drawn
};

/// How far a camera reaches from the vehicle, in m.
double camera_reach_m(const CameraModel& camera);

}  // namespace gnbv
