// Structures that nobody tuned anything to: of a kind that exists, its proportions drawn.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// `mixed`: up to four of the others, close together, with clutter between them.
constexpr std::array<std::string_view, 8> kRandomKinds = {"hall",   "tower", "mast",  "truss",
                                                          "bridge", "hull",  "crane", "mixed"};

/// What the seed chooses among kRandomKinds, each as likely as the others.
std::string_view random_kind(std::uint64_t seed);

/// A seed that anybody can draw again: the first 8 hexadecimal digits of the SHA-256 of
/// "TEXT KIND DRAW", the text being a frozen commit, say.
std::uint64_t drawn_seed(std::string_view text, std::string_view kind, int draw);

/// Closed parts, outwards-facing, standing on the ground z = 0 about the z axis, 8 to 58 m in its
/// largest extent along an axis, turned about z as chance has it. The same for a seed and kind
/// always; `kind` is one of kRandomKinds.
TriangleMesh make_random_structure(std::uint64_t seed, std::string_view kind);

}  // namespace gnbv
