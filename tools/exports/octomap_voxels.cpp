#include "tools/exports/octomap_voxels.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr int kOctomapKeyOffset = 32768;
constexpr int kTreeDepth = 16;
// what a child is, in the two bits that .bt files spend on it; 0: nothing
constexpr unsigned kFreeLeaf = 1;
constexpr unsigned kOccupiedLeaf = 2;
constexpr unsigned kInnerNode = 3;

struct BtHeader {
  double voxel_m = 0.0;
  std::size_t nodes = 0;
};

/// Surface is thin: its voxels hardly ever fill cubes that are pruned to one leaf. Many times as
/// many voxels as a file of that size has leaves are damage, not a map.
std::size_t most_voxels_of(const std::filesystem::path& bt) {
  constexpr std::size_t kLeavesPerByte = 4;
  constexpr std::size_t kVoxelsPerLeaf = 64;
  std::error_code error;
  const auto bytes = std::filesystem::file_size(bt, error);
  const std::size_t most = error ? 0 : bytes * kLeavesPerByte * kVoxelsPerLeaf;
  return std::clamp<std::size_t>(most, 1'000'000, 100'000'000);
}

/// Leaves the data next. OctoMap's own readers print to stderr, too.
BtHeader read_header(std::istream& in, const std::filesystem::path& path) {
  BtHeader header;
  bool is_tree = false;
  std::string line;
  while (std::getline(in, line) && line != "data") {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "res") words >> header.voxel_m;
    if (key == "size") words >> header.nodes;
    if (line == "id OcTree") is_tree = true;
  }
  if (in && is_tree && header.voxel_m > 0.0) return header;
  throw BadInput(fmt::format("{}: is no map of OctoMap's binary format", path.string()));
}

/// The data of a .bt file: two bits for each child of an inner node, then those children that are
/// inner nodes themselves. OctoMap's own reader does not notice where a file ends, and fills the
/// memory with what it takes for nodes.
struct BtReader {
  std::istream& in;
  const std::filesystem::path& path;
  MeasuredVoxels& voxels;
  std::size_t most_voxels;
  std::size_t nodes = 1;  // that were read, the root among them

  /// The children of the node whose first voxel is `first`, each 2^`level` voxels wide.
  void read_children(const std::array<std::int32_t, 3>& first, int level) {
    std::array<char, 2> bytes{};
    if (level < 0 || !in.read(bytes.data(), bytes.size())) {
      throw BadInput(fmt::format("{}: is damaged, or ends too early", path.string()));
    }
    std::array<std::array<std::int32_t, 3>, 8> corners{};
    std::array<unsigned, 8> states{};
    for (std::size_t i = 0; i < 8; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        corners[i][axis] = first[axis] + static_cast<std::int32_t>(((i >> axis) & 1U) << level);
      }
      states[i] = (static_cast<unsigned char>(bytes[i / 4]) >> (2 * (i % 4))) & 3U;
      if (states[i] != 0) ++nodes;
      if (states[i] == kFreeLeaf) voxels.free_voxels += std::size_t{1} << (3 * level);
      if (states[i] == kOccupiedLeaf) add_occupied(corners[i], level);
    }
    for (std::size_t i = 0; i < 8; ++i) {
      if (states[i] == kInnerNode) read_children(corners[i], level - 1);
    }
  }

  void add_occupied(const std::array<std::int32_t, 3>& first, int level) {
    const std::int32_t edge = 1 << level;
    const std::size_t count = std::size_t{1} << (3 * level);
    if (voxels.occupied_world_m.size() + count > most_voxels) {
      throw BadInput(
          fmt::format("{}: is damaged: a cube of {} occupied voxels", path.string(), count));
    }
    for (std::int32_t z = 0; z < edge; ++z) {
      for (std::int32_t y = 0; y < edge; ++y) {
        for (std::int32_t x = 0; x < edge; ++x) {
          const Vec3 key(first[0] + x, first[1] + y, first[2] + z);
          const Vec3 centre = key + Vec3::Constant(0.5 - kOctomapKeyOffset);
          voxels.occupied_world_m.push_back((voxels.voxel_m * centre).cast<float>());
        }
      }
    }
  }
};

}  // namespace

MeasuredVoxels read_octomap(const std::filesystem::path& bt) {
  std::ifstream in(bt, std::ios::binary);
  const BtHeader header = read_header(in, bt);
  MeasuredVoxels voxels{.voxel_m = header.voxel_m};
  if (header.nodes == 0) return voxels;
  BtReader reader{in, bt, voxels, most_voxels_of(bt)};
  reader.read_children({}, kTreeDepth - 1);
  if (reader.nodes != header.nodes) {
    throw BadInput(fmt::format("{}: is damaged: {} nodes, its header says {}", bt.string(),
                               reader.nodes, header.nodes));
  }
  return voxels;
}

}  // namespace gnbv
