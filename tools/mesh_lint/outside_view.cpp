// view_from_outside() of mesh_report.hpp.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "bench/score/escape_search.hpp"
#include "sim/core/parallel.hpp"
#include "tools/mesh_lint/mesh_places.hpp"

namespace gnbv {
namespace {

enum Side : std::uint8_t { kNone = 0, kFront = 1, kBack = 2 };

Vec3f normal_of(const TriangleMesh& mesh, std::uint32_t face) {
  const auto& [a, b, c] = mesh.faces[face];
  const Vec3 pa = mesh.vertices_m[a].cast<double>();
  const Vec3 ab = mesh.vertices_m[b].cast<double>() - pa;
  const Vec3 ac = mesh.vertices_m[c].cast<double>() - pa;
  return ab.cross(ac).normalized().cast<float>();
}

/// The sides of some samples' faces that a straight line leaves from, both bits possible; a sample
/// whose front is seen is asked no further.
void find_sides(const TriangleMesh& mesh, const RayScene& scene, const ReferenceConfig& config,
                std::span<const SurfaceSample> samples, std::span<std::uint8_t> seen) {
  constexpr float kGrazing = 0.02F;
  std::vector<std::size_t> open(samples.size());
  std::iota(open.begin(), open.end(), std::size_t{0});
  for (const Vec3f& direction : spread_directions(config.directions)) {
    std::vector<Vec3f> origins;
    for (const std::size_t i : open) origins.push_back(samples[i].p_world_m);
    std::vector<std::uint8_t> blocked(open.size());
    const std::vector<Vec3f> along(open.size(), direction);
    scene.find_blocked(kStructurePart, origins, along, static_cast<float>(config.escape_near_m),
                       kEndless, blocked);
    for (std::size_t k = 0; k < open.size(); ++k) {
      if (blocked[k] != 0) continue;
      const float cosine = direction.dot(normal_of(mesh, samples[open[k]].face));
      // lines in the plane of the face tell nothing
      if (std::abs(cosine) > kGrazing) seen[open[k]] |= cosine > 0.0F ? kFront : kBack;
    }
    std::erase_if(open, [&](std::size_t i) { return (seen[i] & kFront) != 0; });
  }
}

}  // namespace

OutsideView view_from_outside(const TriangleMesh& whole, const MeshLint& lint, int threads) {
  constexpr double kSamples = 20000.0;
  constexpr std::size_t kChunk = 4096;
  const World world{.structure = sound_part(whole, lint), .has_ground = false};
  const TriangleMesh& mesh = world.structure;
  OutsideView view;
  view.area_m2 = surface_area_m2(mesh);
  constexpr double kFarthest_m = 1e12;  // rays of single precision end on the way to 1e18
  if (mesh.faces.empty() || farthest_m(lint.box_m) > kFarthest_m) return view;
  std::vector<bool> is_two_sided;
  for (std::size_t i = 0; i < lint.is_sound.size(); ++i) {
    if (lint.is_sound[i]) is_two_sided.push_back(lint.is_two_sided[i]);
  }
  const RayScene scene(world);
  const std::vector<SurfaceSample> samples = sample_about(mesh, kSamples);
  ReferenceConfig config;
  // more samples, each of less surface, get by with fewer directions
  constexpr double kFewest = 128.0;
  config.directions = static_cast<int>(std::clamp(
      config.directions * kSamples / static_cast<double>(std::max<std::size_t>(samples.size(), 1)),
      kFewest, static_cast<double>(config.directions)));
  const std::vector<std::uint8_t> sees_out =
      samples_seeing_out(world, scene, samples, config, threads);

  std::vector<std::size_t> sample_count(mesh.faces.size(), 0);
  for (const SurfaceSample& s : samples) ++sample_count[s.face];
  std::vector<SurfaceSample> seeing;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::uint32_t face = samples[i].face;
    if (sees_out[i] == 0) {
      view.hidden_area_m2 += face_area_m2(mesh, face) / static_cast<double>(sample_count[face]);
    } else if (!is_two_sided[face]) {
      seeing.push_back(samples[i]);
    }
  }
  std::vector<std::uint8_t> sides(seeing.size(), kNone);
  parallel_for_chunks(threads, sides.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    find_sides(mesh, scene, config, std::span(seeing).subspan(begin, end - begin),
               std::span(sides).subspan(begin, end - begin));
  });
  std::vector<std::uint8_t> of_face(mesh.faces.size(), kNone);
  for (std::size_t i = 0; i < seeing.size(); ++i) of_face[seeing[i].face] |= sides[i];
  for (std::size_t face = 0; face < of_face.size(); ++face) {
    if (of_face[face] != kBack) continue;
    ++view.from_behind.count;
    view.from_behind.area_m2 += face_area_m2(mesh, face);
  }
  return view;
}

}  // namespace gnbv
