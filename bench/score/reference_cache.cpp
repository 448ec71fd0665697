// The surface reference as bytes, and back from the cache.
#include <bit>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "bench/score/content_cache.hpp"
#include "bench/score/packed_counts.hpp"
#include "bench/score/surface_reference.hpp"
#include "sim/core/sha256.hpp"

namespace gnbv {
namespace {

static_assert(std::endian::native == std::endian::little);
static_assert(sizeof(Vec3f) == 3 * sizeof(float));

constexpr std::string_view kKind = "surface_reference";

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
  sha.add(config.directions);
  sha.add(std::uint64_t{config.fewest_samples});
  return sha.hex();
}

/// The gaps between sorted codes are small: neighbours along z differ by one.
void put_voxels(const VoxelSet& voxels, std::string& bytes) {
  put_count(voxels.size(), bytes);
  std::uint64_t before = 0;
  for (const std::uint64_t code : voxels) {
    put_count(code - before, bytes);
    before = code;
  }
}

std::optional<VoxelSet> take_voxels(std::string_view& bytes) {
  const auto count = take_count(bytes);
  if (!count || *count > bytes.size()) return std::nullopt;  // a byte a voxel at least
  VoxelSet voxels;
  voxels.reserve(*count);
  std::uint64_t code = 0;
  for (std::uint64_t i = 0; i < *count; ++i) {
    const auto gap = take_count(bytes);
    if (!gap) return std::nullopt;
    voxels.push_back(code += *gap);
  }
  return voxels;
}

std::string bytes_of(const SurfaceReference& reference) {
  std::string bytes;
  for (const auto* const sizes : {&reference.raw, &reference.outside}) {
    for (const VoxelSet& voxels : *sizes) put_voxels(voxels, bytes);
  }
  put_count(reference.samples_world_m.size(), bytes);
  for (const auto* const points : {&reference.points_world_m, &reference.samples_world_m}) {
    bytes.append(reinterpret_cast<const char*>(points->data()), std::span(*points).size_bytes());
  }
  return bytes;
}

std::optional<SurfaceReference> reference_in(std::string_view bytes) {
  SurfaceReference reference;
  for (auto* const sizes : {&reference.raw, &reference.outside}) {
    for (VoxelSet& voxels : *sizes) {
      std::optional<VoxelSet> taken = take_voxels(bytes);
      if (!taken) return std::nullopt;
      voxels = *std::move(taken);
    }
  }
  const auto samples = take_count(bytes);
  if (!samples || *samples > bytes.size()) return std::nullopt;
  reference.points_world_m.resize(reference.outside[0].size());
  reference.samples_world_m.resize(*samples);
  for (auto* const points : {&reference.points_world_m, &reference.samples_world_m}) {
    const std::size_t size = std::span(*points).size_bytes();
    if (bytes.size() < size) return std::nullopt;
    if (size > 0) std::memcpy(points->data()->data(), bytes.data(), size);
    bytes.remove_prefix(size);
  }
  if (!bytes.empty()) return std::nullopt;
  return reference;
}

}  // namespace

SurfaceReference cached_surface_reference(const World& world, const RayScene& scene,
                                          const ReferenceConfig& config, int threads) {
  const std::string key = key_of(world, config);
  if (const auto bytes = load_cached(kKind, key)) {
    if (auto reference = reference_in(*bytes)) return *std::move(reference);
  }
  SurfaceReference reference = make_surface_reference(world, scene, config, threads);
  store_cached(kKind, key, bytes_of(reference));
  return reference;
}

}  // namespace gnbv
