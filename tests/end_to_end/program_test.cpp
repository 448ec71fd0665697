// The program as its users meet it: exit codes, messages, and what it leaves behind.
#include "tests/support/program.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include "sim/core/file.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

std::string one_view(const fs::path& out) {
  return "run smoke --set planner.termination.max_iterations=1 --out " + out.string();
}

TEST(Program, HelpsAndSaysItsVersion) {
  for (const std::string arguments :
       {"--help", "run --help", "table --help", "render --help", "asset --help", "lint --help",
        "schema --help", "score --help", "sweep --help", "ceiling --help", "export --help",
        "plot --help", "check --help", "compare --help", "report --help", "surface --help"}) {
    const Outcome help = gnbv(arguments);
    EXPECT_EQ(help.exit_code, 0) << arguments;
    EXPECT_TRUE(has(help, "Usage")) << arguments;
  }
  EXPECT_EQ(gnbv("--version").exit_code, 0);
}

TEST(Program, HelpIsNoWiderThan80ColumnsAndHasExamples) {
  for (const std::string command : {"", "run ", "table ", "render ", "asset ", "lint ", "schema ",
                                    "score ", "sweep ", "ceiling ", "export ", "plot ", "check ",
                                    "compare ", "report ", "surface ", "fly ", "paper "}) {
    const Outcome help = gnbv(command + "--help");
    std::istringstream lines(help.output);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
    EXPECT_TRUE(command.empty() || has(help, "\nExamples:\n  gnbv " + command)) << command;
  }
}

TEST(Program, SuggestsWhatAMistypedWordMayHaveMeant) {
  EXPECT_TRUE(has(gnbv("rendr"), "did you mean `gnbv render`?"));
  EXPECT_FALSE(has(gnbv("rendr"), "subcommand"));
  EXPECT_TRUE(has(gnbv("run smoke --utility propsed"), "--utility propsed: "));
  EXPECT_TRUE(has(gnbv("comp"), "did you mean `gnbv compare`?"));
  EXPECT_TRUE(has(gnbv("run smoke --utilty bircher"), "did you mean --utility?"));
  EXPECT_FALSE(has(gnbv("fly-me-to-the-moon"), "did you mean"));
}

TEST(Program, HelpContinuesAnEntryFartherInThanItBegins) {
  const Outcome help = gnbv("compare --help");
  std::istringstream lines(help.output);
  for (std::string line; std::getline(lines, line);) {
    const bool is_entry = line.starts_with("  --");
    EXPECT_FALSE(is_entry && line.substr(4, line.find(' ', 4) + 3 - 4).ends_with(" --")) << line;
  }
  EXPECT_TRUE(has(help, "\n      --")) << help.output;
  EXPECT_FALSE(has(help, "gnbv: ")) << help.output;  // nothing to complain of
}

TEST(Program, BadUsageExitsWith2) {
  EXPECT_EQ(gnbv("").exit_code, 2);
  EXPECT_EQ(gnbv("fly-me-to-the-moon").exit_code, 2);
  EXPECT_EQ(gnbv("run").exit_code, 2);
  EXPECT_EQ(gnbv("run smoke --threads none").exit_code, 2);
}

/// The options of a command that --help calls numbers.
std::vector<std::string> numbers_of(const std::string& command) {
  std::vector<std::string> options;
  std::istringstream help(gnbv(command + " --help").output);
  for (std::string word, last; help >> word; last = word) {
    if (word.starts_with("FLOAT") && last.starts_with("--")) options.push_back(last);
  }
  return options;
}

TEST(Program, NoNumberOnTheCommandLineMayBeNaNOrInfinite) {
  std::size_t tried = 0;
  for (const std::string command :
       {"fly", "run", "sweep", "table", "compare", "ceiling", "render", "export", "plot", "paper",
        "report", "asset", "lint", "schema", "score", "check", "surface"}) {
    for (const std::string& option : numbers_of(command)) {
      for (const std::string value : {"nan", "inf", "-inf", "1e999"}) {
        const Outcome refused = gnbv(command + " " + option + "=" + value);
        EXPECT_EQ(refused.exit_code, 2) << command << " " << option << "=" << value;
        EXPECT_TRUE(has(refused, option)) << refused.output;
        ++tried;
      }
    }
  }
  EXPECT_GE(tried, 4U * 8U);
}

TEST(Program, AVariableThatIsNotSetIsNoOption) {
  for (const std::string words :
       {"run smoke --mesh ''", "run smoke --seed ''", "run smoke --utility ''",
        "run smoke --preset ''", "run smoke --out ''", "compare smoke --baseline ''", "score ''",
        "asset smoke -o ''", "sweep ''"}) {
    const Outcome refused = gnbv(words);
    EXPECT_EQ(refused.exit_code, 2) << words;
    EXPECT_TRUE(has(refused, ": is empty")) << words << ": " << refused.output;
  }
}

/// An oracle plans for minutes in a large scene; what its plan needs would be in the cache.
TEST(Program, RefusesAFolderBeforeAnOraclePlans) {
  TempFolder temp;
  const fs::path cache = temp.path() / "cache";
  const fs::path other = temp.path() / "other";
  fs::create_directory(other);
  write_file_atomically(other / "thesis.txt", "");
  setenv("GNBV_CACHE", cache.c_str(), 1);
  const Outcome refused =
      gnbv("run smoke --set planner.utility.name=oracle_views --out " + other.string());
  setenv("GNBV_CACHE", "", 1);
  EXPECT_EQ(refused.exit_code, 2) << refused.output;
  EXPECT_TRUE(has(refused, "not empty")) << refused.output;
  EXPECT_FALSE(fs::exists(cache));
}

TEST(Program, RunsRendersAndRepeatsFromItsOwnRunDirectory) {
  TempFolder temp;
  const fs::path a = temp.path() / "a";
  const fs::path b = temp.path() / "b";
  const Outcome first = gnbv("run smoke --seed 3 --out " + a.string());
  ASSERT_EQ(first.exit_code, 0) << first.output;
  EXPECT_TRUE(has(first, a.string()));
  const Outcome second =
      gnbv("run " + (a / "scenario.yaml").string() + " --threads 1 --out " + b.string());
  ASSERT_EQ(second.exit_code, 0) << second.output;
  const auto sha = [](const fs::path& run) {
    return nlohmann::json::parse(read_file(run / "summary.json")).at("result_sha256");
  };
  EXPECT_EQ(sha(a), sha(b));

  const Outcome render = gnbv("render " + a.string());
  ASSERT_EQ(render.exit_code, 0) << render.output;
  EXPECT_TRUE(fs::exists(a / "path.png"));
}

/// Input that must be refused with exit code 2, the given words, and nothing left behind.
struct BadInputCase {
  const char* name;
  std::string arguments;
  std::vector<std::string> words;
};

void PrintTo(const BadInputCase& refused, std::ostream* out) { *out << refused.arguments; }

class RefusedInput : public testing::TestWithParam<BadInputCase> {};

TEST_P(RefusedInput, ExitsWith2NamesTheFaultAndLeavesNothing) {
  TempFolder temp;
  const fs::path here = temp.path();
  std::ofstream(here / "unknown.yaml") << "name: x\nplaner: {}\n";
  std::ofstream(here / "type.yaml") << "name: x\n\nseed: many\n";
  std::ofstream(here / "range.yaml") << "planner:\n  map:\n    resolution_m: -0.2\n";
  std::ofstream(here / "broken.yaml") << "planner: {map: [\n";
  std::ofstream(here / "empty.obj") << "";
  std::ofstream(here / "nan.obj") << "v 0 0 1\nv nan 0 1\nv 0 1 1\nf 1 2 3\n";
  std::ofstream(here / "outside.obj") << "v 0 0 1\nv 900 0 1\nv 0 1 1\nf 1 2 3\n";
  std::ofstream(here / "file") << "";
  std::string arguments = GetParam().arguments;
  for (std::size_t at = arguments.find('@'); at != std::string::npos; at = arguments.find('@')) {
    arguments.replace(at, 1, here.string());
  }
  const Outcome outcome = gnbv(arguments);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  for (const std::string& word : GetParam().words) {
    EXPECT_TRUE(has(outcome, word)) << "no '" << word << "' in: " << outcome.output;
  }
  EXPECT_FALSE(fs::exists(here / "out"));
}

INSTANTIATE_TEST_SUITE_P(
    Program, RefusedInput,
    testing::Values(
        BadInputCase{"UnknownScenario", "run aircaft --out @/out", {"aircaft", "aircraft"}},
        BadInputCase{"UnknownKey",
                     "run @/unknown.yaml --out @/out",
                     {"unknown.yaml:2", "planer", "planner"}},
        BadInputCase{"WrongType", "run @/type.yaml --out @/out", {"type.yaml:3", "seed", "many"}},
        BadInputCase{
            "OutOfRange", "run @/range.yaml --out @/out", {"range.yaml:3", "resolution_m", "-0.2"}},
        BadInputCase{"BrokenYaml", "run @/broken.yaml --out @/out", {"broken.yaml"}},
        BadInputCase{"MissingFile", "run @/absent.yaml --out @/out", {"absent.yaml"}},
        BadInputCase{"UnknownSetKey",
                     "run smoke --set planner.utilty.name=isler --out @/out",
                     {"--set", "utilty", "utility"}},
        BadInputCase{
            "UnknownUtility", "run smoke --utility best --out @/out", {"best", "proposed"}},
        BadInputCase{"MissingMesh", "run smoke --mesh @/absent.obj --out @/out", {"absent.obj"}},
        BadInputCase{"MeshFolder", "run smoke --mesh @ --out @/out", {"is a directory"}},
        BadInputCase{"CeilingOfNothing", "ceiling aircaft", {"aircaft", "aircraft"}},
        BadInputCase{"LintOfNothing", "lint @/absent.obj", {"absent.obj", "No such file"}},
        BadInputCase{"UnknownAsset", "asset aircrft -o @/out", {"aircrft", "'aircraft'"}},
        BadInputCase{"UnknownRandomKind",
                     "asset random --kind crain -o @/out",
                     {"--kind crain", "did you mean 'crane'?", "hull"}},
        BadInputCase{
            "SeedOfABuiltin", "asset smoke --seed 2 -o @/out.obj", {"smoke", "asset random"}},
        BadInputCase{"NegativeAssetSeed", "asset random --seed -1 -o @/out.obj", {"--seed"}},
        BadInputCase{"UnknownMeshFormat", "asset smoke -o @/out", {"out", ".obj, .ply or .glb"}},
        BadInputCase{"EmptyMesh", "run smoke --mesh @/empty.obj --out @/out", {"empty.obj"}},
        BadInputCase{"NanMesh", "run smoke --mesh @/nan.obj --out @/out", {"nan.obj"}},
        BadInputCase{"MeshOutside",
                     "run smoke --mesh @/outside.obj --out @/out",
                     {"outside.obj", "workspace_m"}},
        BadInputCase{"UnwritableOut", "run smoke --out @/file/out", {"file/out"}},
        BadInputCase{"LeafTooFine",
                     "run smoke --set planner.cloud.leaf_m=0.002 --out @/out",
                     {"--set", "leaf_m", "0.002"}},
        BadInputCase{"WorkspaceTooFar",
                     "run smoke --set 'workspace_m={min: [2530, -4, 0], max: [2540, 4, 5]}' "
                     "--set 'start.position_m=[2532, -2.8, 1.2]' --out @/out",
                     {"--set", "workspace_m", "2540", "1000 m"}},
        BadInputCase{"TooHeavyToFly",
                     "run smoke --set vehicle.airframe.mass_kg=5 --out @/out",
                     {"--set", "mass_kg", "thrust_max"}},
        BadInputCase{"NegativeSeed", "run smoke --seed -1 --out @/out", {"seed", "-1"}},
        BadInputCase{"ResumeOfNothing", "run smoke --resume", {"--resume", "--out"}},
        BadInputCase{"FolderOfAnother", "run smoke --out @", {"not empty"}},
        BadInputCase{"TableWithoutAPaper", "table smoke --out @/out", {"smoke", "aircraft"}},
        BadInputCase{"RenderOfNothing", "render @/out", {"out"}}),
    [](const auto& refused) { return std::string(refused.param.name); });

TEST(Program, AMissionThatEndsBeforeItExploredSaysWhy) {
  TempFolder temp;
  const fs::path out = temp.path() / "out";
  // in a corner, looking away, and without frontier views
  const Outcome run = gnbv(
      "run smoke --quiet --set 'start={position_m: [0, -3.9, 4.5], yaw_deg: -90, jitter_m: [0, 0, "
      "0]}' --set planner.fvs.enabled=false --set planner.agvs.scales=false "
      "--set planner.profiling.method=none --out " +
      out.string());
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_TRUE(has(run, "ended after 1 view, before it explored")) << run.output;
  EXPECT_TRUE(has(run, "outside the workspace") && has(run, "what helps: ")) << run.output;
  const auto summary = nlohmann::json::parse(read_file(out / "summary.json"));
  EXPECT_GT(summary.at("last_rejections").at("out_of_bounds"), 0);
}

TEST(Program, AFailedExportLeavesNoFolder) {
  TempFolder temp;
  const fs::path out = temp.path() / "out";
  ASSERT_EQ(gnbv(one_view(out)).exit_code, 0);
  EXPECT_EQ(gnbv("export " + out.string() + " --format colmap").exit_code, 2);  // no frames
  EXPECT_FALSE(fs::exists(out / "export"));
}

TEST(Program, AKilledRunGoesOnToTheSameResult) {
  TempFolder temp;
  const fs::path whole = temp.path() / "whole";
  const fs::path killed = temp.path() / "killed";
  const std::string run = "run smoke --set planner.termination.max_iterations=80 --out ";
  ASSERT_EQ(gnbv(run + whole.string()).exit_code, 0);
  // killed when the journal holds some views, and asked to stop when it holds some more
  for (const std::string signal : {"KILL", "TERM"}) {
    const std::string start = run + killed.string() + " --resume";
    const std::string lines = signal == "KILL" ? "4" : "20";
    const std::string stop = " & p=$!; n=0; while [ $(cat " + killed.string() +
                             "/iterations.csv.part 2>/dev/null | wc -l) -lt " + lines +
                             " ] && [ $n -lt 1000 ]; do sleep 0.01; n=$((n+1)); done; kill -" +
                             signal + " $p; wait $p";
    const Outcome stopped = gnbv(start + " 2>/dev/null" + stop);
    EXPECT_NE(stopped.exit_code, 0) << signal << stopped.output;
  }
  const Outcome resumed = gnbv(run + killed.string() + " --resume");
  ASSERT_EQ(resumed.exit_code, 0) << resumed.output;
  const auto sha = [](const fs::path& folder) {
    return nlohmann::json::parse(read_file(folder / "summary.json")).at("result_sha256");
  };
  EXPECT_EQ(sha(killed), sha(whole));
}

TEST(Program, KeepsARunThatIsAlreadyThere) {
  TempFolder temp;
  const fs::path out = temp.path() / "run";
  ASSERT_EQ(gnbv(one_view(out)).exit_code, 0);
  const std::string before = read_file(out / "summary.json");
  const Outcome again = gnbv(one_view(out));
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_TRUE(has(again, "--resume"));
  EXPECT_EQ(read_file(out / "summary.json"), before);
}

TEST(Program, WritesItsStructuresAndFindsThemSound) {
  TempFolder temp;
  for (const std::string extension : {".obj", ".ply", ".glb"}) {
    const std::string file = (temp.path() / ("smoke" + extension)).string();
    const Outcome asset = gnbv("asset smoke --json 2>/dev/null -o " + file);
    ASSERT_EQ(asset.exit_code, 0) << asset.output;
    const Outcome lint = gnbv("lint --json 2>/dev/null " + file);
    EXPECT_EQ(lint.exit_code, 0) << lint.output;
    const auto facts = nlohmann::json::parse(asset.output);
    const auto report = nlohmann::json::parse(lint.output);
    EXPECT_EQ(report.at("usable"), true);
    EXPECT_EQ(report.at("faces"), facts.at("faces"));
    EXPECT_EQ(report.at("bounds_m"), facts.at("bounds_m"));
  }
  EXPECT_TRUE(has(gnbv("asset --list"), "smoke\n"));
  EXPECT_EQ(gnbv("asset smoke --list").exit_code, 2) << "a list is of all";
}

TEST(Program, WritesRandomStructuresWhoseBytesAreThoseOfTheirSeed) {
  TempFolder temp;
  const auto written = [&](const std::string& file, const std::string& options) {
    const std::string path = (temp.path() / file).string();
    const Outcome asset = gnbv("asset random --json " + options + " 2>/dev/null -o " + path);
    EXPECT_EQ(asset.exit_code, 0) << options;
    const auto facts = nlohmann::json::parse(asset.output);
    const std::string chosen =
        fmt::format("--kind {} --seed {}", facts.at("kind").get<std::string>(),
                    facts.at("seed").get<std::uint64_t>());
    return std::pair(read_file(path), chosen);
  };
  for (const std::string extension : {".obj", ".ply", ".glb"}) {
    const auto [bytes, chosen] = written("a" + extension, "--seed 9");
    EXPECT_EQ(written("a" + extension, chosen).first, bytes) << "the seed chose that kind";
    EXPECT_NE(written("a" + extension, "--seed 10").first, bytes);
  }
  EXPECT_EQ(written("a.obj", "").second, written("a.obj", "--seed 1").second);
  const Outcome list = gnbv("asset --list");
  for (const std::string kind : {"hall", "mixed"})
    EXPECT_TRUE(has(list, "random --kind " + kind + "\n")) << list.output;
}

TEST(Program, LintExitsWith1OnAMeshThatNoMissionTakes) {
  TempFolder temp;
  std::ofstream(temp.path() / "nan.obj") << "v 0 0 1\nv nan 0 1\nv 0 1 1\nf 1 2 3\n";
  const Outcome lint = gnbv("lint " + (temp.path() / "nan.obj").string());
  EXPECT_EQ(lint.exit_code, 1) << lint.output;
  EXPECT_TRUE(has(lint, "nan.obj:2: vertex 2")) << lint.output;
}

TEST(Program, FliesTheOracleAndItsCeilingIsNoLess) {
  TempFolder temp;
  setenv("GNBV_CACHE", (temp.path() / "cache").c_str(), 1);
  // a room of which little has to be looked at
  const std::string where =
      " smoke --set planner.cloud.leaf_m=0.1 --set cameras.0.range_max_m=2.5 ";
  const Outcome ceiling = gnbv("ceiling --json" + where + "2>/dev/null");
  ASSERT_EQ(ceiling.exit_code, 0);
  const auto most = nlohmann::json::parse(ceiling.output);
  const Outcome again = gnbv("ceiling --json" + where + "2>/dev/null");
  auto cached = nlohmann::json::parse(again.output);
  cached["wall_s"] = most.at("wall_s");
  EXPECT_EQ(cached, most);
  const Outcome run = gnbv("run" + where + "--utility oracle_metres --json --out " +
                           (temp.path() / "run").string() + " 2>/dev/null");
  setenv("GNBV_CACHE", "", 1);
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const auto flown = nlohmann::json::parse(run.output);
  // where the views fall into leaves differs a little from the survey's
  EXPECT_LE(flown.at("coverage").at("final").at("0.05").get<double>(),
            most.at("leaf_outside").at("0.05").get<double>() + 0.02);
}

TEST(Program, PrintsJsonAloneOnStdoutWhenAsked) {
  TempFolder temp;
  const Outcome json = gnbv(one_view(temp.path() / "run") + " --json 2>/dev/null");
  ASSERT_EQ(json.exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(json.output).at("iterations"), 1);
}

TEST(Program, PrintsTheSchemaThatItsScenarioFilesFollow) {
  const nlohmann::json schema = nlohmann::json::parse(gnbv("schema").output);
  EXPECT_TRUE(schema.at("properties").contains("planner"));
}

}  // namespace
}  // namespace gnbv
