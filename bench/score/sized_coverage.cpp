#include "bench/score/sized_coverage.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/score/coverage_curve.hpp"

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

bool is_papers_size(double size_m) {
  return std::find(kCoverageSizes_m.begin(), kCoverageSizes_m.end(), size_m) !=
         kCoverageSizes_m.end();
}

SizedShares sized_shares(const World& world, double size_m, const ReferenceConfig& config,
                         std::span<const Vec3f> cloud_world_m,
                         std::span<const std::size_t> prefixes, int threads) {
  const double factor = kCoverageSizes_m[0] / size_m;
  World small = world;
  for (TriangleMesh* mesh : {&small.structure, &small.obstacles, &small.terrain}) {
    mesh->vertices_m = scaled(mesh->vertices_m, factor);
  }
  small.terrain_floor_z_m *= factor;
  ReferenceConfig scaled_config = config;
  scaled_config.floor_z_m *= factor;
  scaled_config.region_m = Box3(factor * config.region_m.min(), factor * config.region_m.max());
  const SurfaceReference reference =
      cached_surface_reference(small, RayScene(small), scaled_config, threads);
  SizedShares out;
  for (const CoverageShares& shares :
       coverage_of_prefixes(reference, scaled(cloud_world_m, factor), prefixes, threads)) {
    out.raw.push_back(shares.raw[0]);
    out.outside.push_back(shares.outside[0]);
  }
  return out;
}

}  // namespace gnbv
