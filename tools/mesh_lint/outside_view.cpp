// view_from_outside() of mesh_report.hpp.
#include <algorithm>
#include <cmath>

#include "bench/score/escape_search.hpp"
#include "sim/core/parallel.hpp"
#include "sim/core/rng.hpp"
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
  constexpr float kGrazing = 0.02F;  // lines in the plane of the face tell nothing
  std::vector<Vec3f> normals;
  for (const SurfaceSample& sample : samples) normals.push_back(normal_of(mesh, sample.face));
  std::vector<Vec3f> origins;
  std::vector<std::size_t> asked;
  for (const Vec3f& direction : spread_directions(config.directions)) {
    origins.clear();
    asked.clear();
    const auto side_of = [&](std::size_t i) {
      const float cosine = direction.dot(normals[i]);
      return std::abs(cosine) <= kGrazing ? kNone : cosine > 0.0F ? kFront : kBack;
    };
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const bool is_new = (side_of(i) & ~seen[i]) != 0;
      if (!is_new || (seen[i] & kFront) != 0) continue;
      asked.push_back(i);
      origins.push_back(samples[i].p_world_m);
    }
    std::vector<std::uint8_t> blocked(asked.size());
    const std::vector<Vec3f> along(asked.size(), direction);
    scene.find_blocked(kStructurePart, origins, along, static_cast<float>(config.escape_near_m),
                       kEndless, blocked);
    for (std::size_t k = 0; k < asked.size(); ++k) {
      if (blocked[k] == 0) seen[asked[k]] |= side_of(asked[k]);
    }
  }
}

/// Of many faces the large ones, and of the others some, which stand for all of these.
struct AskedFaces {
  explicit AskedFaces(const TriangleMesh& mesh)
      : samples(sample_about(mesh, kSamples)), large_m2(surface_area_m2(mesh) / kSamples) {
    constexpr std::size_t kMany = 200000;
    constexpr std::size_t kSome = 50000;
    if (mesh.faces.size() < kMany) return;
    const std::size_t one_in = mesh.faces.size() / kSome;
    double all_m2 = 0.0, asked_m2 = 0.0;  // of those that are not large
    double all = 0.0, asked = 0.0;
    std::vector<bool> is_asked(mesh.faces.size(), true);
    for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
      const double area_m2 = face_area_m2(mesh, face);
      if (area_m2 > large_m2) continue;
      is_asked[face] = mix_bits(face) % one_in == 0;
      all_m2 += area_m2;
      ++all;
      if (!is_asked[face]) continue;
      asked_m2 += area_m2;
      ++asked;
    }
    std::erase_if(samples, [&](const SurfaceSample& s) { return !is_asked[s.face]; });
    is_all = asked == all;
    area_factor = asked_m2 > 0.0 ? all_m2 / asked_m2 : 1.0;
    count_factor = asked > 0.0 ? all / asked : 1.0;
  }

  static constexpr double kSamples = 20000.0;
  std::vector<SurfaceSample> samples;
  double large_m2;
  bool is_all = true;
  double area_factor = 1.0, count_factor = 1.0;  // of a face that is not large
};

}  // namespace

OutsideView view_from_outside(const TriangleMesh& whole, const MeshLint& lint, int threads) {
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
  const AskedFaces asked(mesh);
  const std::vector<SurfaceSample>& samples = asked.samples;
  ReferenceConfig config;
  // more samples, each of less surface, get by with fewer directions
  constexpr double kFewest = 128.0;
  config.directions =
      static_cast<int>(std::clamp(config.directions * AskedFaces::kSamples /
                                      static_cast<double>(std::max<std::size_t>(samples.size(), 1)),
                                  kFewest, static_cast<double>(config.directions)));
  const std::vector<std::uint8_t> sees_out =
      samples_seeing_out(world, scene, samples, config, threads);

  struct Share {
    double count, area_m2;
  };
  const auto stands_for = [&](std::uint32_t face) -> Share {
    const double area_m2 = face_area_m2(mesh, face);
    if (area_m2 > asked.large_m2) return {1.0, area_m2};
    return {asked.count_factor, asked.area_factor * area_m2};
  };
  std::vector<std::size_t> sample_count(mesh.faces.size(), 0);
  for (const SurfaceSample& s : samples) ++sample_count[s.face];
  std::vector<SurfaceSample> seeing;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::uint32_t face = samples[i].face;
    if (sees_out[i] == 0) {
      view.hidden_area_m2 += stands_for(face).area_m2 / static_cast<double>(sample_count[face]);
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
  double from_behind = 0.0;
  for (std::uint32_t face = 0; face < of_face.size(); ++face) {
    if (of_face[face] != kBack) continue;
    from_behind += stands_for(face).count;
    view.from_behind.area_m2 += stands_for(face).area_m2;
  }
  view.from_behind.count = static_cast<std::size_t>(std::llround(from_behind));
  view.is_estimate = !asked.is_all;
  return view;
}

}  // namespace gnbv
