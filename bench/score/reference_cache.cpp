// cached_surface_reference() of surface_reference.hpp.
#include <optional>

#include "bench/score/content_cache.hpp"
#include "bench/score/packed_numbers.hpp"
#include "bench/score/surface_reference.hpp"

namespace gnbv {
namespace {

std::string key_of(const World& world, const ReferenceConfig& config) {
  Sha256 sha;
  for (const TriangleMesh* mesh : {&world.structure, &world.obstacles, &world.terrain}) {
    add_mesh(sha, *mesh);
  }
  for (const Vec3& corner_m : {config.region_m.min(), config.region_m.max()}) {
    for (const double value : corner_m) sha.add(value);
  }
  for (const double value :
       {config.floor_z_m, config.sample_spacing_m, config.escape_near_m, config.obstacle_reach_m}) {
    sha.add(value);
  }
  sha.add(std::uint64_t{world.is_portable});
  sha.add(config.directions);
  sha.add(std::uint64_t{config.fewest_samples});
  sha.add(std::uint64_t{config.area_samples});
  return sha.hex();
}

std::string bytes_of(const SurfaceReference& reference) {
  std::string bytes;
  for (const auto* const sizes : {&reference.raw, &reference.counted}) {
    for (const VoxelSet& voxels : *sizes) put_ascending(bytes, voxels);
  }
  put_count(bytes, reference.area_samples);
  put_count(bytes, reference.samples_world_m.size());
  for (const auto* const points : {&reference.points_world_m, &reference.samples_world_m}) {
    for (const Vec3f& p_m : *points) {
      for (const float x_m : p_m) append_bytes(bytes, x_m);
    }
  }
  return bytes;
}

std::vector<Vec3f> take_points(PackedNumbers& in, std::uint64_t count) {
  std::vector<Vec3f> points_m;
  for (; count > 0 && in.is_good(); --count) {
    points_m.emplace_back(in.take<std::array<float, 3>>().data());
  }
  return points_m;
}

std::optional<SurfaceReference> reference_in(std::string_view bytes) {
  PackedNumbers in(bytes);
  SurfaceReference reference;
  for (auto* const sizes : {&reference.raw, &reference.counted}) {
    for (VoxelSet& voxels : *sizes) voxels = in.take_ascending<std::uint64_t>();
  }
  reference.area_samples = in.take_count();
  const std::uint64_t samples = in.take_count();
  reference.points_world_m = take_points(in, reference.counted[0].size());
  reference.samples_world_m = take_points(in, samples);
  if (!in.is_read()) return std::nullopt;
  return reference;
}

}  // namespace

SurfaceReference cached_surface_reference(const World& world, const RayScene& scene,
                                          const ReferenceConfig& config, int threads,
                                          const ReferenceProgress& progress) {
  return cached("surface_reference", key_of(world, config), reference_in, bytes_of,
                [&] { return make_surface_reference(world, scene, config, threads, progress); });
}

}  // namespace gnbv
