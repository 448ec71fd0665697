#include "tools/scene/looks.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<SceneLayer, 15> kLayers = {{{"cloud", "Points"},
                                                 {"voxels", "Voxels"},
                                                 {"structure", "Structure"},
                                                 {"path", "Path"},
                                                 {"profile", "Profile"},
                                                 {"frusta", "All views"},
                                                 {"plan", "Plan"},
                                                 {"vehicle", "Vehicle"},
                                                 {"missed", "Missed"},
                                                 {"found", "Found"},
                                                 {"candidates", "Candidates"},
                                                 {"unknown", "Unknown"},
                                                 {"predicted", "Predicted"},
                                                 {"frontiers", "Frontiers"},
                                                 {"surface", "Surface"}}};

constexpr std::array<const Look*, 31> kLooks = {
    &looks::kStructure,     &looks::kObstacle,      &looks::kTerrain,     &looks::kNoFly,
    &looks::kWorkspace,     &looks::kSeen,          &looks::kNewPoints,   &looks::kProfilePoints,
    &looks::kOccupied,      &looks::kUnknown,       &looks::kPredicted,   &looks::kFrontier,
    &looks::kLookedAt,      &looks::kFrontierLayer, &looks::kFound,       &looks::kMissed,
    &looks::kMissedInOrder, &looks::kOnlyOther,     &looks::kProfile,     &looks::kPlan,
    &looks::kCamera,        &looks::kHull,          &looks::kFrontRotors, &looks::kRearRotors,
    &looks::kChosen,        &looks::kViewBefore,    &looks::kRayFree,     &looks::kRayUnknown,
    &looks::kRayHit,        &looks::kCovered,       &looks::kNotCovered};

constexpr std::array<RejectionLook, kRejectionNames.size()> kRejections = {
    {{Rejection::out_of_bounds, "out of bounds",
      "Outside the workspace, or below the lowest height at which the vehicle may fly", 0x6b7787},
     {Rejection::not_free, "not free",
      "The voxel in which it stands is not known to be free: occupied, or never seen", 0x6e3d12},
     {Rejection::collision, "collision",
      "Something occupied lies within the vehicle's radius of safety there", 0xc42d7c},
     {Rejection::path_blocked, "path blocked",
      "On the way from the view before, something occupied lies within the radius of safety, or no "
      "way through known free space was found",
      0xffe47c},
     {Rejection::recently_visited, "visited", "A view before stood there and looked the same way",
      0xf2b8c6},
     {Rejection::cluster_outside_fov, "cluster outside view",
      "The middle of the frontier that it was to look at is in no camera's picture", 0x75e6f2},
     {Rejection::cluster_hidden, "cluster hidden",
      "Something occupied hides the frontier that it was to look at", 0x4c00c4},
     {Rejection::sees_no_surface, "sees no surface",
      "The utility refuses it: none of its rays meets a surface", 0x8f9a1e},
     {Rejection::no_fly, "no-fly box", "In a box where nobody may fly, or too near to it",
      0x004d3d},
     {Rejection::beyond_gimbal, "beyond the gimbal", "No gimbal of the vehicle reaches its pitch",
      0xf12de9},
     {Rejection::search_limit, "search limit",
      "The search for a way around ended at its limit and had found none", 0xb08cff}}};

Json ramp_json(const std::vector<Rgb>& colours) {
  Json bytes = Json::array();
  for (int i = 0; i < 256; ++i) {
    for (const float linear : ramp(colours, i / 255.0)) {
      bytes.push_back(std::lround(255.0F * linear_to_srgb(linear)));
    }
  }
  return bytes;
}

}  // namespace

std::span<const SceneLayer> scene_layers() { return kLayers; }
std::span<const Look* const> all_looks() { return kLooks; }
std::span<const RejectionLook> rejection_looks() { return kRejections; }

Json looks_json() {
  Json json = {{"layers", Json::array()},
               {"looks", Json::object()},
               {"reasons", Json::array()},
               {"ramps",
                {{"path", ramp_json(path_colours())},
                 {"amount", ramp_json(amount_colours())},
                 {"score", ramp_json(score_colours())},
                 {"error", ramp_json(error_colours())}}}};
  for (const SceneLayer& layer : kLayers) {
    json["layers"].push_back({{"name", layer.name}, {"words", layer.words}});
  }
  for (const Look* const look : kLooks) {
    json["looks"][look->name] = {{"layer", look->layer},
                                 {"words", look->words},
                                 {"light", look->light},
                                 {"dark", look->dark}};
  }
  for (const RejectionLook& look : kRejections) {
    json["reasons"].push_back(
        {{"words", look.words}, {"means", look.means}, {"light", look.light}});
  }
  return json;
}

}  // namespace gnbv
