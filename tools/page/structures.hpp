// What stands in the worlds of a report's runs, each once.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tools/page/page_data.hpp"
#include "tools/page/true_surface.hpp"
#include "tools/run/run_inputs.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

/// A structure among what is around it, and what of its surface there is to find.
struct KnownStructure {
  World world;
  RayScene scene;
  TrueVoxels to_find;

  explicit KnownStructure(World its_world) : world(std::move(its_world)), scene(world) {}
};

struct Structures {
  struct OfRun {
    int number = -1;       // into `meshes`; -1: it cannot be had
    std::string why = {};  // not
    std::shared_ptr<const KnownStructure> known = {};
    std::vector<RunInput> inputs = {};  // that it is made of
  };
  std::vector<page::MeshData> meshes;
  std::vector<OfRun> of_run;
};

/// Of all records, none where the run was flown around another structure; the true surface from the
/// cache, or found.
Structures pack_structures(const std::vector<RunRecord>& records, int threads,
                           page::Arrays& arrays);

/// The structure, thinned until its arrays take at most `max_bytes`.
page::MeshData pack_mesh(const TriangleMesh& mesh, std::size_t max_bytes, page::Arrays& arrays);

}  // namespace gnbv
