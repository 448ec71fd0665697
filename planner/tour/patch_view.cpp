#include "planner/tour/patch_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnbv {
namespace {

constexpr double kPixel_rad = deg_to_rad(0.6);
// of a disc, in the edge of a small voxel: 0.9 of the discs' spacing leaves no holes (this and the
// bias: facts/tour.md, section 1, splats of 0.09 m with a bias of 0.08 m for a spacing of 0.1 m)
constexpr float kDiscRadius = 1.8F;
// what lies no deeper behind a disc is the disc's own surface
constexpr float kBias = 1.6F;
// from where on a cell of fewer pixels is drawn as one disc: half the diagonal of its square
constexpr float kSmallCell_px = 4.0F;
constexpr float kCellRadius = 0.71F;      // in the edge of a cell
constexpr std::uint32_t kWholeDiscs = 3;  // so many at least, or most of the cell is empty
constexpr float kNoDepth = std::numeric_limits<float>::infinity();

}  // namespace

double camera_reach_m(const CameraModel& camera) {
  const CameraConfig& c = camera.config;
  const double across = std::hypot(std::tan(0.5 * c.fov_x_rad), std::tan(0.5 * c.fov_y_rad));
  return c.range_max_m * std::sqrt(1.0 + across * across) + c.p_body_m.norm();
}

void PatchViewer::begin(const CameraModel& camera, const Isometry& T_world_camera) {
  const CameraConfig& c = camera.config;
  const double half_x = std::tan(0.5 * c.fov_x_rad);
  const double half_y = std::tan(0.5 * c.fov_y_rad);
  image_.width = static_cast<int>(std::ceil(2.0 * half_x / kPixel_rad));
  image_.height = static_cast<int>(std::ceil(2.0 * half_y / kPixel_rad));
  image_.cx = 0.5F * static_cast<float>(image_.width);
  image_.cy = 0.5F * static_cast<float>(image_.height);
  image_.fx = image_.cx / static_cast<float>(half_x);
  image_.fy = image_.cy / static_cast<float>(half_y);
  image_.R_camera_world = T_world_camera.linear().transpose().cast<float>();
  image_.origin_m = T_world_camera.translation().cast<float>();
  image_.range_max_m = static_cast<float>(c.range_max_m);
  depth_m_.assign(static_cast<std::size_t>(image_.width * image_.height), kNoDepth);
  ray_x_.resize(static_cast<std::size_t>(image_.width));
  ray_y_.resize(static_cast<std::size_t>(image_.height));
  for (std::size_t x = 0; x < ray_x_.size(); ++x) {
    ray_x_[x] = (static_cast<float>(x) + 0.5F - image_.cx) / image_.fx;
  }
  for (std::size_t y = 0; y < ray_y_.size(); ++y) {
    ray_y_[y] = (static_cast<float>(y) + 0.5F - image_.cy) / image_.fy;
  }
}

/// The ray through a pixel is t (ray_x, ray_y, 1) in the camera's frame. It meets the disc's plane,
/// the points q with normal . q = normal . p, at the depth t = normal . p / normal . (ray_x, ray_y,
/// 1); the pixel is covered where that point lies within the radius of p. Only pixels in the square
/// about the disc's middle are asked.
void PatchViewer::draw(const Vec3f& p, const Vec3f& normal, float radius_m) {
  const float along = normal.dot(p);
  const float u = image_.fx * p.x() / p.z() + image_.cx;
  const float v = image_.fy * p.y() / p.z() + image_.cy;
  const float half = image_.fx * radius_m / p.z();
  const int u0 = std::max(0, static_cast<int>(std::ceil(u - half - 0.5F)));
  const int u1 = std::min(image_.width - 1, static_cast<int>(std::floor(u + half - 0.5F)));
  const int v0 = std::max(0, static_cast<int>(std::ceil(v - half - 0.5F)));
  const int v1 = std::min(image_.height - 1, static_cast<int>(std::floor(v + half - 0.5F)));
  for (int y = v0; y <= v1; ++y) {
    const float ray_y = ray_y_[static_cast<std::size_t>(y)];
    const float across_row = normal.y() * ray_y + normal.z();
    float* const row_m = &depth_m_[static_cast<std::size_t>(y * image_.width)];
    for (int x = u0; x <= u1; ++x) {
      const float ray_x = ray_x_[static_cast<std::size_t>(x)];
      const float across = normal.x() * ray_x + across_row;
      if (std::fabs(across) < 1e-3F) continue;
      const float z_m = along / across;
      const Vec3f off_m(z_m * ray_x - p.x(), z_m * ray_y - p.y(), z_m - p.z());
      if (!(off_m.squaredNorm() <= radius_m * radius_m)) continue;
      row_m[x] = std::min(row_m[x], z_m);
    }
  }
}

bool PatchViewer::is_before(const Vec3f& p, float cos_incidence, float bias_m) const {
  const int x = static_cast<int>(image_.fx * p.x() / p.z() + image_.cx);
  const int y = static_cast<int>(image_.fy * p.y() / p.z() + image_.cy);
  if (x < 0 || y < 0 || x >= image_.width || y >= image_.height) return false;
  const float half_pixel = 0.5F / image_.fx;
  return p.z() <= depth_m_[static_cast<std::size_t>(y * image_.width + x)] + bias_m +
                      half_pixel * p.z() / cos_incidence;
}

bool PatchViewer::is_in_image(const Vec3f& p, float margin_m) const {
  return p.z() > 0.05F && p.z() <= image_.range_max_m + margin_m && is_in_cone(p, margin_m);
}

bool PatchViewer::is_in_cone(const Vec3f& p, float margin_m) const {
  return std::fabs(p.x()) <= image_.cx / image_.fx * p.z() + margin_m &&
         std::fabs(p.y()) <= image_.cy / image_.fy * p.z() + margin_m;
}

void PatchViewer::draw_cell(const TourScene& scene, const CellBlocks::Block& block,
                            const CellBlocks::Cell& cell) {
  const auto cell_m = static_cast<float>(scene.cells.edge_m());
  const Vec3f middle = to_camera(cell.middle_m);
  if (!is_in_image(middle, slant() * 0.9F * cell_m)) return;
  in_image_.push_back(cell.index);
  const bool has_plane = !cell.normal.isZero();
  const Vec3f normal = image_.R_camera_world * cell.normal;
  const bool is_small = cell_m * image_.fx < kSmallCell_px * middle.z();
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
  for (const CellBlocks::Block* block : blocks) {
    const Vec3f middle = to_camera(block->center_m);
    const bool is_in_reach =
        middle.z() >= -block_radius_m && middle.z() <= image_.range_max_m + block_radius_m;
    if (!is_in_reach || !is_in_cone(middle, slant() * block_radius_m)) continue;
    for (const CellBlocks::Cell& cell : block->cells) draw_cell(scene, *block, cell);
  }
  const auto range_min_m = static_cast<float>(camera.config.range_min_m);
  const auto cos_min = static_cast<float>(std::cos(scene.config.incidence_max_rad));
  const float bias_m = kBias * static_cast<float>(scene.cells.detail_m());
  for (const std::uint32_t index : in_image_) {
    for (std::uint32_t side = 0; side < 2; ++side) {
      const PatchId id = 2 * index + side;
      const Patch& patch = scene.patches[id];
      if (patch.missing <= 0.0F) continue;
      const Vec3f p = to_camera(patch.target_m);
      if (!is_in_image(p, 0.0F) || p.z() < range_min_m) continue;
      const float cosine = patch.normal.dot(image_.origin_m - patch.target_m) / p.norm();
      if (cosine < cos_min || !is_before(p, cosine, bias_m)) continue;
      seen.push_back({id, static_cast<std::uint8_t>(incidence_bin(cosine))});
    }
  }
}

}  // namespace gnbv
