#include "bench/score/surface_reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "bench/score/surface_pieces.hpp"
#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

// Unit normals, tilted by two degrees: built structures have edges straight opposite each other,
// and a ray should not aim at one.
std::vector<Vec3f> tilted_normals(const TriangleMesh& mesh) {
  const Vec3 tilt(0.0271, -0.0113, 0.0193);
  std::vector<Vec3f> normals;
  normals.reserve(mesh.faces.size());
  for (const auto& face : mesh.faces) {
    const Vec3 a = mesh.vertices_m[face[0]].cast<double>();
    const Vec3 b = mesh.vertices_m[face[1]].cast<double>();
    const Vec3 c = mesh.vertices_m[face[2]].cast<double>();
    const Vec3 cross = (b - a).cross(c - a);
    const Vec3 normal = cross.norm() > 0.0 ? Vec3(cross.normalized()) : Vec3::UnitZ();
    normals.push_back((normal + tilt).normalized().cast<float>());
  }
  return normals;
}

class EscapeSearch {
 public:
  EscapeSearch(const TriangleMesh& mesh, const RayScene& scene, const ReferenceConfig& config)
      : scene_(scene),
        near_m_(static_cast<float>(config.escape_near_m)),
        obstacle_reach_m_(static_cast<float>(config.obstacle_reach_m)),
        normals_(tilted_normals(mesh)),
        directions_(spread_directions(config.directions)) {}

  /// 1 for each sample that sees out.
  std::vector<std::uint8_t> ask(std::span<const SurfaceSample> samples) const {
    std::vector<std::uint8_t> sees_out(samples.size(), 0);
    std::vector<std::uint32_t> lines(samples.size(), 0);  // that leave the structure
    std::vector<std::size_t> open(samples.size());        // what is not decided
    std::iota(open.begin(), open.end(), std::size_t{0});
    leave_out_buried(samples, open);
    const auto ask = [&](std::uint32_t needed, std::size_t left, const auto& direction_of) {
      count_lines(samples, open, direction_of, lines);
      std::erase_if(open, [&](std::size_t i) {
        sees_out[i] = lines[i] >= needed ? 1 : 0;
        return lines[i] >= needed || lines[i] + left < needed;
      });
    };
    for (const float side : {1.0F, -1.0F}) {  // most surface is decided by these
      ask(1, 1, [&](std::size_t i) -> Vec3f { return side * normals_[samples[i].face]; });
    }
    // one direction at a time for all that is left: neighbours in space with equal directions trace
    // fast
    const auto needed = static_cast<std::uint32_t>(
        std::ceil(kLeastOpenShare * static_cast<double>(directions_.size())));
    for (std::size_t d = 0; d < directions_.size(); ++d) {
      ask(needed, directions_.size() - d - 1, [&](std::size_t) -> Vec3f { return directions_[d]; });
    }
    return sees_out;
  }

 private:
  /// Of the samples those under the terrain.
  void leave_out_buried(std::span<const SurfaceSample> samples,
                        std::vector<std::size_t>& open) const {
    if (!scene_.has_terrain()) return;
    std::vector<Vec3f> origins;
    for (const SurfaceSample& sample : samples) origins.push_back(sample.p_world_m);
    const std::vector<Vec3f> up(samples.size(), Vec3f::UnitZ());
    std::vector<std::uint8_t> is_buried(samples.size());
    scene_.terrain_blocks(origins, up, near_m_, kEndless, is_buried);
    std::erase_if(open, [&](std::size_t i) { return is_buried[i] != 0; });
  }

  /// Ends the lines that an obstacle meets. They begin a little before their sample, so that one
  /// that touches it does.
  void end_at_obstacles(std::vector<Vec3f> origins, std::span<const Vec3f> directions,
                        std::vector<std::uint8_t>& blocked) const {
    if (!scene_.has_obstacles()) return;
    for (std::size_t k = 0; k < origins.size(); ++k) origins[k] -= near_m_ * directions[k];
    std::vector<std::uint8_t> by_obstacle(blocked.size());
    scene_.obstacles_block(origins, directions, 0.0F, obstacle_reach_m_, by_obstacle);
    for (std::size_t k = 0; k < blocked.size(); ++k) blocked[k] |= by_obstacle[k];
  }

  /// Adds one to `lines` of each of the samples that a line leaves from.
  template <typename Direction>
  void count_lines(std::span<const SurfaceSample> samples, std::span<const std::size_t> of,
                   const Direction& direction_of, std::vector<std::uint32_t>& lines) const {
    std::vector<Vec3f> origins, directions;
    origins.reserve(of.size());
    directions.reserve(of.size());
    for (const std::size_t i : of) {
      origins.push_back(samples[i].p_world_m);
      directions.push_back(direction_of(i));
    }
    std::vector<std::uint8_t> blocked(of.size());
    scene_.structure_blocks(origins, directions, near_m_, kEndless, blocked);
    end_at_obstacles(std::move(origins), directions, blocked);
    for (std::size_t k = 0; k < of.size(); ++k) lines[of[k]] += blocked[k] == 0 ? 1 : 0;
  }

  const RayScene& scene_;
  float near_m_;
  float obstacle_reach_m_;
  std::vector<Vec3f> normals_;
  std::vector<Vec3f> directions_;
};

void check(const ReferenceConfig& config) {
  GNBV_CHECK(config.sample_spacing_m > 0.0, "sample spacing {} m", config.sample_spacing_m);
  GNBV_CHECK(config.directions >= 1, "{} directions", config.directions);
  GNBV_CHECK(config.escape_near_m >= 0.0, "escape distance {} m", config.escape_near_m);
  GNBV_CHECK(config.obstacle_reach_m > 0.0, "reach of obstacles {} m", config.obstacle_reach_m);
}

/// A sample that sees out.
struct OutsideSample {
  Vec3f p_world_m;
  double area_m2;  // that it stands for
};

/// What a voxel of the finest size holds.
struct VoxelSurface {
  std::uint64_t code = 0;
  double area_m2 = 0.0;
  double outside_m2 = 0.0;
  Vec3f point_world_m = Vec3f::Zero();  // of those that see out the nearest to the centre
  float from_centre_m2 = std::numeric_limits<float>::infinity();
};

/// The samples of the pieces of a slab.
struct SlabSamples {
  struct Piece {
    std::uint64_t voxel = 0;
    double area_m2 = 0.0;
    std::size_t first = 0;  // its samples are [first, first + count)
    std::size_t count = 0;
  };
  std::vector<Piece> pieces;
  std::vector<SurfaceSample> samples;
};

SlabSamples slab_samples(const TriangleMesh& mesh, const Slabs& slabs, std::size_t index,
                         double floor_z_m, double spacing_m) {
  SlabSamples slab;
  for (const std::uint32_t face : slabs.faces[index]) {
    for_each_piece(mesh, face, slabs.slab(index), floor_z_m, [&](const SurfacePiece& piece) {
      const std::size_t count = points_on(piece, spacing_m);
      slab.pieces.push_back({piece.voxel, piece.area_m2, slab.samples.size(), count});
      for (std::size_t k = 0; k < count; ++k) slab.samples.push_back({point_on(piece, k), face});
    });
  }
  return slab;
}

/// Both in the order of the voxels' codes, which is that of the slabs. Sums run in this order, too.
struct SlabSurface {
  std::vector<VoxelSurface> voxels;
  std::vector<OutsideSample> samples;
};

SlabSurface slab_surface(SlabSamples slab, const EscapeSearch& search) {
  const std::vector<std::uint8_t> sees_out = search.ask(slab.samples);
  std::stable_sort(slab.pieces.begin(), slab.pieces.end(),
                   [](const auto& a, const auto& b) { return a.voxel < b.voxel; });
  SlabSurface out;
  for (const SlabSamples::Piece& piece : slab.pieces) {
    if (out.voxels.empty() || out.voxels.back().code != piece.voxel) {
      out.voxels.push_back({piece.voxel});
    }
    VoxelSurface& voxel = out.voxels.back();
    voxel.area_m2 += piece.area_m2;
    const Vec3f centre_m = voxel_centre_m(piece.voxel, kCoverageSizes_m[0]).cast<float>();
    const double area_m2 = piece.area_m2 / static_cast<double>(piece.count);
    for (std::size_t i = piece.first; i < piece.first + piece.count; ++i) {
      if (sees_out[i] == 0) continue;
      const Vec3f& p_m = slab.samples[i].p_world_m;
      voxel.outside_m2 += area_m2;
      out.samples.push_back({p_m, area_m2});
      const float from_centre_m2 = (p_m - centre_m).squaredNorm();
      if (from_centre_m2 >= voxel.from_centre_m2) continue;
      voxel.from_centre_m2 = from_centre_m2;
      voxel.point_world_m = p_m;
    }
  }
  return out;
}

/// `count` of them, one wherever the area that was passed by grows by a count-th of all: the
/// samples' order runs through space, so that these lie as evenly as they do.
std::vector<Vec3f> of_equal_areas(std::span<const SlabSurface> slabs, std::size_t count) {
  double all_m2 = 0.0;
  std::size_t samples = 0;
  for (const SlabSurface& slab : slabs) {
    for (const OutsideSample& sample : slab.samples) all_m2 += sample.area_m2;
    samples += slab.samples.size();
  }
  count = std::min(count, samples);
  std::vector<Vec3f> out;
  double passed_m2 = 0.0;
  for (const SlabSurface& slab : slabs) {
    for (const OutsideSample& sample : slab.samples) {
      passed_m2 += sample.area_m2;
      const double due = passed_m2 / all_m2 * static_cast<double>(count);
      while (static_cast<double>(out.size()) + 0.5 <= due) out.push_back(sample.p_world_m);
    }
  }
  return out;
}

/// So close that `fewest_samples` are about reached.
double spacing_for(const TriangleMesh& mesh, const ReferenceConfig& config) {
  const double area_m2 = surface_area_m2(mesh);
  const double few = static_cast<double>(config.fewest_samples);
  return area_m2 > 0.0 && few > 0.0 ? std::min(config.sample_spacing_m, std::sqrt(area_m2 / few))
                                    : config.sample_spacing_m;
}

/// Leaves the voxels that lie in the region.
void restrict_to(const Box3& region_m, SurfaceReference& reference) {
  const auto is_outside = [&](const Vec3& p_m) { return !region_m.contains(p_m); };
  const VoxelSet finest = reference.outside[0];
  std::size_t i = 0;  // points_world_m are in the order of the finest voxels
  std::erase_if(reference.points_world_m, [&](const Vec3f&) {
    return is_outside(voxel_centre_m(finest[i++], kCoverageSizes_m[0]));
  });
  for (auto* const sizes : {&reference.raw, &reference.outside}) {
    for (std::size_t size = 0; size < kCoverageSizes_m.size(); ++size) {
      std::erase_if((*sizes)[size], [&](std::uint64_t code) {
        return is_outside(voxel_centre_m(code, kCoverageSizes_m[size]));
      });
    }
  }
}

/// The voxels of one size that have surface enough.
VoxelSet rich_voxels(std::span<const VoxelSurface> finest, std::size_t size,
                     double VoxelSurface::*area_m2) {
  constexpr double kRounding = 1.0 - 1e-9;
  const double least_m2 =
      kRounding * kLeastFaceShare * kCoverageSizes_m[size] * kCoverageSizes_m[size];
  std::vector<std::pair<std::uint64_t, double>> areas_m2;
  areas_m2.reserve(finest.size());
  for (const VoxelSurface& voxel : finest) {
    areas_m2.emplace_back(coarser_code(voxel.code, kCoverageFactors[size]), voxel.*area_m2);
  }
  std::stable_sort(areas_m2.begin(), areas_m2.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  VoxelSet rich;
  for (std::size_t begin = 0, end = 0; begin < areas_m2.size(); begin = end) {
    double sum_m2 = 0.0;
    for (; end < areas_m2.size() && areas_m2[end].first == areas_m2[begin].first; ++end) {
      sum_m2 += areas_m2[end].second;
    }
    if (sum_m2 >= least_m2) rich.push_back(areas_m2[begin].first);
  }
  return rich;
}

}  // namespace

// A Fibonacci sphere, taken in steps of about the golden ratio of its length, so that the first few
// directions already spread over the sphere.
std::vector<Vec3f> spread_directions(int count) {
  const double golden_rad = kPi * (3.0 - std::sqrt(5.0));
  int stride = std::max(1, static_cast<int>(std::lround(0.618 * count)));
  while (std::gcd(stride, count) != 1) ++stride;
  std::vector<Vec3f> directions;
  for (int k = 0; k < count; ++k) {
    const auto i = static_cast<double>(static_cast<std::int64_t>(k) * stride % count);
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double r = std::sqrt(1.0 - z * z);
    directions.push_back(
        Vec3(r * std::cos(golden_rad * i), r * std::sin(golden_rad * i), z).cast<float>());
  }
  return directions;
}

SurfaceReference make_surface_reference(const World& world, const RayScene& scene,
                                        const ReferenceConfig& config, int threads) {
  check(config);
  const EscapeSearch search(world.structure, scene, config);
  const Slabs slabs = make_slabs(world.structure, config.floor_z_m);
  const double spacing_m = spacing_for(world.structure, config);
  std::vector<SlabSurface> parts(slabs.faces.size());
  parallel_for(threads, parts.size(), [&](std::size_t slab) {
    parts[slab] = slab_surface(
        slab_samples(world.structure, slabs, slab, config.floor_z_m, spacing_m), search);
  });
  std::vector<VoxelSurface> all;
  for (const SlabSurface& part : parts) {
    all.insert(all.end(), part.voxels.begin(), part.voxels.end());
  }

  SurfaceReference reference;
  for (std::size_t size = 0; size < kCoverageSizes_m.size(); ++size) {
    reference.raw[size] = rich_voxels(all, size, &VoxelSurface::area_m2);
    reference.outside[size] = rich_voxels(all, size, &VoxelSurface::outside_m2);
  }
  auto voxel = all.begin();
  for (const std::uint64_t code : reference.outside[0]) {
    while (voxel->code != code) ++voxel;
    reference.points_world_m.push_back(voxel->point_world_m);
  }
  for (SlabSurface& part : parts) {
    std::erase_if(part.samples, [&](const OutsideSample& sample) {
      return !config.region_m.contains(sample.p_world_m.cast<double>());
    });
  }
  reference.samples_world_m = of_equal_areas(parts, kAreaSamples);
  restrict_to(config.region_m, reference);
  return reference;
}

std::vector<std::uint8_t> samples_seeing_out(const World& world, const RayScene& scene,
                                             std::span<const SurfaceSample> samples,
                                             const ReferenceConfig& config, int threads) {
  check(config);
  constexpr std::size_t kChunk = 16384;
  const EscapeSearch search(world.structure, scene, config);
  std::vector<std::uint8_t> seen(samples.size(), 0);
  parallel_for_chunks(threads, samples.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    const std::vector<std::uint8_t> part = search.ask(samples.subspan(begin, end - begin));
    std::copy(part.begin(), part.end(), seen.begin() + static_cast<std::ptrdiff_t>(begin));
  });
  return seen;
}

std::array<double, 3> coverage_at_all_sizes(const std::array<VoxelSet, 3>& reference,
                                            std::span<const Vec3f> points_world_m) {
  const std::array<VoxelSet, 3> cloud =
      at_all_sizes(voxels_of(points_world_m, kCoverageSizes_m[0]));
  std::array<double, 3> shares{};
  for (std::size_t i = 0; i < shares.size(); ++i) shares[i] = coverage(reference[i], cloud[i]);
  return shares;
}

}  // namespace gnbv
