// The ceiling's results on disk, and what they depend on.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bench/limits/ceiling.hpp"
#include "bench/limits/view_survey.hpp"

namespace gnbv {

/// SHA-256 over all that ceiling and survey depend on: structure, surroundings and ground, region,
/// no_fly boxes, cameras and LIDARs (without their noise), profile with the start it is flown from,
/// workspace and voxels, floor, leaf, collision radius, and the legal positions with their cells,
/// which stand for the navigation box.
std::string ceiling_key(const Scenario& scenario, const World& world, const LegalViewpoints& legal);

/// A scenario with all that the ceiling depends on, and the defaults elsewhere: scenarios of which
/// this is the same have one ceiling.
Scenario what_a_ceiling_depends_on(const Scenario& scenario);

std::string text_of(const Ceiling& ceiling);
std::optional<Ceiling> ceiling_from(std::string_view text);

/// About a byte and a half a voxel that a view finds.
std::string bytes_of(const ViewSurvey& survey);
std::optional<ViewSurvey> survey_from(std::string_view bytes);

/// survey_views(), from the cache when it is there.
ViewSurvey cached_survey(const std::string& key, const Scenario& scenario, const RayScene& scene,
                         const LegalViewpoints& legal, const SurfaceReference& reference,
                         int threads, const HeedStop& stop = {});

}  // namespace gnbv
