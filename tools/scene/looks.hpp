// What pictures and pages show of a run: its layers, and the colour and the words of each thing.
// The renderer takes them from here, and the page from the JSON that looks_json() makes.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string_view>

#include "planner/motion/free_space.hpp"
#include "tools/scene/colour.hpp"

namespace gnbv {

/// What a user switches on and off together.
struct SceneLayer {
  std::string_view name;   // also its key in a page's link
  std::string_view words;  // on its switch
};

/// In the order of their switches.
std::span<const SceneLayer> scene_layers();

/// One kind of thing: how it is drawn, and what a legend calls it.
struct Look {
  std::string_view name;   // its key in the JSON
  std::string_view layer;  // that it belongs to; empty: to none that can be switched
  std::string_view words;
  std::uint32_t light = 0;     // 0xRRGGBB, on pictures and on a light page
  std::uint32_t dark = light;  // on a dark page
  Rgb rgb() const { return srgb(light); }
};

namespace looks {

// what is there
inline constexpr Look kStructure{"structure", "structure", "structure", 0xc9d1da, 0x8a93a0};
inline constexpr Look kObstacle{"obstacle", "", "obstacle", 0xb59a7a};
inline constexpr Look kTerrain{"terrain", "", "terrain", 0xa9b39a};
inline constexpr Look kNoFly{"no_fly", "", "no-fly box", 0xc8375d};
inline constexpr Look kWorkspace{"workspace", "", "workspace", 0x9aa5b3};

// what was measured, and what is believed
inline constexpr Look kSeen{"seen", "cloud", "seen", 0x0b6fa8, 0x4fb0e0};
inline constexpr Look kNewPoints{"new_points", "cloud", "points of this view", 0x00a8ff};
/// A hue that the amounts do not have.
inline constexpr Look kProfilePoints{"profile_points", "cloud", "seen before the first view alone",
                                     0xc99a6b};
inline constexpr Look kOccupied{"occupied", "voxels", "occupied", 0xc9d1da, 0x8a93a0};
inline constexpr Look kUnknown{"unknown", "unknown", "unknown", 0xe69f00};
inline constexpr Look kPredicted{"predicted", "predicted", "predicted by symmetry", 0xd5309c};
inline constexpr Look kFrontier{"frontier", "frontiers", "frontier", 0x56b4e9};
inline constexpr Look kLookedAt{"looked_at", "frontiers", "frontier looked at", 0x0b5fa5, 0x3f8fd8};
inline constexpr Look kFrontierLayer{"frontier_layer", "frontiers", "views of a layer", 0x8a9fc0};

// the true surface
inline constexpr Look kFound{"found", "found", "surface found", 0xa9c3d6};
inline constexpr Look kMissed{"missed", "missed", "surface missed", 0xd5420a};
/// Beside the colours of an order, which has an orange of its own.
inline constexpr Look kMissedInOrder{"missed_in_order", "missed", "surface missed", 0x98a0ab};
inline constexpr Look kOnlyOther{"only_other", "missed", "missed here, found by another run",
                                 0x9b2fae, 0xc75fda};

// the flight
inline constexpr Look kProfile{"profile", "profile", "profile flight", 0x5b6878, 0x93a0af};
/// Nothing that was flown has it.
inline constexpr Look kPlan{"plan", "plan", "still planned", 0x0a8f8a, 0x49d6cf};
/// Neither of the path's colours nor of the rotors'.
inline constexpr Look kCamera{"camera", "vehicle", "what the cameras see", 0x00735a, 0x49c39f};
inline constexpr Look kHull{"hull", "vehicle", "vehicle", 0x23282f, 0xaab4c2};
inline constexpr Look kFrontRotors{"front_rotors", "vehicle", "front rotors", 0xe8731a};
inline constexpr Look kRearRotors{"rear_rotors", "vehicle", "rear rotors", 0x4a5360, 0x9aa7b8};

// one decision
inline constexpr Look kChosen{"chosen", "candidates", "chosen view", 0x0057ff, 0x5b96ff};
inline constexpr Look kCovered{"covered", "candidates", "covered", 0x008f5f};
inline constexpr Look kNotCovered{"not_covered", "candidates", "not covered", 0xd5420a};
inline constexpr Look kViewBefore{"view_before", "candidates", "view before", 0x14181e, 0xf4f6f9};
inline constexpr Look kRayFree{"ray_free", "candidates", "ray through free", 0x9aa5b3, 0x75808e};
inline constexpr Look kRayUnknown{"ray_unknown", "candidates", "through unknown", 0xe69f00};
inline constexpr Look kRayHit{"ray_hit", "candidates", "meets surface", 0x14181e, 0xf4f6f9};

}  // namespace looks

/// Of all of them.
std::span<const Look* const> all_looks();

/// A reason for which candidates were rejected.
struct RejectionLook {
  Rejection rejection;
  std::string_view words;
  std::string_view means;  // one sentence
  std::uint32_t light;     // 0xRRGGBB
  Rgb rgb() const { return srgb(light); }
};

/// Of all reasons, by their numbers. The colours stand apart from each other and from the marks of
/// the chosen view, for people with colour blindness, too.
std::span<const RejectionLook> rejection_looks();

/// {"layers": [{"name", "words"}], "looks": {NAME: {"layer", "words", "light", "dark"}}, "reasons":
/// [{"words", "means", "light"}], "ramps": {"path" | "amount" | "score" | "error": 256 colours,
/// three sRGB bytes each}}.
nlohmann::ordered_json looks_json();

}  // namespace gnbv
