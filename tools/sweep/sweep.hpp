// A grid of missions: scenarios x methods x seeds, each cell named by its content.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scenarios/scenario.hpp"

namespace gnbv {

/// A scenario as a table or comparison names it, and how it is made.
struct SweepScenario {
  std::string name;      // of the row; unique in a sweep
  std::string scenario;  // built-in name or YAML path
  std::string mesh;      // "" keeps the scenario's structure
  bool bounds_auto = false;
  std::vector<std::string> overrides;  // key=value, in order
};

/// What is compared: a utility, a preset, one switch.
struct SweepMethod {
  std::string name;                    // unique in a sweep
  std::vector<std::string> overrides;  // key=value, after the scenario's
};

struct Sweep {
  std::vector<SweepScenario> scenarios;
  std::vector<SweepMethod> methods;
  std::vector<std::uint64_t> seeds;
};

/// One mission of it.
struct Cell {
  std::string scenario;  // SweepScenario::name
  std::string method;    // SweepMethod::name
  std::uint64_t seed = 0;
  std::string id;  // 16 hexadecimal digits of the SHA-256 of the resolved scenario, with the
                   // mesh file by its content, and the version of the program
  Scenario resolved;
};

/// The sweep of a YAML file. Throws BadInput naming every fault at once, each with file and line.
Sweep read_sweep(const std::filesystem::path& yaml);

/// All cells, scenario by scenario, method by method, seed by seed; the index of `--index`.
/// Resolves every scenario; throws BadInput with all faults of all cells at once, each named once.
/// Cells of the same content (a method that changes nothing) keep the same id.
std::vector<Cell> cells_of(const Sweep& sweep);

}  // namespace gnbv
