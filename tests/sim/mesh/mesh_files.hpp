// Mesh files written by the tests that read them.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "sim/core/error.hpp"
#include "sim/mesh/mesh_file.hpp"
#include "tests/support/fault.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv::test {

inline MeshFileConfig file(const std::filesystem::path& path) { return {.path = path.string()}; }

class MeshFile : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& content) const {
    return temp_.write(name, content);
  }
  MeshReading read(const std::string& name, const std::string& content) const {
    return read_mesh(file(write(name, content)));
  }
  /// The message of the BadInput that loading throws; empty when it loads.
  std::string fault(const std::string& name, const std::string& content) const {
    return fault_of([&] { load_mesh(file(write(name, content))); });
  }

  TempFolder temp_;
  std::filesystem::path folder_ = temp_.path();
};

/// Positive for a closed surface whose faces turn outwards.
inline double volume_m3(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const auto c = face_corners_m(mesh, i);
    sum += c[0].dot(c[1].cross(c[2])) / 6.0;
  }
  return sum;
}

/// One that may lose all of its faces.
inline MeshFileConfig forgiven(const std::filesystem::path& path) {
  MeshFileConfig config = file(path);
  config.lost_max = 1.0;
  return config;
}

/// The message of the BadInput that loading throws; empty when it loads.
inline std::string complaint(const MeshFileConfig& config) {
  return test::fault_of([&] { load_mesh(config); });
}

/// A box whose six sides take two materials in turn, with one vertex doubled on purpose.
inline TriangleMesh two_coloured_box() {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices_m.emplace_back((i & 1) != 0 ? 2.1F : -0.3F, (i & 2) != 0 ? 1.7F : 0.1F,
                                 (i & 4) != 0 ? 4.3F : 0.7F);
  }
  mesh.vertices_m.push_back(mesh.vertices_m[7]);
  mesh.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 8, 6}, {0, 1, 5}, {0, 5, 4},
                {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  mesh.materials = {{"hull", {0.25F, 0.5F, 0.75F}}, {"tail fin", {1.0F, 0.0F, 0.125F}}};
  mesh.face_material = {0, 0, 0, 0, 1, 1, 1, 1, 0, 0, 1, 1};
  return mesh;
}

/// Every corner of every face with its face's colour, in an order that files cannot change.
inline std::vector<std::array<float, 12>> coloured_triangles(const TriangleMesh& mesh) {
  std::vector<std::array<float, 12>> out;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    auto& row = out.emplace_back();
    // start at the smallest corner; the sense of rotation stays
    std::array<std::array<float, 3>, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3f& p = mesh.vertices_m[mesh.faces[i][k]];
      corner[k] = {p.x(), p.y(), p.z()};
    }
    std::rotate(corner.begin(), std::min_element(corner.begin(), corner.end()), corner.end());
    for (std::size_t k = 0; k < 9; ++k) row[k] = corner[k / 3][k % 3];
    const auto& rgb = mesh.materials[mesh.face_material.empty() ? 0 : mesh.face_material[i]].rgb;
    std::copy(rgb.begin(), rgb.end(), row.begin() + 9);
  }
  std::sort(out.begin(), out.end());
  return out;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return at == text.npos ? text : text.replace(at, from.size(), to);
}

inline std::string data_uri(const std::string& bytes) {
  std::string out = "data:application/octet-stream,";
  for (const char c : bytes) out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return out;
}

inline std::string in_utf16(const std::string& text, bool is_big, bool has_mark) {
  std::string out = has_mark ? (is_big ? "\xFE\xFF" : "\xFF\xFE") : "";
  for (const char c : text) out += is_big ? std::string{'\0', c} : std::string{c, '\0'};
  return out;
}

}  // namespace gnbv::test
