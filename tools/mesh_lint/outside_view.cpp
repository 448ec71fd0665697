#include "tools/mesh_lint/outside_view.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bench/score/escape_search.hpp"
#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

constexpr double kSamples = 20000.0;
constexpr std::size_t kChunk = 4096;

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
class SideSearch {
 public:
  SideSearch(const TriangleMesh& mesh, const RayScene& scene, const ReferenceConfig& config)
      : mesh_(mesh),
        scene_(scene),
        near_m_(static_cast<float>(config.escape_near_m)),
        directions_(spread_directions(config.directions)) {}

  void sides(std::span<const SurfaceSample> samples, std::span<std::uint8_t> seen) const {
    std::vector<std::size_t> open(samples.size());
    std::iota(open.begin(), open.end(), std::size_t{0});
    std::vector<Vec3f> origins;
    std::vector<std::uint8_t> blocked;
    for (const Vec3f& direction : directions_) {
      origins.clear();
      for (const std::size_t i : open) origins.push_back(samples[i].p_world_m);
      blocked.assign(open.size(), 0);
      const std::vector<Vec3f> along(open.size(), direction);
      scene_.find_blocked(kStructurePart, origins, along, near_m_, kEndless, blocked);
      for (std::size_t k = 0; k < open.size(); ++k) {
        if (blocked[k] != 0) continue;
        const float cosine = direction.dot(normal_of(mesh_, samples[open[k]].face));
        // lines in the plane of the face tell nothing
        if (std::abs(cosine) > kGrazing) seen[open[k]] |= cosine > 0.0F ? kFront : kBack;
      }
      std::erase_if(open, [&](std::size_t i) { return (seen[i] & kFront) != 0; });
    }
  }

 private:
  static constexpr float kGrazing = 0.02F;
  const TriangleMesh& mesh_;
  const RayScene& scene_;
  float near_m_;
  std::vector<Vec3f> directions_;
};

std::vector<std::uint8_t> seen_sides(const SideSearch& search,
                                     std::span<const SurfaceSample> samples, int threads) {
  std::vector<std::uint8_t> seen(samples.size(), kNone);
  parallel_for_chunks(threads, samples.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    search.sides(samples.subspan(begin, end - begin), std::span(seen).subspan(begin, end - begin));
  });
  return seen;
}

}  // namespace

OutsideView view_from_outside(const TriangleMesh& mesh, const std::vector<bool>& is_two_sided,
                              int threads) {
  GNBV_CHECK(is_two_sided.size() == mesh.faces.size(), "{} flags for {} faces", is_two_sided.size(),
             mesh.faces.size());
  OutsideView view;
  view.area_m2 = surface_area_m2(mesh);
  if (mesh.faces.empty()) return view;
  const World world{.structure = mesh, .has_ground = false};
  const RayScene scene(world);
  const ReferenceConfig config;
  const std::vector<SurfaceSample> samples =
      sample_surface(mesh, std::sqrt(view.area_m2 / kSamples));
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
  const std::vector<std::uint8_t> sides =
      seen_sides(SideSearch(mesh, scene, config), seeing, threads);
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
