// Laws of the report: it shows what the run directory holds, does without what is missing or
// damaged, and no name is ever more than text.
#include "tools/page/report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/text.hpp"
#include "tests/support/covered_record.hpp"
#include "tests/support/made_frames.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/tools/page/page_arrays.hpp"
#include "tools/page/page_text.hpp"
#include "tools/run/tour_files.hpp"
#include "tools/scene/looks.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

std::string part_of(const std::string& html, const std::string& begin, const std::string& end) {
  const std::size_t at = html.find(begin);
  if (at == std::string::npos) return "";
  const std::size_t from = at + begin.size();
  return html.substr(from, html.find(end, from) - from);
}

using Json = nlohmann::ordered_json;
using Numbers = std::vector<double>;

Json data_of(const Report& report) {
  return Json::parse(
      part_of(report.html, "<script type=\"application/json\" id=\"data\">", "</script>"));
}

std::vector<std::uint8_t> bytes_of(const Report& report) {
  const std::string text =
      part_of(report.html, "<script type=\"application/octet-stream\" id=\"arrays\">", "</script>");
  std::vector<std::uint8_t> bytes;
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < text.size() && text[i] != '='; ++i) {
    constexpr std::string_view kLetters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    word = word << 6U | static_cast<std::uint32_t>(kLetters.find(text[i]));
    if (i % 4 > 0) bytes.push_back(static_cast<std::uint8_t>(word >> (6 - 2 * (i % 4))));
  }
  return bytes;
}

Report report_of(const std::vector<RunRecord>& records, int threads = 1) {
  return make_report(records, {.threads = threads, .title = ""}, [](double) {});
}

/// A made run in a folder of its own.
class ReportTest : public testing::Test {
 protected:
  ReportTest() { write_made_run(folder()); }
  const fs::path& folder() const { return temp_.path(); }
  RunRecord read() const { return read_run(folder()); }
  /// The same, as one that was scored.
  RunRecord scored(std::uint64_t seed, const std::vector<double>& coverage) const {
    RunRecord record = covered_record(seed, coverage);
    record.folder = folder();
    return record;
  }

 private:
  TempFolder temp_;
};

std::size_t rows(const Json& array) { return array["shape"][0]; }

TEST_F(ReportTest, HoldsTheViewsAndWhatGrewWithThem) {
  const RunRecord record = read();
  const Report report = report_of({record, record});
  const std::vector<std::uint8_t> bytes = bytes_of(report);
  const Json data = data_of(report);
  ASSERT_EQ(data["meshes"].size(), 1U);  // once for both
  const std::size_t voxels = rows(data["meshes"][0]["surface"]["index"]);
  EXPECT_GT(voxels, 0U);
  for (const Json& run : data["runs"]) {
    EXPECT_EQ(test::numbers(run["views"]["pose"], bytes),
              (Numbers{4, 4, 1, 3, -4, 4, 2, 1.5, -4, -4, 3, 0.8}));
    EXPECT_EQ(test::numbers(run["views"]["seconds"], bytes), (Numbers{0, 1, 2}));  // as metres
    EXPECT_EQ(rows(run["cloud"]["points"]), 6U);
    // two points of the profile; after the views 3, 5 and 6
    EXPECT_EQ(test::numbers(run["cloud"]["after"], bytes), (Numbers{2, 3, 5, 6}));
    EXPECT_EQ(test::numbers(run["voxels"]["after"], bytes), (Numbers{2, 3, 5, 6}));
    EXPECT_EQ(rows(run["path"]["time"]), 5U);
    EXPECT_EQ(rows(run["found"]), voxels);
    EXPECT_EQ(rows(run["cloud"]["error"]), 6U);
    EXPECT_EQ(run["figures"], nullptr);
    EXPECT_EQ(run["candidates"], nullptr);
    EXPECT_EQ(run["command"],
              fmt::format("gnbv run {}/scenario.yaml --out NEW", folder().string()));
  }
}

/// Only a live page may ask anybody, and only its own server.
TEST_F(ReportTest, AsksItsServerOnlyWhenItIsLive) {
  const std::vector<RunRecord> records = {read()};
  const Report still = report_of(records);
  const Report live = make_report(records, {.is_live = true}, [](double) {});
  EXPECT_EQ(still.policy.find("connect-src"), std::string::npos);
  EXPECT_NE(live.policy.find("; connect-src 'self'"), std::string::npos);
  for (const Report* const report : {&still, &live}) {
    EXPECT_NE(report->html.find(report->policy), std::string::npos);
    EXPECT_EQ(report->policy.find("unsafe"), std::string::npos);
  }
  EXPECT_EQ(data_of(still)["is_live"], false);
  EXPECT_EQ(data_of(live)["is_live"], true);
}

/// What is left of each plan after each view, as long as it is; nothing for other runs.
TEST_F(ReportTest, HoldsWhatATourStillMeantToDo) {
  RunRecord record = read();
  EXPECT_EQ(data_of(report_of({record}))["runs"][0]["plan"], nullptr);
  record.scenario.planner.utility.name = "tour";
  const Report without = report_of({record});
  EXPECT_EQ(data_of(without)["runs"][0]["plan"], nullptr);
  EXPECT_NE(without.missing.at(0).find("plan.jsonl"), std::string::npos);

  MadePlan first{.iteration = 1, .plan = {}};
  first.plan.views = {record.views[1].decision.view, {Vec3(1, 2, 3), 0.5}};
  MadePlan last{.iteration = 3, .plan = {}};
  write_file_atomically(folder() / kPlanFile, plan_jsonl(std::vector{first, last}));
  const Report report = report_of({record});
  const Json plan = data_of(report)["runs"][0]["plan"];
  EXPECT_EQ(test::numbers(plan["ranges"], bytes_of(report)), (Numbers{0, 2, 1, 2, 2, 2}));
  const Numbers poses = test::numbers(plan["poses"], bytes_of(report));
  ASSERT_EQ(poses.size(), 14U);
  EXPECT_EQ(Vec3(poses[7], poses[8], poses[9]), Vec3(1, 2, 3));
  const Eigen::Quaterniond q(poses[13], poses[10], poses[11], poses[12]);
  const CameraModel camera = make_camera_model(record.scenario.cameras.at(0));
  const Isometry T = T_world_body(first.plan.views[1]) * camera.T_body_camera;
  EXPECT_TRUE(q.toRotationMatrix().isApprox(T.linear(), 1e-5));
}

/// A page is as large as it may be, and no larger, however much there is to show.
TEST_F(ReportTest, UsesItsSizeAndKeepsIt) {
  std::vector<Vec3f> points;
  for (int i = 0; i < 900 * 900; ++i) {
    points.push_back(Vec3(0.05 * (i % 900), 0.05 * (i / 900), 1.0).cast<float>());
  }
  write_cloud_ply(points, folder() / "cloud.ply");
  RunRecord record = read();
  record.views.back().cloud_points = points.size();
  for (const std::size_t runs : {1U, 8U}) {
    const Report report = report_of(std::vector<RunRecord>(runs, record), 2);
    EXPECT_LE(report.html.size(), kMaxReportBytes);
    const Json data = data_of(report);
    ASSERT_EQ(data["runs"].size(), runs);
    for (const Json& run : data["runs"]) {
      // a lattice a bit coarser keeps a part: half a million points for one, or 100,000 for each
      const double drawn = static_cast<double>(rows(run["cloud"]["points"]));
      EXPECT_GT(drawn, runs == 1 ? 150'000.0 : 30'000.0);
      EXPECT_LE(drawn, runs == 1 ? 500'000.0 : 100'000.0);
    }
  }
}

TEST_F(ReportTest, SaysWhatIsMissingAndShowsTheRest) {
  fs::remove(folder() / "cloud.ply");
  const Report report = report_of({read()});
  const Json run = data_of(report)["runs"][0];
  EXPECT_EQ(run["cloud"], nullptr);
  EXPECT_EQ(rows(run["views"]["pose"]), 3U);
  std::string all;
  for (const Json& sentence : run["missing"]) all += sentence.get<std::string>() + "\n";
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
            "&lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt;, Proposed");
  EXPECT_EQ(data_of(report)["runs"][0]["label"], record.scenario.name + ", Proposed");
}

TEST_F(ReportTest, TheSameBytesAtAnyNumberOfThreads) {
  write_made_frames(folder());
  const RunRecord record = read();
  const Report one = report_of({record, record}, 1);
  const Json run = data_of(one)["runs"][0];
  EXPECT_EQ(run["frames"].size(), 3U);
  EXPECT_EQ(rows(run["cloud"]["colour"]), 6U);
  EXPECT_EQ(run["command"],
            fmt::format("gnbv run {}/scenario.yaml --frames --out NEW", folder().string()));
  EXPECT_EQ(one.html, report_of({record, record}, 4).html);
}

TEST_F(ReportTest, DamagedFramesCostTheFramesAlone) {
  write_made_frames(folder());
  const auto expect_no_frames = [&](const std::string& why) {
    const Report report = report_of({read()});
    ASSERT_EQ(report.missing.size(), 1U);
    EXPECT_NE(report.missing[0].find(why), std::string::npos) << report.missing[0];
    const Json run = data_of(report)["runs"][0];
    EXPECT_EQ(run["frames"].size(), 0U);
    EXPECT_EQ(rows(run["cloud"]["points"]), 6U);
    EXPECT_EQ(run["missing"].back(), report.missing[0]);
  };
  const fs::path frames = folder() / "frames";
  write_file_atomically(frames / "1.png", "no picture");
  expect_no_frames("1.png");
  fs::remove(frames / "1.png");
  expect_no_frames("poses.csv:3");
  write_file_atomically(frames / "poses.csv", "another,version\n");
  expect_no_frames("poses.csv:1");
}

TEST_F(ReportTest, AStructureThatWasMovedCostsTheStructureAlone) {
  RunRecord record = read();
  record.scenario.structure.file.path = (folder() / "moved.obj").string();
  const Report report = report_of({record});
  EXPECT_NE(report.missing.back().find("moved.obj"), std::string::npos);
  const Json data = data_of(report);
  EXPECT_EQ(data["meshes"].size(), 0U);
  EXPECT_EQ(data["runs"][0]["mesh"], -1);
  EXPECT_EQ(rows(data["runs"][0]["cloud"]["points"]), 6U);
}

TEST_F(ReportTest, TheTitleIsTheUsersOrAHeadingOfTheRuns) {
  RunRecord record = read();
  record.scenario.name = "power_plant";
  EXPECT_EQ(data_of(report_of({record}))["title"], "Power plant, Proposed");
  const Report titled = make_report({record}, {.title = "my_run"}, [](double) {});
  EXPECT_EQ(data_of(titled)["title"], "my_run");
}

TEST_F(ReportTest, ATableNamesCoverageInFullAndExplainsNoColumnThatIsNotThere) {
  RunRecord record = scored(1, {0.2});
  record.figures->ceiling.reset();
  record.figures->utility = record.scenario.planner.utility.name = "aep";
  const Json table = data_of(report_of({record}))["tables"][0];
  EXPECT_EQ(table["rows"][0][0], human_name("aep"));
  std::vector<std::string> coverage;
  for (const Json& column : table["columns"]) {
    const std::string head = column["head"];
    EXPECT_NE(head, "Of ceiling");
    if (head.find("0.") != std::string::npos) coverage.push_back(head);
  }
  EXPECT_EQ(coverage,
            (std::vector<std::string>{"Coverage 0.05 m", "Coverage 0.10 m", "Coverage 0.50 m"}));
  EXPECT_EQ(table["notes"].dump().find("of ceiling"), std::string::npos);
}

/// A released run is no second seed of a run by the paper.
TEST_F(ReportTest, RunsOfTwoConfigurationsAreTwoRows) {
  RunRecord a = scored(1, {0.2});
  a.figures->structure = "smoke";
  RunRecord b = a;
  b.scenario.planner.preset = "released";
  b.figures->coverage_final[0] = b.figures->coverage_profile[0] = 0.5;
  RunRecord other_seed = a;
  other_seed.scenario.seed = 2;
  const auto labels = [](const std::vector<RunRecord>& records) {
    std::vector<std::string> firsts;
    const Json data = data_of(report_of(records));
    for (const Json& row : data["tables"][0]["rows"]) {
      firsts.push_back(fmt::format("{}: {}", row[0].get<std::string>(), row[2].get<std::string>()));
    }
    return firsts;
  };
  using Labels = std::vector<std::string>;
  EXPECT_EQ(labels({a, other_seed}), (Labels{"Proposed: 2", "Profile: 1"}));
  EXPECT_EQ(labels({a, b, other_seed}), (Labels{"Proposed, paper: 2", "Proposed, released: 1",
                                                "Profile, paper: 1", "Profile, released: 1"}));
  EXPECT_EQ(labels({a, a}), (Labels{"Proposed: 1", "Profile: 1"})) << "one mission, told twice";
}

/// The series of each choice of the plot of coverage, over the n-th effort.
std::vector<Json> coverage_series(const Report& report, std::size_t effort,
                                  const char* of = "runs") {
  std::vector<Json> all;
  const Json data = data_of(report);
  for (const Json& choice : data["plots"][0]["choices"]) {
    if (!choice[of].empty()) all.push_back(choice[of][effort]["panels"].back()["series"]);
  }
  return all;
}

/// One that is known at 0.05 m alone is drawn there alone.
TEST_F(ReportTest, DrawsCeilingsWhereTheyAreKnown) {
  RunRecord record = scored(1, {0.2, 0.3, 0.4, 0.5});
  record.scenario.structure.file.path = "moved.obj";  // no ceiling of this machine's own
  record.figures->ceiling = 0.9;
  for (const auto& records : {std::vector{record}, std::vector{record, record}}) {
    const Report report = report_of(records);
    std::vector<Numbers> ceilings;
    for (const Json& all : coverage_series(report, 0)) {
      ceilings.emplace_back();
      for (const Json& series : all) {
        if (series["mark"] != "level") continue;
        ceilings.back().push_back(test::numbers(series["y"], bytes_of(report))[0]);
      }
    }
    EXPECT_EQ(ceilings, (std::vector<Numbers>{{90}, {}, {}}));
  }
}

/// Of a mission that ended before its first view, and over the metres of one view.
TEST_F(ReportTest, AnAxisOfNothingGoesToOne) {
  RunRecord record = scored(1, {0.2});
  record.views.clear();
  const Json choice = data_of(report_of({record}))["plots"][0]["choices"][0];
  EXPECT_GE(choice["runs"][0]["panels"][0]["x"]["high"], 1.0);
}

/// A line a run, and of runs that differ in their seeds alone their mean.
TEST_F(ReportTest, PlotsHaveTheRunsAndTheMeanOfTheirSeeds) {
  const RunRecord one = scored(1, {0.2, 0.3, 0.4, 0.5});
  RunRecord two = scored(2, {0.2, 0.5, 0.6, 0.7});
  const Report report = report_of({one, two});
  const std::vector<std::uint8_t> bytes = bytes_of(report);
  const auto numbers = [&](const Json& series, const char* name) {
    Numbers values = test::numbers(series[name], bytes);
    for (double& value : values) value = std::round(1e9 * value) / 1e9;
    return values;
  };
  const Json runs = coverage_series(report, 0)[0];
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[1]["name"], data_of(report)["runs"][1]["label"]);
  EXPECT_EQ(numbers(runs[1], "x"), (Numbers{0, 1, 2, 3}));
  EXPECT_EQ(numbers(runs[1], "y"), (Numbers{20, 50, 60, 70}));
  EXPECT_EQ(runs[0]["mark"], "steps");  // surface counts from the view that saw it
  const Json over_metres = coverage_series(report, 1)[0][1];
  EXPECT_EQ(numbers(over_metres, "x"), (Numbers{0, 2, 4, 6}));
  EXPECT_EQ(over_metres["y"], runs[1]["y"]) << "the same numbers stand in the page once";
  EXPECT_EQ(numbers(coverage_series(report, 0, "means")[0].back(), "y"), (Numbers{20, 40, 50, 60}));
  // from take-off of those that know it: energy of none of these
  EXPECT_TRUE(data_of(report)["plots"][0]["choices"][0]["runs"][5]["panels"].empty());
  two.figures->before.profile_end_s = 30.0;
  two.figures->curve.energy_wh = {1, 2, 3, 4};
  const Report some = report_of({one, two});
  const auto spent = [&](std::size_t run) {
    std::vector<Numbers> all;
    const Json data = data_of(some);
    for (const Json& list : data["runs"][run]["views"]["from_take_off"]) {
      all.push_back(test::numbers(list, bytes_of(some)));
    }
    return all;
  };
  EXPECT_EQ(spent(0), (std::vector<Numbers>{{0, 2, 4, 6}, {0, 5, 10, 15}, {}}));
  EXPECT_EQ(spent(1), (std::vector<Numbers>{{0, 2, 4, 6}, {30, 35, 40, 45}, {1, 2, 3, 4}}));
  EXPECT_EQ(coverage_series(some, 5)[0].size(), 1U);
  EXPECT_EQ(coverage_series(some, 5, "means")[0].size(), 1U);
  two.scenario.planner.preset = "released";
  EXPECT_TRUE(coverage_series(report_of({one, two}), 0, "means").empty());
}

/// As `gnbv surface` wrote it, where it is whole and there is room; else a command that makes one.
TEST_F(ReportTest, CarriesTheSurfaceOfTheRunWhereItHasRoom) {
  const RunRecord record = read();
  EXPECT_TRUE(data_of(report_of({record}))["runs"][0]["surface"].is_null());
  fs::create_directory(folder() / "surface");
  const auto run_with = [&](std::size_t size, const std::string& says) {
    std::string glb(size, ' ');
    for (std::size_t i = 0; i < says.size(); ++i) glb[i] = says[i];
    write_file_atomically(folder() / "surface" / "surface.glb", glb);
    return data_of(report_of({record}))["runs"][0];
  };
  using namespace std::string_literals;
  const std::string head = "glTF\2\0\0\0"s;
  EXPECT_EQ(rows(run_with(40, head + "\x28\0\0\0\x04\0\0\0JSON"s)["surface"]), 40U);
  for (const Json& without : {run_with(0, ""), run_with(40, "glTF and more"),
                              run_with(39, head + "\x28\0\0\0\x04\0\0\0JSON"s)}) {
    EXPECT_TRUE(without["surface"].is_null());
    EXPECT_NE(without["missing"].dump().find("surface.glb: is no whole"), std::string::npos);
  }
  // 9,000,000 bytes
  const Json large = run_with(9'000'000, head + "\x40\x54\x89\0\x04\0\0\0JSON"s);
  EXPECT_TRUE(large["surface"].is_null());
  EXPECT_NE(large["missing"].dump().find("makes a smaller one"), std::string::npos);
}

/// WCAG 2's contrast of 3 to 1 against the stage (report.css), by night as by day.
TEST(PageColours, MarksStandOutFromTheStageAndTheChosenViewFromWhatWasMissed) {
  const auto brightness = [](std::uint32_t colour) {
    const Rgb rgb = srgb(colour);
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2] + 0.05;
  };
  for (const Look* const look : {&looks::kHull, &looks::kChosen, &looks::kMissed, &looks::kPlan}) {
    EXPECT_GT(brightness(0xf4f6f9) / brightness(look->light), 3.0) << look->name;
    EXPECT_GT(brightness(look->dark) / brightness(0x14181e), 3.0) << look->name;
  }
  EXPECT_NE(looks::kChosen.light, looks::kMissed.light);
}

TEST(PageText, NoTextIsMarkup) {
  EXPECT_EQ(html_escaped("<a href='x'>\"&\"</a>"),
            "&lt;a href=&#39;x&#39;&gt;&quot;&amp;&quot;&lt;/a&gt;");
  const std::string hostile = "</script><!--<script>&";
  const std::string json = script_json(Json(hostile).dump());
  EXPECT_EQ(json.find_first_of("<>&"), std::string::npos) << json;
  EXPECT_EQ(Json::parse(json).get<std::string>(), hostile);
  // of the empty text, as every browser computes it
  EXPECT_EQ(policy_hash(""), "'sha256-47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU='");
}

}  // namespace
}  // namespace gnbv
