// What is kept of true surfaces, told and pruned by the program.
#include "tests/end_to_end/scored_mission.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;
using test::Score;

class Cache : public Score {
 protected:
  Cache() : shared_(std::getenv("GNBV_CACHE")) {
    setenv("GNBV_CACHE", (temp_.path() / "cache").c_str(), 1);
  }
  ~Cache() override {
    setenv("GNBV_CACHE", shared_.c_str(), 1);
    unsetenv("GNBV_CACHE_LIMIT");
  }
  std::size_t results(const std::string& options = "") const {
    const Outcome told = gnbv("cache --json" + options);
    EXPECT_EQ(told.exit_code, 0) << told.output;
    return Json::parse(told.output).at("all").at("results");
  }

 private:
  std::string shared_;
};

TEST_F(Cache, IsToldAndPruned) {
  EXPECT_EQ(results(), 0U);
  ASSERT_EQ(gnbv("score " + original().string()).exit_code, 0);
  const std::size_t kept = results();
  EXPECT_GE(kept, 1U);
  EXPECT_EQ(results(" --prune"), kept);  // less than 2 GiB
  EXPECT_EQ(results(" --prune --limit 100MB"), kept);
  EXPECT_EQ(results(" --prune --limit 0"), 0U);
}

TEST_F(Cache, ALimitOfNothingKeepsNothing) {
  setenv("GNBV_CACHE_LIMIT", "0", 1);
  ASSERT_EQ(gnbv("score " + original().string()).exit_code, 0);
  EXPECT_EQ(results(), 0U);
}

TEST_F(Cache, ALimitThatIsNoneIsRefused) {
  for (const char* const wrong :
       {"cache --limit 5", "cache --prune --limit -1", "cache --prune --limit nan"}) {
    const Outcome refused = gnbv(wrong);
    EXPECT_EQ(refused.exit_code, 2) << wrong << refused.output;
    EXPECT_NE(refused.output.find("--limit"), std::string::npos) << refused.output;
  }
  setenv("GNBV_CACHE_LIMIT", "2GiB", 1);
  EXPECT_EQ(gnbv("score " + original().string()).exit_code, 2);
}

}  // namespace
}  // namespace gnbv
