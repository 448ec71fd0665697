#include "bench/score/surface_reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

// Work is cut into slabs along x that no voxel of any size straddles: each slab owns its voxels,
// and slabs in order give sorted codes. Half metres are exact in binary.
constexpr double kSlab_m = 0.5;
static_assert(kCoverageSizes_m[2] == kSlab_m);

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

// Groups of samples, of which one that sees out settles the group. Group g: [first[g], first[g +
// 1]).
struct Groups {
  std::span<const SurfaceSample> samples;
  std::vector<std::size_t> first;
  std::size_t size() const { return first.size() - 1; }
};

class EscapeSearch {
 public:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  EscapeSearch(const TriangleMesh& mesh, const RayScene& scene, const ReferenceConfig& config)
      : scene_(scene),
        near_m_(static_cast<float>(config.escape_near_m)),
        normals_(tilted_normals(mesh)),
        directions_(spread_directions(config.directions)) {}

  // For each group the sample found to see out, kNone without one.
  std::vector<std::size_t> settle(const Groups& groups) const {
    std::vector<std::size_t> seen(groups.size(), kNone);
    std::vector<std::size_t> open(groups.size());
    std::iota(open.begin(), open.end(), std::size_t{0});
    Batch batch;
    along_normals(groups, open, seen, batch);
    along_directions(groups, open, seen, batch);
    return seen;
  }

 private:
  struct Batch {
    std::vector<Vec3f> origins, directions;
    std::vector<std::size_t> group, sample;
    std::vector<std::uint8_t> blocked;
    void add(std::size_t g, std::size_t s, const Vec3f& origin, const Vec3f& direction) {
      group.push_back(g);
      sample.push_back(s);
      origins.push_back(origin);
      directions.push_back(direction);
    }
  };

  // Traces the batch, empties it and drops the groups it settled from `open`.
  void trace(Batch& batch, std::vector<std::size_t>& open, std::vector<std::size_t>& seen) const {
    batch.blocked.assign(batch.group.size(), 0);
    scene_.structure_blocks(batch.origins, batch.directions, near_m_, batch.blocked);
    for (std::size_t i = 0; i < batch.group.size(); ++i) {
      std::size_t& found = seen[batch.group[i]];
      if (batch.blocked[i] == 0 && found == kNone) found = batch.sample[i];
    }
    std::erase_if(open, [&](std::size_t g) { return seen[g] != kNone; });
    batch.group.clear();
    batch.sample.clear();
    batch.origins.clear();
    batch.directions.clear();
  }

  // Round r asks the r-th sample of every open group: most surface is settled by its first.
  void along_normals(const Groups& groups, std::vector<std::size_t>& open,
                     std::vector<std::size_t>& seen, Batch& batch) const {
    std::size_t longest = 0;
    for (const std::size_t g : open) {
      longest = std::max(longest, groups.first[g + 1] - groups.first[g]);
    }
    for (std::size_t r = 0; r < longest && !open.empty(); ++r) {
      for (const float side : {1.0F, -1.0F}) {
        for (const std::size_t g : open) {
          const std::size_t i = groups.first[g] + r;
          if (i >= groups.first[g + 1]) continue;
          const SurfaceSample& s = groups.samples[i];
          batch.add(g, i, s.p_world_m, side * normals_[s.face]);
        }
        trace(batch, open, seen);
      }
    }
  }

  // One direction at a time for all samples left: neighbours in space with equal directions trace
  // fast.
  void along_directions(const Groups& groups, std::vector<std::size_t>& open,
                        std::vector<std::size_t>& seen, Batch& batch) const {
    for (const Vec3f& direction : directions_) {
      if (open.empty()) return;
      for (const std::size_t g : open) {
        for (std::size_t i = groups.first[g]; i < groups.first[g + 1]; ++i) {
          batch.add(g, i, groups.samples[i].p_world_m, direction);
        }
      }
      trace(batch, open, seen);
    }
  }

  const RayScene& scene_;
  float near_m_;
  std::vector<Vec3f> normals_;
  std::vector<Vec3f> directions_;
};

void check(const ReferenceConfig& config) {
  GNBV_CHECK(config.sample_spacing_m > 0.0, "sample spacing {} m", config.sample_spacing_m);
  GNBV_CHECK(config.directions >= 1, "{} directions", config.directions);
  GNBV_CHECK(config.escape_near_m >= 0.0, "escape distance {} m", config.escape_near_m);
}

// Slabs of the mesh, and for each the faces whose box touches it and reaches above the floor.
struct Slabs {
  std::int64_t first = 0;
  std::vector<std::vector<std::uint32_t>> faces;
};

Slabs make_slabs(const TriangleMesh& mesh, double floor_z_m) {
  const auto slab_of = [](float x_m) {
    return static_cast<std::int64_t>(std::floor(static_cast<double>(x_m) / kSlab_m));
  };
  const Box3 box = bounds_m(mesh);
  Slabs slabs;
  if (box.isEmpty()) return slabs;
  // throws for what has no voxel
  voxel_code(box.min().cast<float>(), kCoverageSizes_m[0]);
  voxel_code(box.max().cast<float>(), kCoverageSizes_m[0]);
  slabs.first = slab_of(static_cast<float>(box.min().x()));
  const std::int64_t last = slab_of(static_cast<float>(box.max().x()));
  slabs.faces.resize(static_cast<std::size_t>(last - slabs.first + 1));
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    Eigen::AlignedBox3f face;
    for (const std::uint32_t v : mesh.faces[f]) face.extend(mesh.vertices_m[v]);
    if (static_cast<double>(face.max().z()) < floor_z_m) continue;
    for (std::int64_t s = slab_of(face.min().x()); s <= slab_of(face.max().x()); ++s) {
      slabs.faces[static_cast<std::size_t>(s - slabs.first)].push_back(f);
    }
  }
  return slabs;
}

std::vector<SurfaceSample> slab_samples(const TriangleMesh& mesh, const Slabs& slabs,
                                        std::size_t slab, const ReferenceConfig& config) {
  const double x_min_m =
      static_cast<double>(slabs.first + static_cast<std::int64_t>(slab)) * kSlab_m;
  std::vector<SurfaceSample> samples;
  for (const std::uint32_t face : slabs.faces[slab]) {
    sample_face(mesh, face, config.sample_spacing_m, x_min_m, x_min_m + kSlab_m, samples);
  }
  std::erase_if(samples, [&](const SurfaceSample& s) {
    return static_cast<double>(s.p_world_m.z()) < config.floor_z_m;
  });
  return samples;
}

struct SlabVoxels {
  VoxelSet raw, outside;  // of the finest size
  std::vector<Vec3f> samples_world_m;
};

/// Samples by voxel, those of a voxel by their distance from its centre.
struct InVoxel {
  std::uint64_t code = 0;
  float from_centre_m2 = 0.0F;
  std::uint32_t sample = 0;
  auto operator<=>(const InVoxel&) const = default;
};

SlabVoxels slab_voxels(const std::vector<SurfaceSample>& samples, const EscapeSearch& search) {
  std::vector<InVoxel> order;
  order.reserve(samples.size());
  for (std::uint32_t i = 0; i < samples.size(); ++i) {
    const Vec3f& p_m = samples[i].p_world_m;
    const std::uint64_t code = voxel_code(p_m, kCoverageSizes_m[0]);
    const Vec3 off_m = p_m.cast<double>() - voxel_centre_m(code, kCoverageSizes_m[0]);
    order.push_back({code, static_cast<float>(off_m.squaredNorm()), i});
  }
  std::sort(order.begin(), order.end());

  SlabVoxels voxels;
  std::vector<SurfaceSample> sorted;
  sorted.reserve(samples.size());
  Groups groups;
  for (const auto& [code, from_centre_m2, i] : order) {
    if (voxels.raw.empty() || voxels.raw.back() != code) {
      voxels.raw.push_back(code);
      groups.first.push_back(sorted.size());
    }
    sorted.push_back(samples[i]);
  }
  groups.first.push_back(sorted.size());
  groups.samples = sorted;
  const std::vector<std::size_t> seen = search.settle(groups);
  for (std::size_t g = 0; g < seen.size(); ++g) {
    if (seen[g] == EscapeSearch::kNone) continue;
    voxels.outside.push_back(voxels.raw[g]);
    voxels.samples_world_m.push_back(sorted[seen[g]].p_world_m);
  }
  return voxels;
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
  std::vector<SlabVoxels> parts(slabs.faces.size());
  parallel_for(threads, parts.size(), [&](std::size_t slab) {
    parts[slab] = slab_voxels(slab_samples(world.structure, slabs, slab, config), search);
  });
  SlabVoxels all;
  for (const SlabVoxels& part : parts) {
    all.raw.insert(all.raw.end(), part.raw.begin(), part.raw.end());
    all.outside.insert(all.outside.end(), part.outside.begin(), part.outside.end());
    all.samples_world_m.insert(all.samples_world_m.end(), part.samples_world_m.begin(),
                               part.samples_world_m.end());
  }
  return {at_all_sizes(std::move(all.raw)), at_all_sizes(std::move(all.outside)),
          std::move(all.samples_world_m)};
}

std::vector<std::uint8_t> samples_seeing_out(const World& world, const RayScene& scene,
                                             std::span<const SurfaceSample> samples,
                                             const ReferenceConfig& config, int threads) {
  check(config);
  constexpr std::size_t kChunk = 16384;
  const EscapeSearch search(world.structure, scene, config);
  std::vector<std::uint8_t> seen(samples.size(), 0);
  parallel_for_chunks(threads, samples.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    Groups groups;
    groups.samples = samples.subspan(begin, end - begin);
    groups.first.resize(groups.samples.size() + 1);
    std::iota(groups.first.begin(), groups.first.end(), std::size_t{0});
    const std::vector<std::size_t> part = search.settle(groups);
    for (std::size_t i = 0; i < part.size(); ++i) {
      seen[begin + i] = part[i] != EscapeSearch::kNone ? 1 : 0;
    }
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
