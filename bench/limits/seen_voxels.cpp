#include "bench/limits/seen_voxels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

constexpr double kBlock_m = kCoverageSizes_m[2];  // work is shared out by cubes of this size
constexpr std::size_t kSamplesAsked = 4;          // of a voxel
// a sight line ends this share of its length before the sample, which lies on the surface
constexpr float kSightEnd = 0.9999F;

/// The samples that are asked, voxel by voxel. Voxel v: [first[v], first[v + 1]).
struct Block {
  std::vector<std::uint64_t> codes;
  std::vector<Vec3f> samples_world_m;
  std::vector<std::size_t> first;
};

/// Samples of a slab of blocks along x, in blocks.
std::vector<Block> blocks_of(const TriangleMesh& mesh, const ReferenceConfig& config,
                             double x_min_m) {
  std::vector<SurfaceSample> samples;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    Eigen::AlignedBox3f face;
    for (const std::uint32_t v : mesh.faces[f]) face.extend(mesh.vertices_m[v]);
    if (static_cast<double>(face.max().z()) < config.floor_z_m ||
        static_cast<double>(face.max().x()) < x_min_m ||
        static_cast<double>(face.min().x()) >= x_min_m + kBlock_m) {
      continue;
    }
    sample_face(mesh, f, config.sample_spacing_m, x_min_m, x_min_m + kBlock_m, samples);
  }
  std::erase_if(samples, [&](const SurfaceSample& s) {
    return static_cast<double>(s.p_world_m.z()) < config.floor_z_m;
  });
  std::vector<std::array<std::uint64_t, 3>> order;  // block, voxel, sample
  order.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Vec3f& p = samples[i].p_world_m;
    order.push_back({voxel_code(p, kBlock_m), voxel_code(p, kCoverageSizes_m[0]), i});
  }
  std::sort(order.begin(), order.end());

  std::vector<Block> blocks;
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin;
    while (end < order.size() && order[end][1] == order[begin][1]) ++end;
    if (begin == 0 || order[begin][0] != order[begin - 1][0]) blocks.emplace_back();
    Block& block = blocks.back();
    block.codes.push_back(order[begin][1]);
    block.first.push_back(block.samples_world_m.size());
    const std::size_t count = std::min(end - begin, kSamplesAsked);
    for (std::size_t k = 0; k < count; ++k) {  // the middles of `count` equal parts
      const std::size_t at = begin + (2 * k + 1) * (end - begin) / (2 * count);
      block.samples_world_m.push_back(samples[order[at][2]].p_world_m);
    }
    begin = end;
  }
  for (Block& block : blocks) block.first.push_back(block.samples_world_m.size());
  return blocks;
}

class SightSearch {
 public:
  SightSearch(const RayScene& scene, std::span<const CameraModel> cameras,
              std::span<const Vec3> positions_world_m)
      : scene_(scene), positions_m_(positions_world_m) {
    for (const CameraModel& camera : cameras) cameras_.emplace_back(camera);
    for (const FreeYawCamera& camera : cameras_) reach_m_ = std::max(reach_m_, camera.reach_m());
  }

  /// The voxels of the block that are seen.
  VoxelSet seen(const Block& block) const {
    std::vector<std::uint8_t> is_seen(block.codes.size(), 0);
    std::vector<std::size_t> open(block.codes.size());
    std::iota(open.begin(), open.end(), std::size_t{0});
    for (const std::size_t position : positions_near(block)) {
      if (open.empty()) break;
      look(positions_m_[position], block, open, is_seen);
      std::erase_if(open, [&](std::size_t v) { return is_seen[v] != 0; });
    }
    VoxelSet seen;
    for (std::size_t v = 0; v < is_seen.size(); ++v) {
      if (is_seen[v] != 0) seen.push_back(block.codes[v]);
    }
    return seen;
  }

 private:
  /// Shuffled, so that the first few look from all sides: most voxels are settled by them.
  std::vector<std::size_t> positions_near(const Block& block) const {
    Eigen::AlignedBox3d box_m;
    for (const Vec3f& p : block.samples_world_m) box_m.extend(p.cast<double>());
    std::vector<std::size_t> near;
    for (std::size_t i = 0; i < positions_m_.size(); ++i) {
      if (box_m.squaredExteriorDistance(positions_m_[i]) <= reach_m_ * reach_m_) near.push_back(i);
    }
    std::sort(near.begin(), near.end(),
              [](std::size_t a, std::size_t b) { return mix_bits(a) < mix_bits(b); });
    return near;
  }

  /// Asks every open voxel's samples from one position, by all cameras.
  void look(const Vec3& position_m, const Block& block, std::span<const std::size_t> open,
            std::vector<std::uint8_t>& is_seen) const {
    std::vector<Vec3f> origins, directions;
    std::vector<std::size_t> voxel;
    for (const FreeYawCamera& camera : cameras_) {
      for (const std::size_t v : open) {
        for (std::size_t i = block.first[v]; i < block.first[v + 1]; ++i) {
          const Vec3 sample_m = block.samples_world_m[i].cast<double>();
          const auto origin_m = camera.origin_world_m(position_m, sample_m);
          if (!origin_m) continue;
          origins.push_back(origin_m->cast<float>());
          directions.emplace_back((sample_m - *origin_m).cast<float>());
          voxel.push_back(v);
        }
      }
    }
    std::vector<RayHit> hits(voxel.size());
    scene_.first_hits(origins, directions, 0.0F, kSightEnd, hits);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      if (hits[i].face == kNoFace) is_seen[voxel[i]] = 1;
    }
  }

  const RayScene& scene_;
  std::span<const Vec3> positions_m_;
  std::vector<FreeYawCamera> cameras_;
  double reach_m_ = 0.0;
};

}  // namespace

FreeYawCamera::FreeYawCamera(const CameraModel& camera)
    : tan_x_(std::tan(0.5 * camera.config.fov_x_rad)),
      tan_y_(std::tan(0.5 * camera.config.fov_y_rad)),
      range_min_m_(camera.config.range_min_m),
      range_max_m_(camera.config.range_max_m),
      reach_m_(range_max_m_ * std::sqrt(1.0 + tan_x_ * tan_x_ + tan_y_ * tan_y_) +
               camera.config.p_body_m.norm()),
      p_body_m_(camera.config.p_body_m) {
  const Isometry T_camera_body = camera.T_body_camera.inverse();
  offset_camera_m_ = T_camera_body.translation();
  // seen by a tilted camera, bearings outside its field of view are in the image, too
  const double half_rad = 0.5 * camera.config.fov_x_rad;
  const double last_share = camera.config.pitch_rad == 0.0 ? 1.0 : kPi / half_rad;
  const Vec3 aside = Eigen::AngleAxisd(camera.config.yaw_rad, Vec3::UnitZ()) * Vec3::UnitY();
  const bool is_symmetric = camera.config.roll_rad == 0.0 && std::abs(aside.dot(p_body_m_)) < 1e-9;
  for (const double share : {0.0, 0.5, 0.8, 0.99, 1.1, 1.25, 1.5, 2.0, 3.0, 4.0}) {
    if (share > last_share) break;
    for (const double side : {1.0, -1.0}) {
      if (side < 0.0 && (is_symmetric || share == 0.0)) continue;
      const double rad = camera.config.yaw_rad + side * share * half_rad;
      bearings_.push_back({rad, T_camera_body.linear() * Vec3(std::cos(rad), std::sin(rad), 0.0),
                           T_camera_body.linear().col(2)});
    }
  }
}

std::optional<Vec3> FreeYawCamera::origin_world_m(const Vec3& vehicle_world_m,
                                                  const Vec3& point_world_m) const {
  const Vec3 to_m = point_world_m - vehicle_world_m;
  if (to_m.squaredNorm() > reach_m_ * reach_m_) return std::nullopt;
  const double level_m = std::hypot(to_m.x(), to_m.y());
  for (const Bearing& bearing : bearings_) {
    const Vec3 p = level_m * bearing.per_level + to_m.z() * bearing.per_height + offset_camera_m_;
    if (p.z() < range_min_m_ || p.z() > range_max_m_ || std::abs(p.x()) > p.z() * tan_x_ ||
        std::abs(p.y()) > p.z() * tan_y_) {
      continue;
    }
    const double yaw_rad = std::atan2(to_m.y(), to_m.x()) - bearing.rad;
    return T_world_body({vehicle_world_m, yaw_rad}) * p_body_m_;
  }
  return std::nullopt;
}

VoxelSet seen_voxels(const World& world, const RayScene& scene,
                     std::span<const CameraModel> cameras, std::span<const Vec3> positions_world_m,
                     const ReferenceConfig& config, int threads) {
  GNBV_CHECK(config.sample_spacing_m > 0.0, "sample spacing {} m", config.sample_spacing_m);
  const Box3 box_m = bounds_m(world.structure);
  if (box_m.isEmpty()) return {};
  const SightSearch search(scene, cameras, positions_world_m);
  const auto first = static_cast<std::int64_t>(std::floor(box_m.min().x() / kBlock_m));
  const auto last = static_cast<std::int64_t>(std::floor(box_m.max().x() / kBlock_m));
  std::vector<VoxelSet> parts(static_cast<std::size_t>(last - first + 1));
  parallel_for(threads, parts.size(), [&](std::size_t slab) {
    const double x_min_m = static_cast<double>(first + static_cast<std::int64_t>(slab)) * kBlock_m;
    for (const Block& block : blocks_of(world.structure, config, x_min_m)) {
      const VoxelSet seen = search.seen(block);
      parts[slab].insert(parts[slab].end(), seen.begin(), seen.end());
    }
  });
  VoxelSet all;
  for (const VoxelSet& part : parts) all.insert(all.end(), part.begin(), part.end());
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace gnbv
