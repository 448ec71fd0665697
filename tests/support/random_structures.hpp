// The random structures that laws are checked on: every kind, so many seeds each.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "assets/random/random_structure.hpp"

namespace gnbv {

struct RandomStructure {
  std::string_view kind;
  std::uint64_t seed;
  TriangleMesh mesh;
  std::string name() const { return fmt::format("--kind {} --seed {}", kind, seed); }
};

/// Seeds 1 to `seeds` of a kind.
inline std::vector<RandomStructure> random_structures(std::string_view kind, std::uint64_t seeds) {
  std::vector<RandomStructure> all;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    all.push_back({kind, seed, make_random_structure(seed, kind)});
  }
  return all;
}

}  // namespace gnbv
