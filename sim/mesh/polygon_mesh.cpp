#include "sim/mesh/polygon_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <unordered_map>
#include <utility>

#include "sim/core/image.hpp"

namespace gnbv {
namespace {

using Vec2 = Eigen::Vector2d;
using Faces = std::vector<std::array<std::uint32_t, 3>>;

/// Twice the area of a triangle, positive where it runs counter-clockwise.
double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// Cuts up one polygon after the other with the same memory. Numbers corners by their place in the
/// polygon, from 0.
class EarClipper {
 public:
  /// Calls add(a, b, c) for each triangle.
  template <typename Add>
  void cut(std::span<const std::uint32_t> corners, const std::vector<Vec3>& vertices,
           const Add& add_triangle) {
    if (corners.size() == 3) return add_triangle(0U, 1U, 2U);
    lay_flat(corners, vertices);
    link(static_cast<std::uint32_t>(corners.size()));
    const auto add = [&](std::uint32_t b) { add_triangle(previous_[b], b, next_[b]); };
    Care care = Care::clean;
    std::uint32_t b = 1;
    std::size_t tried = 0;
    for (std::size_t left = corners.size(); left > 3;) {
      if (is_ear(b, care)) {
        add(b);
        b = clipped(b);
        --left;
        tried = 0;
      } else {
        b = next_[b];
        if (++tried < left) continue;
        // less care from now on: a polygon without a clean ear is not simple
        care = care == Care::clean ? Care::thin : Care::none;
        tried = 0;
      }
    }
    add(b);
  }

 private:
  enum class Care {
    clean,  // an ear has an area, and no other corner in it or on its border
    thin,   // an ear has an area; other corners may lie on its border
    none    // any corner is an ear
  };

  /// Projects the polygon along the axis nearest to its Newell normal, seen from its front.
  void lay_flat(std::span<const std::uint32_t> corners, const std::vector<Vec3>& vertices) {
    const Vec3& origin = vertices[corners[0]];
    Vec3 normal = Vec3::Zero();
    for (std::size_t i = 2; i < corners.size(); ++i) {
      normal += (vertices[corners[i - 1]] - origin).cross(vertices[corners[i]] - origin);
    }
    Eigen::Index axis = 2;
    normal.cwiseAbs().maxCoeff(&axis);
    Eigen::Index u = (axis + 1) % 3;
    Eigen::Index v = (axis + 2) % 3;
    if (normal[axis] < 0.0) std::swap(u, v);
    at_.clear();
    for (const std::uint32_t corner : corners) {
      const Vec3 p = vertices[corner] - origin;
      at_.emplace_back(p[u], p[v]);
    }
  }

  void link(std::uint32_t count) {
    next_.resize(count);
    previous_.resize(count);
    reflex_.clear();
    for (std::uint32_t i = 0; i < count; ++i) {
      next_[i] = i + 1 < count ? i + 1 : 0;
      previous_[i] = i > 0 ? i - 1 : count - 1;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      if (!(turn_at(i) > 0.0)) reflex_.push_back(i);
    }
  }

  double turn_at(std::uint32_t b) const { return turn(at_[previous_[b]], at_[b], at_[next_[b]]); }

  bool is_ear(std::uint32_t b, Care care) const {
    if (care == Care::none) return true;
    const Vec2& p_a = at_[previous_[b]];
    const Vec2& p_b = at_[b];
    const Vec2& p_c = at_[next_[b]];
    const double longest2 =
        std::max({(p_b - p_a).squaredNorm(), (p_c - p_b).squaredNorm(), (p_a - p_c).squaredNorm()});
    const double area2 = turn(p_a, p_b, p_c);
    const double flat2 = 1e-7 * longest2;  // as is_flat()
    // the edge goes there and back: this corner has no area and would block others
    if (std::abs(area2) <= flat2 && (p_a - p_b).dot(p_c - p_b) >= 0.0) return true;
    // a corner within a straight edge is no ear
    if (!(area2 > (care == Care::clean ? flat2 : 0.0))) return false;
    // if any corner lies in the triangle, then a reflex one does
    return std::none_of(reflex_.begin(), reflex_.end(),
                        [&](std::uint32_t corner) { return is_in_the_way(corner, b, care); });
  }

  bool is_in_the_way(std::uint32_t corner, std::uint32_t b, Care care) const {
    const std::uint32_t a = previous_[b];
    const std::uint32_t c = next_[b];
    if (corner == a || corner == b || corner == c) return false;
    const Vec2& p = at_[corner];
    if (p == at_[a] || p == at_[c]) return false;  // at both ends of a bridge to a hole
    const double least =
        std::min({turn(at_[a], at_[b], p), turn(at_[b], at_[c], p), turn(at_[c], at_[a], p)});
    return care == Care::clean ? least >= 0.0 : least > 0.0;
  }

  /// Takes the corner out and returns the next one.
  std::uint32_t clipped(std::uint32_t b) {
    next_[previous_[b]] = next_[b];
    previous_[next_[b]] = previous_[b];
    std::erase_if(reflex_, [&](std::uint32_t corner) {
      const bool is_beside = corner == previous_[b] || corner == next_[b];
      return corner == b || (is_beside && turn_at(corner) > 0.0);
    });
    return next_[b];
  }

  std::vector<Vec2> at_;
  std::vector<std::uint32_t> next_, previous_;
  std::vector<std::uint32_t> reflex_;  // the remaining corners at which the polygon is not convex
};

std::uint32_t level_of(std::uint32_t rgb, unsigned shift) { return (rgb >> shift) & 0xffU; }

/// 0xrrggbb of level(shift) for each channel.
template <typename Level>
std::uint32_t rgb_of(const Level& level) {
  return level(16U) << 16U | level(8U) << 8U | level(0U);
}

std::uint32_t mean_rgb(const std::vector<std::uint32_t>& vertex_rgb,
                       const std::array<std::uint32_t, 3>& face) {
  return rgb_of([&](unsigned shift) {
    std::uint32_t sum = 1;  // rounds the third of it
    for (const std::uint32_t v : face) sum += level_of(vertex_rgb[v], shift);
    return sum / 3;
  });
}

std::uint32_t in_steps(std::uint32_t rgb) {
  return rgb_of([&](unsigned shift) { return (level_of(rgb, shift) + 8) / 17 * 17; });
}

bool are_few(std::span<const std::uint32_t> colours) {
  constexpr std::size_t kFew = 256;
  std::set<std::uint32_t> found;
  return std::all_of(colours.begin(), colours.end(), [&](std::uint32_t rgb) {
    found.insert(rgb);
    return found.size() <= kFew;
  });
}

Material material_of(std::uint32_t rgb) {
  const auto linear = [&](unsigned shift) {
    return srgb_to_linear(static_cast<float>(level_of(rgb, shift)) / 255.0F);
  };
  return {.name = fmt::format("colour_{:06x}", rgb), .rgb = {linear(16), linear(8), linear(0)}};
}

/// Frees the memory, which clear() would keep.
template <typename T>
void give_back(std::vector<T>& used) {
  std::vector<T>().swap(used);
}

void cut_faces(const PolygonMesh& polygons, TriangleMesh& mesh) {
  const std::size_t count = polygons.corners.size() - 2 * polygons.face_ends.size();
  mesh.faces.reserve(count);
  mesh.face_material.reserve(count);
  EarClipper clipper;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < polygons.face_ends.size(); ++i) {
    const auto corners = std::span(polygons.corners).subspan(begin, polygons.face_ends[i] - begin);
    const std::size_t first = std::exchange(begin, polygons.face_ends[i]);
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      mesh.faces.push_back({corners[a], corners[b], corners[c]});
      if (polygons.corner_looks.empty()) return;
      const CornerLook* const looks = polygons.corner_looks.data() + first;
      mesh.face_looks.push_back({looks[a], looks[b], looks[c]});
    };
    clipper.cut(corners, polygons.vertices, add);
    mesh.face_material.resize(mesh.faces.size(),
                              polygons.face_material.empty() ? 0 : polygons.face_material[i]);
  }
}

}  // namespace

void LevelColours::add(const Vec3& levels) {
  constexpr double kOverlit = 2.0;  // what lights may make of 1
  if (full_ < most_ && (levels.array() > std::max(full_, kOverlit)).any()) {
    for (std::uint32_t& of : rgb) {
      of = rgb_of([&](unsigned shift) {
        return static_cast<std::uint32_t>(std::lround(full_ / most_ * level_of(of, shift)));
      });
    }
    full_ = most_;
  }
  rgb.push_back(rgb_of([&](unsigned shift) {
    const double share = levels[2 - shift / 8] / full_;
    return static_cast<std::uint32_t>(
        std::lround(255.0 * (share >= 0.0 ? std::min(share, 1.0) : 0.0)));
  }));
}

Faces triangles_of(std::span<const std::uint32_t> corners, const std::vector<Vec3>& vertices) {
  Faces out;
  EarClipper().cut(corners, vertices, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    out.push_back({a, b, c});
  });
  return out;
}

void take_colours(std::span<const std::uint32_t> face_rgb, std::vector<Material>& materials,
                  std::vector<std::uint16_t>& face_material) {
  const bool are_exact = are_few(face_rgb);
  std::unordered_map<std::uint32_t, std::uint16_t> index_of;
  materials.clear();
  face_material.clear();
  face_material.reserve(face_rgb.size());
  for (const std::uint32_t file_rgb : face_rgb) {
    const std::uint32_t rgb = are_exact ? file_rgb : in_steps(file_rgb);
    const auto next = static_cast<std::uint16_t>(materials.size());
    const auto [entry, is_new] = index_of.try_emplace(rgb, next);
    if (is_new) materials.push_back(material_of(rgb));
    face_material.push_back(entry->second);
  }
}

TriangleMesh triangulated(PolygonMesh polygons) {
  TriangleMesh mesh;
  mesh.materials = std::move(polygons.materials);
  cut_faces(polygons, mesh);
  // free each one as soon as it is used: a large file may fill the memory
  give_back(polygons.corners);
  give_back(polygons.face_ends);
  give_back(polygons.face_material);
  give_back(polygons.corner_looks);
  mesh.vertices_m.reserve(polygons.vertices.size());
  for (const Vec3& p : polygons.vertices) mesh.vertices_m.push_back(p.cast<float>());
  give_back(polygons.vertices);
  if (polygons.vertex_rgb.empty()) return mesh;
  std::vector<std::uint32_t> face_rgb;
  face_rgb.reserve(mesh.faces.size());
  for (const auto& face : mesh.faces) face_rgb.push_back(mean_rgb(polygons.vertex_rgb, face));
  take_colours(face_rgb, mesh.materials, mesh.face_material);
  return mesh;
}

}  // namespace gnbv
