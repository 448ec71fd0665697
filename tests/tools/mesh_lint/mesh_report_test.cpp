#include "tools/mesh_lint/mesh_report.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "assets/catalog.hpp"
#include "scenarios/load.hpp"
#include "sim/core/image.hpp"
#include "tests/bench/shapes.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using test::add_box;
using test::add_sheet;

OutsideView view_of(const TriangleMesh& mesh, int threads = 2) {
  return view_from_outside(mesh, lint_mesh(mesh), threads);
}

void turn_faces(TriangleMesh& mesh, std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) std::swap(mesh.faces[i][1], mesh.faces[i][2]);
}

TEST(OutsideView, ABoxInABoxIsHidden) {
  TriangleMesh mesh;
  add_box(mesh, {0, 0, 0}, {4, 4, 4});  // 96 m2
  add_box(mesh, {1, 1, 1}, {2, 2, 2});  // 24 m2
  const OutsideView view = view_of(mesh);
  EXPECT_NEAR(view.area_m2, 120.0, 1e-4);
  EXPECT_NEAR(view.hidden_area_m2, 24.0, 1e-4);
  EXPECT_EQ(view.from_behind.count, 0U);
}

TEST(MeshReport, NamesThePicturesThatWereFoundAndTheirMemory) {
  const TempFolder folder;
  write_png(Image{3, 2, std::vector<std::uint8_t>(18)}, folder.path() / "p.png");
  folder.write("a.mtl", "newmtl a\nmap_Kd p.png\nnewmtl b\nmap_Kd none.png\n");
  Scenario scenario = load_scenario("smoke", {});
  scenario.structure.file.path =
      folder.write("a.obj",
                   "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 0 1\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n"
                   "usemtl b\nf 1/1 3/1 2/1\n");
  const std::string text = terminal_text(report_on_mesh(scenario, false, 1));
  EXPECT_NE(text.find("1 picture, 0.0 MB of pixels, and 0.0 MB"), text.npos) << text;
  EXPECT_NE(text.find("p.png 3 x 2"), text.npos) << text;
  EXPECT_NE(text.find("plain colours of their materials: none.png"), text.npos) << text;
}

TEST(OutsideView, FacesTurnedInwardsAreTheOnesThatWereTurned) {
  TriangleMesh mesh;
  add_box(mesh, {0, 0, 0}, {1, 2, 3});
  EXPECT_EQ(view_of(mesh).from_behind.count, 0U);
  turn_faces(mesh, 0, 2);  // the bottom
  EXPECT_EQ(view_of(mesh).from_behind.count, 2U);
  EXPECT_NEAR(view_of(mesh).from_behind.area_m2, 2.0, 1e-5);
  turn_faces(mesh, 2, 12);  // and all others
  EXPECT_EQ(view_of(mesh).from_behind.count, 12U);
}

TEST(OutsideView, SheetsSeenFromBothSidesPointNowhereWrong) {
  TriangleMesh mesh;
  add_sheet(mesh, {0, 0, 1}, {1, 0, 0}, {0, 1, 0});
  EXPECT_EQ(view_of(mesh).from_behind.count, 0U);
  // back to back on the floor of an open box, both senses
  add_box(mesh, {0, 0, 3}, {1, 1, 1}, false);
  const TriangleMesh once = mesh;
  mesh.faces.insert(mesh.faces.end(), once.faces.begin(), once.faces.end());
  turn_faces(mesh, once.faces.size(), mesh.faces.size());
  EXPECT_EQ(view_of(mesh).from_behind.count, 0U);
}

/// Each face in four of the same shape.
TriangleMesh finer(const TriangleMesh& mesh) {
  TriangleMesh fine;
  for (const auto& face : mesh.faces) {
    std::array<Vec3f, 3> corner, middle;
    for (std::size_t i = 0; i < 3; ++i) corner[i] = mesh.vertices_m[face[i]];
    for (std::size_t i = 0; i < 3; ++i) middle[i] = 0.5F * (corner[i] + corner[(i + 1) % 3]);
    const auto first = static_cast<std::uint32_t>(fine.vertices_m.size());
    fine.vertices_m.insert(fine.vertices_m.end(), corner.begin(), corner.end());
    fine.vertices_m.insert(fine.vertices_m.end(), middle.begin(), middle.end());
    for (const auto& [a, b, c] :
         {std::array{0U, 3U, 5U}, {3U, 1U, 4U}, {5U, 4U, 2U}, {3U, 4U, 5U}}) {
      fine.faces.push_back({first + a, first + b, first + c});
    }
  }
  return fine;
}

TEST(OutsideView, OfManyFacesSomeStandForAll) {
  TriangleMesh mesh;
  add_box(mesh, {0, 0, 0}, {4, 4, 4});  // 96 m2
  add_box(mesh, {1, 1, 1}, {2, 2, 2});  // 24 m2, hidden
  turn_faces(mesh, 0, 12);
  EXPECT_FALSE(view_of(mesh).is_estimate);
  for (int i = 0; i < 7; ++i) mesh = finer(mesh);
  ASSERT_EQ(mesh.faces.size(), std::size_t{24} << 14);
  const OutsideView view = view_of(mesh);
  EXPECT_TRUE(view.is_estimate);
  EXPECT_NEAR(view.area_m2, 120.0, 1e-2);
  EXPECT_NEAR(view.hidden_area_m2, 24.0, 1.0);
  EXPECT_NEAR(view.from_behind.area_m2, 96.0, 1.0);
  EXPECT_NEAR(static_cast<double>(view.from_behind.count), 12 << 14, 0.02 * (12 << 14));
  // what is large beside them counts as itself
  add_box(mesh, {10, 0, 0}, {40, 40, 40});
  turn_faces(mesh, mesh.faces.size() - 12, mesh.faces.size());
  EXPECT_NEAR(view_of(mesh).from_behind.area_m2, 96.0 + 9600.0, 2.0);
}

TEST(OutsideView, DoesNotDependOnTheNumberOfThreads) {
  TriangleMesh mesh = make_builtin_structure("smoke");
  turn_faces(mesh, 0, mesh.faces.size() / 3);
  const OutsideView one = view_of(mesh, 1);
  const OutsideView three = view_of(mesh, 3);
  EXPECT_GT(one.from_behind.count, 0U);
  EXPECT_EQ(one.from_behind.count, three.from_behind.count);
  EXPECT_EQ(one.from_behind.area_m2, three.from_behind.area_m2);
  EXPECT_EQ(one.hidden_area_m2, three.hidden_area_m2);
}

class Report : public testing::Test {
 protected:
  /// Of the mesh as an OBJ file, with overrides of the scenario `aircraft`.
  MeshReport of(const TriangleMesh& mesh, std::vector<std::string> overrides = {}) {
    write_mesh(mesh, temp_.path() / "t.obj");
    return of_file(temp_.path() / "t.obj", std::move(overrides));
  }
  MeshReport of_text(const std::string& obj) { return of_file(temp_.write("t.obj", obj), {}); }
  static MeshReport of_file(const fs::path& path, std::vector<std::string> overrides) {
    overrides.insert(overrides.begin(), "structure.file.path=" + path.string());
    return report_on_mesh(load_scenario("aircraft", overrides), false, 2);
  }

  TempFolder temp_;
};

Finding finding(const MeshReport& report, std::string_view check) {
  for (const Finding& f : report.findings) {
    if (f.check == check) return f;
  }
  ADD_FAILURE() << "no finding about " << check;
  return {};
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A tower of 4 x 6 x 8 m.
TriangleMesh tower(const Vec3& at, double scale = 1.0) {
  TriangleMesh mesh;
  add_box(mesh, at, scale * Vec3(4, 6, 8));
  return mesh;
}

TEST_F(Report, ASoundMeshHasOnlyGoodFindings) {
  const MeshReport report = of(tower({-2, -3, 0}));
  EXPECT_TRUE(report.is_usable());
  for (const Finding& f : report.findings) {
    if (f.check == "floor") continue;  // the bottom and 0.3 m of the walls
    EXPECT_EQ(f.severity, Severity::ok) << f.check << ": " << f.what;
  }
  // 24 m2 of the bottom and 0.3 m of 20 m around, of 208 m2
  EXPECT_TRUE(says(finding(report, "floor").what, "14.4 %")) << finding(report, "floor").what;
}

TEST_F(Report, ACameraThatClearsThroughSurfaceIsWarnedOfAndTheFlagPutsItRight) {
  const std::string deep = "cameras.0.return_max_m=5";
  const Finding found = finding(of(tower({-2, -3, 0}), {deep}), "returns");
  EXPECT_EQ(found.severity, Severity::warning);
  EXPECT_TRUE(says(found.what, "from 5 to 8 m")) << found.what;
  EXPECT_EQ(found.fix, "--set planner.map.no_return=unknown");
  for (const Finding& f :
       of(tower({-2, -3, 0}), {deep, "planner.map.no_return=unknown"}).findings) {
    EXPECT_NE(f.check, "returns");
  }
}

TriangleMesh lying(TriangleMesh mesh) {
  for (Vec3f& v : mesh.vertices_m) v = {v.x(), v.z(), -v.y()};  // y up
  return mesh;
}

TEST_F(Report, ASuspectPlaceOrSizeIsNamedAndTheFlagPutsItRight) {
  struct Flaw {
    TriangleMesh mesh;
    const char* check;
    Severity severity;
    const char* what;
    const char* fix;
    const char* set;  // that puts it right
  };
  const std::vector<Flaw> flaws = {
      {tower({-2000, -3000, 0}, 1000.0), "size", Severity::warning, "large",
       "--set structure.file.unit_m=0.001 (8 m", "structure.file.unit_m=0.001"},
      {tower({0, 0, 0}, 0.001), "size", Severity::warning, "small", "", ""},
      {lying(tower({-2, -3, 0})), "up axis", Severity::warning, "y = 0", "structure.file.up_axis=y",
       "structure.file.up_axis=y"},
      // 24 m2 of the bottom and 1.5 m of 20 m around, of 208 m2
      {tower({-2, -3, -1.5}), "ground", Severity::warning, "26.0 %",
       "structure.file.offset_m=[0, 0, 1.5]", "structure.file.offset_m=[0, 0, 1.5]"},
      {tower({0, 0, 30}), "ground", Severity::note, "floats", "offset_m", ""},
      {tower({500000, 0, 0}), "place", Severity::error, "reaches only", "offset_m=[-500002, -3, 0]",
       "structure.file.offset_m=[-500002, -3, 0]"},
      {tower({50, 0, 0}), "place", Severity::note, "outside", "--bounds auto", ""}};
  for (const Flaw& flaw : flaws) {
    const MeshReport report = of(flaw.mesh);
    const Finding found = finding(report, flaw.check);
    if (found.check == "place") {  // which is all that is wrong
      EXPECT_EQ(report.is_usable(), flaw.severity != Severity::error) << found.what;
    }
    EXPECT_EQ(found.severity, flaw.severity) << found.what;
    EXPECT_TRUE(says(found.what, flaw.what)) << found.what;
    EXPECT_TRUE(says(found.fix, flaw.fix)) << found.fix;
    if (*flaw.set == '\0') continue;
    EXPECT_EQ(finding(of(flaw.mesh, {flaw.set}), flaw.check).severity, Severity::ok) << flaw.set;
  }
}

TEST_F(Report, WhatLoadMeshRefusesIsStillReported) {
  const MeshReport nan = of_text("v 0 0 0\nv 1 0 0\nv 0 nan 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n");
  EXPECT_FALSE(nan.is_usable());
  EXPECT_TRUE(says(finding(nan, "coordinates").what, "t.obj:3: vertex 3"));
  EXPECT_EQ(nan.lint.sound.count, 1U);
  const MeshReport flat = of_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  EXPECT_FALSE(flat.is_usable());
  const MeshReport empty = of_text("");
  EXPECT_FALSE(empty.is_usable());
  EXPECT_TRUE(says(finding(empty, "file").what, "is empty"));
  for (const MeshReport& report : {nan, flat, empty}) {
    EXPECT_TRUE(says(terminal_text(report), "not usable"));
    EXPECT_EQ(nlohmann::json::parse(json_text(report)).at("usable"), false);
  }
}

TEST_F(Report, WhatIsTooLargeForRaysIsAFindingAndNoCrash) {
  for (const char* far : {"1e15", "1e19", "3e37"}) {
    const std::string x(far);
    const MeshReport report =
        of_text("v 0 0 0\nv " + x + " 0 0\nv 0 " + x + " " + x + "\nv 1 1 1\nf 1 2 3\nf 1 2 4\n");
    EXPECT_FALSE(report.is_usable()) << far;
    EXPECT_EQ(finding(report, "place").severity, Severity::error) << far;
  }
}

TEST_F(Report, AHundredthOfTheFacesMayBeLost) {
  std::string text = "v 0 0 1\nv 4 0 1\nv 0 4 5\n";
  for (int i = 0; i < 99; ++i) text += "f 1 2 3\n";
  EXPECT_TRUE(of_text(text + "f 1 2 9\n").is_usable());
  const MeshReport report = of_text(text + "f 1 2 9\nf 1 2\n");
  EXPECT_FALSE(report.is_usable());
  EXPECT_TRUE(says(finding(report, "lost").what, "2 of 101 faces"));
}

TEST_F(Report, EveryFlawHasItsFinding) {
  TriangleMesh mesh = tower({-2, -3, 0});
  const auto faces = mesh.faces;
  mesh.faces.push_back(faces[0]);                                 // twice
  mesh.faces.push_back({faces[4][0], faces[4][2], faces[4][1]});  // back to back
  mesh.faces.push_back({faces[2][0], faces[2][0], faces[2][1]});  // flat
  std::swap(mesh.faces[8][1], mesh.faces[8][2]);                  // inwards
  add_sheet(mesh, {5, 5, 1}, {1, 0, 0}, {0, 1, 0});               // open
  mesh.vertices_m.emplace_back(100.0F, 0.0F, 0.0F);               // astray
  const MeshReport report = of(mesh);
  EXPECT_TRUE(report.is_usable());
  for (const char* check :
       {"duplicates", "two-sided", "flat faces", "facing", "edges", "vertices"}) {
    EXPECT_NE(finding(report, check).severity, Severity::ok) << check;
  }
  EXPECT_EQ(finding(report, "vertices").severity, Severity::warning);  // it widens the box
  const auto json = nlohmann::json::parse(json_text(report));
  EXPECT_EQ(json.at("faces"), 16);
  EXPECT_EQ(json.at("findings").size(), report.findings.size());
}

}  // namespace
}  // namespace gnbv
