// What stands in the worlds of a report's runs, each once.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/report/byte_pack.hpp"
#include "tools/report/true_surface.hpp"
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
    int number = -1;       // into `json`; -1: it cannot be had
    std::string why = {};  // not
    std::shared_ptr<const KnownStructure> known = {};
    std::vector<RunInput> inputs = {};  // that it is made of
  };
  BytePack bytes;
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  std::vector<OfRun> of_run;
};

/// Of all records, none where the run was flown around another structure; the true surface from the
/// cache, or found.
Structures pack_structures(const std::vector<RunRecord>& records, int threads);

}  // namespace gnbv
