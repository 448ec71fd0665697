// Laws of light and of what stands for surfaces: hollows, ghosts, dots and voxels.
#include <gtest/gtest.h>

#include "sim/core/error.hpp"
#include "tests/sim/mesh/mesh_files.hpp"
#include "tools/render/renderer.hpp"
#include "tools/scene/voxels.hpp"

namespace gnbv {
namespace {

constexpr Rgb kWhite = {0.8F, 0.8F, 0.8F};

// A level square of side 8 m at z = 0, and perhaps a wall of 4 m along its side x = 0.
RenderScene floor_scene(bool has_wall) {
  SurfaceItem item;
  item.mesh.vertices_m = {{0, -4, 0}, {8, -4, 0}, {8, 4, 0}, {0, 4, 0}, {0, -4, 4}, {0, 4, 4}};
  item.mesh.faces = {{0, 1, 2}, {0, 2, 3}};
  if (has_wall) item.mesh.faces.insert(item.mesh.faces.end(), {{0, 3, 5}, {0, 5, 4}});
  item.mesh.materials[0].rgb = kWhite;
  RenderScene scene;
  scene.surfaces.push_back(item);
  return scene;
}

RenderView floor_view() {
  return {.width_px = 640,
          .height_px = 480,
          .T_world_camera = look_at({14.0, -6.0, 12.0}, {3.0, 0.0, 0.5}),
          .to_light_world = Vec3(1.0, 0.0, 1.0)};  // no shadow on the floor
}

double brightness(const Image& image, const RenderView& view, const Vec3& p_world_m) {
  const Vec3 p = project(view, p_world_m).value();
  double sum = 0.0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      sum += image.at(static_cast<int>(p.x()) + dx, static_cast<int>(p.y()) + dy)[1];
    }
  }
  return sum / 9.0;
}

TEST(AmbientOcclusion, DarkensACornerAndNotAnOpenPlane) {
  const RenderView view = floor_view();
  Renderer renderer;
  const Image open = renderer.render(floor_scene(false), view);
  const Image corner = renderer.render(floor_scene(true), view);
  // a hand from the wall against the middle; haze alone darkens the far edge by a few, too
  const auto fall = [&](const Image& image) {
    return brightness(image, view, {4, 0, 0}) - brightness(image, view, {0.12, 0, 0});
  };
  EXPECT_GT(fall(corner), fall(open) + 8.0);
  EXPECT_NEAR(brightness(corner, view, {4, 0, 0}), brightness(open, view, {4, 0, 0}), 2.0);
  // an open plane is as even as without any occlusion: what is left is gloss and haze
  for (double x = 2.0; x < 6.0; x += 0.5) {
    EXPECT_NEAR(brightness(open, view, {x, 0, 0}), brightness(open, view, {x + 0.25, 0, 0}), 1.5);
  }
}

TEST(AmbientOcclusion, ReachesNoFartherThanAskedFor) {
  const RenderView view = floor_view();
  Renderer renderer;
  RenderScene scene = floor_scene(true);
  const Image wide = renderer.render(scene, view);
  scene.hollow_m = 0.05;  // under what lies between the wall and the place that is looked at
  const Image narrow = renderer.render(scene, view);
  EXPECT_GT(brightness(narrow, view, {0.12, 0, 0}), brightness(wide, view, {0.12, 0, 0}) + 8.0);
  EXPECT_NEAR(brightness(narrow, view, {4, 0, 0}), brightness(wide, view, {4, 0, 0}), 2.0);
}

TEST(Ghost, ShowsOneLayerAndWhatIsBehindIt) {
  const RenderView view{
      .width_px = 64, .height_px = 64, .T_world_camera = look_at({-9, 0, 0}, Vec3::Zero())};
  const auto centre = [&](int sheets, bool has_ball) {
    RenderScene scene;
    for (int i = 0; i < sheets; ++i) {
      const auto x = static_cast<float>(-i);  // the nearest comes last
      SurfaceItem sheet;
      sheet.mesh.vertices_m = {{x, 2, -2}, {x, -2, -2}, {x, -2, 2}, {x, 2, 2}};
      sheet.mesh.faces = {{0, 2, 1}, {0, 3, 2}};
      sheet.mesh.materials[0].rgb = {0, 0, 0};
      sheet.opacity = 0.4F;
      scene.surfaces.push_back(sheet);
    }
    if (has_ball) scene.balls.push_back({{5, 0, 0}, 1.0F, {0.8F, 0.02F, 0.02F}, false});
    return render(scene, view).at(32, 32);
  };
  // not once for each sheet, which would take 60 each; haze and gloss take a few
  EXPECT_NEAR(centre(3, false)[1], centre(1, false)[1], 6);
  EXPECT_LT(centre(1, false)[1], centre(0, false)[1] - 10);
  EXPECT_GT(centre(1, true)[0], centre(1, true)[2] + 20);  // red shines through
}

TEST(PointNormals, StandOnAPlaneAndAreUnknownOnALine) {
  std::vector<Vec3f> plane;
  const Vec3f n = Vec3f(1, 2, 2).normalized();
  const Vec3f a = n.unitOrthogonal();
  const Vec3f b = n.cross(a);
  for (int i = 0; i < 900; ++i) {
    plane.push_back(0.02F * static_cast<float>(i % 30) * a +
                    0.02F * static_cast<float>(i / 30) * b);
  }
  // float32 coordinates of 1 m: slopes to a millionth or so over 0.3 m
  for (const Vec3f& found : point_normals(plane, 0.1)) EXPECT_GT(std::abs(found.dot(n)), 0.9999F);
  std::vector<Vec3f> line;
  for (int i = 0; i < 50; ++i) line.push_back(Vec3f(0.02F * static_cast<float>(i), 0.05F, 0.05F));
  for (const Vec3f& found : point_normals(line, 0.1)) EXPECT_TRUE(found.isZero());
}

TEST(Voxels, AreSortedAsTheMapHasThem) {
  // a wall of occupied voxels in free space; behind it nothing was measured
  OccupancyGrid grid(OccupancyConfig{}, Box3(Vec3(0, 0, 0), Vec3(4, 2, 2)));
  const GridGeometry& geometry = grid.geometry();
  ScanUpdate scan;
  for (VoxelIndex v = 0; v < geometry.voxel_count(); ++v) {
    const std::int32_t x = geometry.key_at(v)[0];
    if (x < 10) scan.free.push_back(v);
    if (x == 10 && geometry.key_at(v)[2] != 5) scan.occupied.push_back(v);
  }
  grid.apply(scan);
  ASSERT_TRUE(grid.predict(geometry.index_of({15, 5, 5})));
  const SortedVoxels sorted = sort_voxels(grid);
  EXPECT_EQ(sorted.occupied, scan.occupied);
  EXPECT_EQ(sorted.occupied.size(), grid.occupied_count());
  EXPECT_EQ(sorted.predicted.size(), grid.predicted_count());
  // the gap at z = 5: ten voxels, each next to a free one; nothing behind the wall is
  EXPECT_EQ(sorted.unknown.size(), 10U);
  for (const VoxelIndex v : sorted.unknown) EXPECT_EQ(geometry.key_at(v)[0], 10);
  EXPECT_EQ(free_faces(grid, sorted.unknown, kWhite, 0.5F).mesh.faces.size(), 2U * 10U);
  const std::vector<Rgb> white = {kWhite};
  const SurfaceItem cubes = voxel_cubes(geometry, sorted.occupied, white, 1.0);
  EXPECT_EQ(cubes.mesh.faces.size(), 12U * sorted.occupied.size());
  // each cube is closed, looks outward and has the volume of its voxel
  EXPECT_NEAR(test::volume_m3(cubes.mesh), 0.008 * static_cast<double>(sorted.occupied.size()),
              1e-4);
}

/// Where colours are data, light bends them less: the shaded side comes nearer to the lit one.
TEST(Light, ShadingIsTheShareOfItThatASceneTakes) {
  RenderScene scene = floor_scene(true);
  RenderView view = floor_view();
  view.to_light_world = Vec3(0.1, 0.0, 1.0);  // the wall is turned from it
  const Vec3 on_floor(5.0, 0.0, 0.0);
  const Vec3 on_wall(0.0, 0.0, 2.5);
  const auto apart = [&](float shading) {
    scene.shading = shading;
    const Image image = render(scene, view);
    return std::abs(brightness(image, view, on_floor) - brightness(image, view, on_wall));
  };
  EXPECT_GT(apart(1.0F), 20.0);
  EXPECT_LT(apart(kDataShading), 0.8 * apart(1.0F));
  EXPECT_LT(apart(0.0F), apart(kDataShading));
}

}  // namespace
}  // namespace gnbv
