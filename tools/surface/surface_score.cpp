#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/compare/text_table.hpp"
#include "sim/core/error.hpp"
#include "sim/core/rng.hpp"
#include "sim/mesh/mesh_lint.hpp"
#include "tools/surface/surface.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kSamples = 500'000;  // shares are then good to 0.1 %
constexpr std::uint64_t kSeed = 1;

}  // namespace

std::vector<Vec3f> samples_by_area(const TriangleMesh& mesh, std::size_t count,
                                   std::uint64_t seed) {
  std::vector<double> area_until_m2;
  double total_m2 = 0.0;
  for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
    total_m2 += face_area_m2(mesh, face);
    area_until_m2.push_back(total_m2);
  }
  std::vector<Vec3f> samples;
  if (!(total_m2 > 0.0)) return samples;
  samples.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto draw = [&](std::uint64_t which) {
      return uniform01({seed, Stream::surface_sample, which, i});
    };
    const double at_m2 = (static_cast<double>(i) + draw(0)) / static_cast<double>(count) * total_m2;
    const auto found = std::upper_bound(area_until_m2.begin(), area_until_m2.end(), at_m2);
    const auto face =
        std::min(static_cast<std::size_t>(found - area_until_m2.begin()), mesh.faces.size() - 1);
    // uniform over a triangle (Osada et al. 2002)
    const double root = std::sqrt(draw(1));
    const double share = draw(2);
    const auto corner = [&](std::size_t k) {
      return mesh.vertices_m[mesh.faces[face][k]].cast<double>();
    };
    const Vec3 p_m =
        (1.0 - root) * corner(0) + root * (1.0 - share) * corner(1) + root * share * corner(2);
    samples.push_back(p_m.cast<float>());
  }
  return samples;
}

SurfaceScore score_surface(const TriangleMesh& surface, const World& truth,
                           const ReferenceConfig& config, int threads) {
  std::vector<Vec3f> samples_m = samples_by_area(surface, kSamples, kSeed);
  const RayScene true_scene(truth);
  const std::vector<std::uint8_t> is_own = points_of_structure(true_scene, samples_m, threads);
  std::size_t sample = 0;
  std::erase_if(samples_m, [&](const Vec3f& p_m) {
    return is_own[sample++] == 0 || static_cast<double>(p_m.z()) < config.floor_z_m ||
           !config.region_m.contains(p_m.cast<double>());
  });
  const SurfaceReference reference = cached_surface_reference(truth, true_scene, config, threads);
  // a point's distance to a surface is exact, so that the reference takes the part of the cloud
  const RayScene found_scene(World{.structure = surface, .has_ground = false});
  return {.distances =
              cloud_distances(shares_to_structure(true_scene, samples_m, threads),
                              shares_to_structure(found_scene, reference.samples_world_m, threads)),
          .samples = samples_m.size(),
          .floor_z_m = config.floor_z_m};
}

std::string score_text(const SurfaceScore& score, const std::string& name, std::size_t width) {
  TextTable table{.title = fmt::format("{}: the surface against the true one, above z = {} m", name,
                                       score.floor_z_m),
                  .columns = {{"Within", "distance_m", ColumnKind::text},
                              {"Precision", "precision", ColumnKind::number},
                              {"Recall", "recall", ColumnKind::number},
                              {"F", "f", ColumnKind::number}},
                  .rows = {},
                  .notes = {}};
  const auto percent = [](double share) {
    return TableCell{fmt::format("{:.1f}%", 100.0 * share), {share}};
  };
  for (const DistanceScore& at : score.distances.at) {
    table.rows.push_back({TableCell{fmt::format("{:.2f} m", at.distance_m)}, percent(at.precision),
                          percent(at.recall), percent(at.f)});
  }
  table.notes.push_back(
      fmt::format("Accuracy {:.4f} m (surface to truth), completeness {:.4f} m (truth, as seen "
                  "from outside, to surface); beyond {} m counts as that",
                  score.distances.accuracy_m, score.distances.completeness_m, kFarthest_m));
  return terminal_text(table, width);
}

std::string score_json(const SurfaceScore& score) {
  nlohmann::ordered_json json = {{"schema", "gnbv-surface-score-1"},
                                 {"floor_z_m", score.floor_z_m},
                                 {"samples", score.samples},
                                 {"accuracy_m", score.distances.accuracy_m},
                                 {"completeness_m", score.distances.completeness_m},
                                 {"chamfer_m", score.distances.chamfer_m}};
  for (const DistanceScore& at : score.distances.at) {
    json["at"].push_back({{"distance_m", at.distance_m},
                          {"precision", at.precision},
                          {"recall", at.recall},
                          {"f", at.f}});
  }
  return json.dump(2) + "\n";
}

}  // namespace gnbv
