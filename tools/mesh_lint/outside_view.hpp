// How much of a structure can be seen from outside, and which side of its faces.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/mesh/mesh_lint.hpp"

namespace gnbv {

struct OutsideView {
  double area_m2 = 0.0;
  double hidden_area_m2 = 0.0;  // no straight line leaves the structure from there
  FaceTally from_behind;        // seen from outside, but only their backs; two-sided faces aside
};

/// By samples of the surface and rays from them, by the rule of bench/score/surface_reference.hpp:
/// about one sample per 20,000th of the area, at least one a face. Every face has to be sound
/// (sim/mesh/mesh_lint.hpp), with its entry in `is_two_sided`. Deterministic at any number of
/// threads.
OutsideView view_from_outside(const TriangleMesh& mesh, const std::vector<bool>& is_two_sided,
                              int threads);

}  // namespace gnbv
