// A run directory read back: what pictures, pages, models and exports are made of.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/score/run_figures.hpp"
#include "scenarios/scenario.hpp"
#include "tools/run/mission_result.hpp"
#include "tools/run/run_files.hpp"

namespace gnbv {

/// Whatever of a run is there. Only scenario.yaml has to be.
struct RunRecord {
  std::filesystem::path folder;              // never "." or "..", no slash at its end
  Scenario scenario;                         // scenario.yaml
  bool goes_on = false;                      // with more views than it last ended with
  std::vector<TrajectorySample> path = {};   // trajectory.tum, times ascending; empty without it
  std::vector<ViewRecord> views = {};        // iterations.csv, or its journal
  std::optional<RunFigures> figures = {};    // summary.json and coverage.csv
  std::optional<double> profile_end_s = {};  // summary.json: where the profile ends,
  std::optional<double> views_begin_s = {};  // and where the planned views begin
  std::vector<std::string> missing = {};     // a sentence each: what is not there, what makes it
};

/// Reads a run directory as it stands (RunFiles). What is absent, or was written by another
/// version, is left out and named in `missing` with the command that makes it. Throws BadInput
/// naming the folder when it holds no run at all, and file and line of whatever is damaged. A mesh
/// file that was moved since is missed only by those who load it.
RunRecord read_run(const std::filesystem::path& folder);

/// The cloud of a run in the order in which it grew.
struct RunCloud {
  std::vector<Vec3f> points_world_m;     // cloud.ply
  std::size_t profile_points = 0;        // the first ones
  std::vector<std::size_t> view_points;  // (views) how many there were after each view

  /// Of the view after which the point was there; -1 for one of the profile, and the number of
  /// views for one that came after the last of them, as a run leaves them that ends in flight.
  int view_of(std::size_t point) const;
};

/// Throws BadInput naming file and command when cloud.ply or profile.ply is missing, or when they
/// and the record's views do not belong together.
RunCloud read_run_cloud(const RunRecord& record);

/// "Aircraft (a340.obj)": a scenario's name says little of the mesh that --mesh put in its
/// structure's place.
std::string scenario_title(const Scenario& scenario);

/// Of a utility: "Proposed", "AEP"; a function of the user's by its label.
std::string utility_title(const UtilityConfig& utility);

/// Who flew where: "aircraft, proposed"; and by which reading of the paper, if not the usual one.
std::string run_title(const RunRecord& record);
/// The main figures in one line, as far as they are there.
std::string run_detail(const RunRecord& record);

/// T_world_body as it truly was, between the samples of the path: straight, and along the shorter
/// arc. For one period before the first sample and after the last, 0.1 s, that one holds: a run
/// begins and ends where it hovers to see. Nothing earlier or later.
std::optional<Isometry> true_pose_at(const RunRecord& record, double time_s);

}  // namespace gnbv
