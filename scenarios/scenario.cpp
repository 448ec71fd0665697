#include "scenarios/scenario.hpp"

#include <fmt/format.h>

namespace gnbv {

std::vector<MeshFileKey> mesh_files(Scenario& scenario) {
  std::vector<MeshFileKey> all = {{"structure.file", &scenario.structure.file}};
  for (std::size_t i = 0; i < scenario.structure.files.size(); ++i) {
    all.push_back({fmt::format("structure.files.{}", i), &scenario.structure.files[i]});
  }
  all.push_back({"terrain", &scenario.terrain});
  for (std::size_t i = 0; i < scenario.obstacles.size(); ++i) {
    all.push_back({fmt::format("obstacles.{}.file", i), &scenario.obstacles[i].file});
  }
  return all;
}

}  // namespace gnbv
