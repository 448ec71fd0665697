// `gnbv paper` as its users meet it: a page whose every file is there, missions that are not flown
// twice, and a page that says so when one failed.
#include <gmock/gmock.h>

#include <filesystem>
#include <regex>
#include <set>

#include "sim/core/file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class PaperProgram : public testing::Test {
 protected:
  Outcome paper(const std::string& arguments) const {
    return gnbv("paper -o page --cells cells --seeds 1 --threads 1 --quiet " + arguments,
                "cd " + temp_.path().string() + " && ");
  }
  std::string page() const { return read_file(temp_.path() / "page" / "index.html"); }

  /// When each run directory was made.
  std::map<fs::path, fs::file_time_type> runs() const {
    std::map<fs::path, fs::file_time_type> all;
    for (const auto& entry : fs::recursive_directory_iterator(temp_.path() / "cells")) {
      if (entry.path().filename() == "summary.json") all[entry.path()] = entry.last_write_time();
    }
    return all;
  }

  TempFolder temp_;
};

TEST_F(PaperProgram, ShowsEveryFigureWithFilesThatAreThereAndFliesNothingTwice) {
  const std::string tiny = "--scenarios lab_model --set planner.termination.max_iterations=3";
  const Outcome first = paper(tiny);
  ASSERT_EQ(first.exit_code, 0) << first.output;
  EXPECT_EQ(first.output, "page/index.html\n");

  const std::string html = page();
  for (const char* const figure : {"2", "4", "5", "6", "13", "14", "15"}) {
    EXPECT_THAT(html, HasSubstr(std::string("<section id=fig") + figure + ">"));
  }
  EXPECT_THAT(html, Not(HasSubstr("<section id=fig8>")));  // of the aircraft, not asked for
  EXPECT_THAT(html, Not(HasSubstr("://")));                // no network
  std::set<std::string> linked;
  const std::regex link("href='([^#'][^']*)'");
  for (std::sregex_iterator at(html.begin(), html.end(), link), end; at != end; ++at) {
    linked.insert((*at)[1]);
    EXPECT_TRUE(fs::is_regular_file(temp_.path() / "page" / (*at)[1].str())) << (*at)[1];
  }
  for (const std::string file :
       {"tables/lab_model.md", "tables/lab_model.csv", "figures/fig02-rays.png",
        "figures/fig04-profile.png", "figures/fig13-path-top.png",
        "figures/fig14-density-entropy.svg", "figures/fig15-surface-top.png"}) {
    EXPECT_TRUE(linked.contains(file)) << file;
  }
  // the paper's numbers stand beside ours
  EXPECT_THAT(html, HasSubstr("30,140"));
  EXPECT_THAT(html, HasSubstr("compared after 3 views, where ours ended; the paper&#39;s took 40"));

  const auto flown = runs();
  EXPECT_EQ(flown.size(), 2U);  // with images and without
  ASSERT_EQ(paper(tiny).exit_code, 0);
  EXPECT_EQ(runs(), flown);
  EXPECT_EQ(page(), html);
}

TEST_F(PaperProgram, ExitsWith1WhenAMissionFailedAndThePageSaysSo) {
  const Outcome failed = paper(
      "--scenarios lab_model --set 'start={position_m: [0, 0, 0.5], jitter_m: [0, 0, 0]}' --set "
      "planner.validity.z_min_m=0");
  EXPECT_EQ(failed.exit_code, 1) << failed.output;
  EXPECT_THAT(failed.output, HasSubstr("not every mission came to its end"));
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr("lab_model, proposed: without a result: exit code 2: gnbv: start"));
  EXPECT_THAT(html, HasSubstr("Proposed: no mission came to its end"));
  EXPECT_THAT(html, HasSubstr("30,140"));
}

TEST_F(PaperProgram, RefusesBadInputAndLeavesNoPage) {
  for (const char* const arguments :
       {"--scenarios moon", "--set planner.utilty.name=isler", "--seeds 0", "--jobs 0"}) {
    EXPECT_EQ(paper(arguments).exit_code, 2) << arguments;
    EXPECT_FALSE(fs::exists(temp_.path() / "page" / "index.html")) << arguments;
  }
}

}  // namespace
}  // namespace gnbv
