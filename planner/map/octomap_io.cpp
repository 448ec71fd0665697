#include "planner/map/octomap_io.hpp"

#include <fmt/format.h>
#include <octomap/octomap.h>

#include <cerrno>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

#include "sim/core/file.hpp"

namespace gnbv {
namespace {

constexpr int kOctomapKeyOffset = 32768;
// voxels of the cubes that are pruned before the next layer of cubes is filled in: an octree takes
// some 46 bytes a voxel, which all of a large map together would not have
constexpr int kLayerVoxels = 16;

octomap::OcTreeKey octomap_key(const Key& key) {
  return {static_cast<octomap::key_type>(key[0] + kOctomapKeyOffset),
          static_cast<octomap::key_type>(key[1] + kOctomapKeyOffset),
          static_cast<octomap::key_type>(key[2] + kOctomapKeyOffset)};
}

void fill(octomap::OcTree& tree, const OccupancyGrid& grid) {
  const OccupancyConfig& config = grid.config();
  tree.setProbHit(config.prob_hit);
  tree.setProbMiss(config.prob_miss);
  tree.setClampingThresMin(config.clamp_min);
  tree.setClampingThresMax(config.clamp_max);
  tree.setOccupancyThres(config.occupied_min);
  const GridGeometry& geometry = grid.geometry();
  const Key& min = geometry.min_key();
  const Key& size = geometry.size();
  VoxelIndex v = 0;  // x fastest
  for (std::int32_t z = min[2]; z < min[2] + size[2]; ++z) {
    if ((z + kOctomapKeyOffset) % kLayerVoxels == 0) tree.prune();
    for (std::int32_t y = min[1]; y < min[1] + size[1]; ++y) {
      for (std::int32_t x = min[0]; x < min[0] + size[0]; ++x, ++v) {
        if (!grid.is_measured(v)) continue;
        tree.setNodeValue(octomap_key({x, y, z}), grid.log_odds(v), true);
      }
    }
  }
  tree.updateInnerOccupancy();
  tree.prune();
}

/// The text before the data, as OctoMap's readers want it. OctoMap's own writers print to stderr,
/// and round the resolution to six digits.
void write_header(std::ostream& out, std::string_view first_line, const octomap::OcTree& tree) {
  out << first_line << "\n# written by gnbv\nid " << tree.getTreeType() << "\nsize " << tree.size()
      << "\nres " << fmt::format("{}", tree.getResolution()) << "\ndata\n";
}

template <typename Write>
void write_by_rename(const std::filesystem::path& path, const Write& write) {
  write_file_atomically(path, [&](const std::filesystem::path& part) {
    errno = 0;
    std::ofstream out(part, std::ios::binary | std::ios::trunc);
    if (out) write(out);
    out.flush();
    if (!out) refuse_to_write(path, errno);
  });
}

}  // namespace

void write_octomap(const OccupancyGrid& grid, const std::filesystem::path& stem) {
  octomap::OcTree tree(grid.geometry().resolution_m());
  fill(tree, grid);
  // appended, since replace_extension would cut a stem with a dot
  write_by_rename(stem.string() + ".ot", [&](std::ostream& out) {
    write_header(out, "# Octomap OcTree file", tree);
    tree.writeData(out);
  });
  tree.toMaxLikelihood();
  tree.prune();
  write_by_rename(stem.string() + ".bt", [&](std::ostream& out) {
    write_header(out, "# Octomap OcTree binary file", tree);
    tree.writeBinaryData(out);
  });
}

}  // namespace gnbv
