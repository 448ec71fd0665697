#include "bench/score/escape_search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

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

}  // namespace

EscapeSearch::EscapeSearch(const TriangleMesh& mesh, const RayScene& scene,
                           const ReferenceConfig& config)
    : scene_(scene),
      near_m_(static_cast<float>(config.escape_near_m)),
      obstacle_reach_m_(static_cast<float>(config.obstacle_reach_m)),
      normals_(tilted_normals(mesh)),
      directions_(spread_directions(config.directions)) {
  GNBV_CHECK(config.sample_spacing_m > 0.0 && config.directions >= 1 &&
                 config.escape_near_m >= 0.0 && config.obstacle_reach_m > 0.0,
             "spacing {} m, {} directions, escape distance {} m, reach of obstacles {} m",
             config.sample_spacing_m, config.directions, config.escape_near_m,
             config.obstacle_reach_m);
}

/// Of the samples those under the terrain.
void EscapeSearch::leave_out_buried(std::span<const SurfaceSample> samples,
                                    std::vector<std::size_t>& open) const {
  if (!scene_.has_terrain()) return;
  std::vector<Vec3f> origins;
  for (const SurfaceSample& sample : samples) origins.push_back(sample.p_world_m);
  const std::vector<Vec3f> up(samples.size(), Vec3f::UnitZ());
  std::vector<std::uint8_t> is_buried(samples.size());
  scene_.find_blocked(kTerrainPart, origins, up, near_m_, kEndless, is_buried);
  std::erase_if(open, [&](std::size_t i) { return is_buried[i] != 0; });
}

/// Ends the lines that an obstacle meets. They begin a little before their sample, so that one
/// that touches it does.
void EscapeSearch::end_at_obstacles(std::vector<Vec3f> origins, std::span<const Vec3f> directions,
                                    std::vector<std::uint8_t>& blocked) const {
  if (!scene_.has_obstacles()) return;
  for (std::size_t k = 0; k < origins.size(); ++k) origins[k] -= near_m_ * directions[k];
  std::vector<std::uint8_t> by_obstacle(blocked.size());
  scene_.find_blocked(kObstaclePart, origins, directions, 0.0F, obstacle_reach_m_, by_obstacle);
  for (std::size_t k = 0; k < blocked.size(); ++k) blocked[k] |= by_obstacle[k];
}

/// Adds one to `lines` of each of the samples that a line leaves from.
template <typename Direction>
void EscapeSearch::count_lines(std::span<const SurfaceSample> samples,
                               std::span<const std::size_t> of, const Direction& direction_of,
                               std::vector<std::uint32_t>& lines) const {
  std::vector<Vec3f> origins, directions;
  origins.reserve(of.size());
  directions.reserve(of.size());
  for (const std::size_t i : of) {
    origins.push_back(samples[i].p_world_m);
    directions.push_back(direction_of(i));
  }
  std::vector<std::uint8_t> blocked(of.size());
  scene_.find_blocked(kStructurePart, origins, directions, near_m_, kEndless, blocked);
  end_at_obstacles(std::move(origins), directions, blocked);
  for (std::size_t k = 0; k < of.size(); ++k) lines[of[k]] += blocked[k] == 0 ? 1 : 0;
}

std::vector<std::uint8_t> EscapeSearch::ask(std::span<const SurfaceSample> samples) const {
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

std::vector<std::uint8_t> samples_seeing_out(const World& world, const RayScene& scene,
                                             std::span<const SurfaceSample> samples,
                                             const ReferenceConfig& config, int threads) {
  constexpr std::size_t kChunk = 16384;
  const EscapeSearch search(world.structure, scene, config);
  std::vector<std::uint8_t> seen(samples.size(), 0);
  parallel_for_chunks(threads, samples.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    const std::vector<std::uint8_t> part = search.ask(samples.subspan(begin, end - begin));
    std::copy(part.begin(), part.end(), seen.begin() + static_cast<std::ptrdiff_t>(begin));
  });
  return seen;
}

}  // namespace gnbv
