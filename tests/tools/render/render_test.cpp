// Laws of tools/render: pictures agree with the geometry they show.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <vector>

#include "sim/core/error.hpp"
#include "tests/tools/render/laid_out.hpp"
#include "tools/render/geometry.hpp"

namespace gnbv {
namespace {

// read before main, hence before any renderer
const bool kLoadedAtStart = ::dlopen("libOSMesa.so.8", RTLD_LAZY | RTLD_NOLOAD) != nullptr;

constexpr Rgb kRed = {0.8F, 0.02F, 0.02F};
constexpr Rgb kBlue = {0.02F, 0.02F, 0.8F};

// A square of side 2 `half_m` in the plane x = `x_m`, facing -x.
SurfaceItem quad(double x_m, double half_m, const Rgb& colour) {
  const auto x = static_cast<float>(x_m);
  const auto h = static_cast<float>(half_m);
  SurfaceItem item;
  item.mesh.vertices_m = {{x, h, -h}, {x, -h, -h}, {x, -h, h}, {x, h, h}};
  item.mesh.faces = {{0, 2, 1}, {0, 3, 2}};
  item.mesh.materials[0].rgb = colour;
  return item;
}

RenderView view_from(const Vec3& eye_m, const Vec3& target_m, int width_px, int height_px) {
  return {.width_px = width_px,
          .height_px = height_px,
          .T_world_camera = look_at(eye_m, target_m),
          .to_light_world = Vec3(-1.0, 0.2, 0.4)};
}

// How much channel k stands out, in [0, 255]; the background is nearly grey.
int excess(const Image& image, int x, int y, std::size_t k) {
  const auto p = image.at(x, y);
  return p[k] - std::max(p[(k + 1) % 3], p[(k + 2) % 3]);
}

TEST(Render, ProgramsThatDrawNothingDoNotLoadOsMesa) { EXPECT_FALSE(kLoadedAtStart); }

TEST(Render, QuadCoversExactlyThePixelsThatSeeIt) {
  RenderScene scene;
  scene.surfaces.push_back(quad(0.0, 1.0, kRed));
  // oblique and off centre: a swapped or mirrored axis would move the shape
  const RenderView view = view_from({-9.0, 3.0, 2.0}, {0.0, 0.4, 0.3}, 320, 200);
  const Image image = render(scene, view);
  int seen = 0;
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 320; ++x) {
      const double f_px = 100.0 / std::tan(0.5 * view.fov_y_rad);
      const Vec3 ray = view.T_world_camera.linear() *
                       Vec3((x + 0.5 - 160.0) / f_px, (y + 0.5 - 100.0) / f_px, 1.0);
      const Vec3 eye = view.T_world_camera.translation();
      const Vec3 hit = eye - ray * (eye.x() / ray.x());
      const double beyond_m = std::max(std::abs(hit.y()), std::abs(hit.z())) - 1.0;
      // a pixel spans 2.7 cm there, seen obliquely under 4 cm: nearer to the edge it may be mixed
      if (beyond_m < -0.04) {
        EXPECT_GT(excess(image, x, y, 0), 60) << x << ' ' << y;
        ++seen;
      } else if (beyond_m > 0.04) {
        EXPECT_LT(excess(image, x, y, 0), 10) << x << ' ' << y;
      }
    }
  }
  EXPECT_GT(seen, 3000);
}

TEST(Render, NearerHidesFartherInAnyOrder) {
  const RenderView view = view_from({-9.0, 0.0, 0.0}, Vec3::Zero(), 64, 64);
  RenderScene scene;
  scene.surfaces = {quad(-1.0, 0.8, kRed), quad(1.0, 0.8, kBlue)};
  EXPECT_GT(excess(render(scene, view), 32, 32, 0), 60);
  std::swap(scene.surfaces[0], scene.surfaces[1]);
  EXPECT_GT(excess(render(scene, view), 32, 32, 0), 60);
  // balls and tubes take part in the same depths
  scene.balls.push_back({{-2.0F, 0.0F, 0.0F}, 0.3F, kBlue, false});
  EXPECT_GT(excess(render(scene, view), 32, 32, 2), 60);
  scene.tubes.push_back({{{-3.0F, -1.0F, 0.0F}, {-3.0F, 1.0F, 0.0F}}, {kRed}, 0.3F, false});
  EXPECT_GT(excess(render(scene, view), 32, 32, 0), 60);
}

TEST(Render, BallsAndDotsAppearWhereTheProjectionSays) {
  RenderView view = view_from({-7.0, -6.0, 5.0}, {0.3, 0.1, 0.2}, 321, 243);
  Renderer renderer;
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(-1, 1, -1),
                        Vec3(0.7, -1.1, 0.4)}) {
    for (const bool is_dot : {false, true}) {
      RenderScene scene;
      if (is_dot) {
        scene.dots = {{.points_m = {p.cast<float>()}, .colours = {kRed}, .radius_m = 0.08F}};
      } else {
        scene.add_ball(p, 0.08, kRed);
      }
      const Image image = renderer.render(scene, view);
      double weight = 0.0, u = 0.0, v = 0.0;
      for (int y = 0; y < image.height_px; ++y) {
        for (int x = 0; x < image.width_px; ++x) {
          const double w = std::max(0, excess(image, x, y, 0) - 10);
          weight += w;
          u += w * (x + 0.5);
          v += w * (y + 0.5);
        }
      }
      ASSERT_GT(weight, 500.0);
      const auto expected = project(view, p);
      ASSERT_TRUE(expected.has_value());
      // shading is uneven across a ball of radius 3.4 px: half a pixel for its centre of colour
      EXPECT_NEAR(u / weight, expected->x(), 0.5);
      EXPECT_NEAR(v / weight, expected->y(), 0.5);
    }
  }
}

TEST(Render, ProjectionMatchesThePinholeFormula) {
  const RenderView view = view_from({-10.0, 0.0, 0.0}, Vec3::Zero(), 200, 100);
  const double f_px = 50.0 / std::tan(0.5 * view.fov_y_rad);
  const auto p = project(view, {0.0, 1.0, 2.0});
  ASSERT_TRUE(p.has_value());
  EXPECT_NEAR(p->x(), 100.0 - f_px * 0.1, 1e-9);  // +y is left when looking along +x
  EXPECT_NEAR(p->y(), 50.0 - f_px * 0.2, 1e-9);
  EXPECT_NEAR(p->z(), 10.0, 1e-9);
  EXPECT_FALSE(project(view, {-11.0, 0.0, 0.0}).has_value());
}

TEST(Render, SameSceneGivesSameBytes) {
  RenderScene scene;
  scene.surfaces.push_back(quad(0.0, 1.0, kRed));
  scene.balls.push_back({{-1.0F, 0.5F, 1.0F}, 0.3F, kBlue, true});
  scene.tubes.push_back({{{-1, -2, 0}, {-1, 2, 1}, {-2, 2, 2}}, {kBlue}, 0.05F, true});
  scene.frusta.push_back({.face_opacity = 0.3F});
  scene.ground = GroundItem{-1.5, 1.0, 5.0};
  const RenderView view = view_from({-9.0, 3.0, 4.0}, Vec3::Zero(), 320, 180);
  Renderer renderer;
  const Image first = renderer.render(scene, view);
  renderer.render(scene, view_from({-5.0, 0.0, 9.0}, Vec3::Zero(), 100, 300));
  EXPECT_EQ(renderer.render(scene, view).rgb, first.rgb);  // nothing is left from other pictures
  EXPECT_EQ(render(scene, view).rgb, first.rgb);
}

TEST(Render, OsMesaAndEglDrawTheSameBytes) {
  for (const char* library : {"libOSMesa.so.8", "libEGL_mesa.so.0"}) {
    if (::dlopen(library, RTLD_LAZY) == nullptr) GTEST_SKIP() << "without " << library;
  }
  RenderScene scene;
  scene.surfaces = {quad(-1.0, 0.8, kRed), quad(1.0, 1.8, kBlue)};
  scene.balls.push_back({{-2.0F, 0.0F, 0.0F}, 0.3F, kBlue, false});
  const RenderView view = view_from({-9.0, 3.0, 2.0}, {0.0, 0.4, 0.3}, 160, 100);
  std::vector<Image> images;
  for (const char* name : {"osmesa", "egl"}) {
    ::setenv("GNBV_GL", name, 1);
    images.push_back(render(scene, view));
  }
  ::unsetenv("GNBV_GL");
  EXPECT_EQ(images[0].rgb, images[1].rgb);
  EXPECT_NE(images[0].rgb, std::vector<std::uint8_t>(images[0].rgb.size(), images[0].rgb[0]));
}

TEST(Render, ShadowFallsOppositeToTheLight) {
  RenderScene scene;
  SurfaceItem roof;  // level square, 3 m above the ground
  roof.mesh.vertices_m = {{-1, -1, 3}, {1, -1, 3}, {1, 1, 3}, {-1, 1, 3}};
  roof.mesh.faces = {{0, 1, 2}, {0, 2, 3}};
  scene.surfaces.push_back(roof);
  scene.ground = GroundItem{0.0, 100.0, 100.0};  // no grid line near
  RenderView view = view_from({0.0, -14.0, 9.0}, Vec3::Zero(), 300, 300);
  view.fov_y_rad = deg_to_rad(45.0);
  view.to_light_world = Vec3(1.0, 0.0, 1.0);
  const Image image = render(scene, view);
  const auto brightness = [&](const Vec3& p) {
    const Vec3 q = project(view, p).value();
    return static_cast<int>(image.at(static_cast<int>(q.x()), static_cast<int>(q.y()))[1]);
  };
  // light from +x at 45 degrees moves the shadow of x in [-1, 1] to [-4, -2]
  EXPECT_LT(brightness({-3.0, 0.5, 0.0}), brightness({3.0, 0.5, 0.0}) - 25);
  EXPECT_LT(brightness({-3.8, 0.5, 0.0}), brightness({3.0, 0.5, 0.0}) - 25);
  EXPECT_NEAR(brightness({-4.4, 0.5, 0.0}), brightness({4.4, 0.5, 0.0}), 2);
}

TEST(Render, SizeIsHonoured) {
  Renderer renderer;
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 300}, {3840, 2160}}) {
    RenderScene scene;
    scene.surfaces.push_back(quad(0.0, width > 1000 ? 0.5 : 4.0, kRed));  // little to shade
    const Image image =
        renderer.render(scene, view_from({-9.0, 0.0, 0.0}, Vec3::Zero(), width, height));
    EXPECT_EQ(image.width_px, width);
    EXPECT_EQ(image.height_px, height);
    ASSERT_EQ(image.rgb.size(), 3U * static_cast<std::size_t>(width * height));
    EXPECT_GT(excess(image, width / 2, height / 2, 0), 60);
  }
}

TEST(Render, ImpossibleAndHugeSizesAreRefused) {
  const auto drawn = [](int width_px, int height_px) {
    return test::fault_of([&] {
      render({}, view_from({-9, 0, 0}, Vec3::Zero(), width_px, height_px));
    });
  };
  EXPECT_NE(drawn(0, 10), "");
  EXPECT_NE(drawn(10, -1), "");
  EXPECT_NE(drawn(kMaxSide_px + 1, 10), "");
  EXPECT_NE(drawn(kMaxSide_px, kMaxSide_px).find("--width and --height"), std::string::npos);
}

TEST(Framing, HoldsEveryPointAndIsTight) {
  const std::vector<Vec3> points = {{-3, 1, 0}, {4, 2, 1}, {0, -6, 2}, {1, 1, 7}, {-2, -2, 3}};
  const FrameMargins margins{0.02, 0.05, 0.10, 0.08};
  for (const double azimuth_deg : {-170.0, -60.0, 0.0, 95.0}) {
    for (const double elevation_deg : {-40.0, 0.0, 30.0, 90.0}) {
      const ViewAngles angles{deg_to_rad(azimuth_deg), deg_to_rad(elevation_deg)};
      const RenderView view = frame_points(points, angles, 400, 300, margins);
      Eigen::AlignedBox2d box;
      for (const Vec3& p : points) box.extend(project(view, p).value().head<2>());
      // exact up to rounding
      EXPECT_GE(box.min().x(), 400 * 0.02 - 1e-6);
      EXPECT_LE(box.max().x(), 400 * 0.95 + 1e-6);
      EXPECT_GE(box.min().y(), 300 * 0.10 - 1e-6);
      EXPECT_LE(box.max().y(), 300 * 0.92 + 1e-6);
      const bool fills_x = box.sizes().x() > 400 * 0.93 - 1e-6;
      const bool fills_y = box.sizes().y() > 300 * 0.82 - 1e-6;
      EXPECT_TRUE(fills_x || fills_y) << azimuth_deg << ' ' << elevation_deg;
    }
  }
}

TEST(Framing, NothingIsRefused) {
  const std::vector<Vec3> points = {{-1, -2, 0}, {3, 2, 5}};
  EXPECT_THROW(frame_points({}, {}, 640, 480), BadInput);
  EXPECT_THROW(frame_points(points, {}, 0, 480), BadInput);
  EXPECT_THROW(frame_points(points, {}, 640, 480, {0.6, 0.6, 0.0, 0.0}), BadInput);
}

TEST(CornerNormals, CubeStaysSharpAndBentStripTurnsSmooth) {
  // two unit squares that meet at x = 0, each from `rise` on; unwelded, as many files are
  const auto strip = [](float rise) {
    TriangleMesh mesh;
    mesh.vertices_m = {{-1, 0, 0}, {0, 0, 0},    {0, 1, 0},    {-1, 1, 0},
                       {0, 0, 0},  {1, 0, rise}, {1, 1, rise}, {0, 1, 0}};
    mesh.faces = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
    return mesh;
  };
  const auto gentle = corner_normals(strip(0.5F), deg_to_rad(35.0));  // bends by 26.6 degrees
  EXPECT_LT((gentle[0][1] - gentle[2][0]).norm(), 1e-6);
  EXPECT_LT((gentle[0][0] - Vec3f::UnitZ()).norm(), 1e-6);  // far from the bend: the face's own
  const auto sharp = corner_normals(strip(1.0F), deg_to_rad(35.0));  // bends by 45 degrees
  EXPECT_LT((sharp[0][1] - Vec3f::UnitZ()).norm(), 1e-6);
  EXPECT_LT((sharp[2][0] - Vec3f(-1, 0, 1).normalized()).norm(), 1e-6);
}

TEST(Png, RoundTripsAndNamesThePathOnError) {
  Image image{5, 3, {}};
  for (int i = 0; i < 45; ++i) image.rgb.push_back(static_cast<std::uint8_t>(i * 37));
  const TempFolder temp;
  const auto path = temp.path() / "round.png";
  write_png(image, path);
  const Image back = read_png(path);
  EXPECT_EQ(back.width_px, 5);
  EXPECT_EQ(back.height_px, 3);
  EXPECT_EQ(back.rgb, image.rgb);
  for (const auto& call : {std::function<void()>([&] { write_png(image, "/nowhere/a.png"); }),
                           std::function<void()>([&] { read_png("/nowhere/a.png"); })}) {
    EXPECT_NE(test::fault_of(call).find("/nowhere/a.png"), std::string::npos);
  }
}

TEST(Png, KeepsEveryValueOfASixteenBitPicture) {
  GreyImage16 image{256, 256, {}};
  for (int i = 0; i < 65536; ++i) image.values.push_back(static_cast<std::uint16_t>(i));
  const TempFolder temp;
  const auto path = temp.path() / "grey.png";
  write_png(image, path);
  const GreyImage16 back = read_png_grey16(path);
  EXPECT_EQ(back.width_px, 256);
  EXPECT_EQ(back.values, image.values);
  write_png(Image{1, 1, {1, 2, 3}}, path);
  EXPECT_THROW(read_png_grey16(path), BadInput);
}

}  // namespace
}  // namespace gnbv
