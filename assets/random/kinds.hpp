// The kinds of random structures: each draws its proportions for a largest extent of about
// `size_m`. About the z axis, on the ground z = 0, long side along x, metres.
#pragma once

#include <vector>

#include "assets/random/mesh_builder.hpp"
#include "sim/core/rng.hpp"

namespace gnbv::random_parts {

std::vector<Part> hall(Rng& draws, double size_m);    // closed, open at an end, sawtooth
std::vector<Part> tower(Rng& draws, double size_m);   // of masonry, tanks, silos, a chimney
std::vector<Part> mast(Rng& draws, double size_m);    // free, guyed, for power lines
std::vector<Part> truss(Rng& draws, double size_m);   // space frame, bare portals, gantry
std::vector<Part> bridge(Rng& draws, double size_m);  // girder, truss, tied arch, stays
std::vector<Part> hull(Rng& draws, double size_m);    // a ship on keel blocks
std::vector<Part> crane(Rng& draws, double size_m);   // tower crane, gantry crane
std::vector<Part> mixed(Rng& draws, double size_m);

}  // namespace gnbv::random_parts
