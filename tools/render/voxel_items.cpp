#include "tools/render/voxel_items.hpp"

#include <algorithm>
#include <array>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

// Corner i of a cube lies at the upper end along x, y, z where its bit 0, 1, 2 is set. The quads
// run counter-clockwise seen from outside: towards -x, +x, -y, +y, -z, +z.
constexpr std::array<std::array<std::uint32_t, 4>, 6> kQuads = {
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

Vec3f corner(const Vec3& centre_m, double half_m, std::uint32_t i) {
  return (centre_m +
          half_m * Vec3((i & 1U) != 0 ? 1 : -1, (i & 2U) != 0 ? 1 : -1, (i & 4U) != 0 ? 1 : -1))
      .cast<float>();
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
  item.crease_rad = 0.0;
  const double half_m = 0.5 * share * geometry.resolution_m();
  for (std::size_t v = 0; v < voxels.size(); ++v) {
    const auto first = static_cast<std::uint32_t>(item.mesh.vertices_m.size());
    const Vec3 centre_m = geometry.center_m(geometry.key_at(voxels[v]));
    for (std::uint32_t i = 0; i < 8; ++i) {
      item.mesh.vertices_m.push_back(corner(centre_m, half_m, i));
      item.vertex_colours.push_back(colours[colours.size() == 1 ? 0 : v]);
    }
    for (const auto& quad : kQuads) {
      item.mesh.faces.push_back({first + quad[0], first + quad[1], first + quad[2]});
      item.mesh.faces.push_back({first + quad[0], first + quad[2], first + quad[3]});
    }
  }
  return item;
}

SurfaceItem exposed_faces(const VoxelSet& voxels, double size_m, std::span<const Rgb> colours) {
  GNBV_CHECK(colours.size() == voxels.size(), "{} colours for {} voxels", colours.size(),
             voxels.size());
  SurfaceItem item;
  item.crease_rad = 0.0;
  for (std::size_t v = 0; v < voxels.size(); ++v) {
    const std::array<std::int64_t, 3> index = index_of(voxels[v]);
    const Vec3 centre_m = voxel_centre_m(voxels[v], size_m);
    for (std::size_t side = 0; side < kQuads.size(); ++side) {
      std::array<std::int64_t, 3> beside = index;
      beside[side / 2] += side % 2 == 0 ? -1 : 1;
      if (std::binary_search(voxels.begin(), voxels.end(), code_of(beside))) continue;
      const auto first = static_cast<std::uint32_t>(item.mesh.vertices_m.size());
      for (const std::uint32_t i : kQuads[side]) {
        item.mesh.vertices_m.push_back(corner(centre_m, 0.5 * size_m, i));
        item.vertex_colours.push_back(colours[v]);
      }
      item.mesh.faces.push_back({first, first + 1, first + 2});
      item.mesh.faces.push_back({first, first + 2, first + 3});
    }
  }
  return item;
}

SurfaceItem free_faces(const OccupancyGrid& grid, std::span<const VoxelIndex> voxels,
                       const Rgb& colour, float opacity) {
  const GridGeometry& geometry = grid.geometry();
  SurfaceItem item;
  item.crease_rad = 0.0;
  item.opacity = opacity;
  for (const VoxelIndex v : voxels) {
    const Key key = geometry.key_at(v);
    for (std::size_t side = 0; side < kQuads.size(); ++side) {
      if (!is_free(grid, neighbour(key, side))) continue;
      const auto first = static_cast<std::uint32_t>(item.mesh.vertices_m.size());
      for (const std::uint32_t i : kQuads[side]) {
        item.mesh.vertices_m.push_back(
            corner(geometry.center_m(key), 0.5 * geometry.resolution_m(), i));
      }
      item.mesh.faces.push_back({first, first + 1, first + 2});
      item.mesh.faces.push_back({first, first + 2, first + 3});
    }
  }
  item.vertex_colours.assign(item.mesh.vertices_m.size(), colour);
  return item;
}

bool is_hidden(const OccupancyGrid& grid, const RenderView& view, const Vec3& p_world_m,
               double beside_m) {
  const GridGeometry& geometry = grid.geometry();
  const Vec3 away_m = view.T_world_camera.translation() - p_world_m;
  const Vec3 along = away_m.normalized();
  for (double t = beside_m; t < away_m.norm(); t += 0.5 * geometry.resolution_m()) {
    const Vec3 at_m = p_world_m + t * along;
    if (grid.state_at(at_m) == VoxelState::occupied) return true;
    if (!geometry.contains(geometry.key_of(at_m)))
      return false;  // beyond the map, and away from it
  }
  return false;
}

bool shows(const RenderView& view, const OccupancyGrid& grid, const Vec3& p_world_m,
           double beside_m) {
  return is_within(view, p_world_m) && !is_hidden(grid, view, p_world_m, beside_m);
}

bool is_seen(const SurfaceItem& faces, const OccupancyGrid& grid, const RenderView& view) {
  const std::vector<Vec3f>& vertices_m = faces.mesh.vertices_m;
  const Vec3 eye_m = view.T_world_camera.translation();
  for (std::size_t i = 0; i + 3 < vertices_m.size(); i += 4) {
    const Vec3 first_m = vertices_m[i].cast<double>();
    const Vec3 middle_m = 0.5 * (first_m + vertices_m[i + 2].cast<double>());
    const Vec3 normal = (vertices_m[i + 1].cast<double>() - first_m)
                            .cross(vertices_m[i + 2].cast<double>() - first_m);
    if (normal.dot(eye_m - middle_m) <= 0.0) continue;
    if (shows(view, grid, middle_m, 0.5 * grid.geometry().resolution_m())) return true;
  }
  return false;
}

}  // namespace gnbv
