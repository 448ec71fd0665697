// Why each view was chosen: the candidates of its decision, and the voxels for whose sake it was.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "planner/core/plan.hpp"
#include "planner/map/grid_geometry.hpp"
#include "sim/core/error.hpp"
#include "sim/core/text.hpp"
#include "tools/page/packs.hpp"
#include "tools/run/decision_lines.hpp"
#include "tools/run/run_files.hpp"
#include "tools/scene/decision.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kLeastBeliefBytes = 4096;
constexpr int kMostDoublings = 12;  // a cell of a kilometre, where voxels are of 0.25 m

std::uint8_t kind_of(const Candidate& candidate, bool is_chosen) {
  if (candidate.rejected) return static_cast<std::uint8_t>(*candidate.rejected);
  if (!is_chosen) return page::kValidCandidate;
  return candidate.covers ? page::kKeptCandidate : page::kChosenCandidate;
}

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

/// A list of the page, and which voxels of a decision it holds.
struct ListKind {
  std::optional<page::BeliefList> page::BeliefData::*list;
  VoxelRuns BelievedVoxels::*voxels;
  bool has_changes;  // whether few do from decision to decision
};
constexpr std::array<ListKind, 4> kLists = {
    {{&page::BeliefData::unknown, &BelievedVoxels::unknown, false},
     {&page::BeliefData::predicted, &BelievedVoxels::predicted, false},
     {&page::BeliefData::frontier, &BelievedVoxels::frontier, true},
     {&page::BeliefData::looked_at, &BelievedVoxels::looked_at, false}}};

page::BeliefList pack_list(std::span<const BelievedVoxels> beliefs, const ListKind& kind,
                           const Lattice& lattice, page::Arrays& arrays) {
  std::vector<std::uint32_t> runs;
  std::vector<std::uint32_t> begins = {0};
  std::vector<std::uint32_t> counts;
  std::vector<VoxelIndex> before;
  for (const BelievedVoxels& view : beliefs) {
    std::vector<VoxelIndex> cells = lattice.cells_of(view.*kind.voxels);
    if (kind.has_changes && !cells.empty()) {
      std::vector<VoxelIndex> changes;
      std::set_symmetric_difference(before.begin(), before.end(), cells.begin(), cells.end(),
                                    std::back_inserter(changes));
      before = std::exchange(cells, changes);
    }
    VoxelIndex end = 0;
    for (const VoxelRun& run : runs_of(cells)) {
      runs.insert(runs.end(), {run.first - end, run.length});
      end = run.first + run.length;
    }
    begins.push_back(as_count(runs.size()));
    counts.push_back(as_count(voxel_count(view.*kind.voxels)));
  }
  return {.runs = arrays.add_numbers(runs),
          .begins = arrays.add(begins),
          .counts = arrays.add(counts),
          .has_changes = kind.has_changes};
}

}  // namespace

std::optional<page::CandidateData> pack_candidates(const RunRecord& record, std::size_t max_bytes,
                                                   page::Arrays& arrays) {
  const std::vector<Plan> plans = read_all_candidates(record.folder, record.views.size());
  if (plans.empty()) return std::nullopt;
  std::vector<Vec3f> points;
  std::vector<float> angles;
  std::vector<std::uint8_t> kind;
  std::vector<float> terms;
  std::vector<std::uint32_t> begins;
  for (const Plan& plan : plans) {
    begins.insert(begins.end(), {as_count(kind.size()), as_count(terms.size() / 5)});
    for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
      const Candidate& c = plan.candidates[i];
      points.push_back(c.view.p_world_m.cast<float>());
      angles.push_back(static_cast<float>(c.view.yaw_rad));
      angles.push_back(static_cast<float>(c.view.gimbal_pitch_rad));
      kind.push_back(kind_of(c, plan.is_chosen(i)));
      if (c.rejected) continue;
      for (const double term : {worth_of(c), c.score.information, c.score.density,
                                c.score.prediction, c.score.distance}) {
        terms.push_back(static_cast<float>(term));
      }
    }
  }
  begins.insert(begins.end(), {as_count(kind.size()), as_count(terms.size() / 5)});
  const std::size_t before = arrays.bytes().size();
  page::CandidateData out{.points = arrays.add_points(points),
                          .angles = arrays.add<2>(angles),
                          .kind = arrays.add(kind),
                          .terms = arrays.add<5>(terms),
                          .begins = arrays.add<2>(begins)};
  const std::size_t needed = arrays.bytes().size() - before;
  if (needed <= max_bytes) return out;
  arrays.cut(before);
  throw BadInput(
      "{}: {} candidates are too many for the page: {:.1f} MB, {:.1f} MB are left; `gnbv render "
      "--what candidates` draws any decision",
      (record.folder / kCandidatesFile).string(), grouped(kind.size()),
      1e-6 * static_cast<double>(needed), 1e-6 * static_cast<double>(max_bytes));
}

std::optional<page::BeliefData> pack_beliefs(const RunRecord& record, std::size_t max_bytes,
                                             page::Arrays& arrays) {
  const Scenario& scenario = record.scenario;
  Lattice lattice{GridGeometry(scenario.workspace_m, scenario.planner.map.resolution_m)};
  const auto beliefs =
      read_beliefs(record.folder, record.views.size(), lattice.voxels.voxel_count());
  if (beliefs.empty()) return std::nullopt;
  const std::size_t before = arrays.bytes().size();
  const std::size_t most = std::max(max_bytes, kLeastBeliefBytes + 32 * beliefs.size());
  for (;; ++lattice.doublings) {
    page::BeliefData out{.size_m = scenario.planner.map.resolution_m * (1 << lattice.doublings),
                         .map_m = scenario.planner.map.resolution_m,
                         .low = lattice.low(),
                         .cells = lattice.cells()};
    for (const ListKind& kind : kLists) {
      const bool is_empty = std::all_of(beliefs.begin(), beliefs.end(), [&](const auto& view) {
        return (view.*kind.voxels).empty();
      });
      if (!is_empty) out.*kind.list = pack_list(beliefs, kind, lattice, arrays);
    }
    const bool fits = arrays.bytes().size() - before <= most;
    if (fits || lattice.doublings == kMostDoublings) return out;
    arrays.cut(before);
  }
}

std::string why_no_beliefs(const RunRecord& record) {
  namespace fs = std::filesystem;
  const RunFiles files(record.folder);
  if (!files.find(kCandidatesFile) || files.find(kBeliefsFile)) {
    return "";
  }
  return fmt::format(
      "{}: the frontier, unknown and predicted voxels of each decision were not kept; {} keeps "
      "them",
      (record.folder / kBeliefsFile).string(), command_to_fly_again(record.folder, "--candidates"));
}

}  // namespace gnbv
