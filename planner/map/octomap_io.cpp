#include "planner/map/octomap_io.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string>
#include <string_view>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"

namespace gnbv {
namespace {

constexpr std::int32_t kRootEdge = 65536;  // voxels: OctoMap's keys are 16 bits wide
constexpr Key kRootKey = {-kRootEdge / 2, -kRootEdge / 2, -kRootEdge / 2};

Key child_at(const Key& first, std::size_t child, std::int32_t edge) {
  Key at = first;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    at[axis] += static_cast<std::int32_t>(child >> axis & 1U) * edge;
  }
  return at;
}

/// The measured voxels as OctoMap's pruned tree (OcTreeBaseImpl::prune), written from its leaves
/// up: as a tree in memory they would take 46 bytes each. TreeReader says how a file looks.
class TreeWriter {
 public:
  TreeWriter(const OccupancyGrid& grid, bool is_binary) : grid_(grid), is_binary_(is_binary) {
    add_cube(kRootKey, kRootEdge);
  }

  std::size_t nodes = 0;
  std::string data;

 private:
  struct Node {
    bool exists = false;
    bool is_leaf = false;
    float value = 0.0F;  // the highest log-odds in it; in a binary tree 1 for occupied
  };

  Node add_cube(const Key& first, std::int32_t edge) {
    const Key& low = grid_.geometry().min_key();
    const Key& size = grid_.geometry().size();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (first[axis] + edge <= low[axis] || first[axis] >= low[axis] + size[axis]) return {};
    }
    if (edge > 1) return add_children(first, edge);
    const VoxelIndex v = grid_.geometry().index_of(first);
    if (!grid_.is_measured(v)) return {};
    if (!is_binary_) return add_leaf(grid_.log_odds(v));
    return add_leaf(grid_.state(v) == VoxelState::occupied ? 1.0F : 0.0F);
  }

  Node add_leaf(float value) {
    ++nodes;
    if (!is_binary_) put_node(data.size(), value, 0);
    return {.exists = true, .is_leaf = true, .value = value};
  }

  Node add_children(const Key& first, std::int32_t edge) {
    const std::size_t begin = data.size();
    const std::size_t nodes_before = nodes++;
    data.resize(begin + (is_binary_ ? 2 : 5));
    Node node;
    bool is_one = true;
    unsigned exist = 0;
    unsigned kinds = 0;
    for (std::size_t i = 0; i < 8; ++i) {
      const Node child = add_cube(child_at(first, i, edge / 2), edge / 2);
      is_one = is_one && child.is_leaf && (i == 0 || child.value == node.value);
      if (!child.exists) continue;
      node.value = node.exists ? std::max(node.value, child.value) : child.value;
      node.exists = true;
      exist |= 1U << i;
      kinds |= (!child.is_leaf ? 3U : child.value > 0.0F ? 2U : 1U) << 2U * i;
    }
    if (is_one || !node.exists) {
      data.resize(begin);
      nodes = nodes_before;
      return is_one ? add_leaf(node.value) : Node();
    }
    is_binary_ ? put(begin, static_cast<std::uint16_t>(kinds)) : put_node(begin, node.value, exist);
    return node;
  }

  template <typename T>
  void put(std::size_t at, T value) {
    data.resize(std::max(data.size(), at + sizeof value));
    std::memcpy(data.data() + at, &value, sizeof value);
  }

  void put_node(std::size_t at, float value, unsigned children) {
    put(at, value);
    put(at + sizeof value, static_cast<std::uint8_t>(children));
  }

  const OccupancyGrid& grid_;
  const bool is_binary_;
};

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
    if (error != std::errc{} || !(read.voxel_m > 0.0) || std::isinf(read.voxel_m)) {
      fail("states no resolution");
    }
    at_ = data + 6;
    if (at_ < bytes_.size()) {
      is_binary ? read_bits(kRootKey, kRootEdge) : read_node(kRootKey, kRootEdge);
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
        read.leaves.push_back({at, edge / 2, log_odds_of(p)});
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
  return leaf.log_odds >= log_odds_of(config.occupied_min);
}

OctomapLeaves read_octomap(const std::filesystem::path& path) { return TreeReader(path).read; }

void write_octomap(const OccupancyGrid& grid, const std::filesystem::path& stem) {
  for (const bool is_binary : {false, true}) {
    const TreeWriter tree(grid, is_binary);
    // appended, since replace_extension would cut a stem with a dot
    write_file_atomically(
        stem.string() + (is_binary ? ".bt" : ".ot"),
        fmt::format(
            "# Octomap OcTree {}file\n# written by gnbv\nid OcTree\nsize {}\nres {}\ndata\n",
            is_binary ? "binary " : "", tree.nodes, grid.geometry().resolution_m()) +
            tree.data);
  }
}

}  // namespace gnbv
