// How near a reconstructed surface is to the true one.
#pragma once

#include <string>

#include "bench/score/cloud_metrics.hpp"
#include "bench/score/surface_reference.hpp"

namespace gnbv {

struct SurfaceScore {
  CloudDistances distances = {};  // precision, accuracy: of the surface's samples; recall,
                                  // completeness: of the reference's, exactly to the surface
  std::size_t samples = 0;        // of the surface, above the floor
  double floor_z_m = 0.0;
};

/// Points spread over a mesh evenly by area, the same for the same mesh: one in each of `count`
/// equal parts of its area, drawn by `seed`.
std::vector<Vec3f> samples_by_area(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed);

/// Scores the surface above the floor: samples by area against the true structure, and the samples
/// of the true surface that see out (bench/score/surface_reference.hpp) against the reconstructed
/// one. What belongs to obstacles or terrain, or lies outside the region, is left out.
/// Deterministic at any number of threads.
SurfaceScore score_surface(const TriangleMesh& surface, const World& truth,
                           const ReferenceConfig& config, int threads);

/// A table for people, no wider than that (0: as wide as it takes), and a JSON object for machines.
std::string score_text(const SurfaceScore& score, const std::string& name, std::size_t width = 0);
std::string score_json(const SurfaceScore& score);

}  // namespace gnbv
