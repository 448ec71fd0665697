// Laws of the report: what is packed is restored, what is thinned keeps its bounds and its budget,
// and no name is ever more than text.
#include "tools/report/report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>

#include "assets/catalog.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/rng.hpp"
#include "tests/support/made_run.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/report/byte_pack.hpp"
#include "tools/report/jpeg.hpp"
#include "tools/report/page_text.hpp"
#include "tools/report/run_json.hpp"
#include "tools/report/thinning.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

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

std::vector<std::uint8_t> bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

std::string part_of(const std::string& html, const std::string& begin, const std::string& end) {
  const std::size_t at = html.find(begin);
  if (at == std::string::npos) return "";
  const std::size_t from = at + begin.size();
  return html.substr(from, html.find(end, from) - from);
}

nlohmann::json data_of(const Report& report) {
  return nlohmann::json::parse(
      part_of(report.html, "<script type=\"application/json\" id=\"data\">", "</script>"));
}

Report report_of(const std::vector<RunRecord>& records, int threads = 1) {
  return make_report(records, {.threads = threads, .title = ""}, [](double) {});
}

// RFC 4648, section 10
TEST(Base64, IsThatOfTheStandard) {
  EXPECT_EQ(base64(bytes_of("")), "");
  EXPECT_EQ(base64(bytes_of("f")), "Zg==");
  EXPECT_EQ(base64(bytes_of("fo")), "Zm8=");
  EXPECT_EQ(base64(bytes_of("foo")), "Zm9v");
  EXPECT_EQ(base64(bytes_of("foobar")), "Zm9vYmFy");
  EXPECT_EQ(base64(std::vector<std::uint8_t>{0xff, 0xfe, 0xfb}), "//77");
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

TEST(Report, HoldsTheViewsAndWhatGrewWithThem) {
  TempFolder temp;
  write_made_run(temp.path());
  const nlohmann::json data = data_of(report_of({read_run(temp.path())}));
  const nlohmann::json& run = data["runs"][0];
  EXPECT_EQ(run["views"]["x"], nlohmann::json({4.0, -4.0, -4.0}));
  EXPECT_EQ(run["views"]["yaw"], nlohmann::json({3.0, 1.5, 0.8}));
  EXPECT_EQ(run["cloud"]["points"]["steps"][1], 18);  // six points
  EXPECT_EQ(run["cloud"]["after"][1], 4);             // the profile and three views
  EXPECT_EQ(run["voxels"]["count"][1], 6);            // no two in one
  EXPECT_EQ(run["path"]["time"][1], 5);
  EXPECT_EQ(run["figures"], nullptr);
}

TEST(PackedRun, PointsAndVoxelsAreThereAfterTheViewThatBroughtThem) {
  TempFolder temp;
  write_made_run(temp.path());
  const PackedRun run = pack_run(read_run(temp.path()), {.points = 100, .frame_bytes = 0}, 1, {});
  const auto counts = [&](const ByteSlice& slice) {
    std::vector<std::uint32_t> values(slice.count);
    std::memcpy(values.data(), run.bytes.bytes().data() + slice.at, 4 * slice.count);
    return values;
  };
  // two points of the profile; after the views 3, 5 and 6
  ASSERT_TRUE(run.cloud && run.voxels);
  EXPECT_EQ(counts(run.cloud->after), (std::vector<std::uint32_t>{2, 3, 5, 6}));
  EXPECT_EQ(counts(run.voxels->after), (std::vector<std::uint32_t>{2, 3, 5, 6}));
  EXPECT_EQ(counts(run.voxels->count), (std::vector<std::uint32_t>(6, 1)));
}

TEST(Report, SaysWhatIsMissingAndShowsTheRest) {
  TempFolder temp;
  write_made_run(temp.path());
  fs::remove(temp.path() / "cloud.ply");
  const Report report = report_of({read_run(temp.path())});
  const nlohmann::json run = data_of(report)["runs"][0];
  EXPECT_EQ(run["cloud"], nullptr);
  EXPECT_EQ(run["views"]["x"].size(), 3U);
  std::string all;
  for (const nlohmann::json& sentence : run["missing"]) all += sentence.get<std::string>() + "\n";
  for (const char* words : {"summary.json", "cloud.ply", "frames", "--resume", "--frames"}) {
    EXPECT_NE(all.find(words), std::string::npos) << words << " in " << all;
  }
  EXPECT_EQ(report.missing.size(), 2U);  // cloud and frames; of the summary the record knows
}

TEST(Report, NamesStayText) {
  TempFolder temp;
  const fs::path folder = temp.path() / "<img src=x onerror=alert(1)>";
  fs::create_directories(folder);
  write_made_run(folder);
  RunRecord record = read_run(folder);
  record.scenario.name = "</script><script>alert(1)</script>";
  const Report report = report_of({record});
  EXPECT_EQ(report.html.find("<script>alert"), std::string::npos);
  EXPECT_EQ(report.html.find("<img src=x"), std::string::npos);
  EXPECT_EQ(part_of(report.html, "<title>", "</title>"),
            "&lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt;, proposed");
  EXPECT_EQ(data_of(report)["runs"][0]["scenario"], record.scenario.name);
}

TEST(Report, TheSameBytesAtAnyNumberOfThreads) {
  TempFolder temp;
  write_made_run(temp.path());
  const RunRecord record = read_run(temp.path());
  EXPECT_EQ(report_of({record, record}, 1).html, report_of({record, record}, 4).html);
}

TEST(Report, RunsAreToldApartByAsMuchAsItTakes) {
  RunRecord a = made_record();
  a.folder = "runs/a";
  RunRecord b = a;
  b.folder = "runs/b";
  RunRecord c = a;
  c.scenario.planner.utility.name = "bircher";
  RunRecord d = c;
  d.scenario.seed = 2;
  EXPECT_EQ(run_labels({a, c}), (std::vector<std::string>{"smoke, proposed", "smoke, bircher"}));
  EXPECT_EQ(run_labels({c, d}),
            (std::vector<std::string>{"smoke, bircher, seed 1", "smoke, bircher, seed 2"}));
  EXPECT_EQ(run_labels({a, b})[1], "smoke, proposed, seed 1 (runs/b)");
}

}  // namespace
}  // namespace gnbv
