// Laws of the pictures of runs: what the files say is what is drawn.
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/core/error.hpp"
#include "tests/tools/render/laid_out.hpp"
#include "tools/render/snapshots.hpp"

namespace gnbv {
namespace {

TEST(Pictures, OneCameraShowsWhatAllRunsHave) {
  RunSource narrow(made_record(), cube());
  RunRecord far = made_record();
  far.views[1].decision.view.p_world_m = {20, 4, 2};
  far.path[3] = made_sample(3, {20, 4, 2});
  RunSource wide(far, cube());
  RunSource* const both[] = {&narrow, &wide};
  RunSource* const turned[] = {&wide, &narrow};
  RunSource* const one[] = {&narrow};
  const RenderView shared = lay_out(kPathPicture, both, {}).view;
  const RenderView again = lay_out(kPathPicture, turned, {}).view;
  const RenderView alone = lay_out(kPathPicture, one, {}).view;
  for (const ViewRecord& view : far.views) {
    EXPECT_TRUE(is_within(shared, view.decision.view.p_world_m));
    const Vec3 p = project(shared, view.decision.view.p_world_m).value();
    EXPECT_LT((p - project(again, view.decision.view.p_world_m).value()).norm(), 1e-6);
  }
  EXPECT_GT(px_per_m_at_focus(alone), px_per_m_at_focus(shared));
}

TEST(Pictures, OfEachKindFindALayoutAtAnySize) {
  RunSource run(made_record(), cube());
  for (const auto& [width, height] :
       {std::pair(480, 270), std::pair(320, 240), std::pair(240, 320), std::pair(320, 2000),
        std::pair(2000, 240), std::pair(40, 30), std::pair(16, 16), std::pair(1280, 720)}) {
    for (const bool has_caption : {true, false}) {
      for (const PictureKind* kind : picture_kinds()) {
        // frame what a true mission had to choose from, or meant to do
        if (kind->name == "candidates" || kind->name == "plan") continue;
        const PictureOptions options{
            .width_px = width, .height_px = height, .has_caption = has_caption};
        const PanelLayout layout = layout_of(*kind, run, options);
        EXPECT_GE(layout.columns * layout.rows, kind->panels);
        const auto [x, y] =
            layout.place_px(static_cast<std::size_t>(layout.columns * layout.rows) - 1);
        EXPECT_GE(x + layout.view.width_px, width);
        EXPECT_GE(y + layout.view.height_px, height - layout.foot_px);
        EXPECT_EQ(layout.head_px > 0, has_words(options));
        EXPECT_LT(y, height - layout.foot_px);
        for (const Vec3f& v : run.world().structure.vertices_m) {
          EXPECT_TRUE(is_within(layout.view, v.cast<double>()))
              << kind->name << ' ' << width << ' ' << height;
        }
      }
    }
  }
}

/// Whatever panels show, the words above, between and below them look the same; and each panel
/// shows it from border to border.
TEST(Pictures, WordsOfPanelsHavePaperThatNoPanelReaches) {
  RunSource run(made_record(), cube());
  Renderer renderer;
  for (const auto& [width, height] : {std::pair{960, 540}, {540, 960}}) {
    const PictureOptions options{.width_px = width, .height_px = height};
    const PanelLayout layout = layout_of(kCoveragePicture, run, options);
    Picture picture{.panels = std::vector<Panel>(2), .detail = "d", .legend = {{"l", {srgb(0)}}}};
    for (Panel& panel : picture.panels) panel.note = "note";
    const Image empty = draw_picture(picture, run, options, layout, renderer);
    for (Panel& panel : picture.panels) {
      panel.scene.balls.push_back({Vec3f(0, 0, 1), 3.0F, srgb(0x102030)});
      panel.labels.push_back({Vec3(50, 0, 1), "a word beside a place far off"});
    }
    const Image full = draw_picture(picture, run, options, layout, renderer);
    picture.detail = "other figures";  // neither do words reach a panel
    picture.legend.front().label = "other words";
    const Image reworded = draw_picture(picture, run, options, layout, renderer);
    EXPECT_NE(reworded.rgb, full.rgb);
    EXPECT_EQ((std::array{full.width_px, full.height_px}), (std::array{width, height}));
    std::vector<std::uint8_t> is_panel(empty.rgb.size() / 3);
    for (std::size_t i = 0; i < 2; ++i) {
      const auto [x0, y0] = layout.place_px(i);
      EXPECT_GE(y0, layout.head_px + layout.note_px);
      const int middle_x = x0 + layout.view.width_px / 2;
      const int middle_y = y0 + layout.view.height_px / 2;
      EXPECT_NE(full.at(middle_x, middle_y), empty.at(middle_x, middle_y));
      for (int y = y0; y < std::min(height - layout.foot_px, y0 + layout.view.height_px); ++y) {
        for (int x = x0; x < std::min(width, x0 + layout.view.width_px); ++x) {
          is_panel[static_cast<std::size_t>(y * width + x)] = 1;
          ASSERT_EQ(reworded.at(x, y), full.at(x, y)) << x << ' ' << y;
        }
      }
    }
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (is_panel[static_cast<std::size_t>(y * width + x)] != 0) continue;
        ASSERT_EQ(full.at(x, y), empty.at(x, y)) << x << ' ' << y;
      }
    }
  }
}

TEST(Pictures, SheetHoldsEveryImageWhereItBelongs) {
  std::vector<Image> images;
  for (std::uint8_t i = 0; i < 3; ++i) {
    images.push_back({2, 2, std::vector<std::uint8_t>(6, i)});
    images.back().rgb.resize(12, static_cast<std::uint8_t>(100 + i));  // the second row
  }
  const Image sheet = contact_sheet(images, 2);
  EXPECT_EQ((std::array{sheet.width_px, sheet.height_px}), (std::array{4, 4}));
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(sheet.at(2 * (i % 2), 2 * (i / 2))[0], i);
    EXPECT_EQ(sheet.at(2 * (i % 2) + 1, 2 * (i / 2) + 1)[0], 100 + i);
  }
  EXPECT_EQ(sheet.at(3, 2)[0], 255);  // empty
  images[0] = {};                     // could not be drawn
  EXPECT_EQ(contact_sheet(images, 2).at(1, 0)[0], 255);
  EXPECT_EQ(contact_sheet(images, 2).at(2, 0)[0], 1);
}

TEST(Pictures, SheetsLettersTheirCellsAndSayALegendOnceARow) {
  DrawnPicture drawn{.image = paper(480, 270, 200),
                     .caption = {.title = "t", .detail = "", .legend = {{"what", {srgb(0)}}}}};
  const auto lower_half = [](const Image& image) {
    return std::vector<std::uint8_t>(image.rgb.begin() + 3 * 480 * 200, image.rgb.end());
  };
  DrawnPicture other = drawn;
  other.caption.legend = {{"else", {srgb(0xff0000)}}};
  DrawnPicture bare = drawn;
  bare.caption.legend.clear();
  const std::vector<Image> same = sheet_cells({drawn, drawn}, 2);
  EXPECT_EQ(lower_half(same[0]), lower_half(with_words(bare)));
  // a white line parts it from its neighbour
  constexpr int kLine_px = 6;
  const Image alone = with_words(drawn);
  EXPECT_EQ(same[1].at(0, 150), (Rgb8{255, 255, 255}));
  EXPECT_EQ(same[0].at(0, 150), (Rgb8{200, 200, 200}));
  for (int y = 200; y < 270; ++y) {
    for (int x = kLine_px; x < 480; ++x) {
      ASSERT_EQ(same[1].at(x, y), alone.at(x, y)) << x << ' ' << y;
    }
  }
  EXPECT_NE(same[1].rgb, with_words(drawn).rgb);  // (b)
  // another legend, or the next row, says it itself
  for (const auto& cells : {sheet_cells({drawn, other}, 2), sheet_cells({drawn, drawn}, 1)}) {
    EXPECT_EQ(lower_half(cells[0]), lower_half(with_words(drawn)));
  }
  EXPECT_TRUE(sheet_cells({{}, drawn}, 2)[0].rgb.empty());
}

TEST(Pictures, ViewsAreCountedFromOneAndIterationsFromZero) {
  EXPECT_EQ(views_so_far(made_record(), 2), "3 views");
  EXPECT_EQ(views_so_far(made_record(), 1), "2 of 3 views (iteration 1)");
}

TEST(Pictures, ColoursMeanTheSameInAllRuns) {
  RunSource low(made_record(), cube());
  World tower = cube();
  for (Vec3f& v : tower.structure.vertices_m) v.z() *= 5.0F;
  RunSource high(made_record(), tower);
  RunSource* const both[] = {&low, &high};
  const PictureOptions shared = with_shared_colours(kVoxelsPicture, both, {});
  EXPECT_EQ(shared.colour_range, (std::array<double, 2>{0.0, 10.0}));
  EXPECT_FALSE(with_shared_colours(kPathPicture, both, {}).colour_range.has_value());
  // without files there are no points to be coloured: left out, and no fault of the others
  EXPECT_FALSE(with_shared_colours(kCloudPicture, both, {}).colour_range.has_value());
}

TEST(Pictures, UnknownKindsAndViewsAreNamed) {
  EXPECT_THROW(picture_kind("paths"), BadInput);
  for (const PictureKind* kind : picture_kinds()) EXPECT_EQ(&picture_kind(kind->name), kind);
  EXPECT_THROW(iteration_of(made_record(), {.iteration = 3}, 0), BadInput);
  EXPECT_EQ(iteration_of(made_record(), {.iteration = 2}, 0), 2U);
  EXPECT_EQ(iteration_of(made_record(), {}, 77), 2U);  // the last one
}

TEST(CloudPicture, ColoursRunFromOnePointToTheLegendsTop) {
  MadeRun made;  // six points, each alone in its voxel
  RunSource lone = made.source();
  const auto drawn = kCloudPicture.draw(lone, {}, {});
  const std::vector<Rgb>& colours = drawn.panels.at(0).scene.dots.at(0).colours;
  for (std::size_t i = lone.cloud().profile_points; i < colours.size(); ++i) {
    EXPECT_EQ(colours[i], amount_ramp(0.0));
  }
  std::vector<Vec3f> points;
  for (int i = 0; i < 40; ++i) points.push_back({3.01F + 0.001F * static_cast<float>(i), 3.01F, 1});
  points.push_back({0, 0, 1});
  write_cloud_ply(points, made.temp.path() / "cloud.ply");
  made.record.views.back().cloud_points = points.size();
  write_cloud_ply(std::span(points).first(2), made.temp.path() / "profile.ply");
  RunSource dense = made.source();
  const auto dots = kCloudPicture.draw(dense, {}, {}).panels.at(0).scene.dots.at(0);
  EXPECT_EQ(dots.colours.back(), amount_ramp(0.0));  // what the low end of the legend says
  EXPECT_EQ(dots.colours.front(), amount_ramp(1.0));
}

/// The profile's sparse points would be read as the low end of the density that cameras give.
TEST(CloudPicture, WhatTheProfileAloneHasSeenIsPale) {
  MadeRun made;
  const std::vector<Vec3f> points = {{0, 0, 1}, {3.01F, 3.01F, 1}, {3.02F, 3.01F, 1}};
  write_cloud_ply(points, made.temp.path() / "cloud.ply");
  for (ViewRecord& view : made.record.views) view.cloud_points = points.size();
  write_cloud_ply(std::span(points).first(2), made.temp.path() / "profile.ply");
  RunSource run = made.source();
  const Picture picture = kCloudPicture.draw(run, {}, {});
  const std::vector<Rgb>& colours = picture.panels.at(0).scene.dots.at(0).colours;
  ASSERT_EQ(picture.legend.size(), 2U);
  EXPECT_EQ(picture.legend[0].label, "seen before the first view alone: 1 point");
  EXPECT_EQ(colours[0], picture.legend[0].colours[0]);
  EXPECT_NE(colours[1], colours[0]);  // a camera has seen its voxel
  EXPECT_EQ(colours[1], colours[2]);
}

TEST(CloudPicture, DrawsEveryPointOfTheCloudUpToTheViewAndNamesTheMiddleOfTheBar) {
  const MadeRun made;
  RunSource run = made.source();
  for (const auto& [iteration, points] : {std::pair{2, 6U}, {1, 5U}}) {
    const Picture picture =
        kCloudPicture.draw(run, {.iteration = iteration, .colour_range = {{1.0, 21.0}}}, {});
    EXPECT_EQ(picture.panels.at(0).scene.dots.at(0).points_m.size(), points);
    EXPECT_EQ(picture.legend.back().label_middle, "11");
  }
}

TEST(CameraChoice, AFileIsACameraAndANameIsADirection) {
  const TempFolder temp;
  const auto file = temp.path() / "camera.json";
  write_file_atomically(file, R"({"position_m": [0, -9, 3], "target_m": [0, 0, 3],
                                  "fov_y_deg": 50})");
  const RenderView view = choose_camera(file.string()).camera.value();
  EXPECT_NEAR(view.fov_y_rad, deg_to_rad(50.0), 1e-12);
  EXPECT_NEAR(view.focus_m, 9.0, 1e-12);
  const Vec3 centre = project(view, {0, 0, 3}).value();
  EXPECT_NEAR(centre.x(), 640.0, 1e-9);
  EXPECT_NEAR(centre.y(), 360.0, 1e-9);
  // lit as the same view of a preset's direction is
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 1, 1}};
  const RenderView south = frame_points(points, {deg_to_rad(-90.0), 0.0}, 100, 100);
  EXPECT_LT((view.to_light_world - south.to_light_world).norm(), 1e-9);
  RunSource run(made_record(), cube());
  EXPECT_EQ(view_of(kPathPicture, run, {.camera = view}).to_light_world, view.to_light_world);
  EXPECT_FALSE(choose_camera("top").camera.has_value());
}

}  // namespace
}  // namespace gnbv
