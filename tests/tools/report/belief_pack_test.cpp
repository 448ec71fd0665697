// Laws of what the report says of the voxels for whose sake a view was chosen.
#include "tools/report/belief_pack.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "sim/core/error.hpp"
#include "tests/support/made_run.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

template <typename T>
std::vector<T> read_back(const BytePack& bytes, const ByteSlice& slice) {
  std::vector<T> values(slice.count);
  std::memcpy(values.data(), bytes.bytes().data() + slice.at, sizeof(T) * values.size());
  return values;
}

/// Indices of the cells of a view, as the page restores them.
std::set<Key> cells_of(const BytePack& bytes, const PackedBeliefs& packed, std::size_t list,
                       std::size_t view) {
  const auto runs = read_back<std::uint8_t>(bytes, packed.lists.at(list)->runs);
  const auto begins = read_back<std::uint32_t>(bytes, packed.lists.at(list)->begins);
  std::size_t at = begins.at(view);
  const auto next = [&] {
    std::int32_t value = 0;
    for (int shift = 0;; shift += 7) {
      const std::uint8_t byte = runs.at(at++);
      value |= (byte & 127) << shift;
      if (byte < 128) return value;
    }
  };
  std::set<Key> cells;
  for (std::int32_t end = 0; at < begins.at(view + 1);) {
    const std::int32_t first = end + next();
    end = first + next();
    for (std::int32_t i = first; i < end; ++i) {
      const auto& [nx, ny, nz] = packed.cells;
      cells.insert(
          {i % nx + packed.low[0], i / nx % ny + packed.low[1], i / (nx * ny) + packed.low[2]});
      EXPECT_LT(i, nx * ny * nz);
    }
  }
  return cells;
}

class BeliefPack : public testing::Test {
 protected:
  BeliefPack() { record_.folder = temp_.path(); }

  void keep(const std::vector<BelievedVoxels>& views) {
    BeliefsFile file(temp_.path(), 1);
    for (std::size_t i = 0; i < views.size(); ++i) file.write(i + 1, views[i]);
    file.finish();
  }

  TempFolder temp_;
  RunRecord record_ = made_record();
  GridGeometry grid_{record_.scenario.workspace_m, record_.scenario.planner.map.resolution_m};
};

TEST_F(BeliefPack, HoldsEachVoxelOfEachDecision) {
  BytePack bytes;
  EXPECT_FALSE(pack_beliefs(record_, 10'000, bytes).has_value());
  const VoxelIndex last = static_cast<VoxelIndex>(grid_.voxel_count() - 1);
  keep({{.unknown = {{0, 3}, {300, 200}}, .predicted = {{301, 1}}}, {.unknown = {{last, 1}}}});
  const auto packed = pack_beliefs(record_, 10'000, bytes);
  ASSERT_TRUE(packed.has_value());
  EXPECT_EQ(packed->size_m, grid_.resolution_m());
  std::set<Key> expected;
  for (VoxelIndex v = 0; v < 500; ++v) {
    if (v < 3 || v >= 300) expected.insert(grid_.key_at(v));
  }
  EXPECT_TRUE(cells_of(bytes, *packed, 0, 0).empty());  // the start is no decision
  EXPECT_EQ(cells_of(bytes, *packed, 0, 1), expected);
  EXPECT_EQ(cells_of(bytes, *packed, 0, 2), (std::set<Key>{grid_.key_at(last)}));
  EXPECT_EQ(cells_of(bytes, *packed, 1, 1), (std::set<Key>{grid_.key_at(301)}));
  EXPECT_EQ(read_back<std::uint32_t>(bytes, packed->lists[0]->counts),
            (std::vector<std::uint32_t>{0, 203, 1}));
  EXPECT_FALSE(packed->lists[2].has_value() || packed->lists[3].has_value());  // hold nothing
}

TEST_F(BeliefPack, HoldsWhatChangesOfFrontiers) {
  record_.views.push_back(made_view(3, {Vec3(4, 4, 1), 3.0}, 7));
  keep({{.frontier = {{5, 4}, {20, 1}}}, {}, {.frontier = {{6, 4}, {20, 1}}}});
  BytePack bytes;
  const auto packed = pack_beliefs(record_, 10'000, bytes);
  ASSERT_TRUE(packed && kBeliefLists[2].has_changes);
  const auto keys = [&](std::initializer_list<VoxelIndex> voxels) {
    std::set<Key> all;
    for (const VoxelIndex v : voxels) all.insert(grid_.key_at(v));
    return all;
  };
  EXPECT_EQ(cells_of(bytes, *packed, 2, 1), keys({5, 6, 7, 8, 20}));
  EXPECT_TRUE(cells_of(bytes, *packed, 2, 2).empty());  // asked for none
  EXPECT_EQ(cells_of(bytes, *packed, 2, 3), keys({5, 9}));
}

TEST_F(BeliefPack, HasLargerCellsWhereThereIsNoRoom) {
  VoxelRuns scattered;
  for (VoxelIndex v = 3; v + 3 < grid_.voxel_count(); v += 7) scattered.push_back({v, 2});
  keep({{.unknown = scattered}, {.unknown = scattered}});
  BytePack all;
  const auto fine = pack_beliefs(record_, 100'000'000, all);
  const std::size_t room = all.bytes().size() / 5;
  BytePack bytes;
  const auto packed = pack_beliefs(record_, room, bytes);
  ASSERT_TRUE(fine && packed);
  EXPECT_LE(bytes.bytes().size(), room + 8);
  EXPECT_GT(packed->size_m, fine->size_m);
  const auto scale = static_cast<double>(std::lround(packed->size_m / fine->size_m));
  std::set<Key> expected;  // a cell of each voxel, and no other
  for (const Key& key : cells_of(all, *fine, 0, 1)) {
    Key cell;
    for (std::size_t a = 0; a < 3; ++a) {
      cell[a] = static_cast<std::int32_t>(std::floor(key[a] / scale));
    }
    expected.insert(cell);
  }
  EXPECT_EQ(cells_of(bytes, *packed, 0, 1), expected);
  // what is told of them stays true
  EXPECT_EQ(read_back<std::uint32_t>(bytes, packed->lists[0]->counts),
            read_back<std::uint32_t>(all, fine->lists[0]->counts));
}

TEST_F(BeliefPack, OfAnOlderRunSaysHowToHaveThem) {
  EXPECT_EQ(why_no_beliefs(record_), "");  // kept no candidates either
  write_file_atomically(temp_.path() / kCandidatesFile, "");
  const std::string why = why_no_beliefs(record_);
  EXPECT_NE(why.find("gnbv run"), std::string::npos) << why;
  EXPECT_NE(why.find("--candidates"), std::string::npos) << why;
  keep({});
  EXPECT_EQ(why_no_beliefs(record_), "");
  BytePack bytes;
  EXPECT_FALSE(pack_beliefs(record_, 10'000, bytes).has_value());  // an oracle's decides nothing
  write_file_atomically(temp_.path() / kBeliefsFile, "{\"iteration\":1,\"unknown\":[0]}\n");
  EXPECT_THROW(pack_beliefs(record_, 10'000, bytes), BadInput);
}

}  // namespace
}  // namespace gnbv
