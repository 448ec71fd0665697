// A small run directory, written by hand, and what it holds.
#pragma once

#include <filesystem>

#include "scenarios/load.hpp"
#include "sim/core/file.hpp"
#include "tools/run/cloud_file.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/iterations_csv.hpp"
#include "tools/run/run_record.hpp"
#include "tools/run/trajectory_tum.hpp"

namespace gnbv {

inline ViewRecord made_view(int iteration, const ViewPose& pose, std::size_t cloud_points) {
  ViewRecord view{.iteration = iteration};
  view.decision = {.view = pose};
  view.cloud_points = cloud_points;
  view.time_s = 3.0 + iteration;
  return view;
}

inline TrajectorySample made_sample(double time_s, const Vec3& p_world_m) {
  TrajectorySample sample{.time_s = time_s};
  sample.T_world_body.translate(p_world_m);
  return sample;
}

/// A flight around the origin: two seconds of profile, then three views.
inline RunRecord made_record() {
  RunRecord record;
  record.scenario = load_scenario("smoke", {});
  record.path = {made_sample(0, {-4, -4, 1}), made_sample(1, {4, -4, 1}), made_sample(2, {4, 4, 1}),
                 made_sample(3, {-4, 4, 2}), made_sample(4, {-4, -4, 3})};
  record.views = {made_view(0, {Vec3(4, 4, 1), 3.0}, 3), made_view(1, {Vec3(-4, 4, 2), 1.5}, 5),
                  made_view(2, {Vec3(-4, -4, 3), 0.8}, 6)};
  record.profile_end_s = 2.0;
  record.views_begin_s = 2.0;
  return record;
}

/// The record as a directory without a summary: two points of the profile, six in all.
inline void write_made_run(const std::filesystem::path& folder) {
  const RunRecord record = made_record();
  write_file_atomically(folder / kScenarioFile, to_yaml(record.scenario));
  write_file_atomically(folder / kTrajectoryFile, trajectory_tum(record.path));
  write_file_atomically(folder / kIterationsFile, iterations_csv(record.views));
  const std::vector<Vec3f> points = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1},
                                     {1, 1, 1}, {0, 0, 2}, {1, 1, 2}};
  write_cloud_ply(points, folder / kCloudFile);
  write_cloud_ply(std::span(points).first(2), folder / kProfileCloudFile);
}

}  // namespace gnbv
