#include "tools/sweep/method_options.hpp"

#include <gtest/gtest.h>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

using Overrides = std::vector<std::string>;

std::vector<std::string> names(const std::vector<SweepMethod>& methods) {
  std::vector<std::string> all;
  for (const SweepMethod& method : methods) all.push_back(method.name);
  return all;
}

std::string fault_of(const MethodOptions& options) {
  try {
    methods_of(options);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

TEST(MethodOptions, StandInTheOrderOfUtilitiesPresetsVariantsValues) {
  const auto methods = methods_of({.utilities = {"proposed", "bircher"},
                                   .presets = {"released"},
                                   .variants = {"literal:planner.utility.density_term=literal"},
                                   .varies = {"planner.utility.lambda_per_m=0.1,0.2"}});
  EXPECT_EQ(names(methods), (std::vector<std::string>{"proposed", "bircher", "released", "literal",
                                                      "planner.utility.lambda_per_m=0.1",
                                                      "planner.utility.lambda_per_m=0.2"}));
  EXPECT_EQ(methods[1].overrides, Overrides{"planner.utility.name=bircher"});
  EXPECT_EQ(methods[2].overrides, Overrides{"planner.preset=released"});
  EXPECT_EQ(methods[3].overrides, Overrides{"planner.utility.density_term=literal"});
}

TEST(MethodOptions, VariantsAloneAreComparedWithTheScenarioAsItIs) {
  const auto methods = methods_of({.variants = {"a=1,b={x: 1, y: [2, 3]},c='d,e'"}});
  EXPECT_EQ(names(methods),
            (std::vector<std::string>{"default", "a=1,b={x: 1, y: [2, 3]},c='d,e'"}));
  EXPECT_TRUE(methods[0].overrides.empty());
  EXPECT_EQ(methods[1].overrides, (Overrides{"a=1", "b={x: 1, y: [2, 3]}", "c='d,e'"}));
}

TEST(MethodOptions, ColonsOfValuesNameNothing) {
  EXPECT_EQ(methods_of({.variants = {"a={x: 1}"}})[1].name, "a={x: 1}");
}

TEST(MethodOptions, ListsAreValues) {
  EXPECT_EQ(names(methods_of({.varies = {"k=[1, 2],[3]"}})),
            (std::vector<std::string>{"k=[1, 2]", "k=[3]"}));
}

TEST(MethodOptions, AllFaultsAreNamedAtOnce) {
  const std::string fault = fault_of({.utilities = {"isler", "isler"},
                                      .variants = {"n:novalue", ":a=1"},
                                      .varies = {"k", "k=1,,2"}});
  for (const std::string text :
       {"'isler': named twice", "'n:novalue'", "':a=1'", "--vary: value 'k'", "'k=1,,2'"}) {
    EXPECT_NE(fault.find(text), std::string::npos) << text << " in " << fault;
  }
}

TEST(MethodOptions, ASeedIsNoMethod) {
  const std::string fault =
      fault_of({.variants = {"n:planner.agvs.step_m=1,seed=3"}, .varies = {"seed=1,2"}});
  EXPECT_NE(fault.find("--variant: value 'n:planner.agvs.step_m=1,seed=3': seeds are no method"),
            std::string::npos);
  EXPECT_NE(fault.find("--vary: value 'seed=1,2': seeds are no method"), std::string::npos);
}

TEST(MethodOptions, OneMethodIsNoComparison) {
  EXPECT_NE(fault_of({.utilities = {"isler"}}).find("'isler': nothing to compare"),
            std::string::npos);
  EXPECT_NE(fault_of({}).find("no method"), std::string::npos);
}

TEST(MethodOptions, AMistypedNameIsToldBeforeThatItIsAlone) {
  EXPECT_NE(fault_of({.utilities = {"proposd"}}).find("--utilities proposd: "), std::string::npos);
  EXPECT_NE(fault_of({.utilities = {"proposd"}}).find("did you mean 'proposed'?"),
            std::string::npos);
  EXPECT_NE(fault_of({.presets = {"papr"}}).find("did you mean 'paper'?"), std::string::npos);
}

}  // namespace
}  // namespace gnbv
