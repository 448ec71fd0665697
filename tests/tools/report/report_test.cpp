// Laws of the report: it shows what the run directory holds, does without what is missing or
// damaged, and no name is ever more than text.
#include "tools/report/report.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "sim/core/file.hpp"
#include "tests/support/covered_record.hpp"
#include "tests/support/made_frames.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/report/run_json.hpp"
#include "tools/report/run_pack.hpp"
#include "tools/run/plan_jsonl.hpp"
#include "tools/run/words.hpp"
#include "tools/scene/colour.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

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

TEST(Report, HoldsTheViewsAndWhatGrewWithThem) {
  TempFolder temp;
  write_made_run(temp.path());
  const nlohmann::json data = data_of(report_of({read_run(temp.path())}));
  const nlohmann::json& run = data["runs"][0];
  EXPECT_EQ(run["views"]["x"], nlohmann::json({4.0, -4.0, -4.0}));
  EXPECT_EQ(run["views"]["seconds"][0], 0.0);  // as its metres
  EXPECT_EQ(run["views"]["yaw"], nlohmann::json({3.0, 1.5, 0.8}));
  EXPECT_EQ(run["cloud"]["points"]["steps"][1], 18);  // six points
  EXPECT_EQ(run["cloud"]["after"][1], 4);             // the profile and three views
  EXPECT_EQ(run["voxels"]["index"][1], 18);           // no two in one voxel
  EXPECT_EQ(run["voxels"]["gain_step"][1], 6);
  EXPECT_EQ(run["voxels"]["gain_points"][1], 6);
  EXPECT_EQ(run["voxels"]["gains_after"][1], 4);
  EXPECT_EQ(run["path"]["time"][1], 5);
  EXPECT_EQ(run["figures"], nullptr);
  EXPECT_EQ(run["command"],
            fmt::format("gnbv run {}/scenario.yaml --out NEW", temp.path().string()));
}

/// The true surface once for each structure, and of each run when it found what of it.
TEST(Report, HoldsWhatOfTheTrueSurfaceEachRunFound) {
  TempFolder temp;
  write_made_run(temp.path());
  const RunRecord record = read_run(temp.path());
  const nlohmann::json data = data_of(report_of({record, record}));
  ASSERT_EQ(data["meshes"].size(), 1U);
  const std::size_t numbers = data["meshes"][0]["surface"]["index"][1];
  EXPECT_GT(numbers, 0U);
  for (const nlohmann::json& run : data["runs"]) {
    EXPECT_EQ(3 * run["found"][1].get<std::size_t>(), numbers);
    EXPECT_EQ(run["cloud"]["error"][1], 6);
    EXPECT_EQ(run["candidates"], nullptr);
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
  const PackedRun run = pack_run(record, nullptr, {.bytes = 100'000, .points = 100}, 1, {});
  ASSERT_TRUE(run.plan.has_value());
  std::vector<std::uint32_t> ranges(run.plan->ranges.count);
  std::memcpy(ranges.data(), run.bytes.bytes().data() + run.plan->ranges.at, 4 * ranges.size());
  EXPECT_EQ(ranges, (std::vector<std::uint32_t>{0, 2, 1, 2, 2, 2}));
  std::vector<float> poses(run.plan->poses.count);
  std::memcpy(poses.data(), run.bytes.bytes().data() + run.plan->poses.at, 4 * poses.size());
  ASSERT_EQ(poses.size(), 14U);
  EXPECT_EQ(Vec3f(poses[7], poses[8], poses[9]), Vec3f(1, 2, 3));
  const Eigen::Quaternionf q(poses[13], poses[10], poses[11], poses[12]);
  const CameraModel camera = make_camera_model(record.scenario.cameras.at(0));
  const Isometry T = T_world_body(first.plan.views[1]) * camera.T_body_camera;
  EXPECT_TRUE(q.toRotationMatrix().isApprox(T.linear().cast<float>(), 1e-5F));
  EXPECT_EQ(data_of(report_of({record}))["runs"][0]["plan"]["ranges"][1], 6);
}

TEST(Report, HoldsTheCamerasAsTheyAreMounted) {
  TempFolder temp;
  write_made_run(temp.path());
  const RunRecord record = read_run(temp.path());
  const nlohmann::json cameras = data_of(report_of({record}))["runs"][0]["cameras"];
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
    const nlohmann::json data = data_of(report);
    ASSERT_EQ(data["runs"].size(), runs);
    for (const nlohmann::json& run : data["runs"]) {
      // a lattice a bit coarser keeps a part: half a million points for one, or 100,000 for each
      const double drawn = run["cloud"]["points"]["steps"][1].get<double>() / 3.0;
      EXPECT_GT(drawn, runs == 1 ? 150'000.0 : 30'000.0);
      EXPECT_LE(drawn, runs == 1 ? 500'000.0 : 100'000.0);
    }
  }
}

TEST(PackedRun, PointsAndVoxelsAreThereAfterTheViewThatBroughtThem) {
  TempFolder temp;
  write_made_run(temp.path());
  const PackedRun run =
      pack_run(read_run(temp.path()), nullptr, {.bytes = 100'000, .points = 100}, 1, {});
  const auto counts = [&](const ByteSlice& slice) {
    std::vector<std::uint32_t> values(slice.count);
    std::memcpy(values.data(), run.bytes.bytes().data() + slice.at, 4 * slice.count);
    return values;
  };
  // two points of the profile; after the views 3, 5 and 6
  ASSERT_TRUE(run.cloud && run.voxels);
  EXPECT_EQ(counts(run.cloud->after), (std::vector<std::uint32_t>{2, 3, 5, 6}));
  EXPECT_EQ(counts(run.voxels->after), (std::vector<std::uint32_t>{2, 3, 5, 6}));
  EXPECT_EQ(counts(run.voxels->gains_after), (std::vector<std::uint32_t>{2, 3, 5, 6}));
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
            "&lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt;, Proposed");
  EXPECT_EQ(data_of(report)["runs"][0]["label"], record.scenario.name + ", Proposed");
}

TEST(Report, TheSameBytesAtAnyNumberOfThreads) {
  TempFolder temp;
  write_made_run(temp.path());
  write_made_frames(temp.path());
  const RunRecord record = read_run(temp.path());
  const Report one = report_of({record, record}, 1);
  const nlohmann::json run = data_of(one)["runs"][0];
  EXPECT_EQ(run["frames"].size(), 3U);
  EXPECT_EQ(run["cloud"]["colour"][1], 18);  // of six points
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
    const nlohmann::json run = data_of(report)["runs"][0];
    EXPECT_EQ(run["frames"].size(), 0U);
    EXPECT_EQ(run["cloud"]["points"]["steps"][1], 18);
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
  const nlohmann::json data = data_of(report);
  EXPECT_EQ(data["meshes"].size(), 0U);
  EXPECT_EQ(data["runs"][0]["mesh"], -1);
  EXPECT_EQ(data["runs"][0]["cloud"]["points"]["steps"][1], 18);
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

TEST(Report, HasTheColoursOfThePictures) {
  TempFolder temp;
  write_made_run(temp.path());
  const nlohmann::json ramps = data_of(report_of({read_run(temp.path())}))["ramps"];
  ASSERT_EQ(ramps["path"].size(), 768U);
  for (int i = 0; i < 256; i += 51) {
    const Rgb path = path_ramp(i / 255.0);
    const Rgb amount = amount_ramp(i / 255.0);
    const Rgb score = ramp(score_colours(), i / 255.0);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t at = 3 * static_cast<std::size_t>(i) + k;
      EXPECT_NEAR(ramps["path"][at].get<double>(), 255.0 * linear_to_srgb(path[k]), 0.501);
      EXPECT_NEAR(ramps["amount"][at].get<double>(), 255.0 * linear_to_srgb(amount[k]), 0.501);
      EXPECT_NEAR(ramps["score"][at].get<double>(), 255.0 * linear_to_srgb(score[k]), 0.501);
    }
  }
}

TEST(Report, NamesUtilitiesAsPeopleDoWithoutThePaperToo) {
  TempFolder temp;
  write_made_run(temp.path());
  RunRecord record = covered_record(1, {0.2});
  record.folder = temp.path();
  for (const char* const utility : {"proposed", "aep"}) {
    record.figures->utility = record.scenario.planner.utility.name = utility;
    const nlohmann::json rows = data_of(report_of({record}))["tables"][0]["rows"];
    EXPECT_EQ(rows[0][0], human_name(utility));
  }
}

TEST(Report, ATableNamesCoverageInFullAndExplainsNoColumnThatIsNotThere) {
  TempFolder temp;
  write_made_run(temp.path());
  RunRecord record = covered_record(1, {0.2});
  record.folder = temp.path();
  record.figures->ceiling.reset();
  const nlohmann::json table = data_of(report_of({record}))["tables"][0];
  std::vector<std::string> coverage;
  for (const nlohmann::json& column : table["columns"]) {
    const std::string head = column["head"];
    EXPECT_NE(head, "Of ceiling");
    if (head.find("0.") != std::string::npos) coverage.push_back(head);
  }
  EXPECT_EQ(coverage,
            (std::vector<std::string>{"Coverage, 0.05 m", "Coverage, 0.10 m", "Coverage, 0.50 m"}));
  EXPECT_EQ(table["notes"].dump().find("of ceiling"), std::string::npos);
}

/// A ceiling that a run was scored with is of 0.05 m: none of the other sizes, least of all 0 %.
TEST(Report, ACeilingIsSaidOfTheSizeWhereItIsKnown) {
  TempFolder temp;
  write_made_run(temp.path());
  RunRecord record = covered_record(1, {0.2});
  record.folder = temp.path();
  record.figures->ceiling = 0.9;
  const nlohmann::json ceiling = data_of(report_of({record}))["runs"][0]["ceiling"];
  EXPECT_EQ(ceiling, nlohmann::json({0.9, nullptr, nullptr}));
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
    const nlohmann::json data = data_of(report_of(records));
    for (const nlohmann::json& row : data["tables"][0]["rows"]) {
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

/// As `gnbv surface` wrote it, or a command that makes a smaller one.
TEST(Report, CarriesTheSurfaceOfTheRunWhereItHasRoom) {
  TempFolder temp;
  write_made_run(temp.path());
  const RunRecord record = read_run(temp.path());
  EXPECT_TRUE(data_of(report_of({record}))["runs"][0]["surface"].is_null());
  fs::create_directory(temp.path() / "surface");
  write_file_atomically(temp.path() / "surface" / "surface.glb", "glTF and more");
  const nlohmann::json with = data_of(report_of({record}));
  EXPECT_EQ(with["runs"][0]["surface"][1], 13);
  write_file_atomically(temp.path() / "surface" / "surface.glb", std::string(9'000'000, 'x'));
  const nlohmann::json without = data_of(report_of({record}));
  EXPECT_TRUE(without["runs"][0]["surface"].is_null());
  EXPECT_NE(without["runs"][0]["missing"].dump().find("makes a smaller one"), std::string::npos);
}

TEST(Report, ColumnsWithoutAValueAreLeftOut) {
  const TextTable table{.title = "t",
                        .columns = {{"A", "a"}, {"B", "b", ColumnKind::number}, {"C", "c"}},
                        .rows = {{{"x"}, {"-"}, {"-"}}, {{"y"}, {"-"}, {"1"}}},
                        .notes = {}};
  const nlohmann::json json = table_json(table);
  EXPECT_EQ(json["columns"].dump(),
            R"([{"head":"A","is_number":false},{"head":"C","is_number":false}])");
  EXPECT_EQ(json["rows"].dump(), R"([["x","-"],["y","1"]])");
}

}  // namespace
}  // namespace gnbv
