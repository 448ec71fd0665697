// The name of a cell: what its result depends on, in 16 digits.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "bench/sources/source_ids.hpp"
#include "scenarios/scenario.hpp"

namespace gnbv {

/// Names cells; remembers the content of the files it has read.
class CellNamer {
 public:
  explicit CellNamer(std::string version = GNBV_VERSION, std::string source = flying_source_id())
      : version_(std::move(version)), source_(std::move(source)) {}

  /// 16 hexadecimal digits of the SHA-256 of the program (its version and flying_source_id()) and
  /// the resolved scenario, in which files (a mesh, a saved profile) are named by the SHA-256 of
  /// their content, wherever they lie, and a function of the user's own by its text alone. Two
  /// builds of the same sources share their cells, any change of what flies a mission does not. A
  /// file that the mesh refers to (the .bin of a .gltf) is not followed. Throws BadInput naming a
  /// file that cannot be read.
  std::string id_of(const Scenario& scenario);

 private:
  std::string content_path(const std::string& path);

  std::string version_;
  std::string source_;
  std::map<std::string, std::string> content_paths_;
};

}  // namespace gnbv
