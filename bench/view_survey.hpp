// What the cloud keeps of every view of a coarse lattice: the leaf ceiling, and what the oracle
// chooses from.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bench/legal_viewpoints.hpp"
#include "bench/surface_reference.hpp"

namespace gnbv {

struct SurveyedView {
  std::uint32_t position = 0;        // of the legal viewpoints
  double yaw_rad = 0.0;              // a multiple of 45 degrees, in (-pi, pi]
  std::vector<std::uint32_t> finds = {};  // ascending: finest outside voxels that a cloud of this view
                                     // alone would hold points in, as indices into the reference
};

struct ViewSurvey {
  std::vector<SurveyedView> views;
  std::vector<std::uint32_t> found = {};  // ascending: what the cloud of all views together holds
  std::array<double, 3> leaf_raw{};      // its coverage, by kCoverageSizes_m
  std::array<double, 3> leaf_outside{};
};

/// Every second legal position along each axis, by eight yaws, as far as the structure fills a
/// twentieth of the images at least. All cameras, without noise, go through the mission's own cloud
/// (SurfaceCloud, with its leaf filter), view after view in the order of `views`. That
/// cloud keeps the centroid that first reached a leaf, as a mission's does, so another order gives
/// a slightly different one. Deterministic at any number of threads; cached by content.
ViewSurvey survey_views(const Scenario& scenario, const World& world, const RayScene& scene,
                        const LegalViewpoints& legal, const SurfaceReference& reference,
                        int threads);

}  // namespace gnbv
