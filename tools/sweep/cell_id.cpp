#include "tools/sweep/cell_id.hpp"

#include "scenarios/load.hpp"
#include "sim/core/file.hpp"
#include "sim/core/sha256.hpp"

namespace gnbv {

std::string CellNamer::content_path(const std::string& path) {
  if (path.empty()) return path;
  std::string& known = content_paths_[path];
  if (known.empty()) {
    Sha256 hash;
    hash.add(read_file(path));
    known = "/sha256/" + hash.hex();  // absolute: to_yaml() puts the current folder before others
  }
  return known;
}

std::string CellNamer::id_of(const Scenario& scenario) {
  Scenario named = scenario;
  for (const MeshFileKey& mesh : mesh_files(named)) mesh.file->path = content_path(mesh.file->path);
  named.planner.utility.python.label.clear();
  named.planner.utility.python.file.clear();
  std::string& profile = named.planner.profiling.file;
  profile = content_path(profile);
  Sha256 hash;
  hash.add("gnbv cell 2\n" + version_ + "\n" + source_ + "\n");
  hash.add(to_yaml(named));
  return hash.hex().substr(0, 16);
}

}  // namespace gnbv
