#include "scenarios/papers_setting.hpp"

#include <gtest/gtest.h>

#include "scenarios/load.hpp"

namespace gnbv {
namespace {

TEST(PapersSetting, IsThatOfTheBuiltInScenariosWhateverTheReading) {
  for (const std::string name : {"aircraft", "power_plant", "lab_model", "lab_airplane"}) {
    EXPECT_TRUE(has_papers_setting(load_scenario(name, {})));
    EXPECT_TRUE(has_papers_setting(
        load_scenario(name, {"seed=7", "planner.utility.name=isler", "planner.preset=released",
                             "planner.fvs.tries=1", "structure.builtin=smoke"})));
  }
}

TEST(PapersSetting, IsNoneWithOtherViewsSensorsProfileRoomOrName) {
  for (const std::string set :
       {"planner.termination.max_iterations=20", "planner.profiling.method=none",
        "cameras.0.range_max_m=6", "cameras=[{}]", "lidars.0.range_max_m=9",
        "planner.map.resolution_m=0.1", "workspace_m={max: [30, 30, 20]}", "name=mine"}) {
    EXPECT_FALSE(has_papers_setting(load_scenario("aircraft", {set}))) << set;
  }
}

}  // namespace
}  // namespace gnbv
