#include "tools/render/geometry.hpp"

#include <map>
#include <utility>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr std::uint32_t kTubeSides = 10;

std::array<float, 4> rgba(const Rgb& colour, float opacity = 1.0F) {
  return {colour[0], colour[1], colour[2], opacity};
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

void add_ball(const BallItem& ball, DrawLists& out) {
  const auto begin = out.balls.begin() + static_cast<std::ptrdiff_t>(out.casting_balls);
  out.balls.insert(ball.casts_shadow ? begin : out.balls.end(),
                   {ball.centre_m, ball.radius_m, ball.colour});
  out.casting_balls += ball.casts_shadow ? 1 : 0;
}

// A cylinder a piece, and a ball where pieces meet and end.
void add_tube(const TubeItem& tube, DrawLists& out) {
  GNBV_CHECK(tube.colours.size() == 1 || tube.colours.size() == tube.points_m.size(),
             "{} colours for {} points", tube.colours.size(), tube.points_m.size());
  std::vector<std::uint32_t>& triangles = tube.casts_shadow ? out.casting : out.plain;
  std::optional<std::size_t> before;  // repeated points have no direction
  for (std::size_t i = 0; i < tube.points_m.size(); ++i) {
    const Vec3f& p = tube.points_m[i];
    if (before && (p - tube.points_m[*before]).norm() <= 1e-5F) continue;
    const Rgb& colour = tube.colours[tube.colours.size() == 1 ? 0 : i];
    add_ball({p, tube.radius_m, colour, tube.casts_shadow}, out);
    const std::optional<std::size_t> from = std::exchange(before, i);
    if (!from) continue;
    const Vec3f& q = tube.points_m[*from];
    const Rgb& colour_before = tube.colours[tube.colours.size() == 1 ? 0 : *from];
    const Vec3f along = (p - q).normalized();
    const Vec3f side =
        along.cross(std::abs(along.z()) < 0.9F ? Vec3f::UnitZ() : Vec3f::UnitX()).normalized();
    const Vec3f other = along.cross(side);
    const auto first = static_cast<std::uint32_t>(out.vertices.size());
    for (std::uint32_t k = 0; k < kTubeSides; ++k) {
      const auto angle = static_cast<float>(2.0 * kPi * k / kTubeSides);
      const Vec3f n = std::cos(angle) * side + std::sin(angle) * other;
      out.vertices.push_back({q + tube.radius_m * n, n, rgba(colour_before)});
      out.vertices.push_back({p + tube.radius_m * n, n, rgba(colour)});
      const std::uint32_t a = first + 2 * k;
      const std::uint32_t b = first + 2 * ((k + 1) % kTubeSides);
      triangles.insert(triangles.end(), {a, b, b + 1, a, b + 1, a + 1});
    }
  }
}

void add_frustum(const FrustumItem& item, DrawLists& out) {
  const Vec3f apex = item.T_world_camera.translation().cast<float>();
  std::array<Vec3f, 4> base;
  const std::array<Vec3, 4> corners_m = far_corners_m(item);
  for (std::size_t k = 0; k < 4; ++k) base[k] = corners_m[k].cast<float>();
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
  // corners (3 * face + k) by the place where they stand, whichever vertex that is
  std::map<std::array<float, 3>, std::vector<std::uint32_t>> corners_at;
  std::vector<std::vector<std::uint32_t>*> corners_beside;  // by vertex
  for (const Vec3f& p_m : mesh.vertices_m) {
    corners_beside.push_back(&corners_at[{p_m.x(), p_m.y(), p_m.z()}]);
  }
  for (std::uint32_t corner = 0; corner < 3 * mesh.faces.size(); ++corner) {
    corners_beside[mesh.faces[corner / 3][corner % 3]]->push_back(corner);
  }
  const auto cos_crease = static_cast<float>(std::cos(crease_rad));
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3f sum = Vec3f::Zero();
      for (const std::uint32_t corner : *corners_beside[mesh.faces[f][k]]) {
        const std::uint32_t face = corner / 3;
        if (face_normals[face].dot(face_normals[f]) < cos_crease) continue;
        sum += angles_rad[face][corner % 3] * face_normals[face];
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
  for (const BallItem& item : scene.balls) add_ball(item, out);
  for (const DotsItem& item : scene.dots) add_dots(item, out);
  for (const DrawVertex& vertex : out.vertices) out.bounds_m.extend(vertex.p_world_m);
  for (const DrawBall& ball : out.balls) {
    out.bounds_m.extend(Vec3f(ball.p_world_m.array() - ball.radius_m));
    out.bounds_m.extend(Vec3f(ball.p_world_m.array() + ball.radius_m));
  }
  for (const DrawDot& dot : out.dots) out.bounds_m.extend(dot.p_world_m);
  return out;
}

}  // namespace gnbv
