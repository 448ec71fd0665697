#include "tools/scene/voxels.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <unordered_map>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

// Corner i of a cube lies at the upper end along x, y, z where its bit 0, 1, 2 is set. The quads
// run counter-clockwise seen from outside: towards -x, +x, -y, +y, -z, +z.
constexpr std::array<std::array<std::uint32_t, 4>, 6> kQuads = {
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

/// Adds those of a cube's six faces that `is_shown(side)`: four corners and two triangles each.
template <typename IsShown>
void add_cube(const Vec3& centre_m, double half_m, const Rgb& colour, const IsShown& is_shown,
              SurfaceItem& item) {
  item.crease_rad = 0.0;
  for (std::size_t side = 0; side < kQuads.size(); ++side) {
    if (!is_shown(side)) continue;
    const auto first = static_cast<std::uint32_t>(item.mesh.vertices_m.size());
    for (const std::uint32_t i : kQuads[side]) {
      const Vec3 corner((i & 1U) != 0 ? 1 : -1, (i & 2U) != 0 ? 1 : -1, (i & 4U) != 0 ? 1 : -1);
      item.mesh.vertices_m.push_back((centre_m + half_m * corner).cast<float>());
      item.vertex_colours.push_back(colour);
    }
    item.mesh.faces.push_back({first, first + 1, first + 2});
    item.mesh.faces.push_back({first, first + 2, first + 3});
  }
}

Key neighbour(Key key, std::size_t quad) {
  key[quad / 2] += quad % 2 == 0 ? -1 : 1;
  return key;
}

bool is_free(const OccupancyGrid& grid, const Key& key) {
  const GridGeometry& geometry = grid.geometry();
  return geometry.contains(key) && grid.state(geometry.index_of(key)) == VoxelState::free;
}

bool touches_free(const OccupancyGrid& grid, const Key& key) {
  for (std::size_t quad = 0; quad < 6; ++quad) {
    if (is_free(grid, neighbour(key, quad))) return true;
  }
  return false;
}

void mark_around(const GridGeometry& geometry, const Key& key, std::vector<bool>& marks) {
  constexpr int r = kNearSurface_voxels;
  for (int z = -r; z <= r; ++z) {
    for (int y = -r; y <= r; ++y) {
      for (int x = -r; x <= r; ++x) {
        const Key at = {key[0] + x, key[1] + y, key[2] + z};
        if (geometry.contains(at)) marks[geometry.index_of(at)] = true;
      }
    }
  }
}

/// Sums over points, about one place for all.
struct Moments {
  double count = 0.0;
  Vec3 sum = Vec3::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();

  Vec3f normal() const {
    if (count < 3.0) return Vec3f::Zero();
    const Vec3 mean = sum / count;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(products / count -
                                                                mean * mean.transpose());
    // points along a line have no normal
    if (solver.eigenvalues()[1] < 1e-9) return Vec3f::Zero();
    return solver.eigenvectors().col(0).cast<float>();
  }
};

}  // namespace

SortedVoxels sort_voxels(const OccupancyGrid& grid) {
  const GridGeometry& geometry = grid.geometry();
  const auto count = static_cast<VoxelIndex>(geometry.voxel_count());
  SortedVoxels sorted;
  std::vector<bool> is_near(count, false);
  for (VoxelIndex v = 0; v < count; ++v) {
    const bool is_occupied = grid.state(v) == VoxelState::occupied;
    if (is_occupied) sorted.occupied.push_back(v);
    if (grid.is_predicted(v)) sorted.predicted.push_back(v);
    if (is_occupied || grid.is_predicted(v)) mark_around(geometry, geometry.key_at(v), is_near);
  }
  for (VoxelIndex v = 0; v < count; ++v) {
    if (!is_near[v] || grid.state(v) != VoxelState::unknown || grid.is_predicted(v)) continue;
    if (touches_free(grid, geometry.key_at(v))) sorted.unknown.push_back(v);
  }
  return sorted;
}

SurfaceItem voxel_cubes(const GridGeometry& geometry, std::span<const VoxelIndex> voxels,
                        std::span<const Rgb> colours, double share) {
  GNBV_CHECK(colours.size() == 1 || colours.size() == voxels.size(), "{} colours for {} voxels",
             colours.size(), voxels.size());
  SurfaceItem item;
  for (std::size_t v = 0; v < voxels.size(); ++v) {
    add_cube(
        geometry.center_m(geometry.key_at(voxels[v])), 0.5 * share * geometry.resolution_m(),
        colours[colours.size() == 1 ? 0 : v], [](std::size_t) { return true; }, item);
  }
  return item;
}

SurfaceItem exposed_faces(const VoxelSet& voxels, double size_m, std::span<const Rgb> colours) {
  GNBV_CHECK(colours.size() == voxels.size(), "{} colours for {} voxels", colours.size(),
             voxels.size());
  SurfaceItem item;
  for (std::size_t v = 0; v < voxels.size(); ++v) {
    const auto is_exposed = [&](std::size_t side) {
      std::array<std::int64_t, 3> beside = index_of(voxels[v]);
      beside[side / 2] += side % 2 == 0 ? -1 : 1;
      return !std::binary_search(voxels.begin(), voxels.end(), code_of(beside));
    };
    add_cube(voxel_centre_m(voxels[v], size_m), 0.5 * size_m, colours[v], is_exposed, item);
  }
  return item;
}

SurfaceItem free_faces(const OccupancyGrid& grid, std::span<const VoxelIndex> voxels,
                       const Rgb& colour, float opacity) {
  const GridGeometry& geometry = grid.geometry();
  SurfaceItem item;
  item.opacity = opacity;
  for (const VoxelIndex v : voxels) {
    const Key key = geometry.key_at(v);
    add_cube(
        geometry.center_m(key), 0.5 * geometry.resolution_m(), colour,
        [&](std::size_t side) { return is_free(grid, neighbour(key, side)); }, item);
  }
  return item;
}

bool shows(const RenderView& view, const OccupancyGrid& grid, const Vec3& p_world_m,
           double beside_m) {
  if (!is_within(view, p_world_m)) return false;
  const GridGeometry& geometry = grid.geometry();
  const Vec3 away_m = view.T_world_camera.translation() - p_world_m;
  const Vec3 along = away_m.normalized();
  for (double t = beside_m; t < away_m.norm(); t += 0.5 * geometry.resolution_m()) {
    const Vec3 at_m = p_world_m + t * along;
    if (grid.state_at(at_m) == VoxelState::occupied) return false;
    if (!geometry.contains(geometry.key_of(at_m))) return true;  // beyond the map, and away from it
  }
  return true;
}

bool shows_any(const RenderView& view, const OccupancyGrid& grid, const RenderScene& scene,
               const Rgb& colour) {
  const double resolution_m = grid.geometry().resolution_m();
  const auto is_shown = [&](const Vec3f& p_m, double beside_m) {
    return shows(view, grid, p_m.cast<double>(), beside_m);
  };
  const Vec3f eye_m = view.T_world_camera.translation().cast<float>();
  const auto shows_face = [&](const SurfaceItem& surface, std::size_t first) {
    const Vec3f* const corner_m = surface.mesh.vertices_m.data() + first;
    const Vec3f middle_m = 0.5F * (corner_m[0] + corner_m[2]);
    const Vec3f normal = (corner_m[1] - corner_m[0]).cross(corner_m[2] - corner_m[0]);
    return normal.dot(eye_m - middle_m) > 0.0F && is_shown(middle_m, 0.5 * resolution_m);
  };
  for (const SurfaceItem& surface : scene.surfaces) {
    for (std::size_t k = 0; k + 3 < surface.vertex_colours.size(); k += 4) {
      if (surface.vertex_colours[k] == colour && shows_face(surface, k)) return true;
    }
  }
  const double within_m = 0.9 * resolution_m;
  return std::any_of(scene.tubes.begin(), scene.tubes.end(),
                     [&](const TubeItem& tube) {
                       const Vec3f middle_m = 0.5F * (tube.points_m.front() + tube.points_m.back());
                       return tube.colours.front() == colour && is_shown(middle_m, within_m);
                     }) ||
         std::any_of(scene.balls.begin(), scene.balls.end(),
                     [&](const BallItem& ball) {
                       return ball.colour == colour && is_shown(ball.centre_m, within_m);
                     }) ||
         std::any_of(scene.dots.begin(), scene.dots.end(), [&](const DotsItem& dots) {
           return dots.colours.front() == colour &&
                  std::ranges::any_of(dots.points_m,
                                      [&](const Vec3f& p_m) { return is_shown(p_m, within_m); });
         });
}

std::vector<Vec3f> point_normals(std::span<const Vec3f> points_world_m, double cell_m) {
  std::unordered_map<std::uint64_t, Moments> cells;
  for (const Vec3f& p_m : points_world_m) {
    const Vec3 away_m = (p_m - points_world_m.front()).cast<double>();
    Moments& cell = cells[voxel_code(p_m, cell_m)];
    cell.count += 1.0;
    cell.sum += away_m;
    cell.products += away_m * away_m.transpose();
  }
  std::unordered_map<std::uint64_t, Vec3f> normal_of;
  for (const auto& [code, own] : cells) {
    const Vec3 centre_m = voxel_centre_m(code, cell_m);
    Moments around;
    for (int k = 0; k < 27; ++k) {
      const Vec3 by_m = cell_m * Vec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
      const auto cell = cells.find(voxel_code((centre_m + by_m).cast<float>(), cell_m));
      if (cell == cells.end()) continue;
      around.count += cell->second.count;
      around.sum += cell->second.sum;
      around.products += cell->second.products;
    }
    normal_of[code] = around.normal();
  }
  std::vector<Vec3f> normals;
  for (const Vec3f& p_m : points_world_m) normals.push_back(normal_of[voxel_code(p_m, cell_m)]);
  return normals;
}

DotsItem cloud_dots(std::span<const Vec3f> points_world_m, double leaf_m, const Rgb& colour) {
  return {.points_m = {points_world_m.begin(), points_world_m.end()},
          .normals = point_normals(points_world_m, 2.5 * leaf_m),
          .colours = {colour},
          .radius_m = static_cast<float>(0.75 * leaf_m)};
}

}  // namespace gnbv
