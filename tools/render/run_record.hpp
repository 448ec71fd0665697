// The files of a run directory that pictures are made of.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

struct PathSample {
  double time_s = 0.0;
  Vec3 p_world_m = Vec3::Zero();
};

struct RunRecord {
  std::vector<PathSample> path;         // trajectory.tum, times ascending
  std::vector<ViewPose> views;          // iterations.csv, in order
  std::optional<double> views_begin_s;  // summary.json, where the planned views begin
  std::string title;                    // scenario and utility, empty without summary.json
  std::string detail;                   // the main figures in one line, as far as they are there
};

/// Throws BadInput naming the file, and the line or column, when trajectory.tum or iterations.csv
/// is missing or damaged or summary.json is damaged; a run without summary.json is fine.
RunRecord read_run(const std::filesystem::path& run_dir);

}  // namespace gnbv
