// A structure of twelve faces for pictures of runs that never flew.
#pragma once

#include "sim/mesh/world.hpp"

namespace gnbv {

inline World cube() {
  World world;
  world.structure.vertices_m = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0},
                                {-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}};
  world.structure.faces = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                           {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  return world;
}

}  // namespace gnbv
