// The cells of the surface as they are drawn: packed, by cubes of the workspace.
#pragma once

#include <cstdint>
#include <vector>

#include "planner/tour/surface_cells.hpp"

namespace gnbv {

class CellBlocks {
 public:
  /// A cell that hides something, or that has something to be seen.
  struct Cell {
    Vec3f middle_m;                // of its discs; of a boundary on its plane
    Vec3f normal = Vec3f::Zero();  // zero: no plane, its discs face whoever looks
    std::uint32_t index = 0;       // of the cell
    std::uint32_t changed = 0;     // SurfaceCell's
    std::uint32_t first_disc = 0;
    std::uint32_t discs = 0;
  };
  struct Block {
    Vec3f center_m;
    std::uint32_t changed = 0;           // the newest of its cells
    std::vector<std::uint32_t> members;  // all its cells
    std::vector<Cell> cells;             // those to be drawn
    std::vector<Vec3f> discs_m;
  };

  CellBlocks(const Box3& workspace_m, double cell_m);

  /// The cells as they are now; nothing to do when they have not changed since the last call.
  void follow(const SurfaceCells& cells, int threads);

  /// Those within reach.
  std::vector<const Block*> near(const Vec3& p_world_m, double reach_m) const;

  /// Of the sphere around a block's cells.
  float radius_m() const { return static_cast<float>(0.9 * lattice_.resolution_m()); }

 private:
  void sort_in(const SurfaceCells& cells);

  GridGeometry lattice_;
  ZeroedArray<std::uint32_t> slot_;  // 1 + index into blocks_
  std::vector<Block> blocks_;
  std::size_t taken_ = 0;      // cells that have a block
  std::uint64_t version_ = 0;  // of the cells, when they were packed
};

}  // namespace gnbv
