#include "planner/map/octomap_io.hpp"

#include <fmt/format.h>
#include <octomap/octomap.h>

#include <sstream>
#include <string_view>
#include <utility>

#include "sim/core/file.hpp"

namespace gnbv {
namespace {

constexpr int kOctomapKeyOffset = 32768;
// voxels of the cubes that are pruned before the next layer of cubes is filled in: an octree takes
// some 46 bytes a voxel, which all of a large map together would not have
constexpr int kLayerVoxels = 16;

void fill(octomap::OcTree& tree, const OccupancyGrid& grid) {
  const OccupancyConfig& config = grid.config();
  tree.setProbHit(config.prob_hit);
  tree.setProbMiss(config.prob_miss);
  tree.setClampingThresMin(config.clamp_min);
  tree.setClampingThresMax(config.clamp_max);
  tree.setOccupancyThres(config.occupied_min);
  const GridGeometry& geometry = grid.geometry();
  const Key& size = geometry.size();
  const VoxelIndex layer = size[0] * size[1];
  for (VoxelIndex v = 0; v < geometry.voxel_count(); ++v) {
    const auto octomap_key = [key = geometry.key_at(v)](int axis) {
      return static_cast<octomap::key_type>(key[axis] + kOctomapKeyOffset);
    };
    if (v % layer == 0 && octomap_key(2) % kLayerVoxels == 0) tree.prune();
    if (!grid.is_measured(v)) continue;
    tree.setNodeValue(octomap::OcTreeKey(octomap_key(0), octomap_key(1), octomap_key(2)),
                      grid.log_odds(v), true);
  }
  tree.updateInnerOccupancy();
  tree.prune();
}

/// A file as OctoMap's readers want it. OctoMap's own writers print to stderr, and round the
/// resolution to six digits.
template <typename WriteData>
void write_by_rename(const std::filesystem::path& path, std::string_view first_line,
                     const octomap::OcTree& tree, const WriteData& write_data) {
  std::ostringstream out;
  out << first_line << "\n# written by gnbv\nid " << tree.getTreeType() << "\nsize " << tree.size()
      << "\nres " << fmt::format("{}", tree.getResolution()) << "\ndata\n";
  write_data(out);
  write_file_atomically(path, std::move(out).str());
}

}  // namespace

void write_octomap(const OccupancyGrid& grid, const std::filesystem::path& stem) {
  octomap::OcTree tree(grid.geometry().resolution_m());
  fill(tree, grid);
  // appended, since replace_extension would cut a stem with a dot
  write_by_rename(stem.string() + ".ot", "# Octomap OcTree file", tree,
                  [&](std::ostream& out) { tree.writeData(out); });
  tree.toMaxLikelihood();
  tree.prune();
  write_by_rename(stem.string() + ".bt", "# Octomap OcTree binary file", tree,
                  [&](std::ostream& out) { tree.writeBinaryData(out); });
}

}  // namespace gnbv
