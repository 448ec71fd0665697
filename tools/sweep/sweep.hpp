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
  std::vector<std::string> sources{};  // of each override, as faults show it; empty: --set
};

/// What is compared: a utility, a preset, one switch.
struct SweepMethod {
  std::string name;                    // unique in a sweep
  std::vector<std::string> overrides;  // key=value, after the scenario's
  std::vector<std::string> sources{};  // as SweepScenario::sources
};

struct Sweep {
  std::vector<SweepScenario> scenarios;
  std::vector<SweepMethod> methods;
  std::vector<std::uint64_t> seeds;
  std::filesystem::path
      folder{};  // where relative paths in overrides begin; empty: the current one
};

/// One mission of it.
struct Cell {
  std::string scenario;  // SweepScenario::name
  std::string method;    // SweepMethod::name
  std::uint64_t seed = 0;
  std::string id;  // CellNamer::id_of()
  Scenario resolved;
};

/// More are refused: a slip in a grid, not a sweep.
constexpr std::size_t kMaxCells = 1'000'000;

std::size_t cell_count(const Sweep& sweep);

/// The sweep of a YAML file; the README says what it may hold. Relative paths in it mean beside it.
/// Throws BadInput naming every fault at once, each with file and line.
Sweep read_sweep(const std::filesystem::path& yaml);

/// All cells, scenario by scenario, method by method, seed by seed; the index of `--index`. A
/// preset (of planner, vehicle, sensor) is applied before the values set beside it, whatever their
/// order. Resolves every scenario; throws BadInput with all faults of all cells at once, each named
/// once. Cells of the same content (a method that changes nothing) keep the same id.
std::vector<Cell> cells_of(const Sweep& sweep);

/// The cells first to last of cells_of(sweep), without resolving the others.
std::vector<Cell> cells_of(const Sweep& sweep, std::size_t first, std::size_t last);

}  // namespace gnbv
