// What is wrong with a user's mesh, and how to put it right: `gnbv lint`.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/scenario.hpp"
#include "sim/mesh/mesh_file.hpp"
#include "sim/mesh/mesh_lint.hpp"

namespace gnbv {

struct MeshReport;

// ---- advice.cpp: what is advised, all of it at once: one round of flags puts a mesh right

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

// ---- mesh_report.cpp, mesh_findings.cpp and outside_view.cpp

/// ok: as it should be. note: good to know, nothing to do. warning: a mission flies, but perhaps
/// not around what was meant. error: no mission flies around it as it is.
enum class Severity { ok, note, warning, error };
std::string_view name_of(Severity severity);

struct Finding {
  std::string_view check;  // what was looked at, one word or two
  Severity severity = Severity::ok;
  std::string what;
  std::string fix;  // flags of `gnbv run`, or what to do in Blender or MeshLab; empty: nothing
};

/// How much of a structure can be seen from outside, and which side of its faces.
struct OutsideView {
  double area_m2 = 0.0;
  double hidden_area_m2 = 0.0;  // no straight line leaves the structure from there
  FaceTally from_behind;        // seen from outside, but only their backs; two-sided faces aside
  bool is_estimate = false;     // of so many faces that some stand for all
};

struct MeshReport {
  std::string path;
  MeshReading reading;  // empty when the file could not be read
  MeshLint lint;
  OutsideView outside;
  Advice advice;                  // nothing when there is no mesh to fly around
  std::vector<Finding> findings;  // the worst first

  bool is_usable() const;  // no finding is an error
};

/// By samples of the surface and rays from them, by the rule of bench/score/surface_reference.hpp:
/// about one sample per 20,000th of the area, at least one a face, and from 128 directions on where
/// that makes many samples. Of more than 200,000 faces the large ones are asked, and some 50,000
/// that stand for the others. Nothing is hidden in what reaches farther than rays do. Of the sound
/// faces; deterministic at any number of threads.
OutsideView view_from_outside(const TriangleMesh& mesh, const MeshLint& lint, int threads);

/// What the figures mean for a mission of this scenario; `report.findings` is not looked at.
std::vector<Finding> findings_of(const MeshReport& report, const Scenario& scenario,
                                 bool bounds_auto);

/// Reads the file of the scenario's structure, placed as the scenario says, and looks at all there
/// is to look at. A file that cannot be read is a finding. With `bounds_auto` the workspace is laid
/// around the structure instead of the scenario's. Throws BadInput only for a config that
/// read_mesh() refuses by itself.
MeshReport report_on_mesh(const Scenario& scenario, bool bounds_auto, int threads);

/// A line for each finding, with its fix below it; last all flags that the fixes come to.
std::string terminal_text(const MeshReport& report);
/// The same for programs.
std::string json_text(const MeshReport& report);

/// What lint warns of, beside what the reader and the scenario do, in each mesh file of the
/// structure, a line each, with the keys of this scenario that put it right.
std::vector<std::string> mesh_warnings(const Scenario& scenario, int threads);

}  // namespace gnbv
