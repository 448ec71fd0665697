// Coverage at voxel sizes that the paper does not have.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/score/surface_reference.hpp"

namespace gnbv {

/// Coverage at one size, as fractions.
struct SizedCoverage {
  double size_m = 0.0;
  double profile = 0.0;  // of what coverage counts
  double final = 0.0;
  double profile_raw = 0.0;  // of all surface
  double final_raw = 0.0;
  double accurate = 0.0;           // accurate coverage (coverage_curve.hpp), final
  std::vector<double> curve = {};  // of what it counts, by the entries of CoverageCurve
  std::vector<double> accurate_curve = {};
};

/// "0.05", "0.10", "0.025": two decimals at least, and as many as the size has.
std::string size_name(double size_m);

/// Its index in kCoverageSizes_m, which every score has; nothing for other sizes.
std::optional<std::size_t> papers_size(double size_m);

/// Of a reference: 7 GB of them and their voxels.
constexpr double kMostSamples = 1e8;

/// Samples grow with 1 / size^2: throws BadInput, naming the size that fits, for one that takes
/// more than kMostSamples of the structure's surface. The paper's sizes are measured in any case.
void need_room_for(std::span<const double> sizes_m, const TriangleMesh& structure);

/// How much of the surface the first prefixes[i] points of a cloud cover at one size, for each i.
/// The cloud's voxels of size s are those of 0.05 m of everything scaled by 0.05 / s, cloud and
/// world alike, so that all that is said of the paper's finest size (surface_reference.hpp) holds
/// for any: what counts as surface enough, what sees out, how closely it is sampled. The reference
/// is cached. Alone the reach of a point (kCoverReach_m) is not scaled, as far as it stays below a
/// tenth of the voxel, so that all sizes nest. `distances_m` as of coverage_of_prefixes().
struct SizedShares {
  std::vector<double> raw;
  std::vector<double> counted;
  std::vector<double> accurate;
};
SizedShares sized_shares(const World& world, double size_m, const ReferenceConfig& config,
                         std::span<const Vec3f> cloud_world_m,
                         std::span<const std::size_t> prefixes, int threads,
                         std::span<const double> distances_m = {});

}  // namespace gnbv
