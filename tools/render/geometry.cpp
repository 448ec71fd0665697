#include "tools/render/geometry.hpp"

#include <algorithm>
#include <numeric>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr int kTubeSides = 10;

std::array<float, 4> rgba(const Rgb& colour, float opacity = 1.0F) {
  return {colour[0], colour[1], colour[2], opacity};
}

// Vertices at equal positions get equal numbers, in order of position.
std::vector<std::uint32_t> weld(const std::vector<Vec3f>& vertices_m) {
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    return std::lexicographical_compare(vertices_m[a].begin(), vertices_m[a].end(),
                                        vertices_m[b].begin(), vertices_m[b].end());
  };
  std::vector<std::uint32_t> order(vertices_m.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), before);
  std::vector<std::uint32_t> welded(vertices_m.size());
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && before(order[i - 1], order[i])) ++count;
    welded[order[i]] = count;
  }
  return welded;
}

struct Corner {
  std::uint32_t face;
  std::uint32_t index;  // 0, 1 or 2
};

// Corners grouped by welded vertex: those of vertex v are corners[first[v] ... first[v + 1]).
struct CornerTable {
  std::vector<std::uint32_t> first;
  std::vector<Corner> corners;
};

CornerTable corners_by_vertex(const TriangleMesh& mesh, const std::vector<std::uint32_t>& welded) {
  CornerTable table;
  table.first.assign(mesh.vertices_m.size() + 1, 0);
  for (const auto& face : mesh.faces) {
    for (const std::uint32_t v : face) ++table.first[welded[v] + 1];
  }
  std::partial_sum(table.first.begin(), table.first.end(), table.first.begin());
  table.corners.resize(3 * mesh.faces.size());
  std::vector<std::uint32_t> next = table.first;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      table.corners[next[welded[mesh.faces[f][k]]]++] = {f, k};
    }
  }
  return table;
}

void add_surface(const SurfaceItem& item, bool has_paint, DrawLists& out) {
  const TriangleMesh& mesh = item.mesh;
  GNBV_CHECK(item.vertex_colours.empty() || item.vertex_colours.size() == mesh.vertices_m.size(),
             "{} colours for {} vertices", item.vertex_colours.size(), mesh.vertices_m.size());
  const auto normals = corner_normals(mesh, item.crease_rad);
  std::vector<std::uint32_t>& indices = item.opacity < 1.0F ? out.ghost
                                        : item.casts_shadow ? out.casting
                                                            : out.plain;
  constexpr std::uint32_t kNone = 0xffffffffU;
  std::vector<std::uint32_t> last(mesh.vertices_m.size(), kNone);  // latest copy of each vertex
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (normals[f][0].isZero()) continue;
    const std::size_t material = mesh.face_material.empty() ? 0 : mesh.face_material[f];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.faces[f][k];
      const auto colour =
          rgba(item.vertex_colours.empty() ? mesh.materials[material].rgb : item.vertex_colours[v],
               item.is_painted && has_paint ? kPainted : item.opacity);
      const bool is_bent = item.is_lit && last[v] != kNone &&
                           out.vertices[last[v]].n_world.dot(normals[f][k]) < 0.9999F;
      const bool is_new = last[v] == kNone || out.vertices[last[v]].rgba != colour || is_bent;
      if (is_new) {
        last[v] = static_cast<std::uint32_t>(out.vertices.size());
        const Vec3f n = item.is_lit ? normals[f][k] : Vec3f(Vec3f::Zero());
        out.vertices.push_back({mesh.vertices_m[v], n, colour});
      }
      indices.push_back(last[v]);
    }
  }
}

Vec3f any_perpendicular(const Vec3f& d) {
  return d.cross(std::abs(d.z()) < 0.9F ? Vec3f::UnitZ() : Vec3f::UnitX()).normalized();
}

// A ring of vertices around `p`, across `axis`, starting towards `side`.
std::uint32_t add_ring(const Vec3f& p, const Vec3f& axis, const Vec3f& side, float radius_m,
                       const Rgb& colour, DrawLists& out) {
  const auto first = static_cast<std::uint32_t>(out.vertices.size());
  const Vec3f other = axis.cross(side);
  for (int i = 0; i < kTubeSides; ++i) {
    const float angle = static_cast<float>(2.0 * kPi * i / kTubeSides);
    const Vec3f n = std::cos(angle) * side + std::sin(angle) * other;
    out.vertices.push_back({p + radius_m * n, n, rgba(colour)});
  }
  return first;
}

void join_rings(std::uint32_t a, std::uint32_t b, std::vector<std::uint32_t>& indices) {
  constexpr auto kSides = static_cast<std::uint32_t>(kTubeSides);
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const std::uint32_t j = (i + 1) % kSides;
    indices.insert(indices.end(), {a + i, a + j, b + j, a + i, b + j, b + i});
  }
}

void add_tube(const TubeItem& tube, DrawLists& out) {
  GNBV_CHECK(tube.colours.size() == 1 || tube.colours.size() == tube.points_m.size(),
             "{} colours for {} points", tube.colours.size(), tube.points_m.size());
  std::vector<std::size_t> kept;  // repeated points have no direction
  for (std::size_t i = 0; i < tube.points_m.size(); ++i) {
    if (kept.empty() || (tube.points_m[i] - tube.points_m[kept.back()]).norm() > 1e-5F) {
      kept.push_back(i);
    }
  }
  const auto point = [&](std::size_t i) { return tube.points_m[kept[i]]; };
  const auto colour = [&](std::size_t i) {
    return tube.colours[tube.colours.size() == 1 ? 0 : kept[i]];
  };
  const auto joint = [&](std::size_t i) {
    out.balls.push_back({point(i), tube.radius_m, colour(i), tube.casts_shadow});
  };
  if (kept.empty()) return;
  joint(0);
  Vec3f side = Vec3f::Zero();
  std::uint32_t ring = 0;
  for (std::size_t i = 0; i + 1 < kept.size(); ++i) {
    const Vec3f along = (point(i + 1) - point(i)).normalized();
    const Vec3f before = i == 0 ? along : (point(i) - point(i - 1)).normalized();
    // gentle bends share one ring, sharp ones (over 25 degrees) start anew behind a ball
    const bool is_sharp = along.dot(before) < 0.9F;
    if (i == 0) side = any_perpendicular(along);
    const auto carry = [&](const Vec3f& axis) {
      side -= axis * axis.dot(side);
      side = side.norm() < 1e-3F ? any_perpendicular(axis) : Vec3f(side.normalized());
    };
    if (i == 0 || is_sharp) {
      if (i > 0) joint(i);
      carry(along);
      ring = add_ring(point(i), along, side, tube.radius_m, colour(i), out);
    }
    Vec3f axis = along;
    if (i + 2 < kept.size()) {
      const Vec3f next = (point(i + 2) - point(i + 1)).normalized();
      if (next.dot(along) >= 0.9F) axis = (along + next).normalized();
    }
    carry(axis);
    const std::uint32_t end = add_ring(point(i + 1), axis, side, tube.radius_m, colour(i + 1), out);
    join_rings(ring, end, tube.casts_shadow ? out.casting : out.plain);
    ring = end;
  }
  joint(kept.size() - 1);
}

void add_frustum(const FrustumItem& item, DrawLists& out) {
  const double x = item.length_m * std::tan(0.5 * item.fov_x_rad);
  const double y = item.length_m * std::tan(0.5 * item.fov_y_rad);
  const Vec3f apex = item.T_world_camera.translation().cast<float>();
  std::array<Vec3f, 4> base;
  for (std::size_t k = 0; k < 4; ++k) {
    const double sx = k == 0 || k == 3 ? -x : x;
    const double sy = k < 2 ? -y : y;
    base[k] = (item.T_world_camera * Vec3(sx, sy, item.length_m)).cast<float>();
  }
  TubeItem edge{{base[0], base[1], base[2], base[3], base[0]}, {item.colour}, item.edge_radius_m};
  add_tube(edge, out);
  for (std::size_t k = 0; k < 4; ++k) {
    edge.points_m = {apex, base[k]};
    add_tube(edge, out);
  }
  if (item.face_opacity <= 0.0F) return;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3f& a = base[k];
    const Vec3f& b = base[(k + 1) % 4];
    const Vec3f n = (b - apex).cross(a - apex).normalized();
    for (const Vec3f& p : {apex, b, a}) {
      out.translucent.push_back(static_cast<std::uint32_t>(out.vertices.size()));
      out.vertices.push_back({p, n, rgba(item.colour, item.face_opacity)});
    }
  }
}

void add_dots(const DotsItem& item, DrawLists& out) {
  const std::size_t count = item.points_m.size();
  GNBV_CHECK(item.colours.size() == 1 || item.colours.size() == count, "{} colours for {} points",
             item.colours.size(), count);
  GNBV_CHECK(item.normals.empty() || item.normals.size() == count, "{} normals for {} points",
             item.normals.size(), count);
  out.dots.reserve(out.dots.size() + count);
  for (std::size_t i = 0; i < count; ++i) {
    out.dots.push_back({item.points_m[i], item.radius_m,
                        item.normals.empty() ? Vec3f(Vec3f::Zero()) : item.normals[i],
                        item.colours[item.colours.size() == 1 ? 0 : i]});
  }
}

}  // namespace

std::vector<std::array<Vec3f, 3>> corner_normals(const TriangleMesh& mesh, double crease_rad) {
  std::vector<Vec3f> face_normals(mesh.faces.size());
  std::vector<std::array<float, 3>> angles_rad(mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    std::array<Vec3f, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = mesh.vertices_m[mesh.faces[f][k]];
    const Vec3f n = (p[1] - p[0]).cross(p[2] - p[0]);
    face_normals[f] = n.norm() > 0.0F ? Vec3f(n.normalized()) : Vec3f(Vec3f::Zero());
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3f a = p[(k + 1) % 3] - p[k];
      const Vec3f b = p[(k + 2) % 3] - p[k];
      angles_rad[f][k] = std::atan2(a.cross(b).norm(), a.dot(b));
    }
  }
  std::vector<std::array<Vec3f, 3>> normals(mesh.faces.size());
  if (crease_rad <= 0.0) {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) normals[f].fill(face_normals[f]);
    return normals;
  }
  const std::vector<std::uint32_t> welded = weld(mesh.vertices_m);
  const CornerTable table = corners_by_vertex(mesh, welded);
  const auto cos_crease = static_cast<float>(std::cos(crease_rad));
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = welded[mesh.faces[f][k]];
      Vec3f sum = Vec3f::Zero();
      for (std::uint32_t c = table.first[v]; c < table.first[v + 1]; ++c) {
        const Corner& corner = table.corners[c];
        if (face_normals[corner.face].dot(face_normals[f]) >= cos_crease) {
          sum += angles_rad[corner.face][corner.index] * face_normals[corner.face];
        }
      }
      normals[f][k] = sum.norm() > 0.0F ? Vec3f(sum.normalized()) : face_normals[f];
    }
  }
  return normals;
}

DrawLists make_draw_lists(const RenderScene& scene) {
  DrawLists out;
  for (const SurfaceItem& item : scene.surfaces) {
    add_surface(item, scene.paint.has_value(), out);
  }
  for (const TubeItem& item : scene.tubes) add_tube(item, out);
  for (const FrustumItem& item : scene.frusta) add_frustum(item, out);
  for (const BallItem& item : scene.balls) {
    out.balls.push_back({item.centre_m, item.radius_m, item.colour, item.casts_shadow});
  }
  for (const bool casts_shadow : {true, false}) {
    for (const DotsItem& item : scene.dots) {
      if (item.casts_shadow == casts_shadow) add_dots(item, out);
    }
    if (casts_shadow) out.casting_dots = out.dots.size();
  }
  const auto plain_balls = std::stable_partition(
      out.balls.begin(), out.balls.end(), [](const DrawBall& ball) { return ball.casts_shadow; });
  out.casting_balls = static_cast<std::size_t>(plain_balls - out.balls.begin());
  for (const DrawVertex& vertex : out.vertices) out.bounds_m.extend(vertex.p_world_m);
  for (const DrawBall& ball : out.balls) {
    out.bounds_m.extend(Vec3f(ball.centre_m.array() - ball.radius_m));
    out.bounds_m.extend(Vec3f(ball.centre_m.array() + ball.radius_m));
  }
  for (const DrawDot& dot : out.dots) out.bounds_m.extend(dot.p_world_m);
  return out;
}

}  // namespace gnbv
