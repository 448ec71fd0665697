// What is wrong with a mesh, in figures. What needs rays is in tools/mesh_lint/mesh_report.hpp.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// A number of faces and their area.
struct FaceTally {
  std::size_t count = 0;
  double area_m2 = 0.0;
};

/// Corners are equal where their positions are (PositionIndices): a file may repeat a vertex for
/// every face. "Sound" faces have finite corners and are not flat; all figures after the first
/// block are about them alone.
struct MeshLint {
  std::size_t not_finite_vertices = 0;
  std::size_t not_finite_faces = 0;  // with such a corner
  std::size_t repeated_corners = 0;  // faces with a position twice
  std::size_t flat_faces = 0;        // all others that are flat
  std::size_t unreferenced_vertices = 0;

  FaceTally sound;
  Box3 box_m;           // around them
  FaceTally duplicate;  // an earlier face has the same corners in the same sense
  FaceTally two_sided;  // another face has the same corners in the opposite sense
  std::vector<bool> is_sound, is_two_sided;  // by face
  std::size_t edges = 0;                     // between positions
  std::size_t open_edges = 0;                // of one face
  std::size_t crowded_edges = 0;  // of more than two, a pair of two-sided faces counting as one
};

MeshLint lint_mesh(const TriangleMesh& mesh);

/// The axis (x, y or z) along which a structure stands, by its shape.
struct LikelyUp {
  char axis = 'z';
  bool is_sure = false;  // by more than where its surface is flat
};

/// Of the sound faces: `up`, which is taken for it, where its coordinates begin at 0; else the only
/// axis whose do; else the one with by far the most surface flat on its lower end. Sure is only
/// what both say of an axis that is not the thin one of a wall. Each axis is measured by its own
/// extent. Nothing when none tells.
std::optional<LikelyUp> likely_up_axis(const TriangleMesh& mesh, char up);

/// Area of the part of a face that lies below z_m.
double area_below_m2(const TriangleMesh& mesh, std::size_t face, double z_m);

}  // namespace gnbv
