#include "tools/surface/surface.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/error.hpp"
#include "sim/core/module.hpp"
#include "tools/run/file_names.hpp"
#include "tools/surface/poisson_module.hpp"
#include "tools/surface/trim.hpp"

namespace gnbv {
namespace {

constexpr int kDeepestByItself = 10;
constexpr double kCell_leaves = 1.5;
constexpr double kTexelsPerLeaf = 4.0;
constexpr double kScrapSide_leaves = 10.0;  // parts smaller than this square are dropped

/// What is wrong with the pictures, and how to come by better ones.
std::string without_pictures(const RunRecord& record, std::string_view why) {
  return fmt::format("{}; colours show the height; {} flies it again and keeps its frames", why,
                     command_to_fly_again(record.folder, "--frames"));
}

/// The frames of a run, and each as a view of the surface.
struct RunPictures {
  FrameRecord frames;
  std::vector<TextureView> views;
};

/// Nothing when the run has no frames, or one is damaged. Depth images are read, pictures not yet.
std::optional<RunPictures> read_pictures(const RunRecord& record, int threads,
                                         std::vector<std::string>& notes) {
  if (!has_frames(record.folder)) {
    notes.push_back(why_no_frames(record) + "; colours show the height");
    return std::nullopt;
  }
  try {
    FrameRecord frames = read_frames(record.folder);
    std::vector<TextureView> views = texture_views(frames, record.scenario.cameras, threads);
    return RunPictures{std::move(frames), std::move(views)};
  } catch (const BadInput& error) {
    notes.push_back(without_pictures(record, error.what()));
    return std::nullopt;
  }
}

/// The shape with the run's pictures on it; with colours by height when none shows any of it or a
/// picture is damaged.
TexturedMesh dressed(TriangleMesh shape, const RunRecord& record, const RunPictures& pictures,
                     const SurfaceSettings& settings, int threads, const SurfaceProgress& progress,
                     std::vector<std::string>& notes) {
  const std::vector<TextureView>& views = pictures.views;
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
                                (record.folder / kFramesFolder).string()));
    return with_height_colours(std::move(shape));
  }
  progress(0.85, fmt::format("texture of {} x {} px, {} charts", layout.width, layout.height,
                             layout.charts.size()));
  Image baked;
  try {
    baked = bake_atlas(
        layout, [&](std::uint32_t view) { return read_colour(pictures.frames, view); }, threads);
  } catch (const BadInput& error) {
    notes.push_back(without_pictures(record, error.what()));
    return with_height_colours(std::move(shape));
  }
  TexturedMesh mesh = with_texture(std::move(shape), layout, std::move(baked));
  if (!settings.has_texture) {  // the colours of the vertices stay
    mesh.face_uv.clear();
    mesh.atlas = {};
  }
  return mesh;
}

}  // namespace

PoissonSurface& poisson_module() {
  static void* const function = function_in_module(
      {GNBV_POISSON_MODULE, GNBV_POISSON_MODULE_AS_BUILT, "PCL, Debian package libpcl-dev"},
      "gnbv_poisson_surface");
  return *reinterpret_cast<PoissonSurface*>(function);
}

int depth_for(const Box3& points_m, double cell_m) {
  const double extent_m = kPoissonScale * points_m.sizes().maxCoeff();
  if (!(extent_m > cell_m)) return kMinDepth;
  return std::clamp(static_cast<int>(std::lround(std::log2(extent_m / cell_m))), kMinDepth,
                    kDeepestByItself);
}

TriangleMesh shape_of(const OrientedCloud& cloud, double leaf_m, const SurfaceSettings& settings,
                      const std::string& name, int threads, const SurfaceProgress& progress) {
  if (cloud.points_world_m.empty()) {
    throw BadInput(
        "{}: its points lie on no surface: they are fewer than 3, or on one line; a run of more "
        "views sees more",
        name);
  }
  GNBV_CHECK(cloud.points_world_m.size() == cloud.normals_world.size() &&
                 cloud.points_world_m.size() == cloud.spacing_m.size(),
             "{} points", cloud.points_world_m.size());
  Box3 box;
  for (const Vec3f& p_m : cloud.points_world_m) box.extend(p_m.cast<double>());
  const int depth = settings.depth > 0 ? settings.depth : depth_for(box, kCell_leaves * leaf_m);
  progress(0.1, fmt::format("Poisson, depth {}, {} points", depth, cloud.points_world_m.size()));
  TriangleMesh closed;
  poisson_module()(cloud.points_world_m, cloud.normals_world, {.depth = depth}, closed);
  progress(0.6, "trimming");
  const TriangleMesh near =
      trimmed(closed, cloud, {.reach_m = settings.trim_m, .reach_max_m = 6.0 * leaf_m}, threads);
  if (near.faces.empty()) {
    throw BadInput("{}: {} points hold no surface together; a larger --trim-m keeps more of it",
                   name, cloud.points_world_m.size());
  }
  const double scrap_m2 = kScrapSide_leaves * leaf_m * kScrapSide_leaves * leaf_m;
  TriangleMesh shape = without_scraps(near, scrap_m2);
  if (shape.faces.empty()) {
    throw BadInput(
        "{}: {} points hold nothing but scraps of less than {:.2g} m2 together; a run of more "
        "views sees more",
        name, cloud.points_world_m.size(), scrap_m2);
  }
  return shape;
}

TexturedMesh reconstruct_surface(const RunRecord& record, const SurfaceSettings& settings,
                                 int threads, const SurfaceProgress& progress,
                                 std::vector<std::string>& notes) {
  progress(0.0, "normals");
  const RunCloud cloud = read_run_cloud(record);
  const std::optional<RunPictures> pictures = read_pictures(record, threads, notes);
  const OrientedCloud points = oriented(seen_points(record, cloud, threads), threads);
  TriangleMesh shape = shape_of(points, record.scenario.planner.cloud.leaf_m, settings,
                                (record.folder / kCloudFile).string(), threads, progress);
  progress(0.62, fmt::format("simplifying {} faces", shape.faces.size()));
  constexpr double kSimplify_leaves = 0.2;
  const double leaf_m = record.scenario.planner.cloud.leaf_m;
  shape = decimated(shape, settings.simplify_m.value_or(kSimplify_leaves * leaf_m));
  if (!pictures) return with_height_colours(std::move(shape));
  return dressed(std::move(shape), record, *pictures, settings, threads, progress, notes);
}

}  // namespace gnbv
