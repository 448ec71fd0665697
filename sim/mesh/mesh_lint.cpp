#include "sim/mesh/mesh_lint.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "sim/core/error.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

using Corners = std::array<Vec3, 3>;

double area_m2(const Corners& p) { return 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm(); }

/// For each vertex the first one at the same place, as PositionIndices has it; by a table of
/// indices alone, since a node a vertex is what lint of millions waits for.
std::vector<std::uint32_t> first_at_place(const std::vector<Vec3f>& vertices_m) {
  constexpr std::uint32_t kFree = ~std::uint32_t{0};
  std::vector<std::uint32_t> table(std::bit_ceil(2 * vertices_m.size() + 1), kFree), first;
  first.reserve(vertices_m.size());
  for (std::uint32_t i = 0; i < vertices_m.size(); ++i) {
    first.push_back(i);
    if (vertices_m[i].hasNaN()) continue;
    std::uint64_t hash = 0;
    for (const float x : vertices_m[i]) {
      hash = mix_bits(hash + std::bit_cast<std::uint32_t>(x + 0.0F));  // -0 becomes 0
    }
    for (std::size_t at = hash;; ++at) {
      std::uint32_t& entry = table[at & (table.size() - 1)];
      if (entry == kFree) entry = i;
      if (vertices_m[entry] != vertices_m[i]) continue;
      first.back() = entry;
      break;
    }
  }
  return first;
}

/// A sound face by its corners in ascending order and the sense in which it runs through them.
struct SortedFace {
  std::array<std::uint32_t, 3> corners;
  std::uint32_t sense_and_face = 0;  // 16 bytes in all: they are sorted

  static constexpr std::uint32_t kReversed = 1U << 31U;
  bool is_reversed() const { return (sense_and_face & kReversed) != 0; }
  std::size_t face() const { return sense_and_face & ~kReversed; }

  bool has_corners_of(const SortedFace& other) const { return corners == other.corners; }
  auto operator<=>(const SortedFace&) const = default;
};

SortedFace sorted(std::array<std::uint32_t, 3> corners, std::size_t face) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  const bool is_reversed = corners[1] > corners[2];
  if (is_reversed) std::swap(corners[1], corners[2]);
  return {corners, static_cast<std::uint32_t>(face) | (is_reversed ? SortedFace::kReversed : 0U)};
}

void add(FaceTally& tally, double area) {
  ++tally.count;
  tally.area_m2 += area;
}

/// In the sorted `faces`, those with the same corners stand together, those of one sense first.
void tally_twins(const TriangleMesh& mesh, const std::vector<SortedFace>& faces, MeshLint& out) {
  for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
    while (end < faces.size() && faces[end].has_corners_of(faces[begin])) ++end;
    const bool has_both_senses = faces[begin].is_reversed() != faces[end - 1].is_reversed();
    for (std::size_t i = begin; i < end; ++i) {
      const double area = face_area_m2(mesh, faces[i].face());
      if (i > begin && faces[i].is_reversed() == faces[i - 1].is_reversed())
        add(out.duplicate, area);
      if (!has_both_senses) continue;
      add(out.two_sided, area);
      out.is_two_sided[faces[i].face()] = true;
    }
  }
}

/// Faces of the same corners count once.
void count_edges(const std::vector<SortedFace>& faces, MeshLint& out) {
  std::vector<std::uint64_t> edges;
  edges.reserve(3 * faces.size());
  const auto edge = [](std::uint32_t low, std::uint32_t high) {
    return std::uint64_t{low} << 32U | high;
  };
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (i > 0 && faces[i].has_corners_of(faces[i - 1])) continue;
    const auto& [a, b, c] = faces[i].corners;
    edges.insert(edges.end(), {edge(a, b), edge(b, c), edge(a, c)});
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end] == edges[begin]) ++end;
    ++out.edges;
    if (end - begin == 1) ++out.open_edges;
    if (end - begin > 2) ++out.crowded_edges;
  }
}

}  // namespace

double area_below_m2(const TriangleMesh& mesh, std::size_t face, double z_m) {
  Corners p = face_corners_m(mesh, face);
  std::sort(p.begin(), p.end(), [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
  if (p[0].z() >= z_m) return 0.0;
  if (p[2].z() <= z_m) return area_m2(p);
  const auto on_plane = [&](const Vec3& low, const Vec3& high) -> Vec3 {
    return low + (z_m - low.z()) / (high.z() - low.z()) * (high - low);
  };
  if (p[1].z() >= z_m) return area_m2({p[0], on_plane(p[0], p[1]), on_plane(p[0], p[2])});
  return area_m2(p) - area_m2({p[2], on_plane(p[1], p[2]), on_plane(p[0], p[2])});
}

std::optional<LikelyUp> likely_up_axis(const TriangleMesh& mesh, char up) {
  constexpr double kNearZero = 0.02;    // of an axis's extent
  constexpr double kLayer = 0.01;       // of it, above the lower end
  constexpr double kRounding = 1e-6;    // of the largest extent
  constexpr double kMinContact = 0.05;  // of the area
  constexpr double kDominance = 3.0;    // over the other axes
  constexpr double kThin = 0.2;         // of the extent of what is taken for up
  Box3 box;
  double area = 0.0;
  std::vector<std::pair<Box3, double>> faces;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const Corners p = face_corners_m(mesh, i);
    if (!(p[0] + p[1] + p[2]).allFinite() || is_flat(mesh, i)) continue;
    Box3 face_box;
    for (const Vec3& corner : p) face_box.extend(corner);
    faces.emplace_back(face_box, area_m2(p));
    box.extend(face_box);
    area += faces.back().second;
  }
  if (faces.empty()) return std::nullopt;
  const double rounding = kRounding * box.sizes().maxCoeff();
  const Eigen::Array3d extent = box.sizes().array();
  const Eigen::Array<bool, 3, 1> begins_at_zero =
      box.min().cwiseAbs().array() <= kNearZero * extent + rounding;
  if (begins_at_zero[up - 'x']) return LikelyUp{up, true};
  Vec3 contact = Vec3::Zero();  // share of the area within the lowest layer
  for (const auto& [face_box, face_area] : faces) {
    const auto is_low = face_box.max().array() <= box.min().array() + kLayer * extent + rounding;
    contact += is_low.select(Vec3::Constant(face_area / area), 0.0).matrix();
  }
  constexpr std::array kAxes = {'x', 'y', 'z'};
  const bool some_begin = begins_at_zero.any();
  std::optional<LikelyUp> found;
  for (Eigen::Index a = 0; a < 3; ++a) {
    const char axis = kAxes[static_cast<std::size_t>(a)];
    if (some_begin && !begins_at_zero[a]) continue;
    const double others = std::max(contact[(a + 1) % 3], contact[(a + 2) % 3]);
    const bool is_flat_there = contact[a] >= kMinContact && contact[a] >= kDominance * others;
    const bool begins_alone = begins_at_zero[a] && begins_at_zero.count() == 1;
    const bool is_thin = extent[a] < kThin * extent[up - 'x'];
    if (is_flat_there || begins_alone) {
      found = LikelyUp{axis, is_flat_there && begins_alone && !is_thin};
    }
  }
  return found;
}

MeshLint lint_mesh(const TriangleMesh& mesh) {
  MeshLint out;
  const std::vector<std::uint32_t> first = first_at_place(mesh.vertices_m);
  out.is_sound.assign(mesh.faces.size(), false);
  out.is_two_sided.assign(mesh.faces.size(), false);
  std::vector<bool> is_used(mesh.vertices_m.size(), false);
  GNBV_CHECK(mesh.faces.size() < SortedFace::kReversed, "{} faces", mesh.faces.size());
  std::vector<SortedFace> sound;
  sound.reserve(mesh.faces.size());
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    std::array<std::uint32_t, 3> corners{};
    bool is_finite = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t vertex = mesh.faces[i][k];
      is_used[vertex] = true;
      is_finite = is_finite && mesh.vertices_m[vertex].allFinite();
      corners[k] = first[vertex];
    }
    const auto& [a, b, c] = corners;
    if (!is_finite) {
      ++out.not_finite_faces;
    } else if (a == b || b == c || c == a) {
      ++out.repeated_corners;
    } else if (is_flat(mesh, i)) {
      ++out.flat_faces;
    } else {
      out.is_sound[i] = true;
      sound.push_back(sorted(corners, i));
      add(out.sound, face_area_m2(mesh, i));
      for (const std::uint32_t v : corners) out.box_m.extend(mesh.vertices_m[v].cast<double>());
    }
  }
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i) {
    if (!is_used[i]) ++out.unreferenced_vertices;
    if (!mesh.vertices_m[i].allFinite()) ++out.not_finite_vertices;
  }
  std::sort(sound.begin(), sound.end());
  tally_twins(mesh, sound, out);
  count_edges(sound, out);
  return out;
}

}  // namespace gnbv
