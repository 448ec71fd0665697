// A scanned cloud as a structure: its surface, and how far the points lie from it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/surface/surface.hpp"

namespace gnbv {

struct CloudSurface {
  std::vector<std::filesystem::path> files;  // surface.ply and others, surface.json
  std::string text;                          // for people
  std::string json;
};

/// Screened Poisson of any cloud's points, without their normals or sensors: thinned to one a leaf
/// of their median spacing (or of a thousandth of the extent), oriented by neighbours, trimmed
/// where no point bears it out, simplified by a fifth of a leaf. The stated error is of all points
/// of the cloud to what is written: mean, 95 % and largest distance. Throws BadInput naming the
/// file for points that are not finite, or hold no surface. Deterministic at any number of threads.
CloudSurface surface_of_cloud(const std::filesystem::path& cloud, const Vec3& offset_m,
                              const SurfaceSettings& settings, const std::filesystem::path& folder,
                              int threads, const SurfaceProgress& progress,
                              std::vector<std::string>& notes);

}  // namespace gnbv
