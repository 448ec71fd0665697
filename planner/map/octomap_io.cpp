#include "planner/map/octomap_io.hpp"

#include <fmt/format.h>
#include <octomap/octomap.h>

#include <charconv>
#include <cstring>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "sim/core/error.hpp"
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

/// A text head, then each node before its children: float32 log-odds, and a byte whose bits say
/// which of the eight children follow. OctoMap's own reader does not notice where a file ends.
class OtReader {
 public:
  explicit OtReader(const std::filesystem::path& path) : path_(path), bytes_(read_file(path)) {
    const std::size_t res = bytes_.find("\nres ");
    const std::size_t data = bytes_.find("\ndata\n");
    if (!bytes_.starts_with("# Octomap OcTree file") || res == std::string::npos ||
        data == std::string::npos) {
      fail("is no OctoMap .ot file");
    }
    const char* const number = bytes_.data() + res + 5;  // in whatever locale the program is
    const auto [end, error] = std::from_chars(number, bytes_.data() + data, read.voxel_m);
    if (error != std::errc{} || !(read.voxel_m > 0.0)) fail("states no resolution");
    at_ = data + 6;
    constexpr std::int32_t kLowest = -kOctomapKeyOffset;
    if (at_ < bytes_.size()) read_node({kLowest, kLowest, kLowest}, 2 * kOctomapKeyOffset);
    if (at_ < bytes_.size()) fail("has more behind its end");
  }

  OctomapLeaves read;

 private:
  [[noreturn]] void fail(const char* what) const {
    throw BadInput(fmt::format("{}: {}", path_.string(), what));
  }

  void read_node(const Key& first, std::int32_t edge) {
    if (at_ + 5 > bytes_.size() || edge == 0) fail("is cut short or damaged");
    float log_odds = 0.0F;
    std::memcpy(&log_odds, bytes_.data() + at_, sizeof log_odds);
    const auto children = static_cast<unsigned char>(bytes_[at_ + 4]);
    at_ += 5;
    if (children == 0) return read.leaves.push_back({first, edge, log_odds});
    for (std::size_t child = 0; child < 8; ++child) {
      if ((children >> child & 1U) == 0) continue;
      Key at = first;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        at[axis] += static_cast<std::int32_t>(child >> axis & 1U) * (edge / 2);
      }
      read_node(at, edge / 2);
    }
  }

  const std::filesystem::path& path_;
  const std::string bytes_;
  std::size_t at_ = 0;
};

}  // namespace

bool is_occupied(const OctomapLeaf& leaf, const OccupancyConfig& config) {
  return leaf.log_odds >= octomap::logodds(config.occupied_min);
}

OctomapLeaves read_octomap(const std::filesystem::path& ot) { return OtReader(ot).read; }

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
