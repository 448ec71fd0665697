// Laws that every structure obeys as a whole.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "sim/core/sha256.hpp"
#include "sim/mesh/triangle_mesh.hpp"
#include "tests/assets/mesh_laws.hpp"

namespace gnbv {

inline std::string sha256_of(const TriangleMesh& mesh) {
  Sha256 hash;
  for (const Vec3f& v : mesh.vertices_m) hash.add(std::span<const float>(v.data(), 3));
  for (const auto& f : mesh.faces) hash.add(std::span<const std::uint32_t>(f));
  hash.add(std::span<const std::uint16_t>(mesh.face_material));
  for (const Material& material : mesh.materials) {
    hash.add(material.name);
    hash.add(std::span<const float>(material.rgb));
    hash.add(std::span<const float>(material.rgb_2));
    hash.add(std::span<const float>(&material.pattern_size_m, 1));
    hash.add(std::to_string(static_cast<int>(material.pattern)));
  }
  return hash.hex();
}

/// Expects every connected part to be closed and to face outwards; returns their number.
inline std::size_t expect_closed_parts(const TriangleMesh& mesh) {
  EXPECT_EQ(open_edges(mesh.faces), 0U);
  Part part;
  for (const Vec3f& v : mesh.vertices_m) part.points_m.push_back(v.cast<double>());
  const std::vector<Faces> parts = connected_parts(mesh.faces, mesh.vertices_m.size());
  for (const Faces& faces : parts) {
    part.faces = faces;
    EXPECT_GT(signed_volume_m3(part), 0.0);
  }
  return parts.size();
}

/// Every face has a material, every material a name of its own, a face and a pattern one can see.
inline void expect_sound_materials(const TriangleMesh& mesh) {
  ASSERT_EQ(mesh.face_material.size(), mesh.faces.size());
  const std::set<std::uint16_t> used(mesh.face_material.begin(), mesh.face_material.end());
  EXPECT_EQ(used.size(), mesh.materials.size());
  EXPECT_LT(*used.rbegin(), mesh.materials.size());
  std::set<std::string> names;
  for (const Material& material : mesh.materials) {
    names.insert(material.name);
    EXPECT_NE(material.name, Material{}.name);
    EXPECT_NE(material.pattern, Pattern::plain) << material.name;
    EXPECT_GT(material.pattern_size_m, 0.0F) << material.name;
    double contrast = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const float a = material.rgb[i], b = material.rgb_2[i];
      EXPECT_TRUE(a >= 0.0F && a <= 1.0F && b >= 0.0F && b <= 1.0F) << material.name;
      contrast = std::max(contrast, std::abs(a - b) / std::max<double>(a, b));
    }
    EXPECT_GT(contrast, 0.15) << material.name;  // of the brighter of the two, in one channel
  }
  EXPECT_EQ(names.size(), mesh.materials.size());
}

/// Smallest height of a triangle; 0 for degenerate ones. Expects every vertex to be used.
inline double least_face_height_m(const TriangleMesh& mesh) {
  std::vector<bool> used(mesh.vertices_m.size(), false);
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
    const auto [a, b, c] = face_corners_m(mesh, face);
    const double longest_m = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    least_m = std::min(least_m, (b - a).cross(c - a).norm() / std::max(longest_m, 1e-12));
    for (const auto v : mesh.faces[face]) used[v] = true;
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
  return least_m;
}

}  // namespace gnbv
