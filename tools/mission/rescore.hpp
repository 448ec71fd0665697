// A run directory scored anew, from its files alone.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "bench/score/mission_score.hpp"
#include "scenarios/scenario.hpp"
#include "tools/mission/reference.hpp"

namespace gnbv {

/// How to score, beside the scenario.
struct ScoreWish {
  std::vector<double> sizes_m = {};          // of voxels, instead of score.sizes_m
  std::optional<Box3> box_m = {};            // only what lies in it
  CeilingFrom ceiling = CeilingFrom::cache;  // of a run; of a part of it there is none
  bool is_quiet = false;                     // no progress on stderr
};

/// A score, and what it is of.
struct Scored {
  MissionScore score;
  std::vector<double> sizes_m;         // of the coverage that was asked for
  std::string structure;               // built-in name, or path of the mesh
  std::size_t points = 0;              // that were scored
  std::size_t points_below_floor = 0;  // that were left out
  double floor_z_m = 0.0;
  double reference_s = 0.0;  // wall time, of the reference
  double score_s = 0.0;      // and of all that is compared with it
};

/// Any cloud against the scenario's structure, wherever that lies, without its points below the
/// floor. Of a box: voxels count whose centres lie in it, and for precision and density the points
/// in it. Throws BadInput when there is nothing to measure in the box and, beginning with `name`,
/// for a cloud that cannot be scored (bench/score/cloud_faults.hpp). Appends to `warnings` what the
/// structure's files left out.
Scored score_any_cloud(const std::string& name, std::span<const Vec3f> cloud_world_m,
                       const Scenario& scenario, const ScoreWish& wish, int threads,
                       std::vector<std::string>& warnings);

/// Scores cloud.ply, profile.ply and iterations.csv by scenario.yaml: bit for bit what the run
/// itself found. Throws BadInput naming the file that is missing or does not fit the others.
Scored score_run(const std::filesystem::path& run, const ScoreWish& wish, int threads);

/// What `gnbv score` prints: a table of lines no wider than that (0: as wide as it takes), and a
/// JSON object. `is_run`: with its profile and curve.
std::string score_text(const Scored& scored, const std::string& name, bool is_run,
                       std::size_t width);
std::string score_json(const Scored& scored, bool is_run);

}  // namespace gnbv
