// What the cloud keeps of every view of a coarse lattice: the leaf ceiling, and what the oracle
// chooses from.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/limits/legal_viewpoints.hpp"
#include "bench/score/surface_reference.hpp"

namespace gnbv {

/// Of a hall more took over 18 minutes of one core. The aircraft has 3,100.
constexpr std::size_t kManySurveyedViews = 8000;

struct SurveyedView {
  std::uint32_t position = 0;             // of the legal viewpoints
  double yaw_rad = 0.0;                   // a multiple of 45 degrees, in (-pi, pi]
  double gimbal_pitch_rad = 0.0;          // one of the gimbal's
  std::vector<std::uint32_t> finds = {};  // finds_alone() of the finest voxels that are counted
};

ViewPose pose_of(const LegalViewpoints& legal, const SurveyedView& view);

struct ViewSurvey {
  std::vector<SurveyedView> views;
  std::array<double, 3> leaf_raw{};  // coverage of the cloud of all views, by kCoverageSizes_m
  std::array<double, 3> leaf_counted{};
};

/// Every second legal position along each axis that has structure within reach, by eight yaws and
/// all pitches of a gimbal, as far as surface above the floor, whosever it is, fills a twentieth of
/// the images at least. Where these are more than kManySurveyedViews, every third position, and so
/// on, but steps of no more than half the least range_max_m of the cameras. All views, in the order
/// of `views`, go through one cloud (CloudOfViews). A leaf of it keeps the centroid that reached it
/// first, as a mission's does: another order gives a slightly different cloud. The same at any
/// number of threads. `stop` is called several times a second, by any thread, and may throw.
ViewSurvey survey_views(const Scenario& scenario, const RayScene& scene,
                        const LegalViewpoints& legal, const SurfaceReference& reference,
                        int threads, const HeedStop& stop = {});

/// The same from the cache (content_cache.hpp), where it is kept by that key (ceiling_key()).
ViewSurvey cached_survey(const std::string& key, const Scenario& scenario, const RayScene& scene,
                         const LegalViewpoints& legal, const SurfaceReference& reference,
                         int threads, const HeedStop& stop = {});

/// About a byte and a half a voxel that a view finds.
std::string bytes_of(const ViewSurvey& survey);
std::optional<ViewSurvey> survey_in(std::string_view bytes);

}  // namespace gnbv
