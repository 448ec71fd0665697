#include "planner/tour/patch_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

constexpr double kPixel_rad = deg_to_rad(0.6);
constexpr double kMostPixels = 640.0;  // along a side of what a wide lens sees: coarser than that
// In the edge of a small voxel: the radius of a disc, 0.9 of the discs' spacing, leaves no holes;
// what lies no deeper behind a disc is the disc's own surface (facts/tour.md, section 1: splats of
// 0.09 m with a bias of 0.08 m for a spacing of 0.1 m).
constexpr float kDiscRadius = 1.8F;
constexpr float kBias = 1.6F;
// A cell of fewer pixels is drawn as one disc, if it has enough discs: else most of it is empty.
constexpr float kSmallCell_px = 4.0F;
constexpr std::uint32_t kWholeDiscs = 3;
constexpr float kCellRadius = 0.71F;  // in the edge of a cell: half the diagonal of its square
constexpr float kNoDepth = std::numeric_limits<float>::infinity();

constexpr double kBlockCells = 8.0;  // along an edge

int ceil_to_int(float x) { return -floor_to_int(-x); }

void pack(const SurfaceCells& cells, CellBlocks::Block& block) {
  block.cells.clear();
  block.discs_m.clear();
  block.changed = 0;
  for (const std::uint32_t index : block.members) {
    const SurfaceCell& cell = cells.cells()[index];
    if (cell.discs_m.empty() && !cell.is_boundary) continue;
    CellBlocks::Cell packed{.middle_m = cell.on_plane_m, .index = index, .changed = cell.changed};
    if (cell.has_plane() && !cell.is_bar) packed.normal = cell.normal;
    if (!cell.is_boundary) {
      Vec3f sum_m = Vec3f::Zero();
      for (const Vec3f& disc_m : cell.discs_m) sum_m += disc_m;
      packed.middle_m = sum_m / static_cast<float>(cell.discs_m.size());
      packed.first_disc = static_cast<std::uint32_t>(block.discs_m.size());
      packed.discs = static_cast<std::uint32_t>(cell.discs_m.size());
      block.discs_m.insert(block.discs_m.end(), cell.discs_m.begin(), cell.discs_m.end());
    }
    block.changed = std::max(block.changed, cell.changed);
    block.cells.push_back(packed);
  }
}

}  // namespace

CellBlocks::CellBlocks(const Box3& workspace_m, double cell_m)
    : lattice_(workspace_m, kBlockCells * cell_m), slot_(lattice_.voxel_count()) {}

void CellBlocks::follow(const SurfaceCells& cells, int threads) {
  if (version_ == cells.version()) return;
  version_ = cells.version();
  for (; taken_ < cells.cells().size(); ++taken_) {
    const Key key = lattice_.key_of(cells.lattice().center_m(cells.cells()[taken_].key));
    if (!lattice_.contains(key)) continue;  // half a cell beyond the workspace
    std::uint32_t& slot = slot_[lattice_.index_of(key)];
    if (slot == 0) {
      blocks_.push_back({.center_m = lattice_.center_m(key).cast<float>()});
      slot = static_cast<std::uint32_t>(blocks_.size());
    }
    blocks_[slot - 1].members.push_back(static_cast<std::uint32_t>(taken_));
  }
  parallel_for_chunks(threads, blocks_.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) pack(cells, blocks_[i]);
  });
}

std::vector<const CellBlocks::Block*> CellBlocks::near(const Vec3& p_world_m,
                                                       double reach_m) const {
  const float within_m = static_cast<float>(reach_m) + radius_m();
  const Vec3 reach = Vec3::Constant(within_m + 1e-3);  // more than anything here rounds
  std::vector<const Block*> found;
  for_each_key(lattice_.keys_in({p_world_m - reach, p_world_m + reach}), [&](const Key& key) {
    const std::uint32_t slot = slot_[lattice_.index_of(key)];
    if (slot == 0) return;
    const Block& block = blocks_[slot - 1];
    const float distance2_m2 = (block.center_m - p_world_m.cast<float>()).squaredNorm();
    if (distance2_m2 <= within_m * within_m) found.push_back(&block);
  });
  return found;
}

namespace {

/// Of an image around the axis that holds all that the camera sees.
Eigen::Vector2d half_sight(const CameraModel& camera) {
  return camera.sight.max().cwiseMax(-camera.sight.min());
}

}  // namespace

double camera_reach_m(const CameraModel& camera) {
  const CameraConfig& c = camera.config;
  if (camera.is_radial()) return return_end_m(c) + c.p_body_m.norm();
  const Eigen::Vector2d most = half_sight(camera);
  const double across = std::hypot(most.x(), most.y());
  return return_end_m(c) * std::sqrt(1.0 + across * across) + c.p_body_m.norm();
}

void PatchViewer::begin(const CameraModel& camera, const Isometry& T_world_camera) {
  const CameraConfig& c = camera.config;
  const double half_x = half_sight(camera).x();
  const double half_y = half_sight(camera).y();
  const double most = std::max(half_x, half_y);
  const double pixel = camera.lens ? std::max(kPixel_rad, 2.0 * most / kMostPixels) : kPixel_rad;
  width_ = static_cast<int>(std::ceil(2.0 * half_x / pixel));
  height_ = static_cast<int>(std::ceil(2.0 * half_y / pixel));
  cx_ = 0.5F * static_cast<float>(width_);
  cy_ = 0.5F * static_cast<float>(height_);
  fx_ = cx_ / static_cast<float>(half_x);
  fy_ = cy_ / static_cast<float>(half_y);
  R_camera_world_ = T_world_camera.linear().transpose().cast<float>();
  origin_world_m_ = T_world_camera.translation().cast<float>();
  range_max_m_ = static_cast<float>(return_end_m(c));
  depth_m_.assign(static_cast<std::size_t>(width_ * height_) + kDiscPadding, kNoDepth);
  const auto set_rays = [](int pixels, float center, float focal, std::vector<float>& rays) {
    rays.clear();
    for (int i = 0; i < pixels; ++i) {
      rays.push_back((static_cast<float>(i) + 0.5F - center) / focal);
    }
    rays.resize(rays.size() + kDiscPadding);
  };
  set_rays(width_, cx_, fx_, ray_x_);
  set_rays(height_, cy_, fy_, ray_y_);
}

/// Only pixels in the square about the disc's middle are asked.
void PatchViewer::draw(const Vec3f& p, const Vec3f& normal, float radius_m) {
  const float u = fx_ * p.x() / p.z() + cx_;
  const float v = fy_ * p.y() / p.z() + cy_;
  const float half = fx_ * radius_m / p.z();
  const auto first = [&](float middle) { return std::max(0, ceil_to_int(middle - half - 0.5F)); };
  const auto last = [&](float middle, int pixels) {
    return std::min(pixels - 1, floor_to_int(middle + half - 0.5F));
  };
  discs_.push_back({.p_m = {p.x(), p.y(), p.z()},
                    .normal = {normal.x(), normal.y(), normal.z()},
                    .along_m = normal.dot(p),
                    .radius2_m2 = radius_m * radius_m,
                    .u0 = first(u),
                    .u1 = last(u, width_),
                    .v0 = first(v),
                    .v1 = last(v, height_)});
}

bool PatchViewer::is_before(const Vec3f& p, float cos_incidence, float bias_m) const {
  const int x = static_cast<int>(fx_ * p.x() / p.z() + cx_);
  const int y = static_cast<int>(fy_ * p.y() / p.z() + cy_);
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return false;
  const float half_pixel = 0.5F / fx_;
  return p.z() <= depth_m_[static_cast<std::size_t>(y * width_ + x)] + bias_m +
                      half_pixel * p.z() / cos_incidence;
}

void PatchViewer::draw_cell(const TourScene& scene, const CellBlocks::Block& block,
                            const CellBlocks::Cell& cell) {
  const auto cell_m = static_cast<float>(scene.cells.edge_m());
  const Vec3f middle = to_camera(cell.middle_m);
  if (!is_in_image(middle, slant() * 0.9F * cell_m)) return;
  in_image_.push_back(cell.index);
  const bool has_plane = !cell.normal.isZero();
  const Vec3f normal = R_camera_world_ * cell.normal;
  const bool is_small = cell_m * fx_ < kSmallCell_px * middle.z();
  if (is_small && has_plane && cell.discs >= kWholeDiscs) {
    draw(middle, normal, kCellRadius * cell_m);
    return;
  }
  const float radius_m = kDiscRadius * static_cast<float>(scene.cells.detail_m());
  for (std::uint32_t i = 0; i < cell.discs; ++i) {
    const Vec3f p = to_camera(block.discs_m[cell.first_disc + i]);
    if (!is_in_image(p, radius_m)) continue;
    draw(p, has_plane ? normal : Vec3f(-p.normalized()), radius_m);
  }
}

void PatchViewer::observe(const TourScene& scene, const CameraModel& camera,
                          const Isometry& T_world_body,
                          std::span<const CellBlocks::Block* const> blocks, float block_radius_m,
                          std::vector<SeenPatch>& seen) {
  begin(camera, T_world_body * camera.T_body_camera);
  in_image_.clear();
  discs_.clear();
  for (const CellBlocks::Block* block : blocks) {
    const Vec3f middle = to_camera(block->center_m);
    const bool is_in_reach =
        middle.z() >= -block_radius_m && middle.z() <= range_max_m_ + block_radius_m;
    if (!is_in_reach || !is_in_cone(middle, slant() * block_radius_m)) continue;
    for (const CellBlocks::Cell& cell : block->cells) draw_cell(scene, *block, cell);
  }
  disc_kernels().draw(discs_.data(), discs_.size(),
                      {ray_x_.data(), ray_y_.data(), depth_m_.data(), width_});
  const auto range_min_m = static_cast<float>(camera.config.range_min_m);
  const auto cos_min = static_cast<float>(std::cos(scene.config.incidence_max_rad));
  const float bias_m = kBias * static_cast<float>(scene.cells.detail_m());
  for (const std::uint32_t index : in_image_) {
    for (std::uint32_t side = 0; side < 2; ++side) {
      const PatchId id = 2 * index + side;
      const Patch& patch = scene.patches[id];
      if (patch.missing <= 0.0F) continue;
      const Vec3f p = to_camera(patch.target_m);
      if (!is_in_image(p, 0.0F)) continue;
      if (camera.lens && !camera.lens->sees(p.cast<double>())) continue;
      const float range_m = camera.is_radial() ? p.norm() : p.z();
      if (range_m < range_min_m || range_m > range_max_m_) continue;
      const float cosine = patch.normal.dot(origin_world_m_ - patch.target_m) / p.norm();
      if (cosine < cos_min || !is_before(p, cosine, bias_m)) continue;
      const double share = certainty(camera, p.z(), SurfaceCells::kNear * scene.cells.detail_m());
      seen.push_back({id, static_cast<std::uint8_t>(incidence_bin(cosine)), certainty_bin(share)});
    }
  }
}

}  // namespace gnbv
