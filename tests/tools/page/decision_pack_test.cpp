// Laws of what a page has of decisions, and of the budget of a run.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <set>

#include "planner/core/plan.hpp"
#include "sim/core/error.hpp"
#include "tests/support/made_frames.hpp"
#include "tests/support/made_run.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/tools/page/page_arrays.hpp"
#include "tools/page/packs.hpp"
#include "tools/run/decision_lines.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using test::numbers;
using test::sheet;
using Numbers = std::vector<double>;

/// A run whose decisions are written by hand.
class DecisionPack : public testing::Test {
 protected:
  DecisionPack() { record_.folder = temp_.path(); }

  void keep(const std::vector<BelievedVoxels>& views) {
    BeliefsFile file(temp_.path(), 1);
    for (std::size_t i = 0; i < views.size(); ++i) file.write(i + 1, views[i]);
    file.finish();
  }
  void keep(const std::vector<Plan>& plans) {
    CandidatesFile file(temp_.path(), 1);
    for (std::size_t i = 0; i < plans.size(); ++i) file.write(i + 1, plans[i]);
    file.finish();
  }
  /// Lattice indices of the cells of a view, as the page restores them.
  static std::set<Key> cells(const page::BeliefData& packed, const page::BeliefList& list,
                             std::size_t view, const page::Arrays& arrays) {
    const Numbers runs = numbers(list.runs, arrays);
    const Numbers begins = numbers(list.begins, arrays);
    std::set<Key> cells;
    const auto [nx, ny, nz] = packed.cells;
    for (std::size_t of = list.has_changes ? 0 : view; of <= view; ++of) {
      double cell = 0.0;
      for (auto i = static_cast<std::size_t>(begins[of]); static_cast<double>(i) < begins[of + 1];
           i += 2) {
        cell += runs[i];
        for (const double end = cell + runs[i + 1]; cell < end; ++cell) {
          const auto c = static_cast<int>(cell);
          EXPECT_LT(c, nx * ny * nz);
          const Key key = {c % nx + packed.low[0], c / nx % ny + packed.low[1],
                           c / (nx * ny) + packed.low[2]};
          if (cells.erase(key) == 0) cells.insert(key);
        }
      }
    }
    return cells;
  }
  std::set<Key> keys(std::initializer_list<VoxelIndex> voxels) const {
    std::set<Key> all;
    for (const VoxelIndex v : voxels) all.insert(grid_.key_at(v));
    return all;
  }

  TempFolder temp_;
  RunRecord record_ = made_record();
  GridGeometry grid_{record_.scenario.workspace_m, record_.scenario.planner.map.resolution_m};
  page::Arrays arrays_;
};

TEST_F(DecisionPack, HoldsEachVoxelOfEachDecision) {
  EXPECT_FALSE(pack_beliefs(record_, 10'000, arrays_).has_value());
  const VoxelIndex last = static_cast<VoxelIndex>(grid_.voxel_count() - 1);
  keep(std::vector<BelievedVoxels>{
      {.unknown = {{0, 3}, {300, 2}}, .predicted = {{301, 1}}, .frontier = {{5, 4}, {20, 1}}},
      {.unknown = {{last, 1}}, .frontier = {{6, 4}, {20, 1}}}});
  const auto packed = pack_beliefs(record_, 10'000, arrays_);
  ASSERT_TRUE(packed && packed->unknown && packed->predicted && packed->frontier);
  EXPECT_FALSE(packed->looked_at.has_value());  // holds nothing
  EXPECT_EQ(packed->size_m, grid_.resolution_m());
  const auto at = [&](const auto& list, std::size_t view) {
    return cells(*packed, *list, view, arrays_);
  };
  EXPECT_TRUE(at(packed->unknown, 0).empty());  // the start is no decision
  EXPECT_EQ(at(packed->unknown, 1), keys({0, 1, 2, 300, 301}));
  EXPECT_EQ(at(packed->unknown, 2), keys({last}));
  EXPECT_EQ(at(packed->predicted, 1), keys({301}));
  EXPECT_EQ(at(packed->frontier, 1), keys({5, 6, 7, 8, 20}));
  EXPECT_EQ(at(packed->frontier, 2), keys({6, 7, 8, 9, 20}));
  EXPECT_EQ(numbers(packed->unknown->counts, arrays_), (Numbers{0, 5, 1}));
}

TEST_F(DecisionPack, HasLargerCellsWhereThereIsNoRoom) {
  VoxelRuns scattered;
  for (VoxelIndex v = 3; v + 3 < grid_.voxel_count(); v += 7) scattered.push_back({v, 2});
  keep(std::vector<BelievedVoxels>{{.unknown = scattered}, {.unknown = scattered}});
  const auto fine = pack_beliefs(record_, 100'000'000, arrays_);
  const std::size_t room = arrays_.bytes().size() / 5;
  page::Arrays less;
  const auto packed = pack_beliefs(record_, room, less);
  ASSERT_TRUE(fine && packed);
  EXPECT_LE(less.bytes().size(), room + 24);
  EXPECT_GT(packed->size_m, fine->size_m);
  const double scale = std::round(packed->size_m / fine->size_m);
  std::set<Key> expected;  // a cell of each voxel, and no other
  for (const Key& key : cells(*fine, *fine->unknown, 1, arrays_)) {
    Key cell;
    for (std::size_t a = 0; a < 3; ++a) {
      cell[a] = static_cast<std::int32_t>(std::floor(key[a] / scale));
    }
    expected.insert(cell);
  }
  EXPECT_EQ(cells(*packed, *packed->unknown, 1, less), expected);
  // what is told of them stays true
  EXPECT_EQ(numbers(packed->unknown->counts, less), numbers(fine->unknown->counts, arrays_));
}

TEST_F(DecisionPack, OfAnOlderRunSaysHowToHaveThem) {
  EXPECT_EQ(why_no_beliefs(record_), "");  // kept no candidates either
  write_file_atomically(temp_.path() / kCandidatesFile, "");
  const std::string why = why_no_beliefs(record_);
  EXPECT_NE(why.find("--candidates"), std::string::npos) << why;
  keep(std::vector<BelievedVoxels>{});
  EXPECT_EQ(why_no_beliefs(record_), "");
  EXPECT_FALSE(pack_beliefs(record_, 10'000, arrays_).has_value());  // an oracle's decides nothing
  write_file_atomically(temp_.path() / kBeliefsFile, "{\"iteration\":1,\"unknown\":[0]}\n");
  EXPECT_THROW(pack_beliefs(record_, 10'000, arrays_), BadInput);
}

TEST_F(DecisionPack, HoldsEachCandidateWithItsReasonAndTerms) {
  EXPECT_FALSE(pack_candidates(record_, 10'000, arrays_).has_value());
  Plan plan;
  plan.candidates = {{.view = {Vec3(4, 5, 6), 0.5}, .sampler = Sampler::agvs},
                     {.view = {Vec3(1, 2, 3), -1.5, 0.25}, .sampler = Sampler::agvs},
                     {.view = {Vec3(1, 2, 4), 1.5}, .sampler = Sampler::agvs}};
  plan.candidates[0].rejected = Rejection::collision;
  plan.candidates[1].score = {.value = 9.0, .information = 8.0, .distance = 0.5};
  plan.chosen = {1};
  Plan other = plan;  // a burst
  other.candidates[1].covers = 7;
  other.candidates[2].covers = 5;
  other.chosen = {2};
  keep(std::vector{plan, other});
  const auto packed = pack_candidates(record_, 10'000, arrays_);
  ASSERT_TRUE(packed.has_value());
  EXPECT_EQ(numbers(packed->begins, arrays_),
            (Numbers{0, 0, 0, 0, 3, 2, 6, 4}));  // the start is no decision
  constexpr auto kCollision = static_cast<double>(Rejection::collision);
  EXPECT_EQ(numbers(packed->kind, arrays_),
            (Numbers{kCollision, page::kChosenCandidate, page::kValidCandidate, kCollision,
                     page::kValidCandidate, page::kKeptCandidate}));
  const Numbers terms = numbers(packed->terms, arrays_);
  ASSERT_EQ(terms.size(), 20U);  // of four that were not rejected
  EXPECT_EQ(Numbers(terms.begin(), terms.begin() + 5), (Numbers{9, 8, 0, 0, 0.5}));
  EXPECT_EQ(terms[10], 7.0);
  EXPECT_EQ(terms[15], 5.0);
  const Numbers angles = numbers(packed->angles, arrays_);
  EXPECT_EQ(Numbers(angles.begin() + 2, angles.begin() + 4), (Numbers{-1.5, 0.25}));
  EXPECT_THROW(pack_candidates(record_, 10, arrays_), BadInput);
}

/// However large each part of it is, and it uses what it has.
TEST_F(DecisionPack, ARunStaysWithinItsBudget) {
  const fs::path run = temp_.path();
  write_made_run(run);
  write_made_frames(run);
  const std::vector<Vec3f> points = sheet(40'000);
  write_cloud_ply(points, run / "cloud.ply");
  VoxelRuns scattered;
  for (VoxelIndex v = 3; v + 3 < grid_.voxel_count(); v += 7) scattered.push_back({v, 2});
  keep(std::vector<BelievedVoxels>(2, {.unknown = scattered, .frontier = scattered}));
  RunRecord record = read_run(run);
  record.views.back().cloud_points = points.size();
  for (int i = 0; i < 20'000; ++i) record.path.push_back(made_sample(5.0 + i, {0, 0, 0.001 * i}));
  fs::create_directory(run / "surface");
  std::size_t before = 0;
  for (const std::size_t bytes : {40'000U, 100'000U, 300'000U}) {
    // candidates and a surface of about a quarter of it each
    Plan plan;
    plan.candidates.assign(bytes / 65, {.view = {Vec3(4, 5, 6), 0.5}, .sampler = Sampler::agvs});
    for (Candidate& candidate : plan.candidates) candidate.rejected = Rejection::collision;
    keep(std::vector<Plan>{plan});
    std::string glb(bytes / 48 * 8, ' ');
    const std::array<std::uint32_t, 5> head = {
        0x46546C67, 2, static_cast<std::uint32_t>(glb.size()), 4, 0x4E4F534A};
    std::memcpy(glb.data(), head.data(), sizeof(head));
    write_file_atomically(run / "surface" / "surface.glb", glb);
    page::Arrays arrays;
    page::RunData data;
    pack_run(
        record, nullptr, {.bytes = bytes, .points = 100'000}, 1, [](double) {}, arrays, data);
    const std::size_t used = arrays.bytes().size();
    EXPECT_LE(used, bytes);
    EXPECT_GT(used, std::max(before, bytes / 2));
    before = used;
    EXPECT_TRUE(data.cloud && data.voxels && data.path && data.candidates && data.beliefs &&
                data.surface);
    EXPECT_EQ(data.missing, std::vector<std::string>{});
    // thinned or not, a path begins and ends where it did
    const Numbers time_s = numbers(data.path->time, arrays);
    EXPECT_EQ(time_s.front(), 0.0);
    EXPECT_EQ(time_s.back(), 20'004.0);
  }
}

}  // namespace
}  // namespace gnbv
