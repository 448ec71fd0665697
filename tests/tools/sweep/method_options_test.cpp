#include "tests/support/fault.hpp"
#include "tools/sweep/compare_missions.hpp"

namespace gnbv {
namespace {

using Texts = std::vector<std::string>;

Texts names(const std::vector<SweepMethod>& methods) {
  Texts all;
  for (const SweepMethod& method : methods) all.push_back(method.name);
  return all;
}

Texts overrides(const SweepMethod& method) {
  Texts all;
  for (const Override& set : method.overrides) all.push_back(set.text);
  return all;
}

TEST(MethodOptions, StandInTheOrderOfUtilitiesPresetsVariantsValues) {
  const auto methods = methods_of({.utilities = {"proposed", "bircher"},
                                   .presets = {"released"},
                                   .variants = {"literal:planner.utility.density_term=literal"},
                                   .varies = {"planner.utility.lambda_per_m=0.1,0.2"}});
  EXPECT_EQ(names(methods),
            (Texts{"proposed", "bircher", "released", "literal", "planner.utility.lambda_per_m=0.1",
                   "planner.utility.lambda_per_m=0.2"}));
  EXPECT_EQ(overrides(methods[1]), Texts{"planner.utility.name=bircher"});
  EXPECT_EQ(overrides(methods[2]), Texts{"planner.preset=released"});
  EXPECT_EQ(overrides(methods[3]), Texts{"planner.utility.density_term=literal"});
}

TEST(MethodOptions, VariantsAloneAreComparedWithTheScenarioAsItIs) {
  const auto methods = methods_of({.variants = {"a=1,b={x: 1, y: [2, 3]},c='d,e'", "a={x: 1}"}});
  EXPECT_EQ(names(methods), (Texts{"default", "a=1,b={x: 1, y: [2, 3]},c='d,e'", "a={x: 1}"}));
  EXPECT_TRUE(methods[0].overrides.empty());
  EXPECT_EQ(overrides(methods[1]), (Texts{"a=1", "b={x: 1, y: [2, 3]}", "c='d,e'"}));
  EXPECT_EQ(names(methods_of({.varies = {"k=[1, 2],[3]"}})), (Texts{"k=[1, 2]", "k=[3]"}));
}

TEST(MethodOptions, AllFaultsAreNamedAtOnce) {
  const std::pair<MethodOptions, Texts> cases[] = {
      {{.utilities = {"isler", "isler"},
        .variants = {"n:novalue", ":a=1"},
        .varies = {"k", "k=1,,2"}},
       {"'isler': named twice", "'n:novalue'", "':a=1'", "--vary: value 'k'", "'k=1,,2'"}},
      {{.variants = {"n:planner.agvs.step_m=1,seed=3"}, .varies = {"seed=1,2"}},
       {"--variant: value 'n:planner.agvs.step_m=1,seed=3': seeds are no method",
        "--vary: value 'seed=1,2': seeds are no method"}},
      {{.utilities = {"isler"}}, {"'isler': nothing to compare"}},
      {{}, {"no method"}},
      // a mistyped name is told before that it is alone
      {{.utilities = {"proposd"}}, {"--utilities proposd: ", "did you mean 'proposed'?"}},
      {{.presets = {"papr"}}, {"--presets papr: ", "did you mean 'paper'?"}}};
  for (const auto& [options, words] : cases) {
    const std::string fault = test::fault_of([&, &given = options] { methods_of(given); });
    for (const std::string& word : words) EXPECT_TRUE(test::says(fault, {word}));
  }
}

}  // namespace
}  // namespace gnbv
