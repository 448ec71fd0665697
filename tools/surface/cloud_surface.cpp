#include "tools/surface/cloud_surface.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "planner/map/surface_cloud.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/text.hpp"
#include "tools/run/cloud_file.hpp"
#include "tools/surface/surface_picture.hpp"
#include "tools/surface/trim.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// Edge of the cubes of which each keeps one point.
double leaf_of(std::span<const Vec3f> points_m, const Box3& box_m, int threads) {
  constexpr double kFinest = 1e-3;  // of the extent
  std::vector<float> spacing_m = oriented_by_neighbours(points_m, threads).spacing_m;
  if (spacing_m.empty()) return 0.0;
  const auto middle = spacing_m.begin() + static_cast<std::ptrdiff_t>(spacing_m.size() / 2);
  std::nth_element(spacing_m.begin(), middle, spacing_m.end());
  return std::max(static_cast<double>(*middle), kFinest * box_m.sizes().maxCoeff());
}

/// Of each point to the surface, ascending.
std::vector<double> errors_m(std::span<const Vec3f> points_m, const TriangleMesh& shape,
                             double farthest_m, int threads) {
  const RayScene scene(World{.structure = shape, .has_ground = false});
  std::vector<double> errors(points_m.size());
  for_each_point(threads, errors.size(), [&](std::size_t i) {
    errors[i] = scene.distance_to_structure_m(points_m[i].cast<double>(), farthest_m);
  });
  std::sort(errors.begin(), errors.end());
  return errors;
}

}  // namespace

CloudSurface surface_of_cloud(const fs::path& cloud, const Vec3& offset_m,
                              const SurfaceSettings& settings, const fs::path& folder, int threads,
                              const SurfaceProgress& progress, std::vector<std::string>& notes) {
  const std::string name = cloud.string();
  progress(0.0, "reading");
  const std::vector<Vec3f> points_m = read_cloud(cloud, offset_m, &notes);
  Box3 box_m;
  for (const Vec3f& p_m : points_m) {
    if (!p_m.allFinite()) throw BadInput("{}: has points that are not finite", name);
    box_m.extend(p_m.cast<double>());
  }
  const double leaf_m = leaf_of(points_m, box_m, threads);
  if (!(leaf_m > 0.0)) throw BadInput("{}: its {} points lie on no surface", name, points_m.size());
  make_folder(folder);
  progress(0.05, "normals");
  const OrientedCloud oriented = oriented_by_neighbours(leaf_filter(points_m, leaf_m), threads);
  const TriangleMesh closed = shape_of(oriented, leaf_m, settings, name, threads, progress);
  constexpr double kSimplify_leaves = 0.2;
  const TexturedMesh mesh = with_height_colours(
      decimated(closed, settings.simplify_m.value_or(kSimplify_leaves * leaf_m)));
  progress(0.8, "distances");
  const double farthest_m = box_m.diagonal().norm();
  const std::vector<double> errors = errors_m(points_m, mesh.shape, farthest_m, threads);
  const double mean_m =
      std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
  const double p95_m = errors[(errors.size() - 1) * 95 / 100];
  progress(0.9, "writing");
  CloudSurface made{.files = write_surface(mesh, folder), .text = "", .json = ""};
  const std::size_t faces = mesh.shape.faces.size();
  const double area_m2 = surface_area_m2(mesh.shape);
  const nlohmann::ordered_json json = {
      {"schema", "gnbv-cloud-surface-1"},
      {"cloud", name},
      {"points", points_m.size()},
      {"leaf_m", leaf_m},
      {"faces", faces},
      {"area_m2", area_m2},
      {"error_m", {{"mean", mean_m}, {"p95", p95_m}, {"max", errors.back()}}}};
  made.json = json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  made.text = fmt::format(
      "{}: {} points, thinned to leaves of {:.3g} m; {} faces, {:.4g} m2\n"
      "error, the points' distance to the surface: mean {:.4f} m, 95 % within {:.4f} m, largest "
      "{:.4f} m\n"
      "fly it: gnbv run aircraft --mesh {} --bounds auto\n",
      name, grouped(points_m.size()), leaf_m, grouped(faces), area_m2, mean_m, p95_m, errors.back(),
      shell_word((folder / "surface.ply").string()));
  write_file_atomically(made.files.emplace_back(folder / "surface.json"), made.json);
  write_png(surface_picture(mesh, cloud.filename().string()),
            made.files.emplace_back(folder / "preview.png"));
  progress(1.0, "done");
  return made;
}

}  // namespace gnbv
