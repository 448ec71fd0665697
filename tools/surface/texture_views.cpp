#include "tools/surface/texture_views.hpp"

#include <algorithm>

#include "bench/limits/cover_counts.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

using Candidates = std::vector<std::vector<ViewCandidate>>;

/// The view that shows the most faces takes them, then the next one the most of the others.
std::vector<std::int32_t> cover(const Candidates& candidates, std::size_t view_count) {
  std::vector<std::vector<std::uint32_t>> faces_of(view_count);
  for (std::uint32_t face = 0; face < candidates.size(); ++face) {
    for (const ViewCandidate& c : candidates[face]) faces_of[c.view].push_back(face);
  }
  const CoverSets sets(faces_of, candidates.size());
  CoverCounts counts(sets, {});
  std::vector<std::int32_t> chosen(candidates.size(), kNoView);
  while (true) {
    const std::span<const std::uint32_t> gains = counts.gains();
    const auto most = std::max_element(gains.begin(), gains.end());
    if (most == gains.end() || *most == 0) return chosen;
    const auto view = static_cast<std::uint32_t>(most - gains.begin());
    for (const std::uint32_t face : faces_of[view]) {
      if (chosen[face] == kNoView) chosen[face] = static_cast<std::int32_t>(view);
    }
    counts.add(view);
  }
}

/// Faces alone among those of another view join them, where that view shows them as well.
void join_islands(const TriangleMesh& mesh, const Candidates& candidates,
                  std::vector<std::int32_t>& chosen) {
  const auto neighbours = neighbours_across_edges(mesh);
  constexpr int kPasses = 4;
  for (int pass = 0; pass < kPasses; ++pass) {
    for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
      const auto agreeing = [&](std::int32_t view) {
        return std::count_if(
            neighbours[face].begin(), neighbours[face].end(),
            [&](std::uint32_t other) { return other != kNoNeighbour && chosen[other] == view; });
      };
      auto most = agreeing(chosen[face]);
      for (const ViewCandidate& candidate : candidates[face]) {
        const auto view = static_cast<std::int32_t>(candidate.view);
        if (agreeing(view) <= most) continue;
        most = agreeing(view);
        chosen[face] = view;
      }
    }
  }
}

}  // namespace

Vec2f TextureView::pixel_of(const Vec3f& p_world_m_) const {
  return gnbv::pixel_of(camera, T_camera_world * p_world_m_.cast<double>()).cast<float>();
}

std::vector<TextureView> texture_views(const FrameRecord& record,
                                       std::span<const CameraConfig> cameras, int threads) {
  std::vector<TextureView> views(record.frames.size());
  parallel_for(threads, views.size(), [&](std::size_t i) {
    const RecordedFrame& frame = record.frames[i];
    views[i] = {.T_camera_world = frame.T_world_camera.inverse(),
                .p_world_m = frame.T_world_camera.translation().cast<float>(),
                .camera = record.cameras[frame.camera],
                .depth_steps = read_depth(record, i)};
    TextureView& view = views[i];
    for (const CameraConfig& camera : cameras) {
      if (camera.name == view.camera.name) view.range_max_m = return_end_m(camera);
    }
  });
  return views;
}

std::vector<std::int32_t> choose_views(const TriangleMesh& mesh, const RayScene& scene,
                                       std::span<const TextureView> views,
                                       const ViewChoiceSettings& settings, int threads) {
  const Candidates candidates = view_candidates(mesh, scene, views, settings, threads);
  std::vector<std::int32_t> chosen = cover(candidates, views.size());
  join_islands(mesh, candidates, chosen);
  return chosen;
}

std::vector<std::array<std::uint32_t, 3>> neighbours_across_edges(const TriangleMesh& mesh) {
  struct Edge {
    std::uint64_t ends;  // the lower vertex first
    std::uint32_t face, corner;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.faces.size());
  for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax({mesh.faces[face][k], mesh.faces[face][(k + 1) % 3]});
      edges.push_back({(std::uint64_t{a} << 32) | b, face, k});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const Edge& a, const Edge& b) { return a.ends < b.ends; });
  std::vector<std::array<std::uint32_t, 3>> neighbours(mesh.faces.size(),
                                                       {kNoNeighbour, kNoNeighbour, kNoNeighbour});
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end].ends == edges[begin].ends) ++end;
    if (end - begin != 2) continue;
    neighbours[edges[begin].face][edges[begin].corner] = edges[begin + 1].face;
    neighbours[edges[begin + 1].face][edges[begin + 1].corner] = edges[begin].face;
  }
  return neighbours;
}

}  // namespace gnbv
