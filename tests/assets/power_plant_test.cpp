#include "assets/power_plant.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "assets/power_plant_parts.hpp"
#include "tests/assets/body_laws.hpp"

namespace gnbv {
namespace {

const TriangleMesh& mesh() {
  static const TriangleMesh made = make_power_plant();
  return made;
}

const std::vector<Body>& bodies() {
  static const std::vector<Body> made = bodies_of(mesh());
  return made;
}

std::vector<Triangle> triangles() {
  std::vector<Triangle> list;
  for (const Body& body : bodies())
    for (std::size_t face = 0; face < body.part.faces.size(); ++face)
      list.push_back(body.triangle(face));
  return list;
}

std::string where(const Body& body) {
  const Vec3 middle = body.box.center();
  return "body around (" + std::to_string(middle.x()) + ", " + std::to_string(middle.y()) + ", " +
         std::to_string(middle.z()) + ")";
}

TEST(PowerPlant, HasTheSizeOfThePapersPlant) {
  const Box3 box = bounds_m(mesh());
  EXPECT_NEAR(box.sizes().x(), 24.8, 0.05);
  EXPECT_NEAR(box.sizes().y(), 16.2, 0.1);
  EXPECT_NEAR(box.center().x(), 0.0, 0.05);
  EXPECT_NEAR(box.center().y(), 0.0, 0.05);
  EXPECT_NEAR(box.max().z(), 12.0, 0.05);
  EXPECT_LT(box.max().z(), 12.0);  // inside the workspace
}

TEST(PowerPlant, StandsOnTheGroundAndReachesNowhereBelow) {
  EXPECT_EQ(bounds_m(mesh()).min().z(), 0.0);
}

TEST(PowerPlant, HasTheCountsPromised) {
  // The paper: 4,422 faces; closed bodies share the vertices that its model repeats.
  EXPECT_GE(mesh().faces.size(), 4000U);
  EXPECT_LE(mesh().faces.size(), 5000U);
  EXPECT_GE(mesh().vertices_m.size(), 2700U);
  EXPECT_LE(mesh().vertices_m.size(), 3300U);
}

TEST(PowerPlant, EveryBodyIsClosedAndFacesOutwards) {
  EXPECT_EQ(open_edges(mesh().faces), 0U);
  EXPECT_GT(bodies().size(), 200U);
  for (const Body& body : bodies()) EXPECT_GT(signed_volume_m3(body.part), 0.0) << where(body);
}

TEST(PowerPlant, HasNoDegenerateFaceAndNoUnusedVertex) {
  std::vector<bool> used(mesh().vertices_m.size(), false);
  for (const auto& f : mesh().faces)
    for (const auto v : f) used[v] = true;
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
  for (const Vec3f& v : mesh().vertices_m) ASSERT_TRUE(v.allFinite());
  for (const Body& body : bodies())
    for (std::size_t face = 0; face < body.part.faces.size(); ++face) {
      const Triangle t = body.triangle(face);
      const double longest_m =
          std::max({(t.b - t.a).norm(), (t.c - t.b).norm(), (t.a - t.c).norm()});
      EXPECT_GT(2.0 * t.area_vector().norm() / longest_m, 0.01)  // a coping's mitre is the finest
          << where(body);
    }
}

TEST(PowerPlant, EveryFaceHasANamedMaterialAndEveryMaterialIsUsed) {
  ASSERT_EQ(mesh().face_material.size(), mesh().faces.size());
  const std::set<std::uint16_t> used(mesh().face_material.begin(), mesh().face_material.end());
  EXPECT_EQ(used.size(), mesh().materials.size());
  EXPECT_LT(*used.rbegin(), mesh().materials.size());
  EXPECT_GE(mesh().materials.size(), 10U);
  std::set<std::string> names;
  for (const Material& material : mesh().materials) {
    names.insert(material.name);
    EXPECT_NE(material.pattern, Pattern::plain) << material.name;  // features everywhere
    EXPECT_GT(material.pattern_size_m, 0.0F) << material.name;
    for (const auto& rgb : {material.rgb, material.rgb_2})
      for (const float c : rgb)  // soot to fresh white paint
        EXPECT_TRUE(c >= 0.01F && c <= 0.8F) << material.name;
  }
  EXPECT_EQ(names.size(), mesh().materials.size());
}

TEST(PowerPlant, IsTheSameEveryTime) {
  const TriangleMesh again = make_power_plant();
  EXPECT_EQ(mesh().vertices_m, again.vertices_m);  // bit for bit: there are neither NaN nor -0
  EXPECT_EQ(mesh().faces, again.faces);
  EXPECT_EQ(mesh().face_material, again.face_material);
}

TEST(PowerPlant, HasNoLargePlaneOnAVoxelBoundary) {
  // Such a plane would fall into one layer of voxels or the other by rounding.
  constexpr double kLarge_m2 = 0.05;
  for (const Triangle& t : triangles())
    for (int axis = 0; axis < 3; ++axis) {
      const double at_m = t.a[axis], cells = at_m / 0.05;
      const bool is_level = t.b[axis] == at_m && t.c[axis] == at_m;
      const bool is_ground = axis == 2 && at_m == 0.0;
      if (is_level && !is_ground && t.area_vector().norm() > kLarge_m2) {
        EXPECT_GT(std::abs(cells - std::round(cells)), 0.01)  // 0.5 mm
            << "xyz"[axis] << " = " << at_m << " around " << t.middle().transpose();
      }
    }
}

TEST(PowerPlant, NoFacesOfTwoBodiesShareAPlane) {
  // Nearer than 2 mm they would flicker in pictures and count twice in samples. Undersides on the
  // ground are never seen.
  const std::vector<Body>& all = bodies();
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      if (!all[i].box.intersects(all[j].box)) continue;
      double shared_m2 = 0.0;
      for (std::size_t f = 0; f < all[i].part.faces.size(); ++f) {
        const Triangle s = all[i].triangle(f);
        const Vec3 normal = s.area_vector().normalized();
        if (std::max({s.a.z(), s.b.z(), s.c.z()}) == 0.0) continue;
        for (std::size_t g = 0; g < all[j].part.faces.size(); ++g) {
          const Triangle t = all[j].triangle(g);
          if (std::abs(normal.dot(t.area_vector().normalized())) > 0.9999 &&
              std::abs(normal.dot(t.middle() - s.a)) < 0.002)
            shared_m2 += overlap_m2(s, t);
        }
      }
      EXPECT_LT(shared_m2, 1e-6) << where(all[i]) << " and " << where(all[j]);
    }
}

TEST(PowerPlant, EveryBodyShowsItself) {
  for (const Body& body : bodies()) {
    bool is_seen = false;
    for (std::size_t face = 0; face < body.part.faces.size() && !is_seen; ++face) {
      const Triangle t = body.triangle(face);
      const Vec3 above = t.middle() + 1e-4 * t.area_vector().normalized();
      is_seen = above.z() > 0.0 && std::none_of(bodies().begin(), bodies().end(),
                                                [&](const Body& b) { return is_inside(b, above); });
    }
    EXPECT_TRUE(is_seen) << where(body);
  }
}

TEST(PowerPlant, NothingFloats) {
  // Every body stands on the ground or pierces one that does, or one that pierces that, ...
  const std::vector<Body>& all = bodies();
  std::vector<std::size_t> reached;
  std::vector<bool> is_held(all.size(), false);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].box.min().z() == 0.0) {
      is_held[i] = true;
      reached.push_back(i);
    }
  for (std::size_t next = 0; next < reached.size(); ++next)
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Body& holder = all[reached[next]];
      if (is_held[i] || !all[i].box.intersects(holder.box)) continue;
      if (!edges_pierce(all[i], holder) && !edges_pierce(holder, all[i])) continue;
      is_held[i] = true;
      reached.push_back(i);
    }
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_TRUE(is_held[i]) << where(all[i]);
}

TEST(PowerPlant, IsItsOwnImageInNoMirror) {
  // Every 50th part of the surface, asked at the middle of the face it falls into.
  const std::vector<Triangle> all = triangles();
  double total_m2 = 0.0;
  for (const Triangle& t : all) total_m2 += t.area_vector().norm();
  constexpr int kSamples = 500;
  for (const Vec3& mirror : {Vec3(-1, 1, 1), Vec3(1, -1, 1), Vec3(-1, -1, 1)}) {
    int alone = 0, taken = 0;
    double sum_m2 = 0.0;
    for (const Triangle& t : all) {
      sum_m2 += t.area_vector().norm();
      for (; taken < kSamples && sum_m2 / total_m2 * kSamples > taken + 0.5; ++taken) {
        const Vec3 image = t.middle().cwiseProduct(mirror);
        alone += std::none_of(all.begin(), all.end(),
                              [&](const Triangle& u) { return distance_m(u, image) < 0.5; });
      }
    }
    EXPECT_EQ(taken, kSamples);
    EXPECT_GT(alone, kSamples / 3) << mirror.transpose();
  }
}

/// Free width at p along an axis, between the first surfaces both ways.
double width_m(const std::vector<Triangle>& all, const Vec3& p, const Vec3& axis) {
  double ahead = 1e3, behind = 1e3;
  for (const Triangle& t : all) {
    ahead = std::min(ahead, meets(t, p, axis).value_or(1e3));
    behind = std::min(behind, meets(t, p, -axis).value_or(1e3));
  }
  return ahead + behind;
}

TEST(PowerPlant, HasDeepGapsInWhichACameraHardlyFits) {
  // Places half a metre apart where the gap is 1 to 2.5 m wide, low down and high up.
  const std::vector<Triangle> all = triangles();
  const auto is_gap = [&](const Vec3& p) {
    if (std::any_of(bodies().begin(), bodies().end(),
                    [&](const Body& b) { return is_inside(b, p); }))
      return false;
    const double gap_m = std::min(width_m(all, p, Vec3::UnitX()), width_m(all, p, Vec3::UnitY()));
    return gap_m > 1.0 && gap_m < 2.5;
  };
  int places = 0;
  for (double x_m = -12.26; x_m < 12.4; x_m += 0.5)
    for (double y_m = -7.94; y_m < 8.1; y_m += 0.5)
      places += is_gap({x_m, y_m, 3.23}) && is_gap({x_m, y_m, 1.57}) && is_gap({x_m, y_m, 0.71});
  EXPECT_GE(places, 40);  // 10 m²
}

}  // namespace
}  // namespace gnbv
