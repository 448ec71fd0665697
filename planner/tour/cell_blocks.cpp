#include "planner/tour/cell_blocks.hpp"

#include <algorithm>

#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

constexpr double kBlockCells = 8.0;  // along an edge

void pack(const SurfaceCells& cells, CellBlocks::Block& block) {
  block.cells.clear();
  block.discs_m.clear();
  block.changed = 0;
  for (const std::uint32_t index : block.members) {
    const SurfaceCell& cell = cells.cells()[index];
    if (cell.discs_m.empty() && !cell.is_boundary) continue;
    CellBlocks::Cell packed{.middle_m = cell.on_plane_m, .index = index, .changed = cell.changed};
    if (cell.has_plane && !cell.is_bar) packed.normal = cell.normal;
    if (!cell.is_boundary) {
      Vec3f sum_m = Vec3f::Zero();
      for (const Vec3f& disc_m : cell.discs_m) sum_m += disc_m;
      packed.middle_m = sum_m / static_cast<float>(cell.discs_m.size());
      packed.first_disc = static_cast<std::uint32_t>(block.discs_m.size());
      packed.discs = static_cast<std::uint32_t>(cell.discs_m.size());
      block.discs_m.insert(block.discs_m.end(), cell.discs_m.begin(), cell.discs_m.end());
    }
    block.changed = std::max(block.changed, cell.changed);
    block.cells.push_back(packed);
  }
}

}  // namespace

CellBlocks::CellBlocks(const Box3& workspace_m, double cell_m)
    : lattice_(workspace_m, kBlockCells * cell_m), slot_(lattice_.voxel_count()) {}

void CellBlocks::sort_in(const SurfaceCells& cells) {
  for (; taken_ < cells.cells().size(); ++taken_) {
    const SurfaceCell& cell = cells.cells()[taken_];
    const Key key = lattice_.key_of(cells.lattice().center_m(cell.key));
    if (!lattice_.contains(key)) continue;  // half a cell beyond the workspace
    const VoxelIndex block = lattice_.index_of(key);
    if (slot_[block] == 0) {
      blocks_.emplace_back();
      blocks_.back().center_m = lattice_.center_m(key).cast<float>();
      slot_[block] = static_cast<std::uint32_t>(blocks_.size());
    }
    blocks_[slot_[block] - 1].members.push_back(static_cast<std::uint32_t>(taken_));
  }
}

void CellBlocks::follow(const SurfaceCells& cells, int threads) {
  if (version_ == cells.version()) return;
  version_ = cells.version();
  sort_in(cells);
  parallel_for_chunks(threads, blocks_.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) pack(cells, blocks_[i]);
  });
}

std::vector<const CellBlocks::Block*> CellBlocks::near(const Vec3& p_world_m,
                                                       double reach_m) const {
  const float within_m = static_cast<float>(reach_m) + radius_m();
  const Vec3 reach = Vec3::Constant(within_m + 1e-3);  // more than anything here rounds
  Key low = lattice_.key_of(Vec3(p_world_m - reach));
  Key high = lattice_.key_of(Vec3(p_world_m + reach));
  for (std::size_t a = 0; a < 3; ++a) {
    low[a] = std::max(low[a], lattice_.min_key()[a]);
    high[a] = std::min(high[a], lattice_.min_key()[a] + lattice_.size()[a] - 1);
  }
  std::vector<const Block*> found;
  Key key;
  for (key[2] = low[2]; key[2] <= high[2]; ++key[2]) {
    for (key[1] = low[1]; key[1] <= high[1]; ++key[1]) {
      for (key[0] = low[0]; key[0] <= high[0]; ++key[0]) {
        const std::uint32_t slot = slot_[lattice_.index_of(key)];
        if (slot == 0) continue;
        const Block& block = blocks_[slot - 1];
        const float distance2_m2 = (block.center_m - p_world_m.cast<float>()).squaredNorm();
        if (distance2_m2 <= within_m * within_m) found.push_back(&block);
      }
    }
  }
  return found;
}

}  // namespace gnbv
