// Whatever stands in a mesh file: it is read or refused as BadInput, and what was read keeps its
// promises. The first byte chooses the format.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "sim/core/error.hpp"
#include "sim/mesh/mesh_file.hpp"
#include "sim/mesh/plain_text.hpp"
#include "sim/mesh/polygon_mesh.hpp"
#include "tests/fuzz/written.hpp"

namespace gnbv {
namespace {

void check_mesh(const PolygonMesh& mesh) {
  std::uint32_t begin = 0;
  for (const std::uint32_t end : mesh.face_ends) {
    GNBV_CHECK(end >= begin + 3 && end <= mesh.corners.size(), "a face of {} corners", end - begin);
    begin = end;
  }
  for (const std::uint32_t corner : mesh.corners) {
    GNBV_CHECK(corner < mesh.vertices.size(), "vertex {} of {}", corner, mesh.vertices.size());
  }
  GNBV_CHECK(mesh.face_material.empty() || mesh.face_material.size() == mesh.face_ends.size(),
             "{} materials", mesh.face_material.size());
  if (!mesh.not_finite.empty()) return;
  for (const Vec3& vertex : mesh.vertices) GNBV_CHECK(vertex.allFinite(), "not finite, not named");
  if (mesh.corners.size() > 3000) return;  // ears take the square of them
  const TriangleMesh triangles = triangulated(mesh);
  GNBV_CHECK(triangles.faces.size() == mesh.corners.size() - 2 * mesh.face_ends.size(),
             "{} triangles", triangles.faces.size());
}

void check_units(std::string_view content) {
  const DeclaredAxes declared = declared_by_collada(content);
  GNBV_CHECK(declared.unit_m.has_value() && *declared.unit_m > 0.0, "a unit of nothing");
  GNBV_CHECK(declared.up_axis >= 'x' && declared.up_axis <= 'z', "an axis of no name");
  const auto number = read_decimal(content.substr(0, 64));
  GNBV_CHECK(!number || !content.empty(), "a number out of nothing");
}

}  // namespace
}  // namespace gnbv

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view content(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (data[0] == 'c') {
    gnbv::check_units(content);
    return 0;
  }
  std::vector<std::string> warnings;
  try {
    const auto path = gnbv::written(content, "mesh");
    gnbv::check_mesh(data[0] == 'p' ? gnbv::read_ply(path, warnings)
                                    : gnbv::read_obj(path, warnings));
  } catch (const gnbv::BadInput&) {
    // said, and that is all
  }
  return 0;
}
