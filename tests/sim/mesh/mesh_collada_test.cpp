#include <gtest/gtest.h>

#include "sim/mesh/mesh_file.hpp"
#include "tests/sim/mesh/mesh_files.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using namespace test;

/// One triangle (1,0,0) (0,2,0) (0,0,3), instanced by two nodes: moved by 10 along the file's x,
/// and mirrored in x.
std::string collada(const std::string& unit, const std::string& up_axis) {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset>)" +
         unit + up_axis + R"(</asset>
<library_effects><effect id="paint"><profile_COMMON><technique sid="t"><lambert>
<diffuse><color>0.25 0.5 0.75 1</color></diffuse></lambert></technique></profile_COMMON></effect>
</library_effects>
<library_materials><material id="red" name="red"><instance_effect url="#paint"/></material>
</library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="9">1 0 0 0 2 0 0 0 3</float_array><technique_common>
<accessor source="#a" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1" material="m"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p>
</triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">
<node id="outer"><translate>10 0 0</translate><node id="inner"><instance_geometry url="#g">
<bind_material><technique_common><instance_material symbol="m" target="#red"/></technique_common>
</bind_material></instance_geometry></node></node>
<node id="mirror"><scale>-1 1 1</scale><instance_geometry url="#g"><bind_material>
<technique_common><instance_material symbol="m" target="#red"/></technique_common></bind_material>
</instance_geometry></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

const char* const kCentimetres = R"(<unit name="centimetre" meter="0.01"/>)";

/// The two triangles of collada(), turned and scaled; the mirrored one keeps its outside by turning
/// round.
template <typename Turn>
void expect_collada(const TriangleMesh& mesh, double factor, const Turn& turn) {
  const std::array<std::array<Vec3, 3>, 2> corners = {
      {{Vec3(11, 0, 0), Vec3(10, 2, 0), Vec3(10, 0, 3)},
       {Vec3(-1, 0, 0), Vec3(0, 0, 3), Vec3(0, 2, 0)}}};
  ASSERT_EQ(mesh.faces.size(), 2U);
  for (std::size_t instance = 0; instance < 2; ++instance) {
    double best = 1e9;  // over the corner the face starts with
    for (std::size_t shift = 0; shift < 3; ++shift) {
      double worst = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3f& found = mesh.vertices_m[mesh.faces[instance][(k + shift) % 3]];
        const Vec3 expected = factor * turn(corners[instance][k]);
        worst = std::max(worst, (found.cast<double>() - expected).norm());
      }
      best = std::min(best, worst);
    }
    EXPECT_LT(best, 2e-6 * factor * 11) << "instance " << instance;  // float transforms
  }
}

Vec3 z_stays(const Vec3& p) { return p; }
Vec3 y_to_z(const Vec3& p) { return {p.x(), -p.z(), p.y()}; }
Vec3 x_to_z(const Vec3& p) { return {-p.y(), -p.z(), p.x()}; }

TEST_F(MeshFile, ColladaUnitUpAxisAndInstancesAreHonoured) {
  const std::string z_up = "<up_axis>Z_UP</up_axis>";
  const TriangleMesh z = load_mesh(file(write("z.dae", collada(kCentimetres, z_up))));
  expect_collada(z, 0.01, z_stays);
  EXPECT_EQ(z.materials.at(0).name, "red");
  EXPECT_EQ(z.materials.at(0).rgb, (std::array<float, 3>{0.25F, 0.5F, 0.75F}));
  expect_collada(load_mesh(file(write("y.dae", collada("", "<up_axis>Y_UP</up_axis>")))), 1.0,
                 y_to_z);
  expect_collada(load_mesh(file(write("silent.dae", collada("", "")))), 1.0, y_to_z);
  expect_collada(load_mesh(file(write("x.dae", collada("", "<up_axis>X_UP</up_axis>")))), 1.0,
                 x_to_z);
}

TEST_F(MeshFile, AColladaUnitIsTheNumberOfItsMeterAttribute) {
  const auto unit_m = [&](const std::string& tag) {
    return read_mesh(file(write("t.dae", collada(tag, "")))).declared.unit_m;
  };
  EXPECT_EQ(unit_m("<unit meter=\"0.0254\" name=\"inch\"/>"), 0.0254);
  EXPECT_EQ(unit_m("<unit name='meter' meter = ' 2e-3 '/>"), 2e-3);
  EXPECT_EQ(unit_m("<unit name='a meter'\n\tmeter='3'></unit>"), 3.0);
  EXPECT_EQ(unit_m("<!-- <unit meter='7'/> --><unit meter='0.5'/>"), 0.5);
  EXPECT_EQ(unit_m("<unit meter='0,01'/>"), 0.01);
  EXPECT_EQ(unit_m("<unit name='" + std::string(5'000'000, 'a') + "' meter='0.5'/>"), 0.5);
  for (const char* silent : {"", "<unit name='inch'/>", "<unit meter='0'/>", "<unit meter='-1'/>",
                             "<unit meter='one'/>", "<units x=''/>"}) {
    EXPECT_EQ(unit_m(silent), 1.0) << silent;
  }
  for (const char* cut : {"<unit meter='", "<unit"}) {
    EXPECT_TRUE(says(fault("t.dae", collada(cut, "")), {"t.dae:"})) << cut;
  }
}

TEST_F(MeshFile, AColladaUpAxisIsTheWordInIt) {
  const std::string blanks(5'000'000, ' ');
  for (const std::string& tag :
       {std::string("<up_axis>\n\t Z_UP <!-- so -->\n</up_axis>"),
        "<up_axis>" + blanks + "Z_UP</up_axis>",
        std::string("<!-- <up_axis>X_UP</up_axis> --><up_axis><![CDATA[Z_UP]]></up_axis>")}) {
    const MeshReading reading = read_mesh(file(write("t.dae", collada("", tag))));
    EXPECT_EQ(reading.declared.up_axis, 'z') << tag.substr(0, 80);
    expect_collada(reading.mesh, 1.0, z_stays);
  }
}

// The paper's own structures are never committed: these run on machines that have them.

TEST(PaperMesh, A340HasTheVerticesFacesAndSizeOfTheFile) {
  const fs::path path = fs::path(GNBV_SHARED_MESHES) / "a340.obj";
  if (!fs::exists(path)) GTEST_SKIP() << path << " is not here";
  const TriangleMesh mesh = load_mesh(file(path));
  EXPECT_EQ(mesh.vertices_m.size(), 17899U);
  EXPECT_EQ(mesh.faces.size(), 31878U);
  const Box3 box = bounds_m(mesh);
  // the figures of the meshes' README, rounded to centimetres
  EXPECT_LT((box.min() - Vec3(-14.93, -17.68, 0.42)).cwiseAbs().maxCoeff(), 0.006);
  EXPECT_LT((box.max() - Vec3(14.93, 17.69, 8.09)).cwiseAbs().maxCoeff(), 0.006);
}

TEST(PaperMesh, PowerPlantAtAQuarterHasThePapersHeight) {
  MeshFileConfig config = file(fs::path(GNBV_SHARED_MESHES) / "powerplant.dae");
  if (!fs::exists(config.path)) GTEST_SKIP() << config.path << " is not here";
  // inches, as the file declares: the README's figures, rounded to decimetres
  const Vec3 full_m = bounds_m(load_mesh(config)).sizes();
  EXPECT_LT((full_m - Vec3(99.1, 64.7, 48.0)).cwiseAbs().maxCoeff(), 0.06) << full_m.transpose();
  config.scale = 0.25;
  std::vector<std::string> warnings;
  const TriangleMesh mesh = load_mesh(config, &warnings);
  // the file instances 4,693 triangles, 19 of them on a line
  EXPECT_EQ(mesh.faces.size(), 4693U - 19U);
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_TRUE(says(warnings[0], {"textures not there", "__auto_"}));
  EXPECT_TRUE(says(warnings[1], {"19 faces without area"}));
  const Vec3 size_m = bounds_m(mesh).sizes();
  EXPECT_NEAR(size_m.x(), 24.8, 0.05);  // README, rounded to decimetres
  EXPECT_NEAR(size_m.y(), 16.2, 0.05);
  EXPECT_NEAR(size_m.z(), 12.0, 0.05);
  EXPECT_NEAR(surface_area_m2(mesh), 1824.0, 0.5);
}

}  // namespace
}  // namespace gnbv
