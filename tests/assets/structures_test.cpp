// Laws of the built-in structures, each over all of them.
#include <gtest/gtest.h>

#include <map>

#include "assets/catalog.hpp"
#include "scenarios/scenario.hpp"
#include "tests/assets/body_laws.hpp"
#include "tests/assets/structure_laws.hpp"

namespace gnbv {
namespace {

/// Across which axis the mesh is its own image: its vertices in x, its faces, too, in y.
enum class Mirror { none, x, y };

struct Expected {
  std::string_view name;
  Vec3 size_m;  // the papers' sizes
  double size_tolerance_m;
  double highest_foot_m;  // of its lowest point
  double area_m2;         // to 1 %
  std::size_t least_parts;
  double least_height_m;    // of a triangle: the finest detail
  float largest_pattern_m;  // tens of pixels from where a camera sees it
  std::vector<double> voxels_m;
  double largest_on_boundary_m2 = 0.0;  // of a face between two layers of voxels
  Mirror mirror = Mirror::none;
};

void PrintTo(const Expected& row, std::ostream* out) { *out << row.name; }

const std::vector<Expected> kExpected = {
    {"aircraft", {29.86, 35.37, 7.67}, 0.05, 0.45, 787.4, 100, 4e-3, 1.3F, {0.05}, 0.05, Mirror::x},
    {"power_plant", {24.8, 16.2, 12.0}, 0.1, 0.0, 2404.0, 200, 0.01, 1.0F, {0.05}, 0.05},
    {"lab_model", {1.3, 1.0, 1.5}, 0.01, 0.01, 9.64, 10, 3e-3, 0.12F, {0.04, 0.05, 0.07}},
    {"lab_airplane", {4, 3, 1}, 0.01, 0.01, 12.62, 60, 3e-4, 0.12F, {0.02, 0.05}, 1e-4, Mirror::y},
    {"smoke", {2.0, 1.3, 1.6}, 0.05, 0.02, 11.58, 2, 0.01, 0.2F, {0.05}},
};

/// Of the meshes that all missions so far were flown around; code drew them before they were files.
const std::map<std::string_view, std::string_view> kSha256 = {
    {"aircraft", "e1e956d6ce9f6162cc0825a23724cec9ab9d70bd0af1ed713b833754ba1bd331"},
    {"power_plant", "91aacffd8b7bf2cc9cabc4a9420d3e8fa24765b17f05a5489242c7cf350e67fc"},
    {"lab_model", "23abec8d841cbf02bdcd320eaa668fa0ae34d68b8222eae7e6b3d4671505b5f8"},
    {"lab_airplane", "c02c0d3f2740003387a64893790318ae5fef5e17ce245dee3820b5f097589830"},
    {"smoke", "25ac1780e480b49e93d10018aecda33858fb142cce5f69107b65a762d460b47d"}};

const TriangleMesh& mesh_of(std::string_view name) {
  static std::map<std::string_view, TriangleMesh> meshes;
  const auto [at, is_new] = meshes.try_emplace(name);
  if (is_new) at->second = make_builtin_structure(name);
  return at->second;
}

class Structure : public testing::TestWithParam<Expected> {
 protected:
  const TriangleMesh& mesh() const { return mesh_of(GetParam().name); }
};

TEST_P(Structure, IsTheOneThatMissionsWereFlownAround) {
  EXPECT_EQ(sha256_of(mesh()), kSha256.at(GetParam().name));
}

TEST_P(Structure, HasThePapersSizeAboutTheOriginAndReachesNowhereBelowTheGround) {
  const Box3 box = bounds_m(mesh());
  const double tolerance_m = GetParam().size_tolerance_m;
  EXPECT_TRUE((box.sizes() - GetParam().size_m).cwiseAbs().maxCoeff() < tolerance_m)
      << box.sizes().transpose();
  EXPECT_LT(box.center().head<2>().norm(), tolerance_m);
  EXPECT_GE(box.min().z(), 0.0);
  EXPECT_LE(box.min().z(), GetParam().highest_foot_m);
  EXPECT_NEAR(surface_area_m2(mesh()), GetParam().area_m2, 0.01 * GetParam().area_m2);
}

TEST_P(Structure, IsMadeOfClosedPartsThatFaceOutwards) {
  EXPECT_GE(expect_closed_parts(mesh()), GetParam().least_parts);
}

TEST_P(Structure, HasNoFlatFaceAndNoUnusedVertex) {
  EXPECT_GT(least_face_height_m(mesh()), GetParam().least_height_m);
}

TEST_P(Structure, HasNamedMaterialsThatACameraCanTellApart) {
  expect_sound_materials(mesh());
  for (const Material& material : mesh().materials) {
    EXPECT_LE(material.pattern_size_m, GetParam().largest_pattern_m) << material.name;
    for (const auto& rgb : {material.rgb, material.rgb_2})
      for (const float c : rgb)  // soot to fresh white paint
        EXPECT_TRUE(c >= 0.01F && c <= 0.9F) << material.name;
  }
}

/// The largest axis-aligned face within 0.1 mm of a boundary of voxels: rounding would decide the
/// layer it falls into. Undersides on the ground are never seen.
double largest_on_boundary_m2(const TriangleMesh& mesh, double voxel_m) {
  double largest_m2 = 0.0;
  for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
    const auto [a, b, c] = face_corners_m(mesh, face);
    for (int axis = 0; axis < 3; ++axis) {
      const double off_m = std::abs(std::remainder(a[axis], voxel_m));
      const bool is_underside = axis == 2 && a.z() == 0.0;
      if (a[axis] == b[axis] && b[axis] == c[axis] && off_m < 1e-4 && !is_underside)
        largest_m2 = std::max(largest_m2, face_area_m2(mesh, face));
    }
  }
  return largest_m2;
}

TEST_P(Structure, HasNoLargePlaneOnTheVoxelBoundariesInUse) {
  for (const double voxel_m : GetParam().voxels_m)
    EXPECT_LE(largest_on_boundary_m2(mesh(), voxel_m), GetParam().largest_on_boundary_m2)
        << voxel_m;
}

using Point = std::array<float, 3>;

/// In a mirror across one axis, or in none. -0 becomes 0.
Point image(Vec3f p, std::optional<int> axis) {
  if (axis) p[*axis] = -p[*axis];
  return {p.x() + 0.0F, p.y() + 0.0F, p.z() + 0.0F};
}

std::vector<Point> sorted_vertices(const TriangleMesh& mesh, std::optional<int> axis) {
  std::vector<Point> points;
  for (const Vec3f& p : mesh.vertices_m) points.push_back(image(p, axis));
  std::ranges::sort(points);
  return points;
}

/// The faces with their materials, corners in their order from the smallest on.
auto sorted_faces(const TriangleMesh& mesh, std::optional<int> axis) {
  std::vector<std::pair<std::array<Point, 3>, std::uint16_t>> faces;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    std::array<Point, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = image(mesh.vertices_m[mesh.faces[i][axis ? 2 - k : k]], axis);
    std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
    faces.emplace_back(corners, mesh.face_material[i]);
  }
  std::ranges::sort(faces);
  return faces;
}

TEST_P(Structure, IsItsOwnImageBitForBitWhereItIsSymmetric) {
  const Mirror mirror = GetParam().mirror;
  if (mirror == Mirror::none) return;
  const int axis = mirror == Mirror::x ? 0 : 1;
  EXPECT_TRUE(sorted_vertices(mesh(), axis) == sorted_vertices(mesh(), std::nullopt));
  if (mirror == Mirror::x) return;
  EXPECT_TRUE(sorted_faces(mesh(), axis) == sorted_faces(mesh(), std::nullopt));
}

std::vector<Triangle> triangles_of(const TriangleMesh& mesh) {
  std::vector<Triangle> list;
  for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
    const auto [a, b, c] = face_corners_m(mesh, face);
    list.push_back({a, b, c});
  }
  return list;
}

TEST_P(Structure, IsItsOwnImageInNoMirrorWhereItIsNot) {
  if (GetParam().mirror != Mirror::none) return;
  // samples spread over the area, each at the middle of the face it falls into
  constexpr int kSamples = 500;
  const double near_m = 0.02 * GetParam().size_m.maxCoeff();
  const std::vector<Triangle> all = triangles_of(mesh());
  const double total_m2 = surface_area_m2(mesh());
  for (const Vec3& mirror : {Vec3(-1, 1, 1), Vec3(1, -1, 1), Vec3(-1, -1, 1)}) {
    int alone = 0, taken = 0;
    double sum_m2 = 0.0;
    for (const Triangle& t : all) {
      sum_m2 += t.area_vector().norm();
      for (; taken < kSamples && sum_m2 / total_m2 * kSamples > taken + 0.5; ++taken) {
        const Vec3 image = t.middle().cwiseProduct(mirror);
        alone += std::none_of(all.begin(), all.end(),
                              [&](const Triangle& u) { return distance_m(u, image) < near_m; });
      }
    }
    EXPECT_EQ(taken, kSamples);
    EXPECT_GT(alone, kSamples / 4) << mirror.transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(Builtin, Structure, testing::ValuesIn(kExpected),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(Structures, AreThoseThatScenariosMayName) {
  EXPECT_TRUE(std::ranges::equal(kExpected, kStructureNames, {}, &Expected::name));
}

TEST(Structures, TheFuselageHasHalfTheDiameterOfAnA340) {
  double longest_m = 0.0, widest_m = 0.0;
  for (const Body& body : bodies_of(mesh_of("aircraft"))) {
    if (body.box.sizes().y() <= longest_m) continue;
    longest_m = body.box.sizes().y();
    widest_m = body.box.sizes().x();
  }
  EXPECT_NEAR(widest_m, 0.5 * 5.64, 1e-6);  // Airbus: 5.64 m
}

TEST(Structures, TheLabAirplaneStandsOnThreePlacesThatSurroundItsMiddle) {
  std::array<int, 3> touching = {0, 0, 0};  // nose, port, starboard
  for (const Vec3f& v : mesh_of("lab_airplane").vertices_m)
    if (v.z() < 0.01F) ++touching[v.x() > 0.5F ? 0 : v.y() > 0.0F ? 1 : 2];
  for (const int count : touching) EXPECT_GT(count, 0);
}

/// How often the line along `axis` through p enters the union of the closed parts.
int entries(const TriangleMesh& mesh, const Vec3& p_m, int axis) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::vector<std::pair<double, int>> crossings;  // coordinate, +1 in or -1 out
  for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
    const auto [a, b, c] = face_corners_m(mesh, face);
    const auto side = [&](const Vec3& from, const Vec3& to) {
      return (to[u] - from[u]) * (p_m[v] - from[v]) - (to[v] - from[v]) * (p_m[u] - from[u]);
    };
    const double wa = side(b, c), wb = side(c, a), wc = side(a, b);
    const bool front = wa > 0.0 && wb > 0.0 && wc > 0.0, back = wa < 0.0 && wb < 0.0 && wc < 0.0;
    if (!front && !back) continue;
    const double at = (wa * a[axis] + wb * b[axis] + wc * c[axis]) / (wa + wb + wc);
    crossings.emplace_back(at, front ? -1 : 1);  // the normal looks along the axis: outwards there
  }
  std::ranges::sort(crossings);
  int depth = 0, count = 0;
  for (const auto& [at, step] : crossings) {
    count += depth == 0 && step > 0;
    depth += step;
  }
  return count;
}

TEST(Structures, TheLabModelIsConcaveSeenAlongEveryAxis) {
  // A convex body is entered once by any line. One line in ten entering again means niches and
  // overhangs of that share of the silhouette. The grid begins off the round numbers, so that no
  // line runs along a face.
  constexpr double kStep_m = 0.0213;
  const Vec3 first_m(-0.6433, -0.4937, 0.0071), last_m(0.65, 0.5, 1.5);
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    int once = 0, again = 0;
    Vec3 p_m = Vec3::Zero();
    for (p_m[u] = first_m[u]; p_m[u] < last_m[u]; p_m[u] += kStep_m) {
      for (p_m[v] = first_m[v]; p_m[v] < last_m[v]; p_m[v] += kStep_m) {
        const int count = entries(mesh_of("lab_model"), p_m, axis);
        once += count > 0;
        again += count > 1;
      }
    }
    EXPECT_GT(once, 500) << axis;
    EXPECT_GT(again, 0.1 * once) << axis;
  }
}

}  // namespace
}  // namespace gnbv
