// Laws of the closed bodies that the built-in structures consist of, by brute force.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assets/catalog.hpp"
#include "tests/assets/body_laws.hpp"

namespace gnbv {
namespace {

struct Exceptions {
  std::string_view name;
  std::size_t hidden = 0;  // wheel hubs within their tyres
  std::size_t loose = 0;   // control surfaces in their slots, and the struts of the wheels
};

void PrintTo(const Exceptions& row, std::ostream* out) { *out << row.name; }

class StructureBodies : public testing::TestWithParam<Exceptions> {
 protected:
  const std::vector<Body> bodies_ = bodies_of(make_builtin_structure(GetParam().name));
  double foot_m() const { return std::ranges::min_element(bodies_, {}, bottom_m)->box.min().z(); }
  static double bottom_m(const Body& body) { return body.box.min().z(); }
};

std::string where(const Body& body) {
  const Vec3 middle = body.box.center();
  return fmt::format("body around ({}, {}, {})", middle.x(), middle.y(), middle.z());
}

TEST_P(StructureBodies, ShareNoPlane) {
  // Faces of two bodies nearer than 2 mm would flicker in pictures and count twice in samples.
  // Undersides at the foot are never seen.
  const double lowest_m = foot_m();
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    for (std::size_t j = i + 1; j < bodies_.size(); ++j) {
      const Body &one = bodies_[i], &other = bodies_[j];
      if (!one.box.intersects(other.box)) continue;
      double shared_m2 = 0.0;
      for (std::size_t f = 0; f < one.part.faces.size(); ++f) {
        const Triangle s = one.triangle(f);
        const Vec3 normal = s.area_vector().normalized();
        if (std::max({s.a.z(), s.b.z(), s.c.z()}) == lowest_m) continue;
        for (std::size_t g = 0; g < other.part.faces.size(); ++g) {
          const Triangle t = other.triangle(g);
          if (std::abs(normal.dot(t.middle() - s.a)) < 0.002 &&
              std::abs(normal.dot(t.area_vector().normalized())) > 0.9999)
            shared_m2 += overlap_m2(s, t);
        }
      }
      EXPECT_LT(shared_m2, 1e-6) << where(one) << " and " << where(other);
    }
}

TEST_P(StructureBodies, AllShowThemselves) {
  std::vector<std::string> hidden;
  for (const Body& body : bodies_) {
    bool is_seen = false;
    for (std::size_t face = 0; face < body.part.faces.size() && !is_seen; ++face) {
      const Triangle t = body.triangle(face);
      const Vec3 above = t.middle() + 1e-4 * t.area_vector().normalized();
      is_seen = above.z() > 0.0 && std::none_of(bodies_.begin(), bodies_.end(),
                                                [&](const Body& b) { return is_inside(b, above); });
    }
    if (!is_seen) hidden.push_back(where(body));
  }
  EXPECT_EQ(hidden.size(), GetParam().hidden) << testing::PrintToString(hidden);
}

TEST_P(StructureBodies, HoldEachOther) {
  // Each stands at the foot or pierces one that does, or one that pierces that, ...
  std::vector<std::size_t> reached;
  std::vector<bool> is_held(bodies_.size(), false);
  const auto hold = [&](std::size_t i) {
    is_held[i] = true;
    reached.push_back(i);
  };
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (bottom_m(bodies_[i]) == foot_m()) hold(i);
  for (std::size_t next = 0; next < reached.size(); ++next)
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Body& holder = bodies_[reached[next]];
      if (is_held[i] || !bodies_[i].box.intersects(holder.box)) continue;
      if (edges_pierce(bodies_[i], holder) || edges_pierce(holder, bodies_[i])) hold(i);
    }
  std::vector<std::string> loose;
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (!is_held[i]) loose.push_back(where(bodies_[i]));
  EXPECT_EQ(loose.size(), GetParam().loose) << testing::PrintToString(loose);
}

INSTANTIATE_TEST_SUITE_P(Builtin, StructureBodies,
                         testing::Values(Exceptions{"aircraft"}, Exceptions{"power_plant"},
                                         Exceptions{"lab_model"}, Exceptions{"lab_airplane", 2, 9},
                                         Exceptions{"smoke"}),
                         [](const auto& row) { return std::string(row.param.name); });

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
  const std::vector<Body> bodies = bodies_of(make_builtin_structure("power_plant"));
  std::vector<Triangle> all;
  for (const Body& body : bodies)
    for (std::size_t face = 0; face < body.part.faces.size(); ++face)
      all.push_back(body.triangle(face));
  const auto is_gap = [&](const Vec3& p) {
    if (std::any_of(bodies.begin(), bodies.end(), [&](const Body& b) { return is_inside(b, p); }))
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
