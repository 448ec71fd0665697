#include "tools/surface/textured_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "sim/core/error.hpp"
#include "tools/scene/colour.hpp"

namespace gnbv {
namespace {

Rgb8 rgb8(const Vec3f& colour) {
  Rgb8 out{};
  for (std::size_t k = 0; k < 3; ++k) {
    const float level = std::clamp(colour[static_cast<Eigen::Index>(k)], 0.0F, 255.0F);
    out[k] = static_cast<std::uint8_t>(std::lround(level));
  }
  return out;
}

bool has_chart(const FaceUv& uv) { return uv[0].x() >= 0.0F; }

/// Vertices that no picture shows take the mean of their neighbours that have a colour, ring by
/// ring; what hangs on nothing becomes grey.
void spread_colours(const TriangleMesh& mesh, std::vector<Vec3f>& colours,
                    std::vector<std::uint8_t>& is_known) {
  std::vector<std::uint32_t> open;  // faces with a vertex still unknown
  for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) open.push_back(face);
  while (true) {
    std::map<std::uint32_t, std::pair<Vec3f, float>> ring;
    std::vector<std::uint32_t> still_open;
    for (const std::uint32_t face : open) {
      const auto& corners = mesh.faces[face];
      const auto known = std::count_if(corners.begin(), corners.end(),
                                       [&](std::uint32_t v) { return is_known[v] != 0; });
      if (known == 3) continue;
      still_open.push_back(face);
      if (known == 0) continue;
      for (const std::uint32_t to : corners) {
        if (is_known[to] != 0) continue;
        auto& [sum, count] = ring.try_emplace(to, Vec3f::Zero(), 0.0F).first->second;
        for (const std::uint32_t from : corners) {
          if (is_known[from] == 0) continue;
          sum += colours[from];
          count += 1.0F;
        }
      }
    }
    if (ring.empty()) break;
    for (const auto& [vertex, mean] : ring) {
      colours[vertex] = mean.first / mean.second;
      is_known[vertex] = 1;
    }
    open = std::move(still_open);
  }
  for (std::size_t i = 0; i < colours.size(); ++i) {
    if (is_known[i] == 0) colours[i] = Vec3f::Constant(128.0F);
  }
}

std::vector<Vec3f> vertex_colours(const TriangleMesh& mesh, const AtlasLayout& layout,
                                  const Image& atlas) {
  std::vector<Vec3f> colours(mesh.vertices_m.size(), Vec3f::Zero());
  std::vector<float> counts(mesh.vertices_m.size(), 0.0F);
  for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
    if (!has_chart(layout.face_uv[face])) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      colours[mesh.faces[face][k]] += bilinear(atlas, layout.face_uv[face][k]);
      counts[mesh.faces[face][k]] += 1.0F;
    }
  }
  std::vector<std::uint8_t> is_known(mesh.vertices_m.size());
  for (std::size_t i = 0; i < colours.size(); ++i) {
    is_known[i] = counts[i] > 0.0F ? 1 : 0;
    if (is_known[i] != 0) colours[i] /= counts[i];
  }
  spread_colours(mesh, colours, is_known);
  return colours;
}

/// Each face without a chart gets 2 x 2 texels below the charts. Its corners lie in the middles of
/// three of them, so that the bilinear filter mixes the colours of its vertices and no others.
void add_swatches(const std::vector<Vec3f>& colours, const AtlasLayout& layout,
                  TexturedMesh& mesh) {
  std::vector<std::uint32_t> faces;
  for (std::uint32_t face = 0; face < mesh.shape.faces.size(); ++face) {
    if (!has_chart(layout.face_uv[face])) faces.push_back(face);
  }
  Image& atlas = mesh.atlas;
  const int top = atlas.height_px;
  atlas.height_px += swatches_height_px(faces.size(), atlas.width_px);
  const std::size_t stride = 3 * static_cast<std::size_t>(atlas.width_px);
  atlas.rgb.resize(stride * static_cast<std::size_t>(atlas.height_px), 128);
  const int in_row = atlas.width_px / 2;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const int x = 2 * (static_cast<int>(i) % in_row);
    const int y = top + 2 * (static_cast<int>(i) / in_row);
    const auto& corners = mesh.shape.faces[faces[i]];
    const Vec3f& a = colours[corners[0]];
    const Vec3f& b = colours[corners[1]];
    const Vec3f& c = colours[corners[2]];
    const std::array<Vec3f, 4> texels = {a, b, c, b + c - a};
    for (int k = 0; k < 4; ++k) {
      const Rgb8 rgb = rgb8(texels[static_cast<std::size_t>(k)]);
      const std::size_t at =
          static_cast<std::size_t>(y + k / 2) * stride + 3 * static_cast<std::size_t>(x + k % 2);
      std::copy(rgb.begin(), rgb.end(), atlas.rgb.begin() + static_cast<std::ptrdiff_t>(at));
    }
    const Vec2f first(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
    mesh.face_uv[faces[i]] = {first, first + Vec2f(1, 0), first + Vec2f(0, 1)};
  }
}

}  // namespace

TexturedMesh with_texture(TriangleMesh mesh, const AtlasLayout& layout, Image baked) {
  GNBV_CHECK(!layout.charts.empty(), "no charts");
  const std::vector<Vec3f> colours = vertex_colours(mesh, layout, baked);
  TexturedMesh textured{.shape = std::move(mesh),
                        .vertex_rgb = {},
                        .face_uv = layout.face_uv,
                        .atlas = std::move(baked)};
  for (const Vec3f& colour : colours) textured.vertex_rgb.push_back(rgb8(colour));
  add_swatches(colours, layout, textured);
  return textured;
}

TexturedMesh with_height_colours(TriangleMesh mesh) {
  static const std::array<Rgb, 5> colours = {srgb(0x30407a), srgb(0x2f7f93), srgb(0x4fae7c),
                                             srgb(0xa9cf5a), srgb(0xf4e04d)};
  const Box3 box = bounds_m(mesh);
  TexturedMesh coloured;
  for (const Vec3f& p_m : mesh.vertices_m) {
    const Rgb linear = ramp(colours, (p_m.z() - box.min().z()) / std::max(box.sizes().z(), 1e-9));
    Vec3f levels;
    for (int k = 0; k < 3; ++k) {
      levels[k] = 255.0F * linear_to_srgb(linear[static_cast<std::size_t>(k)]);
    }
    coloured.vertex_rgb.push_back(rgb8(levels));
  }
  coloured.shape = std::move(mesh);
  return coloured;
}

std::vector<Vec3f> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Vec3f> normals(mesh.vertices_m.size(), Vec3f::Zero());
  for (const auto& face : mesh.faces) {
    const Vec3f& a = mesh.vertices_m[face[0]];
    const Vec3f n = (mesh.vertices_m[face[1]] - a).cross(mesh.vertices_m[face[2]] - a);
    for (const std::uint32_t vertex : face) normals[vertex] += n;
  }
  for (Vec3f& n : normals) n = n.norm() > 0.0F ? Vec3f(n.normalized()) : Vec3f(Vec3f::UnitZ());
  return normals;
}

DistinctCorners distinct_corners(const TexturedMesh& mesh) {
  DistinctCorners corners;
  std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> index_of;
  const bool has_uv = !mesh.face_uv.empty();
  for (std::size_t face = 0; face < mesh.shape.faces.size(); ++face) {
    auto& out = corners.faces.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t vertex = mesh.shape.faces[face][k];
      const Vec2f uv = has_uv ? mesh.face_uv[face][k] : Vec2f(Vec2f::Zero());
      const auto next = static_cast<std::uint32_t>(corners.vertex.size());
      const auto [entry, is_new] = index_of.try_emplace({vertex, uv.x(), uv.y()}, next);
      if (is_new) {
        corners.vertex.push_back(vertex);
        if (has_uv) corners.uv.push_back(uv);
      }
      out[k] = entry->second;
    }
  }
  return corners;
}

}  // namespace gnbv
