#include "tools/surface/surface.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/error.hpp"
#include "tools/surface/poisson_module.hpp"
#include "tools/surface/trim.hpp"

namespace gnbv {
namespace {

constexpr int kDeepestByItself = 10;
constexpr double kCell_leaves = 1.5;
constexpr double kTexelsPerLeaf = 4.0;
constexpr double kScrapSide_leaves = 10.0;  // parts smaller than this square are dropped

/// Colours of the vertices are those of the texture; without it, its atlas goes.
void drop_texture(TexturedMesh& mesh) {
  mesh.face_uv.clear();
  mesh.atlas = {};
}

}  // namespace

int depth_for(const Box3& points_m, double cell_m) {
  const double extent_m = kPoissonScale * points_m.sizes().maxCoeff();
  if (!(extent_m > cell_m)) return kMinDepth;
  return std::clamp(static_cast<int>(std::lround(std::log2(extent_m / cell_m))), kMinDepth,
                    kDeepestByItself);
}

TriangleMesh shape_of(const OrientedCloud& cloud, double leaf_m, const SurfaceSettings& settings,
                      const std::string& name, int threads, const SurfaceProgress& progress) {
  Box3 box;
  for (const Vec3f& p_m : cloud.points_world_m) box.extend(p_m.cast<double>());
  const int depth = settings.depth > 0 ? settings.depth : depth_for(box, kCell_leaves * leaf_m);
  progress(0.1, fmt::format("Poisson, depth {}, {} points", depth, cloud.points_world_m.size()));
  TriangleMesh closed;
  poisson_module()(cloud.points_world_m, cloud.normals_world, {.depth = depth}, closed);
  progress(0.6, "trimming");
  const double scrap_m = kScrapSide_leaves * leaf_m;
  TriangleMesh shape = trimmed(
      closed, cloud,
      {.reach_m = settings.trim_m, .reach_max_m = 6.0 * leaf_m, .part_min_m2 = scrap_m * scrap_m},
      threads);
  if (shape.faces.empty()) {
    throw BadInput(
        fmt::format("{}: {} points hold no surface together; a larger --trim-m keeps more of it",
                    name, cloud.points_world_m.size()));
  }
  return shape;
}

TexturedMesh dressed(TriangleMesh shape, const RunRecord& record, const SurfaceSettings& settings,
                     int threads, const SurfaceProgress& progress,
                     std::vector<std::string>& notes) {
  if (!has_frames(record.folder)) {
    notes.push_back(
        fmt::format("{}: has no frames, so that colours show the height; {} flies it "
                    "again and keeps them",
                    record.folder.string(), command_to_fly_again(record.folder, "--frames")));
    return with_height_colours(std::move(shape));
  }
  const FrameRecord frames = read_frames(record.folder);
  const std::vector<TextureView> views = texture_views(frames, record.scenario.cameras, threads);
  const double texels_per_m = kTexelsPerLeaf / record.scenario.planner.cloud.leaf_m;
  progress(0.65, fmt::format("choosing among {} pictures for {} faces", views.size(),
                             shape.faces.size()));
  const RayScene scene(World{.structure = shape, .has_ground = false});
  const std::vector<std::int32_t> chosen =
      choose_views(shape, scene, views, {.texels_per_m = texels_per_m}, threads);
  const AtlasLayout layout = lay_out_atlas(
      shape, chosen, views, {.texels_per_m = texels_per_m, .max_side_px = settings.texture_px});
  if (layout.charts.empty()) {
    notes.push_back(fmt::format("{}: no picture shows the surface; colours show the height",
                                (record.folder / "frames").string()));
    return with_height_colours(std::move(shape));
  }
  progress(0.85, fmt::format("texture of {} x {} px, {} charts", layout.width, layout.height,
                             layout.charts.size()));
  const auto picture = [&](std::uint32_t view) { return read_png(frames.frames[view].colour); };
  TexturedMesh mesh = with_texture(std::move(shape), layout, bake_atlas(layout, picture, threads));
  if (!settings.has_texture) drop_texture(mesh);
  return mesh;
}

TexturedMesh reconstruct_surface(const RunRecord& record, const SurfaceSettings& settings,
                                 int threads, const SurfaceProgress& progress,
                                 std::vector<std::string>& notes) {
  progress(0.0, "normals");
  const RunCloud cloud = read_run_cloud(record);
  const OrientedCloud points = oriented(seen_points(record, cloud, threads), threads);
  TriangleMesh shape = shape_of(points, record.scenario.planner.cloud.leaf_m, settings,
                                (record.folder / "cloud.ply").string(), threads, progress);
  return dressed(std::move(shape), record, settings, threads, progress, notes);
}

}  // namespace gnbv
