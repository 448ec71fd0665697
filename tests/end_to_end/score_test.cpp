// Scores of run directories and clouds, by the program.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tests/end_to_end/scored_mission.hpp"
#include "tools/run/cloud_file.hpp"
#include "tools/run/summary_json.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

using test::Score;

constexpr std::array kScored = {"precision_recall", "accuracy_m",     "completeness_m",
                                "chamfer_m",        "density",        "mean_coverage_over_own",
                                "ceiling_at_0.05",  "effort_to_reach"};

TEST_F(Score, UpdatesARunToTheVeryBytesThatItWroteItself) {
  const std::string summary = read_file(original() / "summary.json");
  const std::string coverage = read_file(original() / "coverage.csv");
  const fs::path run = copy();
  // of schema 1, and with figures that are wrong
  Json old = summary_of(run);
  old["schema"] = 1;
  old["coverage"]["final"]["0.05"] = 0.123;
  for (const char* key : kScored) old.erase(key);
  write_file_atomically(run / "summary.json", old.dump(2) + "\n");
  fs::remove(run / "coverage.csv");
  try {
    read_run_figures(run);
    FAIL();
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find("schema 1 of another version"), std::string::npos)
        << error.what();
  }

  const Outcome only_looked = gnbv("score " + run.string());
  ASSERT_EQ(only_looked.exit_code, 0) << only_looked.output;
  EXPECT_FALSE(fs::exists(run / "coverage.csv"));
  for (const std::string threads : {"1", "2"}) {
    const Outcome updated = gnbv("score " + run.string() + " --update --threads " + threads);
    ASSERT_EQ(updated.exit_code, 0) << updated.output;
    EXPECT_EQ(read_file(run / "summary.json"), summary);
    EXPECT_EQ(read_file(run / "coverage.csv"), coverage);
    // the second time of this schema with every figure wrong, by the cache
    Json wrong = summary_of(run);
    wrong["coverage"] = 1;
    for (const char* key : kScored) wrong[key] = 1;
    write_file_atomically(run / "summary.json", wrong.dump(2) + "\n");
    write_file_atomically(run / "coverage.csv", "");
  }
}

TEST_F(Score, TheCeilingGivesARunItsEfforts) {
  const fs::path run = copy();
  EXPECT_TRUE(summary_of(run).at("effort_to_reach").is_null());
  const fs::path cache = temp_.path() / "cache";
  const auto score = [&](const std::string& options) {
    const Outcome outcome = gnbv("score " + run.string() + " --update" + options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return summary_of(run);
  };
  const std::string shared = std::getenv("GNBV_CACHE");
  setenv("GNBV_CACHE", cache.c_str(), 1);
  const Json without = score("");
  EXPECT_TRUE(without.at("ceiling_at_0.05").is_null());
  const Json found = score(" --ceiling");
  const Json again = score("");  // by the cache
  setenv("GNBV_CACHE", shared.c_str(), 1);
  EXPECT_EQ(again, found);
  EXPECT_GT(found.at("ceiling_at_0.05"), 0.5);
  const RunFigures figures = read_run_figures(run);
  const Json& at_80 = found.at("effort_to_reach").at("0.80");
  ASSERT_FALSE(at_80.is_null());
  const auto view = at_80.at("views").get<std::size_t>();
  EXPECT_GE(figures.curve.coverage[view][0], 0.8 * *figures.ceiling);
  EXPECT_EQ(at_80.at("metres"), figures.curve.metres[view]);
  EXPECT_TRUE(score("").at("effort_to_reach").is_null());  // nobody knows it any more
}

TEST_F(Score, OfARunReadsBackAsItsFigures) {
  const RunFigures figures = read_run_figures(original());
  const Json summary = summary_of(original());
  EXPECT_EQ(figures.scenario, "smoke");
  EXPECT_EQ(figures.structure, "smoke");
  EXPECT_EQ(figures.result_sha256, summary.at("result_sha256"));
  EXPECT_EQ(figures.iterations, summary.at("iterations"));
  EXPECT_EQ(figures.coverage_final[1], summary.at("coverage").at("final").at("0.10"));
  EXPECT_EQ(figures.coverage_profile_raw[2],
            summary.at("coverage").at("profile_raw_reference").at("0.50"));
  EXPECT_EQ(figures.distances.at[2].recall, summary.at("precision_recall").at(2).at("recall"));
  EXPECT_EQ(figures.density.variation, summary.at("density").at("variation"));
  // the curve goes from the profile to the end, and never falls
  ASSERT_EQ(figures.curve.views(), static_cast<std::size_t>(figures.iterations));
  EXPECT_EQ(figures.curve.coverage.front(), figures.coverage_profile);
  EXPECT_EQ(figures.curve.coverage.back(), figures.coverage_final);
  EXPECT_EQ(figures.curve.metres.back(), figures.straight_m);
  for (std::size_t view = 1; view <= figures.curve.views(); ++view) {
    for (std::size_t size = 0; size < 3; ++size) {
      EXPECT_GE(figures.curve.coverage[view][size], figures.curve.coverage[view - 1][size]);
    }
    EXPECT_GT(figures.curve.seconds[view], figures.curve.seconds[view - 1]);
  }
  EXPECT_EQ(area_under_coverage(figures.curve, Effort::metres, 0, figures.straight_m),
            summary.at("mean_coverage_over_own").at("metres"));
}

TEST_F(Score, FiguresOfADamagedRunAreRefusedByFileAndKey) {
  const fs::path run = copy();
  const std::string summary = read_file(run / "summary.json");
  const std::string coverage = read_file(run / "coverage.csv");
  const auto complaint = [&] {
    try {
      read_run_figures(run);
    } catch (const BadInput& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint(), "");
  const auto expect_refused = [&](const std::string& words) {
    EXPECT_NE(complaint().find(words), std::string::npos) << complaint();
    write_file_atomically(run / "summary.json", summary);
    write_file_atomically(run / "coverage.csv", coverage);
  };
  Json json = Json::parse(summary);
  json["distance_m"]["flown"] = "far";
  write_file_atomically(run / "summary.json", json.dump());
  expect_refused("summary.json: /distance_m/flown: \"far\" is no number");
  json.erase("seed");
  write_file_atomically(run / "summary.json", json.dump());
  expect_refused("summary.json: /seed: is missing");
  write_file_atomically(run / "summary.json", "{");
  expect_refused("summary.json: is no JSON");
  write_file_atomically(run / "coverage.csv", coverage.substr(0, coverage.rfind("\n12,") + 1));
  expect_refused("coverage.csv: 12 rows for the profile and 12 views");
  write_file_atomically(run / "coverage.csv", coverage + "13,1,2,nan,4,5\n");
  expect_refused("coverage.csv:15: '13,1,2,nan,4,5'");
  write_file_atomically(run / "coverage.csv", "view\n");
  expect_refused("coverage.csv:1: is not the header");
  fs::remove(run / "summary.json");
  expect_refused("holds no summary.json");
}

TEST_F(Score, OfTheRunsCloudIsTheRuns) {
  const Outcome outcome =
      gnbv("score " + (original() / "cloud.ply").string() + " --scenario smoke --json 2>/dev/null");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const Json cloud = Json::parse(outcome.output);
  const Json run = summary_of(original());
  EXPECT_EQ(cloud.at("coverage").at("final"), run.at("coverage").at("final"));
  for (const char* key : {"mean_coverage_over_own", "ceiling_at_0.05", "effort_to_reach"}) {
    EXPECT_FALSE(cloud.contains(key));
  }
  for (const char* key : {"precision_recall", "chamfer_m", "density"}) {
    EXPECT_EQ(cloud.at(key), run.at(key)) << key;
  }
}

TEST_F(Score, TellsTwoDensitiesApartInLinesThatFitTheTerminal) {
  const Outcome outcome = gnbv("score " + original().string() + " 2>/dev/null", "COLUMNS=80 ");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_TRUE(has(outcome, "2,492 points against smoke")) << outcome.output;
  EXPECT_TRUE(has(outcome, "Points in a voxel of 0.2 m that holds any: ")) << outcome.output;
  EXPECT_FALSE(has(outcome, "Density")) << outcome.output;
  std::istringstream lines(outcome.output);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_TRUE(line.size() <= 80U || line.starts_with(original().string())) << line;
  }
}

TEST_F(Score, OfAMeshFileIsThatOfTheStructureItHolds) {
  const fs::path mesh = temp_.path() / "mesh.ply";
  ASSERT_EQ(gnbv("asset smoke -o " + mesh.string()).exit_code, 0);
  const std::string score = "score " + (original() / "cloud.ply").string() + " --json 2>/dev/null";
  const Outcome by_mesh = gnbv(score + " --mesh " + mesh.string());
  ASSERT_EQ(by_mesh.exit_code, 0) << by_mesh.output;
  const Json a = Json::parse(by_mesh.output);
  const Json b = Json::parse(gnbv(score + " --scenario smoke").output);
  EXPECT_EQ(a.at("coverage"), b.at("coverage"));
  EXPECT_EQ(a.at("chamfer_m"), b.at("chamfer_m"));
  // surface below is not asked for
  const Json high = Json::parse(gnbv(score + " --scenario smoke --floor-z 1").output);
  EXPECT_EQ(high.at("floor_z_m"), 1.0);
  EXPECT_NE(high.at("coverage"), b.at("coverage"));
}

TEST_F(Score, OfACloudDoesNotDependOnItsGround) {
  std::vector<Vec3f> points = read_cloud(original() / "cloud.ply");
  for (int i = 0; i < 50; ++i) {
    points.emplace(points.begin() + 7 * i, 0.1F * static_cast<float>(i), 0.0F, -0.01F);
  }
  const std::string file = (temp_.path() / "ground.ply").string();
  write_cloud_ply(points, file);
  const Outcome outcome = gnbv("score " + file + " --scenario smoke --json 2>/dev/null");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const Json with_ground = Json::parse(outcome.output);
  const Json run = summary_of(original());
  EXPECT_EQ(with_ground.at("points_below_floor"), 50);
  EXPECT_EQ(with_ground.at("points"), points.size() - 50);
  EXPECT_EQ(with_ground.at("coverage").at("final"), run.at("coverage").at("final"));
  for (const char* key : {"precision_recall", "chamfer_m", "density"}) {
    EXPECT_EQ(with_ground.at(key), run.at(key)) << key;
  }
  const Outcome told = gnbv("score " + file + " --scenario smoke");
  EXPECT_TRUE(has(told, "50 points below z = 0.3 m left out")) << told.output;
}

/// Every file of a run that does not fit the others, each alone.
TEST_F(Score, OfARunWhoseFilesDoNotFitNamesTheFile) {
  const fs::path run = copy();
  const auto expect_refused = [&](const char* file, const std::string& content,
                                  const std::string& words, const std::string& option = "") {
    const std::string whole = read_file(run / file);
    write_file_atomically(run / file, content);
    const Outcome outcome = gnbv("score " + run.string() + option);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_TRUE(has(outcome, (run / file).string() + ": " + words)) << outcome.output;
    write_file_atomically(run / file, whole);
  };
  const std::string rows = read_file(run / "iterations.csv");
  const std::size_t last = rows.rfind('\n', rows.size() - 2) + 1;
  expect_refused("iterations.csv", rows.substr(0, last), "11 views, 12 in summary.json");
  Json summary = summary_of(run);
  summary["iterations"] = "12";
  expect_refused("summary.json", summary.dump(), "/iterations: \"12\" is no count");
  for (const Json& schema : {Json(kSummarySchema + 1), Json(-1), Json("2"), Json(1.5)}) {
    summary = summary_of(run);
    summary["schema"] = schema;
    expect_refused("summary.json", summary.dump(), "/schema: " + schema.dump(), " --update");
  }
  summary = summary_of(run);
  summary.erase("coverage");
  expect_refused("summary.json", summary.dump(), "is not the summary of a run", " --update");

  std::vector<Vec3f> points = read_cloud(run / "cloud.ply");
  points[5].z() = std::numeric_limits<float>::infinity();
  write_cloud_ply(points, temp_.path() / "infinite.ply");
  expect_refused("cloud.ply", read_file(temp_.path() / "infinite.ply"), "point 5 ");
  points[5].z() = 60000.0F;
  write_cloud_ply(points, temp_.path() / "far.ply");
  expect_refused("cloud.ply", read_file(temp_.path() / "far.ply"), "point 5 ");
  EXPECT_EQ(gnbv("score " + run.string() + " --update").exit_code, 0);
}

/// Arguments after which `score` exits with 2 and one line that holds the words.
struct Refused {
  std::string arguments;
  std::vector<std::string> words;
};

// one test, since every test of its own flies a mission
TEST_F(Score, RefusesWhatItCannotScoreInOneLine) {
  const fs::path here = temp_.path();
  std::vector<Vec3f> points = read_cloud(original() / "cloud.ply");
  write_cloud_ply({}, here / "empty.ply");
  const auto write_moved = [&](const char* name, float scale, const Vec3f& offset_m) {
    std::vector<Vec3f> moved;
    for (const Vec3f& p : points) moved.emplace_back(scale * p + offset_m);
    write_cloud_ply(moved, here / name);
  };
  write_moved("mm.ply", 1000.0F, Vec3f::Zero());
  write_moved("moved.ply", 1.0F, Vec3f(20, 0, 0));
  points[5].y() = std::numeric_limits<float>::quiet_NaN();
  write_cloud_ply(points, here / "nan.ply");
  std::ofstream(here / "prose.ply") << "Lorem ipsum\n";
  fs::create_directory(here / "nothing");
  fs::copy_file(here / "moved.ply", copy() / "profile.ply", fs::copy_options::overwrite_existing);

  const std::vector<Refused> all = {
      {"@/empty.ply --scenario smoke", {"empty.ply", "no points"}},
      {"@/nan.ply --scenario smoke", {"nan.ply", "point 5 ", "not finite"}},
      {"@/mm.ply --scenario smoke",
       {"mm.ply", "looks like millimetres", "scale the cloud by 0.001"}},
      {"@/moved.ply --scenario smoke",
       {"moved.ply", "no point within 1 m of the mesh", "the cloud spans"}},
      {"@/prose.ply --scenario smoke", {"prose.ply", "no PLY"}},
      {"@/mm.ply", {"--mesh", "--scenario"}},
      {"@/absent.ply --scenario smoke", {"absent.ply"}},
      {"@/nothing", {"nothing", "no summary.json"}},
      {"@/mm.ply --scenario smoke --update", {"--update", "mm.ply"}},
      {"@/run --scenario smoke", {"scenario.yaml"}},
      {"@/run", {"profile.ply", "cloud.ply"}},
  };
  for (const Refused& refused : all) {
    std::string arguments = refused.arguments;
    arguments.replace(0, 1, here.string());
    const Outcome outcome = gnbv("score " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments << "\n" << outcome.output;
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
    for (const std::string& word : refused.words) {
      EXPECT_TRUE(has(outcome, word)) << "no '" << word << "' in: " << outcome.output;
    }
  }
}

}  // namespace
}  // namespace gnbv
