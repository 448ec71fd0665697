#include "tools/scene/structure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/parallel.hpp"
#include "tools/scene/flight.hpp"

namespace gnbv {
namespace {

void add_in_one_colour(const TriangleMesh& mesh, const Look& look, float opacity,
                       RenderScene& scene) {
  if (mesh.faces.empty()) return;
  SurfaceItem& surface = scene.surfaces.emplace_back();
  surface.mesh = mesh;
  surface.vertex_colours.assign(mesh.vertices_m.size(), look.rgb());
  surface.opacity = opacity;
}

/// Joints of panels are narrower than a pixel of an aircraft: one ray a pixel would tear them into
/// dots.
constexpr int kRaysASide = 2;
constexpr int kRays = kRaysASide * kRaysASide;

/// Through the pixels of one row, those of a pixel beside each other.
std::vector<Vec3f> directions_world(const RenderView& view, const PaintItem& paint, int row) {
  const double tan_y = std::tan(0.5 * view.fov_y_rad);
  const double per_ray = 2.0 * tan_y / (kRaysASide * paint.height_px);
  const Eigen::Matrix3d R_world_camera = view.T_world_camera.linear();
  std::vector<Vec3f> directions;
  directions.reserve(static_cast<std::size_t>(kRays * paint.width_px));
  for (int column = 0; column < paint.width_px; ++column) {
    for (int ray = 0; ray < kRays; ++ray) {
      const double right = kRaysASide * column + ray % kRaysASide + 0.5;
      const double up = kRaysASide * row + ray / kRaysASide + 0.5;
      const Vec3 p_camera(per_ray * (right - 0.5 * kRaysASide * paint.width_px),
                          per_ray * (0.5 * kRaysASide * paint.height_px - up), 1.0);
      directions.push_back((R_world_camera * p_camera).cast<float>());
    }
  }
  return directions;
}

}  // namespace

void frame_structure(RunSource& run, std::vector<Vec3>& points_world_m) {
  for (const Vec3f& v : run.world().structure.vertices_m) {
    points_world_m.push_back(v.cast<double>());
  }
}

void add_ground(RunSource& run, RenderScene& scene) {
  if (has_flat_ground(run.record().scenario)) scene.ground = GroundItem{};
  if (run.world().terrain.faces.empty()) return;
  add_in_one_colour(run.world().terrain, looks::kTerrain, 1.0F, scene);
  scene.surfaces.back().casts_shadow = false;
}

/// Bodies where they are then, and the ways that they go, through their middles.
void add_movers(RunSource& run, double time_s, float opacity, RenderScene& scene) {
  for (const MovingBody& mover : run.world().movers) {
    const Box3 box_m = bounds_m(mover.mesh);
    TriangleMesh mesh = mover.mesh;
    for (Vec3f& p_m : mesh.vertices_m) p_m += mover.motion.offset_at(time_s).cast<float>();
    add_in_one_colour(mesh, looks::kObstacle, opacity, scene);
    std::vector<Vec3> way = mover.motion.corners_m();
    for (Vec3& corner_m : way) corner_m += box_m.center();
    scene.tubes.push_back(path_tube(way, 0.0015 * box_m.diagonal().norm(), looks::kObstacle.rgb()));
  }
}

void add_surroundings(RunSource& run, RenderScene& scene) {
  add_in_one_colour(run.world().obstacles, looks::kObstacle, 1.0F, scene);
  add_movers(run, 0.0, 1.0F, scene);
  TriangleMesh boxes;
  for (const NoFlyConfig& keep_out : run.record().scenario.no_fly) {
    append(boxes, box_mesh(keep_out.box_m));
  }
  add_in_one_colour(boxes, looks::kNoFly, 0.3F, scene);
}

std::vector<LegendItem> legend_of_surroundings(RunSource& run) {
  const Scenario& scenario = run.record().scenario;
  std::vector<LegendItem> legend;
  if (!scenario.obstacles.empty()) legend.push_back(entry(looks::kObstacle));
  if (!scenario.no_fly.empty()) legend.push_back(entry(looks::kNoFly));
  return legend;
}

void add_ghost(RunSource& run, float opacity, RenderScene& scene, double time_s) {
  add_ground(run, scene);
  add_in_one_colour(run.world().structure, looks::kStructure, opacity, scene);
  add_in_one_colour(run.world().obstacles, looks::kObstacle, opacity, scene);
  add_movers(run, time_s, opacity, scene);
}

void add_structure(RunSource& run, const RenderView& view, RenderScene& scene) {
  add_ground(run, scene);
  const std::size_t faces = run.world().structure.faces.size();
  if (faces == 0) return;
  SurfaceItem& surface = scene.surfaces.emplace_back();
  surface.mesh = run.world().structure;
  surface.is_painted = true;
  scene.paint = paint_of_structure(run.scene(), faces, view, run.threads());
  add_surroundings(run, scene);
}

PaintItem paint_of_structure(const RayScene& scene, std::size_t structure_faces,
                             const RenderView& view, int threads) {
  PaintItem paint{.width_px = 2 * view.width_px, .height_px = 2 * view.height_px};
  const auto width = static_cast<std::size_t>(paint.width_px);
  paint.rgba.resize(4 * width * static_cast<std::size_t>(paint.height_px));
  const Vec3f eye_m = view.T_world_camera.translation().cast<float>();
  parallel_for(threads, static_cast<std::size_t>(paint.height_px), [&](std::size_t row) {
    const std::vector<Vec3f> directions = directions_world(view, paint, static_cast<int>(row));
    std::vector<RayHit> hits(directions.size());
    scene.first_hits(eye_m, directions, 0.0F, std::numeric_limits<float>::infinity(), hits);
    for (std::size_t column = 0; column < width; ++column) {
      Vec3f sum = Vec3f::Zero();
      float count = 0.0F;
      for (std::size_t i = kRays * column; i < kRays * (column + 1); ++i) {
        const RayHit& hit = hits[i];
        if (hit.face < 0 || static_cast<std::size_t>(hit.face) >= structure_faces) continue;
        const Vec3f n = scene.normal_world(hit.face);
        const Vec3f p_world_m = eye_m + hit.distance_m * directions[i];
        const auto [r, g, b] =
            scene.albedo(hit.face, p_world_m, n.dot(directions[i]) > 0.0F ? Vec3f(-n) : n);
        sum += Vec3f(r, g, b);
        count += 1.0F;
      }
      if (count == 0.0F) continue;
      std::uint8_t* const pixel = paint.rgba.data() + 4 * (width * row + column);
      for (Eigen::Index k = 0; k < 3; ++k)
        pixel[k] = srgb_byte(std::clamp(sum[k] / count, 0.0F, 1.0F));
      pixel[3] = 255;
    }
  });
  return paint;
}

}  // namespace gnbv
