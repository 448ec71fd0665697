#include "tools/report/belief_pack.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "tools/run/file_names.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kLeastBytes = 4096;
constexpr int kMostDoublings = 12;  // a cell of a kilometre, where voxels are of 0.25 m

using Beliefs = std::vector<BelievedVoxels>;

/// Cells of 2^doublings voxels along each axis.
struct Lattice {
  GridGeometry voxels;
  int doublings = 0;

  std::int32_t coarse(std::int32_t key) const { return key >> doublings; }  // floor, also below 0
  Key low() const {
    const Key& k = voxels.min_key();
    return {coarse(k[0]), coarse(k[1]), coarse(k[2])};
  }
  Key cells() const {
    Key cells;
    for (std::size_t a = 0; a < 3; ++a) {
      cells[a] = coarse(voxels.min_key()[a] + voxels.size()[a] - 1) - low()[a] + 1;
    }
    return cells;
  }
  VoxelIndex cell_of(VoxelIndex voxel) const {
    const Key key = voxels.key_at(voxel);
    const Key first = low();
    const Key size = cells();
    return static_cast<VoxelIndex>(
        ((coarse(key[2]) - first[2]) * size[1] + coarse(key[1]) - first[1]) * size[0] +
        coarse(key[0]) - first[0]);
  }
  /// Ascending, each once.
  std::vector<VoxelIndex> cells_of(const VoxelRuns& runs) const {
    std::vector<VoxelIndex> all;
    for (const VoxelRun& run : runs) {
      for (VoxelIndex v = run.first; v < run.first + run.length; ++v) {
        all.push_back(doublings == 0 ? v : cell_of(v));
      }
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }
};

void add_number(std::uint32_t number, std::vector<std::uint8_t>& out) {
  for (; number >= 128; number >>= 7) out.push_back(static_cast<std::uint8_t>(number | 128));
  out.push_back(static_cast<std::uint8_t>(number));
}

struct List {
  std::vector<std::uint8_t> runs;
  std::vector<std::uint32_t> begins = {0};
  std::vector<std::uint32_t> counts;
  bool has_any = false;

  std::size_t bytes() const { return runs.size() + 4 * (begins.size() + counts.size()); }
};

void add_cells(std::span<const VoxelIndex> cells, std::vector<std::uint8_t>& out) {
  VoxelIndex end = 0;
  for (const VoxelRun& run : runs_of(cells)) {
    add_number(run.first - end, out);
    add_number(run.length, out);
    end = run.first + run.length;
  }
}

List list_of(const Beliefs& beliefs, const BeliefList& of, const Lattice& lattice) {
  List list;
  std::vector<VoxelIndex> before;
  for (const BelievedVoxels& view : beliefs) {
    const std::vector<VoxelIndex> cells = lattice.cells_of(view.*of.voxels);
    if (of.has_changes && !cells.empty()) {
      std::vector<VoxelIndex> changes;
      std::set_symmetric_difference(before.begin(), before.end(), cells.begin(), cells.end(),
                                    std::back_inserter(changes));
      add_cells(changes, list.runs);
      before = cells;
    } else {
      add_cells(cells, list.runs);
    }
    list.begins.push_back(static_cast<std::uint32_t>(list.runs.size()));
    list.counts.push_back(static_cast<std::uint32_t>(voxel_count(view.*of.voxels)));
    list.has_any = list.has_any || !cells.empty();
  }
  return list;
}

std::array<List, kBeliefLists.size()> lists_of(const Beliefs& beliefs, const Lattice& lattice) {
  std::array<List, kBeliefLists.size()> lists;
  for (std::size_t i = 0; i < lists.size(); ++i) {
    lists[i] = list_of(beliefs, kBeliefLists[i], lattice);
  }
  return lists;
}

std::size_t bytes_of(const std::array<List, kBeliefLists.size()>& lists) {
  std::size_t bytes = 0;
  for (const List& list : lists) bytes += list.bytes();
  return bytes;
}

}  // namespace

std::optional<PackedBeliefs> pack_beliefs(const RunRecord& record, std::size_t max_bytes,
                                          BytePack& bytes) {
  const Scenario& scenario = record.scenario;
  Lattice lattice{GridGeometry(scenario.workspace_m, scenario.planner.map.resolution_m)};
  const Beliefs beliefs =
      read_beliefs(record.folder, record.views.size(), lattice.voxels.voxel_count());
  if (beliefs.empty()) return std::nullopt;
  auto lists = lists_of(beliefs, lattice);
  const std::size_t most = std::max(max_bytes, kLeastBytes + 32 * beliefs.size());
  while (bytes_of(lists) > most && lattice.doublings < kMostDoublings) {
    ++lattice.doublings;
    lists = lists_of(beliefs, lattice);
  }
  PackedBeliefs out{.size_m = scenario.planner.map.resolution_m * (1 << lattice.doublings),
                    .low = lattice.low(),
                    .cells = lattice.cells(),
                    .lists = {}};
  for (std::size_t i = 0; i < lists.size(); ++i) {
    if (!lists[i].has_any) continue;
    out.lists[i] = {.runs = bytes.add(lists[i].runs),
                    .begins = bytes.add(lists[i].begins),
                    .counts = bytes.add(lists[i].counts)};
  }
  return out;
}

std::string why_no_beliefs(const RunRecord& record) {
  namespace fs = std::filesystem;
  if (!fs::exists(record.folder / kCandidatesFile) || fs::exists(record.folder / kBeliefsFile)) {
    return "";
  }
  return fmt::format(
      "{}: the frontier, unknown and predicted voxels of each decision were not kept; {} keeps "
      "them",
      (record.folder / kBeliefsFile).string(), command_to_fly_again(record.folder, "--candidates"));
}

}  // namespace gnbv
