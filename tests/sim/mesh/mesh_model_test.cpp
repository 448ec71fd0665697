// SDF and URDF models: where each visual stands, by hand, and what is refused.
#include <gtest/gtest.h>

#include "tests/sim/mesh/mesh_files.hpp"

namespace gnbv {
namespace {

class ModelFile : public test::MeshFile {
 protected:
  TriangleMesh load(const std::string& name, const std::string& content) {
    warnings_.clear();
    return load_mesh(test::file(write(name, content)), &warnings_);
  }
  std::vector<std::string> warnings_;
};

/// Of the part that each box adds: 8 vertices, in order.
std::vector<Vec3> box_centres(const TriangleMesh& mesh) {
  std::vector<Vec3> centres;
  for (std::size_t i = 0; i + 8 <= mesh.vertices_m.size(); i += 8) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < 8; ++k) sum += mesh.vertices_m[i + k].cast<double>();
    centres.push_back(sum / 8.0);
  }
  return centres;
}

void expect_places(const TriangleMesh& mesh, const std::vector<Vec3>& expected) {
  const std::vector<Vec3> centres = box_centres(mesh);
  ASSERT_EQ(centres.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_LT((centres[i] - expected[i]).norm(), 1e-6) << i << ": " << centres[i].transpose();
  }
}

const std::string kBox = "<geometry><box><size>1 1 1</size></box></geometry>";

std::string visual(const std::string& pose, const std::string& geometry = kBox) {
  return "<visual name='v'>" + pose + geometry + "</visual>";
}
std::string sdf(const std::string& model) {
  return "<?xml version='1.0'?><sdf version='1.9'>" + model + "</sdf>";
}

TEST_F(ModelFile, PosesOfAnSdfFollowWhatTheyAreRelativeTo) {
  const TriangleMesh mesh =
      load("model.sdf",
           sdf(R"(
    <model name='m'><pose>10 0 0 0 0 1.5707963267948966</pose>
      <link name='a'><pose>1 0 0 0 0 0</pose>)" +
               visual("<pose>0 0 2 0 0 0</pose>") + R"(
        <collision name='c'><geometry><box><size>9 9 9</size></box></geometry></collision></link>
      <frame name='f' attached_to='a'><pose degrees='True'>0 1 0 0 0 90</pose></frame>
      <link name='b'><pose relative_to='f'>1 0 0 0 0 0</pose>)" +
               visual("") + R"(</link>
      <joint name='j' type='fixed'><parent>a</parent><child>b</child><pose>0 0 1 0 0 0</pose></joint>
      <link name='c'><pose relative_to='j' rotation_format='quat_xyzw'>0 0 1 0 0 0 1</pose>)" +
               visual("<pose relative_to='a'>0 0 5 0 0 0</pose>") + visual("<pose/>") + R"(</link>
    </model>)"));
  // in the model: a (1,0,0), f (1,1,0) turned, b (1,2,0), j (1,2,1), c (1,2,2)
  expect_places(mesh, {{10, 1, 2}, {8, 1, 0}, {10, 1, 5}, {8, 1, 2}});
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(ModelFile, NamesAreThoseOfTheRightElement) {
  write("part.sdf", sdf("<model name='part'><link name='l'>" + visual("") + "</link></model>"));
  const auto at_x = [](const std::string& kind, int x_m) {
    return fmt::format("<{0} name='n'><pose>{1} 0 0 0 0 0</pose>{2}</{0}>", kind, x_m,
                       kind == "link" ? visual("") : "<child>n</child>");
  };
  for (const std::string& pair :
       {at_x("link", 1) + at_x("joint", 7), at_x("joint", 7) + at_x("link", 1)}) {
    expect_places(load("m.sdf", sdf("<model name='m'>" + pair + "<link name='o'>" +
                                    visual("<pose relative_to='n'/>") + "</link></model>")),
                  {{1, 0, 0}, {1, 0, 0}});
  }
  expect_places(
      load("m.sdf", sdf("<model name='m'>" + at_x("link", 1) + at_x("link", 9) + "</model>")),
      {{1, 0, 0}, {9, 0, 0}});
  const std::string include = "<include><uri>part.sdf</uri>";
  expect_places(load("m.sdf", sdf("<model name='m'>" + include +
                                  "<name>x</name><pose>5 0 0 0 0 0</pose></include>" + include +
                                  "<pose relative_to='x'>0 5 0 0 0 0</pose></include></model>")),
                {{5, 0, 0}, {5, 5, 0}});
  EXPECT_TRUE(test::says(fault("r.urdf", "<robot><link name='a'/>\n<link name='a'/></robot>"),
                         {"r.urdf:2: a second link of the name 'a'"}));
  write("m/new.sdf", sdf("<model name='m'>" + at_x("link", 3) + "</model>"));
  write("m/model.config",
        "<model><sdf version='1.10'>new.sdf</sdf><sdf version='1.9'>old</sdf></model>");
  expect_places(load_mesh(test::file(folder_ / "m")), {{3, 0, 0}});
}

TEST_F(ModelFile, IncludedModelsAndWorldsStandWhereTheyArePut) {
  std::filesystem::create_directories(folder_ / "post" / "meshes");
  write_mesh(box_mesh(Box3(Vec3(0, 0, 0), Vec3(1, 1, 1))), folder_ / "post" / "meshes" / "a b.ply");
  write("post/model.config", "<model><sdf version='1.4'>old.sdf</sdf><sdf>new.sdf</sdf></model>");
  write("post/new.sdf", sdf("<model name='post'><pose>0 0 3 0 0 0</pose><link name='l'>" +
                            visual("",
                                   "<geometry><mesh><uri>model://post/meshes/a%20b.ply</uri>"
                                   "<scale>2 2 2</scale></mesh></geometry>") +
                            "</link></model>"));
  const std::string world = sdf(
      R"(<world name='w'>
      <include><uri>model://post</uri></include>
      <include><uri>model://post</uri><pose relative_to='world'>5 0 0 0 0 0</pose></include>
      <state world_name='w'><model name='post'><pose>9 9 9 0 0 0</pose></model></state>
      <model name='ground'><link name='l'>)" +
      visual("", "<geometry><plane><normal>0 0 1</normal></plane></geometry>") + R"(</link></model>
      <model name='outer'><pose>0 7 0 0 0 0</pose>
        <model name='inner'><pose>0 1 0 0 0 0</pose><link name='l'>)" +
      visual("") + R"(</link></model>
      </model></world>)");
  expect_places(load("site.world", world), {{1, 1, 4}, {6, 1, 1}, {0, 8, 0}});
  ASSERT_EQ(warnings_.size(), 2U);
  EXPECT_TRUE(test::says(warnings_[0], {"site.world:4: <state> is not read"}));
  EXPECT_TRUE(test::says(warnings_[1], {"1 planes or heightmaps left out"}));
  MeshFileConfig folder = test::file(folder_ / "post");
  folder.offset_m = Vec3(0, 0, 10);
  expect_places(load_mesh(folder), {{1, 1, 14}});
  std::filesystem::rename(folder_ / "post", folder_ / "renamed");
  expect_places(load_mesh(test::file(folder_ / "renamed")), {{1, 1, 4}});
}

TEST_F(ModelFile, LinksOfAUrdfStandWhereJointsAtZeroPutThem) {
  const MeshFileConfig path = test::file(write("robot/urdf/r.urdf", R"(<robot name='r'>
    <link name='tip'><visual><origin xyz='1 0 0'/><geometry><box size='1 1 1'/></geometry>
      <material name='red'/></visual></link>
    <link name='base'><visual><geometry><box size='1 2 3'/></geometry></visual>
      <collision><geometry><sphere radius='9'/></geometry></collision></link>
    <link name='arm'/>
    <material name='red'><color rgba='1 0 0 1'/></material>
    <joint name='1' type='revolute'><parent link='base'/><child link='arm'/>
      <origin xyz='0 0 2' rpy='0 0 1.5707963267948966'/></joint>
    <joint name='2' type='fixed'><parent link='arm'/><child link='tip'/>
      <origin xyz='3 0 0' rpy='1.5707963267948966 0 0'/></joint></robot>)"));
  const TriangleMesh mesh = load_mesh(path);
  expect_places(mesh, {{0, 0, 0}, {0, 4, 2}});
  EXPECT_EQ(mesh.materials[mesh.face_material.back()].rgb, (std::array{1.0F, 0.0F, 0.0F}));
  EXPECT_NEAR(test::volume_m3(mesh), 7.0, 1e-5);
}

TEST_F(ModelFile, PrimitivesHaveTheirVolumeAndTurnOutwards) {
  const auto volume_of = [&](const std::string& shape) {
    return test::volume_m3(load("p.sdf", sdf("<model name='m'><link name='l'>" +
                                             visual("<pose>3 4 5 0.1 0.2 0.3</pose>",
                                                    "<geometry>" + shape + "</geometry>") +
                                             "</link></model>")));
  };
  const auto expect_near = [](double measured, double exact) {
    EXPECT_NEAR(measured, exact, 0.01 * exact);  // inscribed: a little less
    EXPECT_LT(measured, exact * (1.0 + 1e-6));
  };
  expect_near(volume_of("<sphere><radius>2</radius></sphere>"), 4.0 / 3.0 * kPi * 8.0);
  expect_near(volume_of("<cylinder><radius>2</radius><length>3</length></cylinder>"), 12.0 * kPi);
  expect_near(volume_of("<cone><radius>2</radius><length>3</length></cone>"), 4.0 * kPi);
  expect_near(volume_of("<capsule><radius>1</radius><length>3</length></capsule>"),
              (4.0 / 3.0 + 3.0) * kPi);
  expect_near(volume_of("<ellipsoid><radii>1 2 3</radii></ellipsoid>"), 4.0 / 3.0 * kPi * 6.0);
  write_mesh(box_mesh(Box3(Vec3(0, 0, 0), Vec3(1, 2, 3))), folder_ / "box.obj");
  EXPECT_NEAR(volume_of("<mesh><uri>box.obj</uri><scale>-1 1 2</scale></mesh>"), 12.0, 1e-4);
}

TEST_F(ModelFile, TheUpAxisOfColladaIsPassedOverAsGazeboDoes) {
  const std::string dae = R"(<COLLADA><asset><unit meter='0.5'/><up_axis>Y_UP</up_axis></asset>
    <library_geometries><geometry id='g'><mesh><source id='s'><float_array id='f' count='9'>
    0 0 0 2 0 0 0 2 4</float_array><technique_common><accessor source='#f' count='3' stride='3'/>
    </technique_common></source><vertices id='v'><input semantic='POSITION' source='#s'/></vertices>
    <triangles count='1'><input semantic='VERTEX' source='#v' offset='0'/><p>0 1 2</p></triangles>
    </mesh></geometry></library_geometries></COLLADA>)";
  write("a.dae", dae);
  const TriangleMesh mesh = load("r.urdf",
                                 "<robot><link name='l'><visual><geometry><mesh "
                                 "filename='package://r/a.dae'/></geometry></visual>"
                                 "</link></robot>");
  EXPECT_LT((bounds_m(mesh).max() - Vec3(1, 1, 2)).norm(), 1e-6);
}

TEST_F(ModelFile, WhatIsNotReadIsRefusedByLine) {
  const auto of_sdf = [&](const std::string& model) { return fault("m.sdf", sdf(model)); };
  const auto of_visual = [&](const std::string& pose, const std::string& geometry) {
    return of_sdf("\n<model name='m'><link name='l'>\n" + visual(pose, geometry) +
                  "</link></model>");
  };
  const auto geometry = [](const std::string& shape) {
    return "<geometry>" + shape + "</geometry>";
  };
  for (const auto& [complaint, words] :
       {std::pair(of_visual("", geometry("<polyline/>")), "m.sdf:3: <polyline> is not read"),
        {of_visual("", geometry("<mesh><uri>a.stl</uri><submesh/></mesh>")),
         "<submesh> is not read"},
        {of_visual("", geometry("<mesh><uri>m.sdf</uri></mesh>")), "m.sdf: is no mesh of a visual"},
        {of_visual("", geometry("<mesh><uri>no.stl</uri></mesh>")), "'no.stl' is neither in"},
        {of_visual("", geometry("<mesh><uri>https://x/y.dae</uri></mesh>")), "is on no disk"},
        {of_visual("", geometry("<sphere><radius>-1</radius></sphere>")), "not positive"},
        {of_visual("", geometry("<box/>")), "<box> without size"},
        {of_visual("", ""), "m.sdf:3: its <geometry> is of 0 shapes"},
        {of_visual("", geometry("<mesh><uri> </uri></mesh>")), "<mesh> names no file"},
        {of_visual("<pose>1 2 3</pose>", kBox), "<pose> has 3 numbers"},
        {of_visual("<pose>1 2 3 0 0 nan</pose>", kBox), "'nan' is no number"},
        {of_visual("<pose relative_to='z'>0 0 0 0 0 0</pose>", kBox), "the frame 'z' is not in"},
        {of_visual("<pose frame='z'>0 0 0 0 0 0</pose>", kBox), "use relative_to"},
        {of_sdf("<model placement_frame='a'/>"), "placement_frame is not"},
        {of_sdf("<include><e:params/></include>"), "params is not read"},
        {of_sdf("<model><link name='a'><pose relative_to='b'/>" + visual("") +
                "</link><link name='b'><pose relative_to='a'/></link></model>"),
         "depends on itself"},
        {of_sdf("<include><uri>m.sdf</uri></include>"), "30 deep"},
        {of_sdf("<model/>"), "no <visual> of it has any"}}) {
    EXPECT_TRUE(test::says(complaint, {words}));
  }
  const std::string joint = "<joint name='j'><parent link='a'/><child link='a'/></joint>";
  EXPECT_TRUE(test::says(fault("r.urdf", "<robot><link name='a'/>" + joint + "</robot>"),
                         {"lead back to it"}));
  EXPECT_TRUE(test::says(fault("r.urdf", "<robot>" + joint + "</robot>"), {"is no link"}));
  for (const char* const call : {"<xacro:wheel side='left'/>", "<xacro:if value='1'/>"}) {
    for (const char* const declares : {" xmlns:xacro='x'", ""}) {
      EXPECT_TRUE(test::says(fault("r.urdf", fmt::format("<robot{}>\n{}</robot>", declares, call)),
                             {"r.urdf:2: is xacro"}));
    }
  }
  std::filesystem::create_directories(folder_ / "none");
  EXPECT_TRUE(test::says(test::complaint(test::file(folder_ / "none")), {"without model.sdf"}));
}

}  // namespace
}  // namespace gnbv
