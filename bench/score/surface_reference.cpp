#include "bench/score/surface_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include "bench/score/escape_search.hpp"
#include "bench/score/surface_pieces.hpp"
#include "sim/core/parallel.hpp"
#include "sim/core/text.hpp"

namespace gnbv {
namespace {

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

/// Counts the voxels that hold one of the points.
void count_samples(std::span<const Vec3f> points_world_m, SurfaceReference& reference) {
  for (std::size_t size = 0; size < kCoverageSizes_m.size(); ++size) {
    reference.counted[size] = voxels_of(points_world_m, kCoverageSizes_m[size]);
  }
  const VoxelSet& finest = reference.counted[0];
  std::vector<float> from_centre_m2(finest.size(), std::numeric_limits<float>::infinity());
  reference.points_world_m.assign(finest.size(), Vec3f::Zero());
  for (const Vec3f& p_m : points_world_m) {
    const std::uint64_t code = voxel_code(p_m, kCoverageSizes_m[0]);
    const auto i =
        static_cast<std::size_t>(std::ranges::lower_bound(finest, code) - finest.begin());
    const Vec3f centre_m = voxel_centre_m(code, kCoverageSizes_m[0]).cast<float>();
    const float away_m2 = (p_m - centre_m).squaredNorm();
    if (away_m2 >= from_centre_m2[i]) continue;
    from_centre_m2[i] = away_m2;
    reference.points_world_m[i] = p_m;
  }
}

/// Leaves the voxels that lie in the region.
void restrict_to(const Box3& region_m, SurfaceReference& reference) {
  const auto is_outside = [&](const Vec3& p_m) { return !region_m.contains(p_m); };
  const VoxelSet finest = reference.counted[0];
  std::size_t i = 0;  // points_world_m are in the order of the finest voxels
  std::erase_if(reference.points_world_m, [&](const Vec3f&) {
    return is_outside(voxel_centre_m(finest[i++], kCoverageSizes_m[0]));
  });
  for (auto* const sizes : {&reference.raw, &reference.counted}) {
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

ReferenceCost cost_of_reference(const TriangleMesh& structure, const ReferenceConfig& config) {
  // measured on halls of many storeys, 5 to 20 thousand m2
  constexpr double kVoxelsPerFace = 1.6;    // a surface cuts more voxels than it has faces of them
  constexpr double kBytesPerSample = 60.0;  // with the tables of voxels and copies
  constexpr double kSecondsPerSample = 1.2e-6;
  const double area_m2 = surface_area_m2(structure);
  const double spacing_m = spacing_for(structure, config);
  const double samples = area_m2 / (spacing_m * spacing_m);
  return {.area_m2 = area_m2,
          .samples = samples,
          .voxels = kVoxelsPerFace * area_m2 / (kCoverageSizes_m[0] * kCoverageSizes_m[0]),
          .bytes = kBytesPerSample * samples,
          .thread_s = kSecondsPerSample * samples};
}

SurfaceReference make_surface_reference(const World& world, const RayScene& scene,
                                        const ReferenceConfig& config, int threads,
                                        const ReferenceProgress& progress) {
  const EscapeSearch search(world.structure, scene, config);
  const Slabs slabs = make_slabs(world.structure, config.floor_z_m);
  const double spacing_m = spacing_for(world.structure, config);
  std::vector<SlabSurface> parts(slabs.faces.size());
  std::mutex mutex;
  std::size_t done = 0;
  if (progress) progress(0.0);
  parallel_for(threads, parts.size(), [&](std::size_t slab) {
    parts[slab] = slab_surface(
        slab_samples(world.structure, slabs, slab, config.floor_z_m, spacing_m), search);
    const std::lock_guard lock(mutex);
    if (progress) progress(static_cast<double>(++done) / static_cast<double>(parts.size()));
  });
  std::vector<VoxelSurface> all;
  for (const SlabSurface& part : parts) {
    all.insert(all.end(), part.voxels.begin(), part.voxels.end());
  }

  SurfaceReference reference;
  reference.area_samples = config.area_samples;
  for (std::size_t size = 0; size < kCoverageSizes_m.size(); ++size) {
    reference.raw[size] = rich_voxels(all, size, &VoxelSurface::area_m2);
    reference.counted[size] = rich_voxels(all, size, &VoxelSurface::outside_m2);
  }
  auto voxel = all.begin();
  for (const std::uint64_t code : reference.counted[0]) {
    while (voxel->code != code) ++voxel;
    reference.points_world_m.push_back(voxel->point_world_m);
  }
  for (SlabSurface& part : parts) {
    std::erase_if(part.samples, [&](const OutsideSample& sample) {
      return !config.region_m.contains(sample.p_world_m.cast<double>());
    });
  }
  reference.samples_world_m = of_equal_areas(parts, kAreaSamples);
  if (config.area_samples > 0) {
    count_samples(drawn_by_area(world.structure, config.floor_z_m, config.area_samples), reference);
  }
  restrict_to(config.region_m, reference);
  return reference;
}

std::string reference_name(std::size_t area_samples) {
  return area_samples == 0 ? "outside" : "area_samples";
}

std::string reference_words(std::size_t area_samples) {
  if (area_samples == 0) return "with visible surface of a tenth of their face";
  return fmt::format("that hold one of {} points drawn by area from all surface, also inner",
                     grouped(area_samples));
}

std::array<double, 3> coverage_at_all_sizes(const std::array<VoxelSet, 3>& reference,
                                            std::span<const Vec3f> points_world_m) {
  const std::array<VoxelSet, 3> cloud = at_all_sizes(covered_voxels(points_world_m, 0));
  std::array<double, 3> shares{};
  for (std::size_t i = 0; i < shares.size(); ++i) shares[i] = coverage(reference[i], cloud[i]);
  return shares;
}

}  // namespace gnbv
