// Laws of what reports are packed of: what is packed is restored, what is thinned keeps its bounds
// and its budget, and no text is ever markup.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "assets/catalog.hpp"
#include "sim/core/error.hpp"
#include "sim/core/rng.hpp"
#include "tests/support/made_frames.hpp"
#include "tests/support/made_run.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/report/byte_pack.hpp"
#include "tools/report/jpeg.hpp"
#include "tools/report/page_text.hpp"
#include "tools/report/run_json.hpp"
#include "tools/report/thinning.hpp"
#include "tools/report/voxel_growth.hpp"

namespace gnbv {
namespace {

/// Points on a wavy sheet of 10 m by 10 m.
std::vector<Vec3f> sheet(std::size_t count) {
  std::vector<Vec3f> points;
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = [&](std::uint64_t axis) {
      return static_cast<float>(10.0 * uniform01({7, Stream::bench, i, axis}) - 5.0);
    };
    points.emplace_back(at(0), at(1), std::sin(at(0)) - 3.0F);
  }
  return points;
}

TEST(BytePack, EveryArrayBeginsWhereABrowserMayReadIt) {
  BytePack pack;
  const std::vector<std::uint8_t> odd = {1, 2, 3};
  const std::vector<std::uint32_t> words = {0x01020304, 5};
  EXPECT_EQ(pack.add(odd).at, 0U);
  const ByteSlice slice = pack.add(words);
  EXPECT_EQ(slice.at, 4U);
  EXPECT_EQ(slice.count, 2U);
  EXPECT_EQ(pack.bytes()[4], 4U);  // little-endian
  EXPECT_EQ(pack.add(std::vector<std::uint8_t>{}).count, 0U);
}

TEST(QuantisedPoints, AreRestoredWithinHalfAStep) {
  const std::vector<Vec3f> points = sheet(2000);
  const QuantisedPoints q = quantised(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      // half a step, and the rounding of float32 at 10 m
      EXPECT_NEAR(restored_point(q, i)[axis], points[i][axis], q.size_m[axis] / 131070.0 + 2e-6);
    }
  }
}

TEST(QuantisedPoints, OneHeightIsExact) {
  const std::vector<Vec3f> flat = {{0, 1, 2.5F}, {4, 1, 2.5F}};
  const QuantisedPoints q = quantised(flat);
  EXPECT_EQ(restored_point(q, 0), flat[0]);
  EXPECT_EQ(restored_point(q, 1), flat[1]);
  EXPECT_TRUE(quantised({}).steps.empty());
}

TEST(Thinning, KeepsTheBudgetAndLeavesNoHole) {
  const std::vector<Vec3f> points = sheet(20000);
  const ThinnedPoints thin = thinned(points, 1500, 0.02);
  ASSERT_LE(thin.kept.size(), 1500U);
  EXPECT_GT(thin.kept.size(), 500U);  // a lattice 1.25 times as coarse keeps 1 / 1.56 of a sheet
  EXPECT_TRUE(std::is_sorted(thin.kept.begin(), thin.kept.end()));
  // whatever went lies in the cell of one that stayed
  const double diagonal_m = thin.cell_m * std::sqrt(3.0);
  for (std::size_t i = 0; i < points.size(); i += 97) {
    const bool is_covered = std::any_of(thin.kept.begin(), thin.kept.end(), [&](std::size_t k) {
      return (points[k] - points[i]).norm() <= diagonal_m;
    });
    EXPECT_TRUE(is_covered) << i;
  }
}

TEST(Thinning, TheFirstPointOfACellStays) {
  const std::vector<Vec3f> points = {
      {0.15F, 0, 0}, {0.05F, 0, 0}, {0.11F, 0, 0}, {-0.05F, 0, 0}, {0.01F, 0.01F, 0.01F}};
  EXPECT_EQ(first_points(points, 0.1), (std::vector<std::size_t>{0, 1, 3}));
  EXPECT_EQ(thinned(points, 5, 0.1).kept.size(), 5U);
  EXPECT_EQ(thinned(points, 5, 0.1).cell_m, 0.0);
}

TEST(Thinning, AMeshKeepsItsPlaceAndItsMaterials) {
  const TriangleMesh whole = make_builtin_structure("aircraft");
  const TriangleMesh thin = with_fewer_faces(whole, 6000);
  ASSERT_LE(thin.faces.size(), 6000U);
  EXPECT_GT(thin.faces.size(), 2000U);
  EXPECT_EQ(thin.faces.size(), thin.face_material.size());
  EXPECT_TRUE(bounds_m(whole).contains(bounds_m(thin)));
  EXPECT_NEAR(bounds_m(thin).diagonal().norm(), bounds_m(whole).diagonal().norm(), 0.5);
  for (const auto& face : thin.faces) {
    EXPECT_EQ(std::set<std::uint32_t>(face.begin(), face.end()).size(), 3U);
    for (const std::uint32_t corner : face) ASSERT_LT(corner, thin.vertices_m.size());
  }
  EXPECT_EQ(with_fewer_faces(whole, 1'000'000).faces.size(), whole.faces.size());
}

TEST(Thumbnails, APixelIsTheMeanOfTheSquareItReplaces) {
  const Image image{4, 2, {0,  0, 0, 10, 0, 0, 9, 9, 9, 9, 9, 9,  //
                           20, 0, 0, 30, 0, 0, 9, 9, 9, 9, 9, 9}};
  const Image half = shrunk(image, 2);
  EXPECT_EQ(half.width_px, 2);
  EXPECT_EQ(half.height_px, 1);
  EXPECT_EQ(half.at(0, 0), (std::array<std::uint8_t, 3>{15, 0, 0}));
  EXPECT_EQ(half.at(1, 0), (std::array<std::uint8_t, 3>{9, 9, 9}));
  const std::vector<std::uint8_t> jpeg = jpeg_bytes(half, 80);
  ASSERT_GT(jpeg.size(), 4U);
  EXPECT_EQ(jpeg[0] << 8U | jpeg[1], 0xffd8);  // start and end of image, ITU T.81 B.1.1.3
  EXPECT_EQ(jpeg[jpeg.size() - 2] << 8U | jpeg.back(), 0xffd9);
}

TEST(PageText, NoTextIsMarkup) {
  EXPECT_EQ(html_escaped("<a href='x'>\"&\"</a>"),
            "&lt;a href=&#39;x&#39;&gt;&quot;&amp;&quot;&lt;/a&gt;");
  const std::string hostile = "</script><!--<script>&";
  const std::string json = script_json(nlohmann::json(hostile).dump());
  EXPECT_EQ(json.find_first_of("<>&"), std::string::npos) << json;
  EXPECT_EQ(nlohmann::json::parse(json).get<std::string>(), hostile);
}

TEST(PageText, ValuesAreNotSearchedForPlaces) {
  EXPECT_EQ(filled("a{{X}}b{{Y}}c", {{"X", "{{Y}}"}, {"Y", "2"}}), "a{{Y}}b2c");
  EXPECT_THROW(filled("{{X}}", {}), BrokenInvariant);
  EXPECT_THROW(filled("", {{"X", ""}}), BrokenInvariant);
}

// of the empty text, as every browser computes it
TEST(PageText, ThePolicyNamesAScriptByItsHash) {
  EXPECT_EQ(policy_hash(""), "'sha256-47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU='");
}

TEST(PackedRun, StaysWithinItsBudget) {
  TempFolder temp;
  write_made_run(temp.path());
  write_made_frames(temp.path());
  const std::vector<Vec3f> points = sheet(40'000);
  write_cloud_ply(points, temp.path() / "cloud.ply");
  RunRecord record = read_run(temp.path());
  record.views.back().cloud_points = points.size();
  for (int i = 0; i < 20'000; ++i) record.path.push_back(made_sample(5.0 + i, {0, 0, 0.001 * i}));
  std::size_t before = 0;
  for (const std::size_t bytes : {20'000U, 100'000U, 300'000U}) {
    const PackedRun run =
        pack_run(record, nullptr, {.bytes = bytes, .points = 100'000}, 1, [](double) {});
    EXPECT_LE(run.bytes.bytes().size(), bytes);
    EXPECT_GT(run.bytes.bytes().size(), std::max(before, bytes / 4));  // and uses it
    before = run.bytes.bytes().size();
    EXPECT_TRUE(run.cloud && run.voxels && run.path && run.missing.empty());
    // thinned or not, a path begins and ends where it did
    const auto* time_s =
        reinterpret_cast<const float*>(run.bytes.bytes().data() + run.path->time_s.at);
    EXPECT_EQ(time_s[0], 0.0F);
    EXPECT_EQ(time_s[run.path->time_s.count - 1], 20'004.0F);
  }
}

/// The counts after `state`, as the page adds them up.
std::vector<std::uint32_t> counts_at(const VoxelGrowth& growth, std::size_t state) {
  std::vector<std::uint32_t> counts(growth.index.size() / 3, 0);
  std::size_t gain = 0;
  for (std::size_t s = 0; s <= state; ++s) {
    for (std::size_t voxel = 0; gain < growth.gains_after[s]; ++gain) {
      voxel += growth.gain_step[gain];
      counts.at(voxel) += growth.gain_points[gain];
    }
  }
  return counts;
}

/// In each voxel of 1 m, among the first `end` points.
std::map<std::array<int, 3>, std::uint32_t> brute_counts(const RunCloud& cloud, std::size_t end) {
  std::map<std::array<int, 3>, std::uint32_t> counts;
  for (std::size_t i = 0; i < end; ++i) {
    const Vec3f& p = cloud.points_world_m[i];
    ++counts[{static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y())),
              static_cast<int>(std::floor(p.z()))}];
  }
  return counts;
}

void expect_brute_counts(const RunCloud& cloud) {
  const VoxelGrowth growth = voxel_growth(cloud, 1.0);
  ASSERT_EQ(growth.after.size(), cloud.view_points.size() + 1);
  for (std::size_t state = 0; state < growth.after.size(); ++state) {
    const bool is_last = state + 1 == growth.after.size();
    const std::size_t end = is_last      ? cloud.points_world_m.size()
                            : state == 0 ? cloud.profile_points
                                         : cloud.view_points[state - 1];
    const auto expected = brute_counts(cloud, end);
    EXPECT_EQ(growth.after[state], expected.size());
    const std::vector<std::uint32_t> counts = counts_at(growth, state);
    for (std::size_t v = 0; v < counts.size(); ++v) {
      const std::array<int, 3> key = {growth.index[3 * v], growth.index[3 * v + 1],
                                      growth.index[3 * v + 2]};
      const auto at = expected.find(key);
      ASSERT_EQ(counts[v], at == expected.end() ? 0 : at->second) << "state " << state;
      EXPECT_EQ(v < growth.after[state], at != expected.end());
    }
  }
}

TEST(VoxelGrowth, TheCountsAfterEachViewAreThoseOfItsPoints) {
  // the last points came after the last view and count to it
  expect_brute_counts(
      {.points_world_m = sheet(6000), .profile_points = 900, .view_points = {900, 4000, 5900}});
  expect_brute_counts({.points_world_m = sheet(50), .profile_points = 20, .view_points = {}});
}

TEST(VoxelGrowth, NoGapAndNoGainIsTooLarge) {
  RunCloud cloud;
  for (int i = 0; i < 70'000; ++i) {
    cloud.points_world_m.emplace_back(static_cast<float>(i % 300), static_cast<float>(i / 300), 0);
  }
  cloud.profile_points = cloud.points_world_m.size();
  cloud.points_world_m.insert(cloud.points_world_m.end(), 511, cloud.points_world_m.back());
  cloud.view_points = {cloud.points_world_m.size()};
  expect_brute_counts(cloud);
}

TEST(Report, StructuresStayWithinTheirBudget) {
  const TriangleMesh whole = make_builtin_structure("aircraft");
  for (const std::size_t bytes : {20'000U, 200'000U}) {
    BytePack pack;
    mesh_json(whole, bytes, pack);
    EXPECT_LE(pack.bytes().size(), bytes);
    EXPECT_GT(pack.bytes().size(), bytes / 4);
  }
}

}  // namespace
}  // namespace gnbv
