#include "tools/render/chosen_view_item.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/render/flight_items.hpp"

namespace gnbv {

const ChosenViewLook kChosenLook = {.chosen = srgb(0xd5420a),
                                    .pyramid = srgb(0x2b323c),
                                    .before = srgb(0x14181e),
                                    .ray_free = srgb(0x9aa5b3),
                                    .ray_unknown = srgb(0xe69f00),
                                    .hit = srgb(0x14181e)};

namespace {

constexpr int kRaysAcross = 9;
constexpr int kRaysDown = 7;

/// Where a ray's way through a box ends; 0 where it misses the box.
double exit_m(const Box3& box_m, const Vec3& from, const Vec3& along) {
  double enter = 0.0;
  double exit = std::numeric_limits<double>::infinity();
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double low = (box_m.min()[k] - from[k]) / along[k];
    const double high = (box_m.max()[k] - from[k]) / along[k];
    if (std::isnan(low) || std::isnan(high)) continue;  // along a face
    enter = std::max(enter, std::min(low, high));
    exit = std::min(exit, std::max(low, high));
  }
  return enter < exit ? exit : 0.0;
}

struct RayPiece {
  Vec3 begin, end;
  bool is_unknown;
};

/// A ray up to the first occupied voxel, in pieces through free ones and through unknown ones.
struct Ray {
  std::vector<RayPiece> pieces = {};
  bool is_hit = false;
};

Ray cast_ray(const OccupancyGrid& grid, const Vec3& from, const Vec3& along, double length_m) {
  const double step_m = 0.25 * grid.geometry().resolution_m();
  VoxelState state = grid.state_at(from);
  Vec3 begin = from;
  Ray ray;
  const auto end_piece = [&](const Vec3& end) {
    ray.pieces.push_back({begin, end, state == VoxelState::unknown});
    begin = end;
  };
  for (double t = 0.0; t < length_m && !ray.is_hit; t += step_m) {
    const VoxelState next = grid.state_at(from + t * along);
    ray.is_hit = next == VoxelState::occupied;
    if (next != state) end_piece(from + t * along);
    state = next;
  }
  if (!ray.is_hit) end_piece(from + length_m * along);
  return ray;
}

/// Rays that say something: that end on a surface, or run through unknown voxels near it.
void add_ray(const Ray& ray, double unit_m, RenderScene& scene) {
  const bool meets_unknown = std::any_of(ray.pieces.begin(), ray.pieces.end(),
                                         [](const RayPiece& piece) { return piece.is_unknown; });
  if (!ray.is_hit && !meets_unknown) return;
  for (const RayPiece& piece : ray.pieces) {
    const Rgb& colour = piece.is_unknown ? kChosenLook.ray_unknown : kChosenLook.ray_free;
    scene.tubes.push_back({{piece.begin.cast<float>(), piece.end.cast<float>()},
                           {colour},
                           static_cast<float>((piece.is_unknown ? 1.6 : 1.2) * unit_m)});
  }
  if (!ray.is_hit) return;
  scene.balls.push_back(
      {ray.pieces.back().end.cast<float>(), static_cast<float>(4.0 * unit_m), kChosenLook.hit});
}

/// Of the pyramid no more than what says where it looks.
FrustumItem outline_of(const CameraConfig& camera, const ViewPose& view, double length_m,
                       double unit_m) {
  FrustumItem frustum =
      frustum_of(camera, T_world_body(view), view.gimbal_pitch_rad, length_m, kChosenLook.pyramid);
  frustum.edge_radius_m = static_cast<float>(1.3 * unit_m);
  return frustum;
}

}  // namespace

void add_chosen_view(const RunRecord& record, const World& world, const Belief& belief,
                     std::size_t iteration, double unit_m, RenderScene& scene) {
  const ViewPose& view = record.views[iteration].decision.view;
  const double beside_m = 3.0 * belief.grid.geometry().resolution_m();
  Box3 near_m = bounds_m(world.structure);
  near_m = Box3(near_m.min().array() - beside_m, near_m.max().array() + beside_m);
  for (const CameraConfig& camera : record.scenario.cameras) {
    const FrustumItem frustum = outline_of(camera, view, 60.0 * unit_m, unit_m);
    add_hung(frustum, view, unit_m, scene);
    const Vec3 eye = frustum.T_world_camera.translation();
    for (int row = 0; row < kRaysDown; ++row) {
      for (int column = 0; column < kRaysAcross; ++column) {
        const double x = 2.0 * (column + 0.5) / kRaysAcross - 1.0;
        const double y = 2.0 * (row + 0.5) / kRaysDown - 1.0;
        const Vec3 ahead =
            Vec3(x * std::tan(0.5 * camera.fov_x_rad), y * std::tan(0.5 * camera.fov_y_rad), 1.0);
        const Vec3 along = frustum.T_world_camera.linear() * ahead.normalized();
        const double length_m =
            std::min(camera.range_max_m * ahead.norm(), exit_m(near_m, eye, along));
        if (length_m > 0.0) add_ray(cast_ray(belief.grid, eye, along, length_m), unit_m, scene);
      }
    }
  }
}

std::vector<PlaceLine> way_to_chosen(const RunRecord& record, std::size_t iteration) {
  std::vector<Vec3> way = {record.views[iteration - 1].decision.view.p_world_m};
  const auto& via = record.views[iteration].decision.via_world_m;
  way.insert(way.end(), via.begin(), via.end());
  way.push_back(record.views[iteration].decision.view.p_world_m);
  const Rgb8 chosen = to_rgb8(kChosenLook.chosen);
  constexpr Rgb8 kWhite = {255, 255, 255};
  std::vector<PlaceLine> lines = {{way.back(), way.back(), chosen, 14.0}};
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    lines.push_back({way[i], way[i + 1], chosen, 2.4});
  }
  lines.push_back({way.back(), way.back(), kWhite, 6.0});
  // the smaller ring, uppermost: a way too short to be seen leaves one within the other
  lines.push_back({way.front(), way.front(), to_rgb8(kChosenLook.before), 8.0});
  lines.push_back({way.front(), way.front(), kWhite, 3.0});
  return lines;
}

}  // namespace gnbv
