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

/// A text head, then the tree. Of .ot, each node before its children: float32 log-odds, in a
/// ColorOcTree a colour, and a byte whose bits say which of the eight children follow. Of .bt, two
/// bits for each child of a node (1 free, 2 occupied, 3 a node that follows). OctoMap's own reader
/// does not notice where a file ends.
class TreeReader {
 public:
  explicit TreeReader(const std::filesystem::path& path) : path_(path), bytes_(read_file(path)) {
    const bool is_binary = bytes_.starts_with("# Octomap OcTree binary file");
    const std::size_t data = bytes_.find("\ndata\n");
    if ((!is_binary && !bytes_.starts_with("# Octomap OcTree file")) || data == std::string::npos) {
      fail("is no OctoMap .ot or .bt file");
    }
    const std::string_view id = value_of("id", data);
    if (id == "ColorOcTree" && !is_binary) extra_ = 3;
    if (id != "OcTree" && id != "ColorOcTree") fail(fmt::format("is an OctoMap of '{}'", id));
    const std::string_view res = value_of("res", data);  // in whatever locale the program is
    const auto [end, error] = std::from_chars(res.data(), res.data() + res.size(), read.voxel_m);
    if (error != std::errc{} || !(read.voxel_m > 0.0)) fail("states no resolution");
    at_ = data + 6;
    constexpr std::int32_t kLowest = -kOctomapKeyOffset;
    if (at_ < bytes_.size()) {
      const Key first = {kLowest, kLowest, kLowest};
      is_binary ? read_bits(first, 2 * kOctomapKeyOffset) : read_node(first, 2 * kOctomapKeyOffset);
    }
    if (at_ < bytes_.size()) fail("has more behind its end");
  }

  OctomapLeaves read;

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw BadInput(fmt::format("{}: {}", path_.string(), what));
  }

  /// Of a line of the head.
  std::string_view value_of(const std::string& key, std::size_t data) const {
    const std::size_t at = bytes_.find("\n" + key + " ");
    if (at >= data) fail(fmt::format("states no '{}'", key));
    const std::size_t first = at + key.size() + 2;
    return std::string_view(bytes_).substr(first, bytes_.find_first_of("\r\n", first) - first);
  }

  static Key child_at(const Key& first, std::size_t child, std::int32_t edge) {
    Key at = first;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      at[axis] += static_cast<std::int32_t>(child >> axis & 1U) * edge;
    }
    return at;
  }

  void need(std::size_t bytes, std::int32_t edge) const {
    if (at_ + bytes > bytes_.size() || edge == 0) fail("is cut short or damaged");
  }

  void read_node(const Key& first, std::int32_t edge) {
    need(5 + extra_, edge);
    float log_odds = 0.0F;
    std::memcpy(&log_odds, bytes_.data() + at_, sizeof log_odds);
    const auto children = static_cast<unsigned char>(bytes_[at_ + 4 + extra_]);
    at_ += 5 + extra_;
    if (children == 0) return read.leaves.push_back({first, edge, log_odds});
    for (std::size_t child = 0; child < 8; ++child) {
      if ((children >> child & 1U) != 0) read_node(child_at(first, child, edge / 2), edge / 2);
    }
  }

  /// Leaves have the log-odds of OctoMap's own clamping bounds, as its reader gives them.
  void read_bits(const Key& first, std::int32_t edge) {
    need(2, edge / 2);
    std::uint16_t bits = 0;
    std::memcpy(&bits, bytes_.data() + at_, sizeof bits);
    at_ += 2;
    const OccupancyConfig defaults;
    for (std::size_t child = 0; child < 8; ++child) {
      const unsigned kind = bits >> 2U * child & 3U;
      const Key at = child_at(first, child, edge / 2);
      if (kind == 3) {
        read_bits(at, edge / 2);
      } else if (kind != 0) {
        const double p = kind == 2 ? defaults.clamp_max : defaults.clamp_min;
        read.leaves.push_back({at, edge / 2, octomap::logodds(p)});
      }
    }
  }

  const std::filesystem::path& path_;
  const std::string bytes_;
  std::size_t at_ = 0;
  std::size_t extra_ = 0;  // bytes of a node's colour
};

}  // namespace

bool is_occupied(const OctomapLeaf& leaf, const OccupancyConfig& config) {
  return leaf.log_odds >= octomap::logodds(config.occupied_min);
}

OctomapLeaves read_octomap(const std::filesystem::path& path) { return TreeReader(path).read; }

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
