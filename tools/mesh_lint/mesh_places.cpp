#include "tools/mesh_lint/mesh_places.hpp"

#include <algorithm>

#include "sim/mesh/mesh_file.hpp"

namespace gnbv {

double reach_m(const Scenario& scenario) { return 32767.0 * scenario.planner.map.resolution_m; }

double farthest_m(const Box3& box_m) {
  return std::max(box_m.min().cwiseAbs().maxCoeff(), box_m.max().cwiseAbs().maxCoeff());
}

double may_sink_m(const Box3& box_m) { return std::max(0.01, 0.002 * box_m.sizes().z()); }

double may_float_m(const Box3& box_m) { return std::max(1.0, 0.2 * box_m.sizes().z()); }

double share_below(const MeshLint& lint, const TriangleMesh& mesh, double z_m) {
  double below_m2 = 0.0, all_m2 = 0.0;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    if (!lint.is_sound[i]) continue;
    below_m2 += area_below_m2(mesh, i, z_m);
    all_m2 += face_area_m2(mesh, i);
  }
  return all_m2 > 0.0 ? below_m2 / all_m2 : 0.0;
}

TriangleMesh in_file_axes(const MeshReport& report, const Scenario& scenario) {
  TriangleMesh in_file = report.reading.mesh;
  const Eigen::Matrix3d R_file_world = R_z_up(report.reading.up_axis).transpose() *
                                       R_yaw(scenario.structure.file.yaw_rad).transpose();
  for (Vec3f& v : in_file.vertices_m) {
    v = (R_file_world * (v.cast<double>() - scenario.structure.file.offset_m)).cast<float>();
  }
  return in_file;
}

TriangleMesh sound_part(const TriangleMesh& mesh, const MeshLint& lint) {
  TriangleMesh out;
  out.vertices_m = mesh.vertices_m;
  // no face reaches these, but a ray tracer wants numbers
  for (Vec3f& v : out.vertices_m) {
    if (!v.allFinite()) v = Vec3f::Zero();
  }
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    if (lint.is_sound[i]) out.faces.push_back(mesh.faces[i]);
  }
  return out;
}

}  // namespace gnbv
