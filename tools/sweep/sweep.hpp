// A grid of missions: scenarios x methods x seeds, each cell named by its content.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/sources/source_ids.hpp"
#include "scenarios/load.hpp"
#include "tools/mission/user_function.hpp"

namespace gnbv {

/// A scenario as a table or comparison names it, and how it is made.
struct SweepScenario {
  std::string name = {};      // of the row; unique in a sweep
  std::string scenario = {};  // built-in name or YAML path
  std::string mesh = {};      // "" keeps the scenario's structure
  bool bounds_auto = false;
  std::vector<Override> overrides = {};  // in order
};

/// What is compared: a utility, a preset, one switch; its overrides come after the scenario's.
using SweepMethod = NamedMethod;

struct Sweep {
  std::vector<SweepScenario> scenarios = {};
  std::vector<SweepMethod> methods = {};  // of different names
  std::vector<std::uint64_t> seeds = {};
  std::filesystem::path folder =
      {};  // where relative paths in overrides begin; "": the current one
};

/// One mission of it.
struct Cell {
  std::string scenario;  // SweepScenario::name
  std::string method;    // SweepMethod::name
  std::uint64_t seed = 0;
  std::string id;  // CellNamer::id_of()
  Scenario resolved;
};

/// Names cells by what their results depend on; remembers the content of the files it has read.
class CellNamer {
 public:
  explicit CellNamer(std::string version = GNBV_VERSION, std::string source = flying_source_id())
      : version_(std::move(version)), source_(std::move(source)) {}

  /// 16 hexadecimal digits of the SHA-256 of the program (its version and flying_source_id()) and
  /// the values of the resolved scenario that are no defaults, so that a later version's keys leave
  /// it as it is. In them files (a mesh, a saved profile) are named by the SHA-256 of their
  /// content, wherever they lie, and that of the files a mesh refers to (libraries, buffers,
  /// pictures), and a function of the user's own by its text alone. Two builds of the same sources
  /// share their cells, any change of what flies a mission does not. Throws BadInput naming a file
  /// that cannot be read.
  std::string id_of(const Scenario& scenario);

 private:
  std::string content_path(const std::string& path, bool is_mesh);

  std::string version_;
  std::string source_;
  std::map<std::string, std::string> content_paths_;
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
