// Laws of functions of the user's own on the command line: which one is meant, what it does, and
// what it is called.
#include "tools/mission/user_function.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/fault.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

class UserFunction : public testing::Test {
 protected:
  /// `FILE.py` with this source, in a folder of the test.
  std::string file(const std::string& name, const std::string& source) const {
    std::filesystem::create_directories((temp_.path() / name).parent_path());
    std::ofstream(temp_.path() / name) << source;
    return (temp_.path() / name).string();
  }
  static std::string kind_of(const NamedMethod& method) {
    for (const Override& set : method.overrides) {
      if (set.text.find(".kind=") != std::string::npos) {
        return set.text.substr(set.text.find('=') + 1);
      }
    }
    return "";
  }
  static std::string fault_of(const std::string& text) {
    return test::fault_of([&] { named_method(text); });
  }

  TempFolder temp_;
};

TEST_F(UserFunction, AFileAloneMeansItsOneFunctionAndNeverOneOfSeveral) {
  EXPECT_EQ(named_method(file("one.py", "scale = 2\ndef f(views):\n  return views\n")).name, "f");
  const std::string several = file("two.py", "def f(v): return v\n\ndef g(v): return v\n");
  EXPECT_THAT(fault_of(several), testing::HasSubstr("defines several functions (f, g)"));
  EXPECT_EQ(named_method(several + ":f").name, "f");
  EXPECT_THAT(fault_of(several + ":h"), testing::HasSubstr("two.py: defines no function 'h'"));
  EXPECT_THAT(fault_of(file("none.py", "x = 1\n")), testing::HasSubstr("defines no function"));
  EXPECT_THAT(fault_of("gone.py"), testing::HasSubstr("gone.py"));
}

TEST_F(UserFunction, TwoParametersThatHaveToBeGivenMakeAPlanner) {
  const std::vector<std::pair<std::string, std::string>> definitions = {
      {"f(views)", "utility"},
      {"f(views, weight=2.0)", "utility"},
      {"f(views, *, weight)", "utility"},
      {"f(views, *more)", "utility"},
      {"f(views: dict[str, list[int]], key=lambda a, b: a)", "utility"},
      {"f(belief, history)", "planner"},
      {"f(\n    belief: Belief,  # (of now)\n    history: 'a, b',\n)", "planner"},
      {"f(belief, history, /, most=30)", "planner"}};
  for (const auto& [definition, kind] : definitions) {
    EXPECT_EQ(kind_of(named_method(file("k.py", "def " + definition + ": pass\n"))), kind)
        << definition;
  }
  EXPECT_EQ(kind_of(named_method(file("a.py", "f = make()\n") + ":f")), "utility");
}

TEST_F(UserFunction, LabelsAreAsShortAsTellsThemApart) {
  const auto labels = [&](const std::vector<std::string>& texts) {
    std::vector<NamedMethod> methods;
    for (const std::string& text : texts) methods.push_back(named_method(text, "", temp_.path()));
    tell_apart(methods);
    std::vector<std::string> all;
    for (const NamedMethod& method : methods) all.push_back(method.name);
    return all;
  };
  for (const char* name : {"u.py", "v.py", "w/v.py"}) {
    file(name, "def f(v): return v\ndef g(v): return v\n");
  }
  using Labels = std::vector<std::string>;
  EXPECT_EQ(labels({"proposed", "u.py:f", "u.py:g"}), (Labels{"proposed", "f", "g"}));
  EXPECT_EQ(labels({"u.py:f", "v.py:f", "v.py:g"}), (Labels{"u.py:f", "v.py:f", "g"}));
  EXPECT_EQ(labels({"v.py:f", "w/v.py:f"}), (Labels{"v.py:f", "w/v.py:f"}));
  EXPECT_EQ(labels({"mine=u.py:f", "best=proposed", "v.py:f"}), (Labels{"mine", "best", "f"}));
}

}  // namespace
}  // namespace gnbv
