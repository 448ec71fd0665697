#include "bench/score/sized_coverage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/score/coverage_curve.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

std::vector<Vec3f> scaled(std::span<const Vec3f> points_m, double factor) {
  std::vector<Vec3f> out;
  out.reserve(points_m.size());
  for (const Vec3f& p_m : points_m) out.push_back((factor * p_m.cast<double>()).cast<float>());
  return out;
}

}  // namespace

std::string size_name(double size_m) {
  std::string name = fmt::format("{}", size_m);
  const std::size_t point = name.find('.');
  return point == std::string::npos || name.size() < point + 3 ? fmt::format("{:.2f}", size_m)
                                                               : name;
}

std::optional<std::size_t> papers_size(double size_m) {
  const auto* const at = std::find(kCoverageSizes_m.begin(), kCoverageSizes_m.end(), size_m);
  if (at == kCoverageSizes_m.end()) return std::nullopt;
  return static_cast<std::size_t>(at - kCoverageSizes_m.begin());
}

void need_room_for(std::span<const double> sizes_m, const TriangleMesh& structure) {
  const double area_m2 = surface_area_m2(structure);
  for (const double size_m : sizes_m) {
    const double spacing_m = ReferenceConfig{}.sample_spacing_m * size_m / kCoverageSizes_m[0];
    const double samples = area_m2 / (spacing_m * spacing_m);
    if (samples <= kMostSamples || papers_size(size_m)) continue;
    const double fits_m = std::ceil(1e3 * size_m * std::sqrt(samples / kMostSamples)) / 1e3;
    throw BadInput(
        "score.sizes_m or --resolution {}: {:.0f} m2 of surface take {:.0f} million samples at "
        "voxels of that size, of which there is memory for {:.0f}: {} m fits",
        size_m, area_m2, 1e-6 * samples, 1e-6 * kMostSamples, fits_m);
  }
}

SizedShares sized_shares(const World& world, double size_m, const ReferenceConfig& config,
                         std::span<const Vec3f> cloud_world_m,
                         std::span<const std::size_t> prefixes, int threads,
                         std::span<const double> distances_m) {
  const double factor = kCoverageSizes_m[0] / size_m;
  World small = world;
  for (TriangleMesh* mesh : {&small.structure, &small.obstacles, &small.terrain}) {
    mesh->vertices_m = scaled(mesh->vertices_m, factor);
  }
  small.terrain_floor_z_m *= factor;
  ReferenceConfig scaled_config = config;
  scaled_config.floor_z_m *= factor;
  scaled_config.obstacle_reach_m *= factor;
  scaled_config.region_m = Box3(factor * config.region_m.min(), factor * config.region_m.max());
  const SurfaceReference reference =
      cached_surface_reference(small, RayScene(small), scaled_config, threads);
  const double reach_m = std::min(factor * kCoverReach_m, 0.1 * kCoverageSizes_m[0]);
  std::vector<double> scaled_m(distances_m.begin(), distances_m.end());
  for (double& distance_m : scaled_m) distance_m *= factor;
  SizedShares out;
  for (const CoverageShares& shares : coverage_of_prefixes(reference, scaled(cloud_world_m, factor),
                                                           prefixes, threads, scaled_m, reach_m)) {
    out.raw.push_back(shares.raw[0]);
    out.accurate.push_back(shares.accurate[0]);
    out.counted.push_back(shares.counted[0]);
  }
  return out;
}

}  // namespace gnbv
