// The cells of a sweep: their order, their names, and what is wrong with its file.
#include "tools/sweep/sweep.hpp"

#include <gmock/gmock.h>

#include <set>

#include "scenarios/document.hpp"
#include "sim/core/file.hpp"
#include "sim/core/image.hpp"
#include "tests/support/fault.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class SweepFile : public testing::Test {
 protected:
  Sweep read(const std::string& text) { return read_sweep(temp_.write("s.yaml", text)); }

  /// What reading the file or resolving its cells complains about, with short paths.
  std::string complaint(const std::string& text) {
    return temp_.without_path(test::fault_of([&] { cells_of(read(text)); }));
  }

  void write_triangle(const std::string& name, double height_m = 1.0) {
    temp_.write(name, fmt::format("v 0 0 0.5\nv 1 0 0.5\nv 0 1 {}\nf 1 2 3\n", height_m));
  }

  TempFolder temp_;
};

std::vector<std::string> names_of(const std::vector<SweepMethod>& methods) {
  std::vector<std::string> names;
  for (const SweepMethod& method : methods) names.push_back(method.name);
  return names;
}

TEST_F(SweepFile, CellsAreScenarioByScenarioMethodByMethodSeedBySeed) {
  const Sweep sweep = read(
      "scenarios: [smoke, {name: wide, scenario: smoke, set: {planner.agvs.step_m: 0.9}}]\n"
      "utilities: [proposed, bircher]\nseeds: [7, 1]\n");
  const std::vector<Cell> cells = cells_of(sweep);
  ASSERT_EQ(cells.size(), cell_count(sweep));
  std::vector<std::string> order;
  for (const Cell& cell : cells) {
    order.push_back(fmt::format("{} {} {}", cell.scenario, cell.method, cell.seed));
    EXPECT_EQ(cell.resolved.seed, cell.seed);
    EXPECT_EQ(cell.resolved.planner.utility.name, cell.method);
    EXPECT_EQ(cell.resolved.planner.agvs.step_m, cell.scenario == "wide" ? 0.9 : 0.7);
  }
  EXPECT_THAT(order, ElementsAre("smoke proposed 7", "smoke proposed 1", "smoke bircher 7",
                                 "smoke bircher 1", "wide proposed 7", "wide proposed 1",
                                 "wide bircher 7", "wide bircher 1"));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (std::size_t last = i; last < cells.size(); ++last) {
      const std::vector<Cell> some = cells_of(sweep, i, last);  // against all
      ASSERT_EQ(some.size(), last - i + 1);
      for (std::size_t k = i; k <= last; ++k) EXPECT_EQ(some[k - i].id, cells[k].id) << k;
    }
  }
}

TEST_F(SweepFile, UtilitiesPresetsAndVariantsStandSideBySideTimesTheGrid) {
  const Sweep sweep = read(
      "scenarios: smoke\nutilities: bircher\npresets: [released]\n"
      "variants: [{name: near, set: {planner.agvs.step_m: 0.4}}]\n"
      "grid: {planner.cloud.leaf_m: [0.02, 0.04], planner.map.resolution_m: 0.25}\n"
      "set: {planner.termination.max_iterations: 9}\n");
  EXPECT_THAT(
      names_of(sweep.methods),
      ElementsAre("bircher leaf_m=0.02 resolution_m=0.25", "bircher leaf_m=0.04 resolution_m=0.25",
                  "released leaf_m=0.02 resolution_m=0.25",
                  "released leaf_m=0.04 resolution_m=0.25", "near leaf_m=0.02 resolution_m=0.25",
                  "near leaf_m=0.04 resolution_m=0.25"));
  const std::vector<Cell> cells = cells_of(sweep);
  ASSERT_EQ(cells.size(), 6U);
  EXPECT_EQ(cells[1].resolved.planner.utility.name, "bircher");
  EXPECT_EQ(cells[1].resolved.planner.cloud.leaf_m, 0.04);
  EXPECT_EQ(cells[2].resolved.planner.preset, "released");
  EXPECT_EQ(cells[4].resolved.planner.agvs.step_m, 0.4);
  for (const Cell& cell : cells) {
    EXPECT_EQ(cell.resolved.planner.map.resolution_m, 0.25);
    EXPECT_EQ(cell.resolved.planner.termination.max_iterations, 9);
    EXPECT_EQ(cell.seed, 1U);
  }
}

TEST_F(SweepFile, AUtilityMayBeAFunctionInAFileBesideIt) {
  temp_.write("u.py",
              "def near(views):\n    return -views['path_m']\n\n"
              "def far(views):\n    return views['path_m']\n");
  const Sweep sweep = read("scenarios: smoke\nutilities: [isler, ./u.py:near, u.py:far]\n");
  EXPECT_THAT(names_of(sweep.methods), ElementsAre("isler", "near", "far"));
  const std::vector<Cell> cells = cells_of(sweep);
  EXPECT_EQ(cells[1].resolved.planner.utility.python.function, "near");
  EXPECT_EQ(cells[1].resolved.planner.utility.python.source, read_file(temp_.path() / "u.py"));
  temp_.write("u.py", cells[1].resolved.planner.utility.python.source + "# changed\n");
  EXPECT_NE(cells_of(read("scenarios: smoke\nutilities: u.py:near\n"))[0].id, cells[1].id);
  EXPECT_EQ(
      complaint("scenarios: smoke\nutilities:\n  - u.py:nobody\n  - none.py\n"),
      "s.yaml:3: utilities.0: value 'u.py:nobody': u.py: defines no function 'nobody' at its "
      "top level\ns.yaml:4: utilities.1: value 'none.py': none.py: No such file or directory");
}

TEST_F(SweepFile, APresetDoesNotUndoWhatIsSetBesideIt) {
  // fvs.tries is one of the switches that a preset sets
  for (const Cell& cell : cells_of(
           read("scenarios: smoke\nset: {planner.fvs.tries: 7}\npresets: [paper, released]\n"))) {
    EXPECT_EQ(cell.resolved.planner.preset, cell.method);
    EXPECT_EQ(cell.resolved.planner.fvs.tries, 7) << cell.method;
    EXPECT_EQ(cell.resolved.planner.fvs.pool_clusters, cell.method == "released");
  }
}

TEST_F(SweepFile, TheIdIsThatOfWhatAMeshRefersToAsWell) {
  const auto save = [&](std::uint8_t red) {
    write_png(Image{1, 1, {red, 0, 0}}, temp_.path() / "p.png");
  };
  temp_.write("m.obj",
              "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 0 1\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n");
  temp_.write("m.gltf", R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
"nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
"bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": "m.bin"}]})");
  const auto points = [](float x) {
    std::string bytes;
    for (const float value : {0.0F, 0.0F, 0.0F, x, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F}) {
      append_bytes(bytes, value);
    }
    return bytes;
  };
  const auto id = [&](const std::string& mesh) {
    return cells_of(read("scenarios: {scenario: smoke, mesh: " + mesh + "}\n"))[0].id;
  };
  std::set<std::string> ids = {id("m.obj")};  // nothing of it is there yet
  for (const std::string colour : {"1 1 1", "1 0 0"}) {
    temp_.write("m.mtl", "newmtl a\nKd " + colour + "\nmap_Kd p.png\n");
    ids.insert(id("m.obj"));
    for (const int red : {10, 20}) {
      save(static_cast<std::uint8_t>(red));
      ids.insert(id("m.obj"));
    }
  }
  EXPECT_EQ(ids.size(), 6U);  // with the second library the picture is there from the start
  save(10);
  temp_.write("m.mtl", "newmtl a\nKd 1 1 1\nmap_Kd p.png\n");
  EXPECT_TRUE(ids.contains(id("m.obj")));
  temp_.write("m.bin", points(1.0F));
  const std::string of_gltf = id("m.gltf");
  temp_.write("m.bin", points(2.0F));
  EXPECT_NE(id("m.gltf"), of_gltf);
}

TEST_F(SweepFile, TheIdIsThatOfTheContent) {
  const std::string text = "scenarios: smoke\nutilities: [proposed, bircher]\nseeds: 3\n";
  const std::vector<Cell> cells = cells_of(read(text));
  std::set<std::string> ids;
  for (const Cell& cell : cells) {
    EXPECT_EQ(cell.id.size(), 16U);
    EXPECT_EQ(cell.id.find_first_not_of("0123456789abcdef"), std::string::npos);
    ids.insert(cell.id);
  }
  EXPECT_EQ(ids.size(), cells.size());
  // names of rows are no content, values are
  const auto id = [&](const std::string& more) {
    return cells_of(read("scenarios: {name: other, scenario: smoke}\n" + more))[0].id;
  };
  EXPECT_EQ(id("variants: {name: as it is}\n"), cells[0].id);
  EXPECT_EQ(id("set: {planner.cloud.leaf_m: 0.05}\n"), cells[0].id);  // smoke's own
  EXPECT_NE(id("set: {planner.cloud.leaf_m: 0.051}\n"), cells[0].id);
  EXPECT_NE(id("seeds: [4]\n"), cells[0].id);
  EXPECT_EQ(CellNamer().id_of(cells[0].resolved), cells[0].id);
  EXPECT_NE(CellNamer("another version").id_of(cells[0].resolved), cells[0].id);
  // another build of the same sources shares its cells
  EXPECT_EQ(CellNamer(GNBV_VERSION, flying_source_id()).id_of(cells[0].resolved), cells[0].id);
  EXPECT_NE(CellNamer(GNBV_VERSION, "changed").id_of(cells[0].resolved), cells[0].id);
  Scenario blind = cells[0].resolved;
  blind.cameras.clear();
  EXPECT_NE(CellNamer().id_of(blind), cells[0].id);
}

TEST_F(SweepFile, AKeyThatALaterVersionAddsLeavesTheIdAsItWas) {
  Scenario scenario;  // of the version that wrote this test
  scenario.seed = 7;
  scenario.cameras = {{.name = "front", .width_px = 320}};
  scenario.lidars = {{.range_max_m = 25.0}};
  EXPECT_EQ(CellNamer("", "").id_of(scenario), "0598e4098ce5d708");
}

TEST_F(SweepFile, AMeshCountsByItsContentWhereverItLies) {
  write_triangle("a/m.obj");
  write_triangle("b/n.obj");
  write_triangle("c/m.obj", 1.25);
  const auto id = [&](const std::string& entry) {
    return cells_of(read("scenarios: {scenario: smoke, " + entry + "}\n"))[0].id;
  };
  const std::string first = id("mesh: a/m.obj");
  EXPECT_EQ(id("mesh: b/n.obj"), first);
  EXPECT_EQ(id("set: {structure.file.path: b/n.obj}"), first);
  EXPECT_NE(id("mesh: c/m.obj"), first);
  EXPECT_NE(id("mesh: a/m.obj, bounds: auto"), first);
  EXPECT_NE(id("mesh: a/m.obj, set: {structure.file.scale: 2}"), first);
}

TEST_F(SweepFile, AMeshThatCannotBeReadIsTheFaultOfItsOwnCell) {
  write_triangle("m.obj");
  temp_.write("cut.glb", "glTF");
  const std::string good = "{name: good, scenario: smoke, mesh: m.obj, bounds: auto}";
  const std::vector<Cell> cells = cells_of(read(
      "scenarios: [{name: bad, scenario: smoke, mesh: cut.glb, bounds: auto}, " + good + "]\n"));
  ASSERT_EQ(cells.size(), 2U);
  EXPECT_EQ(cells[1].id, cells_of(read("scenarios: " + good + "\n"))[0].id);
}

TEST_F(SweepFile, RelativePathsMeanBesideTheFile) {
  write_triangle("m.obj");
  temp_.write("mine.yaml", "name: own\ncameras: [{}]\n");
  const Sweep sweep = read("scenarios: [{scenario: mine.yaml, mesh: m.obj}, ./mine.yaml]\n");
  EXPECT_EQ(sweep.scenarios[0].name, "m");
  EXPECT_EQ(sweep.scenarios[1].name, "mine");
  const std::vector<Cell> cells = cells_of(sweep);
  EXPECT_EQ(cells[0].resolved.name, "own");
  EXPECT_EQ(cells[0].resolved.structure.file.path, (temp_.path() / "m.obj").string());
}

TEST_F(SweepFile, AllFaultsAreNamedAtOnceWithTheirLines) {
  EXPECT_EQ(
      complaint("scenarios:\n  - smok\n  - {scenario: smoke, mesh: none.obj, bound: auto}\n"
                "utilites: [proposed]\n"
                "presets: [relesed]\n"
                "variants: [{set: {planner.cloud.leaf_m: 0.02}}]\n"
                "grid:\n  planner.utilty.name: [isler]\n  planner.cloud.leaf_m: []\n"
                "set:\n  planner.agvs.step_m: long\n  seed: 3\n"
                "seeds: [1, -1, 1]\n"),
      "s.yaml:2: scenarios.0: value 'smok': no such file, and no built-in scenario (did you mean "
      "'smoke'? built in: aircraft, lab_airplane, lab_model, power_plant, smoke)\n"
      "s.yaml:3: scenarios.1.bound: is no known key (did you mean 'bounds'?)\n"
      "s.yaml:3: scenarios.1.mesh: value 'none.obj': no such file\n"
      "s.yaml:4: utilites: is no known key (did you mean 'utilities'?)\n"
      "s.yaml:5: planner.preset: value 'relesed': is no known name (did you mean 'released'? "
      "allowed: paper, released, authors_2018, takeoff)\n"
      "s.yaml:6: variants.0: value '{set: {planner.cloud.leaf_m: 0.02}}': has no key 'name'\n"
      "s.yaml:8: planner.utilty: is no known key (did you mean 'planner.utility'?)\n"
      "s.yaml:9: grid.planner.cloud.leaf_m: value '[]': the list is empty\n"
      "s.yaml:11: planner.agvs.step_m: value 'long': expects a number\n"
      "s.yaml:12: set.seed: seeds are given by the key 'seeds'\n"
      "s.yaml:13: seeds.1: value '-1': expects a whole number, 0 or more\n"
      "s.yaml:13: seeds.2: value '1': is given twice");
}

TEST_F(SweepFile, AKeyOrANameThatIsGivenTwiceIsAFault) {
  const std::string twice = "\ngrid: {planner.utility.name: [isler, paper]}\n";
  const std::pair<std::string, std::string> cases[] = {
      {"utilities: [proposed]" + twice,
       "s.yaml:3: grid.planner.utility.name: value '[isler, paper]': the method 'proposed' sets "
       "planner.utility.name, too"},
      {"presets: [released]\ngrid: {planner.preset: [paper]}\n", "'released' sets"},
      {"variants: [{name: v, set: {planner.utility: {name: isler}}}]" + twice,
       "'v' sets planner.utility, too"},
      {"utilities: [isler, isler]\n", "the name 'isler' is given twice"}};
  for (const auto& [methods, says] : cases) {
    EXPECT_THAT(complaint("scenarios: smoke\n" + methods), HasSubstr(says));
  }
  EXPECT_THAT(complaint("scenarios: [smoke, smoke]\n"), HasSubstr("s.yaml:1: scenarios.1"));
  EXPECT_EQ(complaint("scenarios: smoke\nutilities: [proposed]\n"
                      "grid: {planner.utility.lambda_per_m: [0.1, 0.2]}\n"),
            "");
}

TEST_F(SweepFile, AFlowTextReadsBackAsTheSameValue) {
  for (const char* text : {"5", "\"5\"", "[1, 2.5, -3e-2]", "{a: {b: [1, two, \"3\"]}, c: true}",
                           "\"a\\\"b\\\\c\"", "[\"a, b\", \"c: d\", \"#e\", \"\", ~]", "\"\\n\""}) {
    ValidationErrors faults;
    const auto node = parse_document(text, {}, faults);
    ASSERT_TRUE(node && faults.empty()) << text;
    EXPECT_EQ(flow_yaml(*node), text);
  }
  // block text that would end within a list goes into quotes
  ValidationErrors faults;
  const auto block = parse_document("- a, b\n- 'c'\n- d\n- {e: f g}\n", {}, faults);
  EXPECT_EQ(flow_yaml(*block), "[\"a, b\", \"c\", d, {e: f g}]");
}

TEST_F(SweepFile, WhatAGridMultipliesIsToldInFewWords) {
  std::string grid = "grid:\n";
  for (const char* key : {"planner.agvs.step_m", "planner.cloud.leaf_m", "start.jitter_yaw_deg"}) {
    grid += fmt::format("  {}: [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.1]\n", key);
  }
  const std::string values = complaint("scenarios: smoke\n" + grid);
  EXPECT_THAT(values,
              HasSubstr("planner.cloud.leaf_m: value '0.1': the value '0.1' is given twice"));
  EXPECT_LT(values.size(), 1'000U);
  const std::string methods = complaint("scenarios: smoke\nutilities: [isler, isler]\n" + grid);
  EXPECT_THAT(methods, HasSubstr("the name 'isler step_m=0.1 leaf_m=0.1 jitter_yaw_deg=0.1' is"));
  EXPECT_LT(methods.size(), 10'000U);
}

TEST_F(SweepFile, MoreCellsThanAnybodyMeansAreRefused) {
  EXPECT_THAT(complaint("scenarios: smoke\nutilities: [proposed, isler]\nseeds: 900000\n"),
              HasSubstr("s.yaml:3: seeds: value '900000': makes 1800000 cells"));
  // without seeds, and no cell of theirs is resolved, or the faulty value would be named, too
  std::string many =
      "scenarios: [smoke, {name: b, scenario: smoke}]\n"
      "set: {planner.agvs.step_m: long}\ngrid:\n";
  for (const char* key : {"planner.agvs.step_m", "planner.cloud.leaf_m"}) {
    many += fmt::format("  {}: [", key);
    for (int i = 0; i < 1000; ++i) many += fmt::format("{},", i);
    many += "]\n";
  }
  const std::string fault = complaint(many);
  EXPECT_THAT(fault, HasSubstr("makes 2000000 cells of the sweep, more than 1000000"));
  EXPECT_THAT(fault, testing::Not(HasSubstr("long")));
  std::string grid = "scenarios: smoke\ngrid:\n";
  for (const char* key : {"planner.agvs.step_m", "planner.cloud.leaf_m", "start.jitter_yaw_deg",
                          "planner.map.resolution_m"}) {
    grid += fmt::format("  {}: [", key);
    for (int i = 0; i < 40; ++i) grid += fmt::format("{},", i);
    grid += "]\n";
  }
  EXPECT_THAT(complaint(grid), HasSubstr("grid: value"));
}

}  // namespace
}  // namespace gnbv
