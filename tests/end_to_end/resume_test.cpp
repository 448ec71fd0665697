// A run goes on only from a record that is its own, in the world that it began in.
#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tests/support/flown_into.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/mission/execute.hpp"
#include "tools/run/iterations_csv.hpp"
#include "tools/run/run_claim.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

class Resumed : public testing::Test {
 protected:
  /// A run that was killed after its fifth view, its record changed by hand and written as an
  /// earlier version did, without checks.
  void kill_and_change(const std::function<void(std::vector<ViewRecord>&)>& change) {
    fs::remove_all(run_);
    fly_into(run_, smoke(), false, 5);
    std::vector<ViewRecord> views = read_view_records(journal_);
    change(views);
    std::ofstream(journal_) << iterations_csv(views);
  }

  /// What a resumed mission is refused for; empty: it is not.
  std::string complaint(const Scenario& scenario = smoke()) const {
    try {
      execute_mission(scenario, {.out = run_, .resume = true, .quiet = true});
      return "";
    } catch (const BadInput& error) {
      return error.what();
    }
  }

  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::directory_iterator(run_)) {
      all[entry.path().filename()] = read_file(entry.path());
    }
    return all;
  }

  TempFolder temp_;
  const fs::path run_ = temp_.path() / "run";
  const fs::path journal_ = run_ / "iterations.csv.part";
};

#define EXPECT_SAYS(words, text) \
  EXPECT_NE(std::string(words).find(text), std::string::npos) << words

TEST_F(Resumed, TakesARecordWithoutChecks) {
  kill_and_change([](auto&) {});
  EXPECT_EQ(complaint(), "");
}

TEST_F(Resumed, EndsAtTheFirstViewThatComesOutDifferentlyAndNamesIt) {
  kill_and_change([](auto& views) { views[3].entropy_nat += 1e-9; });
  const std::string before = read_file(journal_);
  EXPECT_SAYS(complaint(), "view 3: entropy_nat is ");
  EXPECT_EQ(read_file(journal_), before) << "the record stays";
  EXPECT_FALSE(fs::exists(run_ / "summary.json"));
}

TEST_F(Resumed, NamesEveryQuantityOfARow) {
  kill_and_change([](auto& views) { views[4].cloud_points += 1; });
  EXPECT_SAYS(complaint(), "view 4: cloud_points is ");
  kill_and_change([](auto& views) { views[2].flown_m += 0.5; });
  EXPECT_SAYS(complaint(), "view 2: flown_m is ");
}

TEST_F(Resumed, RefusesAPoseOutsideTheWorkspace) {
  kill_and_change([](auto& views) { views[3].decision.view.p_world_m.x() = 1e10; });
  EXPECT_SAYS(complaint(), "iterations.csv.part:5: view 3 leads to 1e+10");
}

TEST_F(Resumed, RefusesARecordThatIsLongerThanItsFlight) {
  const std::string set = "planner.termination.max_iterations=3";
  fly_into(run_, smoke({set}), false);
  std::vector<ViewRecord> views = read_view_records(journal_);
  views.push_back(views.back());
  views.back().iteration = 3;
  std::ofstream(journal_) << iterations_csv(views);
  EXPECT_SAYS(complaint(smoke({set})), "ends after 3 views (max_iterations), recorded were 4");
}

TEST_F(Resumed, NoticesEveryEditOfAJournal) {
  fly_into(run_, smoke(), false, 5);
  const std::string whole = read_file(journal_);
  const auto line_begin = [&](int line) {
    std::size_t at = 0;
    for (int i = 1; i < line; ++i) at = whole.find('\n', at) + 1;
    return at;
  };
  // a sampler, which no flight depends on; then a row that is gone
  std::string edited = whole;
  const std::size_t sampler = edited.find(",agvs,", line_begin(4));
  ASSERT_NE(sampler, std::string::npos);
  edited.replace(sampler, 6, ",fvs,");
  std::ofstream(journal_) << edited;
  EXPECT_SAYS(complaint(), "iterations.csv.part:");
  EXPECT_SAYS(complaint(), "is not the row that was written");
  std::string shorter = whole;
  shorter.erase(line_begin(3), line_begin(4) - line_begin(3));
  std::ofstream(journal_) << shorter;
  EXPECT_SAYS(complaint(), "iterations.csv.part:3");
  std::ofstream(journal_) << whole;
  EXPECT_EQ(complaint(), "");
}

/// A mission on a mesh file, whole but for its summary, as one that was killed while finishing.
class ResumedMesh : public Resumed {
 protected:
  void SetUp() override {
    ASSERT_EQ(gnbv("asset smoke -o " + mesh_.string()).exit_code, 0);
    ASSERT_EQ(gnbv("run " + words_).exit_code, 0);
  }
  /// Moves a vertex.
  void exchange_mesh() const {
    std::string text = read_file(mesh_);
    const std::size_t vertex = text.find("\nv ") + 1;
    text.replace(vertex, text.find('\n', vertex) - vertex, "v 0.1 0.2 0.9");
    std::ofstream(mesh_) << text;
  }
  const fs::path mesh_ = temp_.path() / "mesh.obj";
  const std::string words_ = "smoke --quiet --mesh " + mesh_.string() + " --out " + run_.string();
};

TEST_F(ResumedMesh, RefusesAnExchangedMesh) {
  fs::remove(run_ / "summary.json");
  exchange_mesh();
  const Outcome resumed = gnbv("run --resume " + words_);
  EXPECT_EQ(resumed.exit_code, 2) << resumed.output;
  EXPECT_SAYS(resumed.output, "structure: " + mesh_.string() + " is not what the run began with");
}

TEST_F(ResumedMesh, IsNotScoredByAnExchangedMesh) {
  ASSERT_EQ(gnbv("score " + run_.string()).exit_code, 0);
  exchange_mesh();
  const Outcome scored = gnbv("score --update " + run_.string());
  EXPECT_EQ(scored.exit_code, 2) << scored.output;
  EXPECT_SAYS(scored.output, "is not what the run began with");
}

/// Refused by what shows or measures the mesh; said, and no more, by what does without it.
TEST_F(ResumedMesh, EveryCommandSaysThatTheMeshWasExchanged) {
  exchange_mesh();
  const std::string out = " -o " + (temp_.path() / "out").string();
  const std::string says = "structure: " + mesh_.string() + " is not what the run began with";
  const std::vector<std::pair<std::string, int>> commands = {
      {"run smoke --resume --quiet --mesh " + mesh_.string() + " --out RUN", 2},
      {"render RUN" + out + ".png", 2},
      {"render RUN --what candidates --iteration 2" + out + "2.png", 2},
      {"ceiling RUN", 2},
      {"report RUN" + out + ".html", 0},
      {"surface RUN" + out, 0},
      {"export RUN --format tum" + out + "-tum", 0}};
  for (auto [command, exit_code] : commands) {
    const Outcome told = gnbv(command.replace(command.find("RUN"), 3, run_.string()));
    EXPECT_EQ(told.exit_code, exit_code) << command << ": " << told.output;
    EXPECT_SAYS(told.output, says);
  }
  // asked for by name it is another question
  const Outcome asked = gnbv("ceiling " + run_.string() + " --mesh " + mesh_.string());
  EXPECT_EQ(asked.exit_code, 0) << asked.output;
}

TEST_F(Resumed, RefusesAnExchangedProfile) {
  const fs::path first = temp_.path() / "first";
  const fs::path second = temp_.path() / "second";
  for (const fs::path& run : {first, second}) {
    execute_mission(
        smoke({"planner.termination.max_iterations=1", run == first ? "seed=1" : "seed=2"}),
        {.out = run, .quiet = true});
  }
  const Scenario saved = smoke({"planner.profiling.method=saved",
                                "planner.profiling.file=" + (first / "profile.map").string()});
  execute_mission(saved, {.out = run_, .quiet = true});
  fs::remove(run_ / "summary.json");
  EXPECT_EQ(complaint(saved), "");
  fs::remove(run_ / "summary.json");
  fs::copy_file(second / "profile.map", first / "profile.map",
                fs::copy_options::overwrite_existing);
  EXPECT_SAYS(complaint(saved), "planner.profiling.file: ");
  EXPECT_SAYS(gnbv("render " + run_.string() + " --what candidates").output,
              "planner.profiling.file: ");
}

TEST_F(Resumed, LeavesAFinishedRunAsItIs) {
  const std::string words = "run smoke --quiet --out " + run_.string();
  ASSERT_EQ(gnbv(words).exit_code, 0);
  const auto before = files();
  const fs::file_time_type written = fs::last_write_time(run_ / "summary.json");
  const Outcome again = gnbv(words + " --resume");
  EXPECT_EQ(again.exit_code, 0) << again.output;
  EXPECT_SAYS(again.output, "is finished already (max_iterations): nothing to resume");
  EXPECT_EQ(files(), before);
  EXPECT_EQ(fs::last_write_time(run_ / "summary.json"), written);
  fs::remove(run_ / "cloud.ply");  // what is missing is made again
  EXPECT_EQ(gnbv(words + " --resume").exit_code, 0);
  EXPECT_EQ(read_file(run_ / "cloud.ply"), before.at("cloud.ply"));
}

TEST_F(Resumed, NoticesAnEditedRowOfAFinishedRun) {
  execute_mission(smoke(), {.out = run_, .quiet = true});
  std::string csv = read_file(run_ / "iterations.csv");
  const std::size_t sampler = csv.find(",agvs,");
  ASSERT_NE(sampler, std::string::npos);
  std::ofstream(run_ / "iterations.csv") << csv.replace(sampler, 6, ",fvs,");
  for (const std::string& command :
       {std::string("score "), "report -o " + (temp_.path() / "r.html").string() + " ",
        "plot -o " + temp_.path().string() + " ",
        std::string("run smoke --resume --quiet --out ")}) {
    const Outcome refused = gnbv(command + run_.string());
    EXPECT_EQ(refused.exit_code, 2) << command << refused.output;
    EXPECT_SAYS(refused.output, "iterations.csv: holds other rows");
  }
}

TEST_F(Resumed, HasNoOldSummaryBesideNewFiles) {
  execute_mission(smoke(), {.out = run_, .quiet = true});
  // finishing fails at its last file but one
  fs::remove(run_ / "coverage.csv");
  fs::create_directories(run_ / "coverage.csv" / "in the way");
  EXPECT_NE(complaint(), "");
  EXPECT_FALSE(fs::exists(run_ / "summary.json"));
}

TEST_F(Resumed, BeginsWhereARunWasKilledBeforeItsFirstFile) {
  fs::create_directories(run_ / "frames");
  const auto part = [&](const std::string& name) { return run_ / name; };
  for (const char* name : {".scenario.part-elsewhere-999999999.yaml", ".gnbv-lock",
                           "frames/.0001_rgbd.rgb.part-elsewhere-999999999.png"}) {
    std::ofstream(part(name)) << "half";
  }
  fs::remove_all(run_ / "frames");
  EXPECT_EQ(complaint(), "");
  EXPECT_FALSE(fs::exists(part(".scenario.part-elsewhere-999999999.yaml")));
  EXPECT_FALSE(fs::exists(part(".gnbv-lock")));
}

TEST_F(Resumed, RemovesWhatKilledWritersLeft) {
  fly_into(run_, smoke(), false, 2);
  fs::create_directories(run_ / "frames");
  const fs::path image = run_ / "frames/.0001_rgbd.rgb.part-elsewhere-999999999.png";
  const fs::path cloud = run_ / ".cloud.part-elsewhere-999999999.ply";
  for (const fs::path& file : {image, cloud}) std::ofstream(file) << "half";
  EXPECT_EQ(complaint(), "");
  EXPECT_FALSE(fs::exists(image));
  EXPECT_FALSE(fs::exists(cloud));
}

TEST_F(Resumed, OneFolderIsFlownIntoByOne) {
  const RunClaim claim(run_);
  EXPECT_SAYS(complaint(), "run: another gnbv flies into it now");
  const Outcome other = gnbv("run smoke --quiet --out " + run_.string());
  EXPECT_EQ(other.exit_code, 2) << other.output;
}

TEST(RunClaim, RemovesWhatItMadeAndNothingElse) {
  const TempFolder temp;
  { const RunClaim claim(temp.path() / "a/b/c"); }
  EXPECT_TRUE(fs::is_empty(temp.path()));
  {
    const RunClaim claim(temp.path() / "a/b");
    std::ofstream(claim.folder() / "file") << "x";
    EXPECT_FALSE(holds_only_leftovers(claim.folder()));
  }
  EXPECT_TRUE(fs::exists(temp.path() / "a/b/file"));
  EXPECT_FALSE(fs::exists(temp.path() / "a/b/.gnbv-lock"));
}

}  // namespace
}  // namespace gnbv
