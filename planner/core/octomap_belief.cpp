#include "planner/core/octomap_belief.hpp"

#include <algorithm>
#include <cmath>

#include "planner/map/octomap_io.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// Voxels of the grid that a leaf overlaps by more than rounding.
KeyBox overlapped(const OctomapLeaf& leaf, double voxels_per_key, const GridGeometry& grid) {
  constexpr double kRounding = 1e-6;  // of a voxel
  KeyBox keys;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = leaf.first[axis] * voxels_per_key;
    const double high = (1.0 * leaf.first[axis] + leaf.edge_voxels) * voxels_per_key;
    const double first = grid.min_key()[axis], last = first + grid.size()[axis] - 1.0;
    keys.low[axis] =
        static_cast<std::int32_t>(std::clamp(std::floor(low + kRounding), first, last + 1.0));
    keys.high[axis] =
        static_cast<std::int32_t>(std::clamp(std::ceil(high - kRounding) - 1.0, first - 1.0, last));
  }
  return keys;
}

}  // namespace

Belief belief_of_octomap(const std::filesystem::path& path, const PlannerModel& model,
                         std::vector<std::string>& notes) {
  const OctomapLeaves map = read_octomap(path);
  Belief belief(model);
  const GridGeometry& grid = belief.grid.geometry();
  const OccupancyConfig& config = model.belief.map;
  const auto log_odds_of = [](double p) { return static_cast<float>(std::log(p / (1.0 - p))); };
  const double ratio = map.voxel_m / grid.resolution_m();
  constexpr double kWrittenDigits = 1e-5;  // OctoMap writes six of a resolution
  const bool is_same = std::abs(ratio - 1.0) < kWrittenDigits;
  constexpr float kNone = -std::numeric_limits<float>::infinity();
  std::vector<float> highest(grid.voxel_count(), kNone);
  for (const OctomapLeaf& leaf : map.leaves) {
    if (!std::isfinite(leaf.log_odds)) {
      throw BadInput(fmt::format("{}: holds log-odds of {}", path.string(), leaf.log_odds));
    }
    for_each_key(overlapped(leaf, is_same ? 1.0 : ratio, grid), [&](const Key& key) {
      float& value = highest[grid.index_of(key)];
      value = std::max(value, leaf.log_odds);
    });
  }
  std::size_t known = 0, below = 0;
  for (VoxelIndex v = 0; v < grid.voxel_count(); ++v) {
    if (highest[v] == kNone) continue;
    const bool is_below = grid.center_m(grid.key_at(v)[2]) < model.belief.floor_z_m &&
                          is_occupied({.first = {}, .log_odds = highest[v]}, config);
    ++(is_below ? below : known);
    if (is_below) continue;
    const float log_odds =
        std::clamp(highest[v], log_odds_of(config.clamp_min), log_odds_of(config.clamp_max));
    GNBV_CHECK(belief.grid.restore(v, log_odds), "log-odds {}", log_odds);
  }
  const std::string name = path.string();
  if (known == 0) {
    throw BadInput(
        fmt::format("{}: none of its {} leaves knows anything within workspace_m: it has "
                    "to be in the world's frame (m, z up)",
                    name, map.leaves.size()));
  }
  if (!is_same) {
    notes.push_back(
        fmt::format("{}: its voxels are {} m, ours {} m: each of ours has the highest "
                    "log-odds of those that it overlaps",
                    name, map.voxel_m, grid.resolution_m()));
  }
  if (below > 0) {
    notes.push_back(fmt::format("{}: {} occupied voxels below floor_z_m = {} left out", name, below,
                                model.belief.floor_z_m));
  }
  return belief;
}

}  // namespace gnbv
