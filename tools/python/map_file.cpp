#include "tools/python/map_file.hpp"

#include <nanobind/stl/string.h>

#include <string>
#include <vector>

#include "planner/map/octomap_io.hpp"
#include "tools/python/arrays.hpp"

namespace gnbv {
namespace {

/// x, y, z of its centre, size, log-odds of each leaf; m, world ENU.
std::vector<double> rows_of(const OctomapLeaves& read) {
  std::vector<double> rows;
  for (const OctomapLeaf& leaf : read.leaves) {
    const double half_m = 0.5 * leaf.edge_voxels * read.voxel_m;
    for (const std::int32_t low : leaf.first) rows.push_back(low * read.voxel_m + half_m);
    rows.push_back(2.0 * half_m);
    rows.push_back(static_cast<double>(leaf.log_odds));
  }
  return rows;
}

}  // namespace

void bind_map_file(nanobind::module_& m) {
  m.def(
      "read_map",
      [](const std::string& path) { return owned_array(rows_of(read_octomap(path)), 5); },
      nb::arg("path"), nb::sig("def read_map(path: str) -> numpy.typing.NDArray[numpy.float64]"));
}

}  // namespace gnbv
