// A run directory scored anew, from its files alone.
#pragma once

#include <filesystem>

#include "bench/score/mission_score.hpp"
#include "scenarios/scenario.hpp"
#include "tools/mission/run_ceiling.hpp"

namespace gnbv {

/// A score, and what it is of.
struct Scored {
  MissionScore score;
  std::string structure;               // built-in name, or path of the mesh
  std::size_t points = 0;              // that were scored
  std::size_t points_below_floor = 0;  // that were left out
  double floor_z_m = 0.0;
  double reference_s = 0.0;  // wall time, of the reference
  double score_s = 0.0;      // and of all that is compared with it
};

/// Any cloud against the scenario's structure, wherever that lies, without its points below the
/// floor. Throws BadInput, beginning with
/// `name`, for a cloud that cannot be scored (bench/score/cloud_faults.hpp).
Scored score_any_cloud(const std::string& name, std::span<const Vec3f> cloud_world_m,
                       const Scenario& scenario, int threads);

/// Scores cloud.ply, profile.ply and iterations.csv by scenario.yaml: bit for bit what the run
/// itself found. Throws BadInput naming the file that is missing or does not fit the others.
Scored score_run(const std::filesystem::path& run, CeilingFrom ceiling, int threads);

}  // namespace gnbv
