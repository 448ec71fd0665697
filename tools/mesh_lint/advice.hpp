// What `gnbv lint` advises, all of it at once: one round of flags puts a mesh right.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenarios/scenario.hpp"
#include "sim/mesh/mesh_lint.hpp"

namespace gnbv {

struct MeshReport;

/// A size that one flies around with a drone.
struct Resize {
  std::string set;   // KEY=VALUE
  std::string text;  // with what else it might be
};

/// How the structure should be placed, and what of the scenario has to change with it, each for
/// when all else is done. What is as it should be is empty.
struct Advice {
  std::optional<Resize> resize;
  std::optional<LikelyUp> likely_up;
  std::string up_axis;  // KEY=VALUE, as the next; to be set only where that axis is sure
  std::string offset;
  bool is_far = false;        // from the origin: the offset brings it there
  bool needs_bounds = false;  // --bounds auto: the workspace does not hold it, or not its start
  std::string start_fault;    // why the scenario's start will not do
  std::string bounds_fault;   // why no workspace can be laid around it
  std::string floor;          // KEY=VALUE, as the next
  std::string resolution;
  std::string resolution_fault;  // why the scenario's own will not do

  /// All that is to be set, KEY=VALUE each.
  std::vector<std::string> sets() const;
};

/// Of a report with a sound face and finite coordinates. `bounds_auto`: the workspace is laid
/// around the structure, whatever the scenario says.
Advice advise(const MeshReport& report, const Scenario& scenario, bool bounds_auto);

}  // namespace gnbv
