// What lies in a run directory, by name; the README says what each holds.
#pragma once

#include <filesystem>

namespace gnbv {

constexpr const char* kScenarioFile = "scenario.yaml";
constexpr const char* kInputsFile = "inputs.json";
constexpr const char* kLockFile = ".gnbv-lock";  // while a mission flies into the directory
constexpr const char* kSummaryFile = "summary.json";
constexpr const char* kCoverageFile = "coverage.csv";
constexpr const char* kIterationsFile = "iterations.csv";
constexpr const char* kTrajectoryFile = "trajectory.tum";
constexpr const char* kCloudFile = "cloud.ply";
constexpr const char* kProfileCloudFile = "profile.ply";  // the first points of the cloud
constexpr const char* kProfileMapFile = "profile.map";
constexpr const char* kMapStem = "map";  // OctoMap: map.ot with log-odds, map.bt without
constexpr const char* kMapFile = "map.bt";
constexpr const char* kMapOddsFile = "map.ot";
constexpr const char* kCandidatesFile = "candidates.jsonl";
constexpr const char* kBeliefsFile = "beliefs.jsonl";
constexpr const char* kViewsFile = "views.csv";
constexpr const char* kPredictionsFile = "predictions.csv";
constexpr const char* kUserUtilityFile = "utility.py";
constexpr const char* kPlanFile = "plan.jsonl";
constexpr const char* kFramesFolder = "frames";
constexpr const char* kSurfaceFolder = "surface";  // of `gnbv surface`, unless named otherwise

/// A file that is still being written, line by line.
inline std::filesystem::path part_of(const std::filesystem::path& file) {
  return file.string() + ".part";
}

}  // namespace gnbv
