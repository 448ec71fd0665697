// Laws of the report: it shows what the run directory holds, does without what is missing or
// damaged, and no name is ever more than text.
#include "tools/page/report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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

std::size_t rows(const Json& array) { return array["shape"][0]; }

TEST(Report, HoldsTheViewsAndWhatGrewWithThem) {
  TempFolder temp;
  write_made_run(temp.path());
  const RunRecord record = read_run(temp.path());
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
              fmt::format("gnbv run {}/scenario.yaml --out NEW", temp.path().string()));
  }
}

/// Only a live page may ask anybody, and only its own server.
TEST(Report, AsksItsServerOnlyWhenItIsLive) {
  TempFolder temp;
  write_made_run(temp.path());
  const std::vector<RunRecord> records = {read_run(temp.path())};
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
TEST(Report, HoldsWhatATourStillMeantToDo) {
  TempFolder temp;
  write_made_run(temp.path());
  RunRecord record = read_run(temp.path());
  EXPECT_EQ(data_of(report_of({record}))["runs"][0]["plan"], nullptr);
  record.scenario.planner.utility.name = "tour";
  const Report without = report_of({record});
  EXPECT_EQ(data_of(without)["runs"][0]["plan"], nullptr);
  EXPECT_NE(without.missing.at(0).find("plan.jsonl"), std::string::npos);

  MadePlan first{.iteration = 1, .plan = {}};
  first.plan.views = {record.views[1].decision.view, {Vec3(1, 2, 3), 0.5}};
  MadePlan last{.iteration = 3, .plan = {}};
  write_file_atomically(temp.path() / kPlanFile, plan_jsonl(std::vector{first, last}));
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

TEST(Report, HoldsTheCamerasAsTheyAreMounted) {
  TempFolder temp;
  write_made_run(temp.path());
  const RunRecord record = read_run(temp.path());
  const Json cameras = data_of(report_of({record}))["runs"][0]["cameras"];
  ASSERT_EQ(cameras.size(), record.scenario.cameras.size());
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const CameraModel model = make_camera_model(record.scenario.cameras[i]);
    EXPECT_EQ(cameras[i]["name"], model.config.name);
    EXPECT_EQ(cameras[i]["fov_x"], model.config.fov_x_rad);
    EXPECT_EQ(cameras[i]["range_m"], model.config.range_max_m);
    ASSERT_EQ(cameras[i]["T_body_camera"].size(), 16U);
    for (std::size_t k = 0; k < 16; ++k) {  // column by column, as three.js has them
      EXPECT_EQ(cameras[i]["T_body_camera"][k], model.T_body_camera.data()[k]);
    }
  }
}

/// A page is as large as it may be, and no larger, however much there is to show.
TEST(Report, UsesItsSizeAndKeepsIt) {
  TempFolder temp;
  write_made_run(temp.path());
  std::vector<Vec3f> points;
  for (int i = 0; i < 900 * 900; ++i) {
    points.push_back(Vec3(0.05 * (i % 900), 0.05 * (i / 900), 1.0).cast<float>());
  }
  write_cloud_ply(points, temp.path() / "cloud.ply");
  RunRecord record = read_run(temp.path());
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

TEST(Report, SaysWhatIsMissingAndShowsTheRest) {
  TempFolder temp;
  write_made_run(temp.path());
  fs::remove(temp.path() / "cloud.ply");
  const Report report = report_of({read_run(temp.path())});
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

TEST(Report, TheSameBytesAtAnyNumberOfThreads) {
  TempFolder temp;
  write_made_run(temp.path());
  write_made_frames(temp.path());
  const RunRecord record = read_run(temp.path());
  const Report one = report_of({record, record}, 1);
  const Json run = data_of(one)["runs"][0];
  EXPECT_EQ(run["frames"].size(), 3U);
  EXPECT_EQ(rows(run["cloud"]["colour"]), 6U);
  EXPECT_EQ(run["command"],
            fmt::format("gnbv run {}/scenario.yaml --frames --out NEW", temp.path().string()));
  EXPECT_EQ(one.html, report_of({record, record}, 4).html);
}

TEST(Report, DamagedFramesCostTheFramesAlone) {
  TempFolder temp;
  write_made_run(temp.path());
  write_made_frames(temp.path());
  const auto expect_no_frames = [&](const std::string& why) {
    const Report report = report_of({read_run(temp.path())});
    ASSERT_EQ(report.missing.size(), 1U);
    EXPECT_NE(report.missing[0].find(why), std::string::npos) << report.missing[0];
    const Json run = data_of(report)["runs"][0];
    EXPECT_EQ(run["frames"].size(), 0U);
    EXPECT_EQ(rows(run["cloud"]["points"]), 6U);
    EXPECT_EQ(run["missing"].back(), report.missing[0]);
  };
  const fs::path frames = temp.path() / "frames";
  write_file_atomically(frames / "1.png", "no picture");
  expect_no_frames("1.png");
  fs::remove(frames / "1.png");
  expect_no_frames("poses.csv:3");
  write_file_atomically(frames / "poses.csv", "another,version\n");
  expect_no_frames("poses.csv:1");
}

TEST(Report, AStructureThatWasMovedCostsTheStructureAlone) {
  TempFolder temp;
  write_made_run(temp.path());
  RunRecord record = read_run(temp.path());
  record.scenario.structure.file.path = (temp.path() / "moved.obj").string();
  const Report report = report_of({record});
  EXPECT_NE(report.missing.back().find("moved.obj"), std::string::npos);
  const Json data = data_of(report);
  EXPECT_EQ(data["meshes"].size(), 0U);
  EXPECT_EQ(data["runs"][0]["mesh"], -1);
  EXPECT_EQ(rows(data["runs"][0]["cloud"]["points"]), 6U);
}

TEST(Report, TheTitleIsTheUsersOrAHeadingOfTheRuns) {
  TempFolder temp;
  write_made_run(temp.path());
  RunRecord record = read_run(temp.path());
  record.scenario.name = "power_plant";
  EXPECT_EQ(data_of(report_of({record}))["title"], "Power plant, Proposed");
  const Report titled = make_report({record}, {.title = "my_run"}, [](double) {});
  EXPECT_EQ(data_of(titled)["title"], "my_run");
}

TEST(Report, NamesUtilitiesAsPeopleDoWithoutThePaperToo) {
  TempFolder temp;
  write_made_run(temp.path());
  RunRecord record = covered_record(1, {0.2});
  record.folder = temp.path();
  for (const char* const utility : {"proposed", "aep"}) {
    record.figures->utility = record.scenario.planner.utility.name = utility;
    const Json rows = data_of(report_of({record}))["tables"][0]["rows"];
    EXPECT_EQ(rows[0][0], human_name(utility));
  }
}

TEST(Report, ATableNamesCoverageInFullAndExplainsNoColumnThatIsNotThere) {
  TempFolder temp;
  write_made_run(temp.path());
  RunRecord record = covered_record(1, {0.2});
  record.folder = temp.path();
  record.figures->ceiling.reset();
  const Json table = data_of(report_of({record}))["tables"][0];
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
TEST(Report, RunsOfTwoConfigurationsAreTwoRows) {
  TempFolder temp;
  write_made_run(temp.path());
  RunRecord a = covered_record(1, {0.2});
  a.folder = temp.path();
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

/// Of four runs, all scored: a ceiling that is known at 0.05 m alone is drawn there alone.
TEST(Report, DrawsCeilingsWhereTheyAreKnown) {
  TempFolder temp;
  write_made_run(temp.path());
  RunRecord record = covered_record(1, {0.2, 0.3, 0.4, 0.5});
  record.folder = temp.path();
  record.scenario.structure.file.path = "moved.obj";  // no ceiling of this machine's own
  record.figures->ceiling = 0.9;
  const auto ceilings_of = [&](const std::vector<RunRecord>& records) {
    const Report report = report_of(records);
    const std::vector<std::uint8_t> bytes = bytes_of(report);
    std::vector<Numbers> ceilings;  // of each choice of the plot of coverage
    const Json data = data_of(report);
    for (const Json& choice : data["plots"][0]["choices"]) {
      ceilings.emplace_back();
      for (const Json& series : choice["series"]) {
        if (series["run"] >= 0) continue;
        ceilings.back().push_back(test::numbers(series["by"][0]["y"], bytes)[0]);
      }
    }
    return ceilings;
  };
  EXPECT_EQ(ceilings_of({record}), (std::vector<Numbers>{{90}}));  // all sizes in one
  EXPECT_EQ(ceilings_of({record, record}), (std::vector<Numbers>{{90}, {}, {}}));
}

/// A line a run, and of runs that differ in their seeds alone their mean within their range.
TEST(Report, PlotsHaveTheRunsAndTheMeanOfTheirSeeds) {
  TempFolder temp;
  write_made_run(temp.path());
  RunRecord one = covered_record(1, {0.2, 0.3, 0.4, 0.5});
  RunRecord two = covered_record(2, {0.2, 0.5, 0.6, 0.7});
  one.folder = two.folder = temp.path();
  const Report report = report_of({one, two});
  const std::vector<std::uint8_t> bytes = bytes_of(report);
  const Json choice = data_of(report)["plots"][0]["choices"][0];
  const auto numbers = [&](const Json& series, const char* name) {
    Numbers values = test::numbers(series["by"][0][name], bytes);
    for (double& value : values) value = std::round(1e9 * value) / 1e9;
    return values;
  };
  ASSERT_EQ(choice["series"].size(), 2U);
  EXPECT_EQ(numbers(choice["series"][1], "x"), (Numbers{0, 1, 2, 3}));
  EXPECT_EQ(numbers(choice["series"][1], "y"), (Numbers{20, 50, 60, 70}));
  EXPECT_EQ(choice["series"][0]["is_step"], true);  // surface counts from the view that saw it
  ASSERT_EQ(choice["means"].size(), 1U);
  EXPECT_EQ(numbers(choice["means"][0], "y"), (Numbers{20, 40, 50, 60}));
  EXPECT_EQ(numbers(choice["means"][0], "low"), (Numbers{20, 30, 40, 50}));
  EXPECT_EQ(numbers(choice["means"][0], "high"), (Numbers{20, 50, 60, 70}));
  two.scenario.planner.preset = "released";
  EXPECT_EQ(data_of(report_of({one, two}))["plots"][0]["choices"][0]["means"].size(), 0U);
}

/// As `gnbv surface` wrote it, where it is whole and there is room; else a command that makes one.
TEST(Report, CarriesTheSurfaceOfTheRunWhereItHasRoom) {
  TempFolder temp;
  write_made_run(temp.path());
  const RunRecord record = read_run(temp.path());
  EXPECT_TRUE(data_of(report_of({record}))["runs"][0]["surface"].is_null());
  fs::create_directory(temp.path() / "surface");
  const auto run_with = [&](std::size_t size, const std::string& says) {
    std::string glb(size, ' ');
    for (std::size_t i = 0; i < says.size(); ++i) glb[i] = says[i];
    write_file_atomically(temp.path() / "surface" / "surface.glb", glb);
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

TEST(Report, ColumnsWithoutAValueAreLeftOut) {
  const TextTable table{.title = "t",
                        .columns = {{"A", "a"}, {"B", "b", ColumnKind::number}, {"C", "c"}},
                        .rows = {{{"x"}, {"-"}, {"-"}}, {{"y"}, {"-"}, {"1"}}},
                        .notes = {}};
  const Json json = page_table(table);
  EXPECT_EQ(json["columns"].dump(),
            R"([{"head":"A","is_number":false},{"head":"C","is_number":false}])");
  EXPECT_EQ(json["rows"].dump(), R"([["x","-"],["y","1"]])");
}

TEST(PageText, NoTextIsMarkup) {
  EXPECT_EQ(html_escaped("<a href='x'>\"&\"</a>"),
            "&lt;a href=&#39;x&#39;&gt;&quot;&amp;&quot;&lt;/a&gt;");
  const std::string hostile = "</script><!--<script>&";
  const std::string json = script_json(Json(hostile).dump());
  EXPECT_EQ(json.find_first_of("<>&"), std::string::npos) << json;
  EXPECT_EQ(Json::parse(json).get<std::string>(), hostile);
  EXPECT_EQ(filled("a{{X}}b{{Y}}c", {{"X", "{{Y}}"}, {"Y", "2"}}), "a{{Y}}b2c");
  EXPECT_THROW(filled("{{X}}", {}), BrokenInvariant);
  EXPECT_THROW(filled("", {{"X", ""}}), BrokenInvariant);
  // of the empty text, as every browser computes it
  EXPECT_EQ(policy_hash(""), "'sha256-47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU='");
}

}  // namespace
}  // namespace gnbv
