// Laws of the picture of a decision.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "sensors/capture.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/tools/render/watched.hpp"
#include "tools/render/candidate_legend.hpp"
#include "tools/render/candidate_views.hpp"
#include "tools/render/chosen_view_item.hpp"
#include "tools/render/frontier_items.hpp"
#include "tools/render/pictures.hpp"
#include "tools/render/place_marks.hpp"
#include "tools/scene/looks.hpp"
#include "tools/render/voxel_items.hpp"
#include "tools/run/candidates_jsonl.hpp"

namespace gnbv {
namespace {

Picture drawn(RunSource& run, const RenderView& view = {}) {
  PictureOptions options;
  options.iteration = kAsked;
  return kCandidatesPicture.draw(run, options, view);
}

std::optional<LegendItem> item_of(const Picture& picture, std::string_view beginning) {
  for (const LegendItem& item : picture.legend) {
    if (item.label.starts_with(beginning)) return item;
  }
  return std::nullopt;
}

/// The first balls and tubes of a scene are the candidates, in their order: a tube from where it
/// stands to where it looks, a ball at the tube's beginning where it is valid, else at its end.
bool shows(const RenderScene& scene, const Plan& plan) {
  if (scene.balls.size() < plan.candidates.size()) return false;
  if (scene.tubes.size() < plan.candidates.size()) return false;
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    const Candidate& candidate = plan.candidates[i];
    const Vec3f p_m = candidate.view.p_world_m.cast<float>();
    const TubeItem& pin = scene.tubes[i];
    const Vec3f& ball_m = candidate.rejected ? pin.points_m.back() : pin.points_m.front();
    if (scene.balls[i].centre_m != ball_m) return false;
    const Vec3f ahead = pin.points_m.back() - pin.points_m.front();
    const double yaw_rad = std::atan2(ahead.y(), ahead.x());
    if (pin.points_m.front() != p_m) return false;
    if (std::abs(wrap_angle_rad(yaw_rad - candidate.view.yaw_rad)) > 1e-3) return false;
  }
  return true;
}

TEST(CandidatesPicture, BothPanelsHoldEachCandidate) {
  const TempFolder temp;
  const Plan& plan = watched().plans[kAsked - 1];
  RunSource planned = source(temp.path());
  const Picture picture = drawn(planned);
  ASSERT_EQ(picture.panels.size(), 2U);
  for (const Panel& panel : picture.panels) EXPECT_TRUE(shows(panel.scene, plan));
  Plan fewer = plan;
  fewer.candidates.pop_back();
  // the same from the file
  const auto from_file = [&](const Plan& of_asked) {
    CandidatesFile file(temp.path(), 1);
    for (std::size_t i = 0; i < watched().plans.size(); ++i) {
      file.write(i + 1, i + 1 == kAsked ? of_asked : watched().plans[i]);
    }
    file.finish();
    RunSource read = source(temp.path());
    return drawn(read).panels.front().scene;
  };
  const std::size_t all = picture.panels.front().scene.balls.size();
  EXPECT_EQ(from_file(plan).balls.size(), all);
  const RenderScene less = from_file(fewer);
  EXPECT_TRUE(shows(less, fewer));
  EXPECT_EQ(less.balls.size() + 1, all);  // nothing but that one is gone
}

/// The close-up holds the chosen view's rays: within its pyramid, and each says something.
TEST(CandidatesPicture, RaysLieInsideTheViewAndEndOnSurfaceOrCrossTheUnknown) {
  const TempFolder temp;
  RunSource run = source(temp.path());
  const Picture picture = drawn(run);
  const RenderScene& scene = picture.panels[1].scene;
  const Scenario& scenario = watched().flown.scenario;
  const CameraModel camera = make_camera_model(scenario.cameras.front());
  const ViewPose& view = watched().flown.result.views[kAsked].decision.view;
  const Isometry T_world_camera = T_world_body(view) * camera.T_body_camera;
  const Eigen::AlignedBox2d whole_px(
      Eigen::Vector2d::Zero(), Eigen::Vector2d(camera.config.width_px, camera.config.height_px));
  const OccupancyGrid& grid = watched().beliefs[kAsked - 1].grid;
  std::size_t hits = 0;
  const std::size_t pins = watched().plans[kAsked - 1].candidates.size();
  ASSERT_GT(scene.tubes.size(), pins);
  for (std::size_t i = pins; i < scene.tubes.size(); ++i) {
    const TubeItem& piece = scene.tubes[i];
    const Vec3 end_m = piece.points_m.back().cast<double>();
    const Vec3 end = T_world_camera.inverse() * end_m;
    ASSERT_GT(end.z(), 0.0);
    EXPECT_LE(end.z(), camera.config.range_max_m + 1e-3);
    EXPECT_TRUE(whole_px.contains(pixel_of(camera, end)));
    const bool is_hit = std::any_of(scene.balls.begin(), scene.balls.end(), [&](const auto& ball) {
      return ball.centre_m == piece.points_m.back() && ball.colour == kChosenLook.hit;
    });
    hits += is_hit ? 1 : 0;
    if (!is_hit) continue;
    EXPECT_EQ(grid.state_at(end_m), VoxelState::occupied);
  }
  EXPECT_GT(hits, 0U);
  // what the first panel frames, the second sees from near
  ASSERT_TRUE(picture.panels[1].view.has_value());
  const std::optional<Vec3> at = project(*picture.panels[1].view, view.p_world_m);
  ASSERT_TRUE(at.has_value());
  EXPECT_TRUE(at->x() > 0 && at->x() < picture.panels[1].view->width_px);
  EXPECT_TRUE(at->y() > 0 && at->y() < picture.panels[1].view->height_px);
}

/// However short it is, and whatever stands before it.
TEST(CandidatesPicture, TheWayThereShowsOverEverythingAndFromBesideIt) {
  const TempFolder temp;
  RunSource run = source(temp.path());
  const Picture picture = drawn(run);
  const std::vector<ViewRecord>& views = run.record().views;
  const Vec3& before_m = views[kAsked - 1].decision.view.p_world_m;
  const Vec3& chosen_m = views[kAsked].decision.view.p_world_m;
  for (const Panel& panel : picture.panels) {
    ASSERT_GE(panel.lines.size(), 3U);
    EXPECT_EQ(panel.lines.front().from_world_m, chosen_m);
    EXPECT_EQ(panel.lines[1].from_world_m, before_m);
    EXPECT_EQ(panel.lines.back().from_world_m, before_m);
    EXPECT_LT(panel.lines.back().width, panel.lines.front().width);  // the upper dot hides no other
  }
  const RenderView& near = *picture.panels[1].view;
  const Vec3 towards = (near.T_world_camera.linear() * Vec3::UnitZ()).normalized();
  EXPECT_GT((chosen_m - before_m).normalized().cross(towards).norm(), 0.5);
}

TEST(CandidatesPicture, LinesOverTheSceneAreNotHiddenByIt) {
  const TempFolder temp;
  RunSource run = source(temp.path());
  PictureOptions options;
  options.has_caption = false;
  options.width_px = 400;
  options.height_px = 300;
  RunSource* const runs[] = {&run};
  const PanelLayout layout = lay_out(kPathPicture, runs, options);
  const Vec3 middle_m = bounds_m(run.world().structure).center();
  Picture picture = kPathPicture.draw(run, options, layout.view);
  picture.panels.front().lines = {{middle_m, middle_m, {255, 0, 255}, 8.0}};
  Renderer renderer;
  const Image image = draw_picture(picture, run, options, layout, renderer);
  const Vec3 at_px = *project(layout.view, middle_m);
  EXPECT_EQ(image.at(static_cast<int>(at_px.x()), static_cast<int>(at_px.y())),
            (Rgb8{255, 0, 255}));
}

/// A camera mounted off the body is seen to be the chosen view's.
TEST(CandidatesPicture, ThePyramidHangsOnTheChosenView) {
  const TempFolder temp;
  RunSource run = source(temp.path());
  RunRecord record = run.record();
  for (CameraConfig& camera : record.scenario.cameras) camera.p_body_m = Vec3(0, 0, -1);
  const Vec3f view = record.views[kAsked].decision.view.p_world_m.cast<float>();
  RenderScene scene;
  add_chosen_view(record, run.world(), watched().beliefs[kAsked - 1], kAsked, 0.01, scene);
  ASSERT_FALSE(scene.frusta.empty());
  const Vec3f eye = scene.frusta.front().T_world_camera.translation().cast<float>();
  EXPECT_NEAR((eye - view).norm(), 1.0, 1e-5);
  EXPECT_TRUE(std::any_of(scene.tubes.begin(), scene.tubes.end(), [&](const TubeItem& tube) {
    return tube.points_m.front() == view && tube.points_m.back() == eye;
  }));
}

/// A picture says of how many candidates it shows nothing, and its legend counts the others.
TEST(CandidatesPicture, TheNoteCountsCandidatesThatNoPanelShows) {
  const TempFolder temp;
  RunSource run = source(temp.path());
  PictureOptions options;
  options.iteration = kAsked;
  RunSource* const runs[] = {&run};
  const RenderView whole = lay_out(kCandidatesPicture, runs, options).view;
  std::vector<RenderView> views = {whole};
  const auto turn = [&](double angle_rad, const Vec3& axis) {
    views.push_back(whole);
    views.back().T_world_camera.rotate(Eigen::AngleAxisd(angle_rad, axis));
  };
  for (const double side : {-1.0, 1.0}) {
    turn(0.5 * side * whole.fov_y_rad, Vec3::UnitX());
    turn(0.7 * side * whole.fov_y_rad, Vec3::UnitY());
  }
  turn(kPi, Vec3::UnitY());  // nothing before the camera
  const std::vector<Candidate>& candidates = watched().plans[kAsked - 1].candidates;
  const OccupancyGrid& grid = watched().beliefs[kAsked - 1].grid;
  std::array<std::size_t, 4> beyond_side{};  // left, right, above, below
  for (const RenderView& view : views) {
    const Eigen::AlignedBox2d picture_px(Eigen::Vector2d::Zero(),
                                         Eigen::Vector2d(view.width_px, view.height_px));
    const Picture picture = kCandidatesPicture.draw(run, options, view);
    const RenderView& near = picture.panels[1].view.value();
    std::size_t unseen = 0;
    std::size_t seen_rejected = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const Candidate& candidate = candidates[i];
      const Vec3& p_m = candidate.view.p_world_m;
      const std::optional<Vec3> px = project(view, p_m);
      bool is_seen = false;
      for (std::size_t k = 0; k < 2; ++k) {
        const RenderView& from = k == 0 ? view : near;
        const BallItem& ball = picture.panels[k].scene.balls[i];
        const Vec3 ball_m = ball.centre_m.cast<double>();
        const std::optional<Vec3> at = project(from, ball_m);
        is_seen |= at && picture_px.contains(at->head<2>()) &&
                   !is_hidden(grid, from, ball_m, ball.radius_m);
      }
      unseen += is_seen ? 0 : 1;
      seen_rejected += is_seen && candidate.rejected ? 1 : 0;
      if (!px) continue;
      beyond_side[0] += px->x() < 0.0 ? 1 : 0;
      beyond_side[1] += px->x() > view.width_px ? 1 : 0;
      beyond_side[2] += px->y() < 0.0 ? 1 : 0;
      beyond_side[3] += px->y() > view.height_px ? 1 : 0;
    }
    const std::string all = fmt::format("{} candidates as pins", candidates.size());
    EXPECT_EQ(picture.panels.front().note,
              unseen == 0 ? all : fmt::format("{}, {} hidden or outside the picture", all, unseen));
    std::size_t said = 0;
    for (const RejectionLook& look : rejection_looks()) {
      const std::string words = fmt::format("{}: ", look.words);
      const auto item = item_of(picture, words);
      if (item) said += std::stoul(item->label.substr(words.size()));
    }
    EXPECT_EQ(said, seen_rejected);
  }
  EXPECT_GT(beyond_side[0] * beyond_side[1] * beyond_side[2] * beyond_side[3], 0U);
}

/// A run's file with other candidates for the decision that is asked for.
void write_candidates(const Plan& of_asked, const std::filesystem::path& folder) {
  CandidatesFile file(folder, 1);
  for (std::size_t i = 0; i < watched().plans.size(); ++i) {
    file.write(i + 1, i + 1 == kAsked ? of_asked : watched().plans[i]);
  }
  file.finish();
}

/// The picture of a decision between those candidates, as read from a run's file.
Picture drawn_with(const Plan& plan, const RenderView& view = {}) {
  const TempFolder temp;
  write_candidates(plan, temp.path());
  RunSource run = source(temp.path());
  return drawn(run, view);
}

/// Whoever was chosen in the end: what was sampled around clusters shows them.
TEST(CandidatesPicture, FrontiersAreShownWhereverViewsAroundThemWereSampled) {
  Plan plan = watched().plans[kAsked - 1];
  for (Candidate& candidate : plan.candidates) {
    candidate.sampler = Sampler::agvs;
    candidate.cluster = -1;
  }
  ASSERT_TRUE(!plan.chosen.empty());
  const Picture without = drawn_with(plan);
  EXPECT_FALSE(item_of(without, "frontier"));
  const std::size_t other = plan.chosen.front() == 0 ? 1 : 0;
  plan.candidates[other].sampler = Sampler::fvs;
  plan.candidates[other].cluster = 0;
  const Picture with = drawn_with(plan);
  EXPECT_TRUE(item_of(with, "frontier"));
  EXPECT_FALSE(item_of(with, "cluster looked at"));  // the chosen view is one of the grid
  for (const std::size_t panel : {0U, 1U}) {
    EXPECT_GT(with.panels[panel].scene.surfaces.size(),
              without.panels[panel].scene.surfaces.size());
  }
  EXPECT_GT(with.panels[0].labels.size(), 0U);
  EXPECT_EQ(with.panels[1].labels.size(), 0U);  // from near, they would hide the chosen view
  plan.candidates[plan.chosen.front()].sampler = Sampler::fvs;
  plan.candidates[plan.chosen.front()].cluster = 0;
  EXPECT_TRUE(item_of(drawn_with(plan), "cluster looked at"));
}

/// A bar from a number to itself would say nothing; and what the picture does not hold is the
/// note's to say.
TEST(CandidatesPicture, TheLegendSaysWhatCanBeFound) {
  Plan plan = watched().plans[kAsked - 1];
  for (Candidate& candidate : plan.candidates) {
    if (&candidate == &plan.candidates[plan.chosen.front()]) continue;
    candidate.rejected = Rejection::recently_visited;
  }
  plan.candidates[plan.chosen.front()].score.value = 1.23;
  RenderView away;
  away.T_world_camera.translate(Vec3(0, 0, 1000));  // and looks up
  const Picture picture = drawn_with(plan, away);
  const std::optional<LegendItem> valid = item_of(picture, "valid: 1, utility 1.23");
  ASSERT_TRUE(valid.has_value());
  EXPECT_EQ(valid->colours, std::vector<Rgb>{score_colours().back()});
  EXPECT_TRUE(item_of(drawn_with(plan), "unknown"));
  const OccupancyGrid& grid = watched().beliefs[kAsked - 1].grid;
  const SurfaceItem unknown = free_faces(grid, sort_voxels(grid).unknown, {1, 1, 1}, 0.5F);
  EXPECT_FALSE(is_seen(unknown, grid, away));
}

/// How much of a decision a picture from there would show, its own candidates being all valid.
std::size_t shown_from(RunSource& run, const PictureOptions& options, const ViewAngles& angles) {
  std::vector<Vec3> points_m;
  frame_candidates(run, options, points_m);
  const RenderView view = frame_points(points_m, angles, 640, 480);
  const ReplayedDecision& decision = run.decision(kAsked);
  const auto& candidates = decision.plan.candidates;
  return static_cast<std::size_t>(
      std::count_if(candidates.begin(), candidates.end(), [&](const Candidate& candidate) {
        return !is_hidden(decision.belief.grid, view, candidate.view.p_world_m, 0.0);
      }));
}

/// Whatever side of what the map knows the candidates are on, the picture is taken from there.
TEST(CandidatesPicture, IsSeenFromWhereTheMostCandidatesShow) {
  PictureOptions options;
  options.iteration = kAsked;
  std::size_t worse = 0;
  for (const Vec3& side : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)}) {
    Plan plan = watched().plans[kAsked - 1];
    const Box3 structure_m = bounds_m(watched().flown.world.structure);
    constexpr double kBeside_m = 0.4;
    for (Candidate& candidate : plan.candidates) {
      const Vec3 half_m = 0.5 * structure_m.sizes().array() + kBeside_m;
      candidate.view.p_world_m = structure_m.center() + half_m.cwiseProduct(side);
      candidate.rejected.reset();
    }
    const TempFolder temp;
    write_candidates(plan, temp.path());
    RunSource run = source(temp.path());
    RunSource* const runs[] = {&run};
    const ViewAngles best = angles_to_candidates(runs, options);
    for (int turn_deg = 0; turn_deg < 360; turn_deg += 45) {
      const ViewAngles angles{ViewAngles{}.azimuth_rad + deg_to_rad(turn_deg)};
      EXPECT_LE(shown_from(run, options, angles), shown_from(run, options, best)) << turn_deg;
      worse += shown_from(run, options, angles) < shown_from(run, options, best) ? 1 : 0;
    }
    // and the picture is, unless the user says from where
    const auto azimuth_rad = [&](const PictureOptions& asked) {
      const Vec3 back =
          -lay_out(kCandidatesPicture, runs, asked).view.T_world_camera.matrix().block<3, 1>(0, 2);
      return std::atan2(back.y(), back.x());
    };
    PictureOptions turned = options;
    turned.angles = {best.azimuth_rad + 1.0, best.elevation_rad};
    EXPECT_NEAR(wrap_angle_rad(azimuth_rad(options) - best.azimuth_rad), 0.0, 1e-9);
    EXPECT_NEAR(wrap_angle_rad(azimuth_rad(turned) - best.azimuth_rad), 1.0, 1e-9);
  }
  EXPECT_GT(worse, 0U);
}

/// Hues alone would not do for everybody: Oklab distances (Ottosson 2020).
TEST(CandidatesPicture, TheColoursOfReasonsAndMarksStandApart) {
  std::vector<Rgb> colours = {kChosenLook.chosen, kChosenLook.hit};
  for (const RejectionLook& look : rejection_looks()) {
    EXPECT_EQ(static_cast<std::size_t>(look.rejection), colours.size() - 2);  // in their order
    colours.push_back(look.colour);
  }
  const auto oklab = [](const Rgb& c) {
    const Vec3 rgb(c[0], c[1], c[2]);
    const Eigen::Matrix3d lms{{0.4122214708, 0.5363325363, 0.0514459929},
                              {0.2119034982, 0.6806995451, 0.1073969566},
                              {0.0883024619, 0.2817188376, 0.6299787005}};
    const Eigen::Matrix3d lab{{0.2104542553, 0.7936177850, -0.0040720468},
                              {1.9779984951, -2.4285922050, 0.4505937099},
                              {0.0259040371, 0.7827717662, -0.8086757660}};
    return Vec3(lab * Vec3(lms * rgb).array().pow(1.0 / 3.0).matrix());
  };
  constexpr double kApart = 0.13;  // six times what is just noticed side by side
  for (std::size_t i = 0; i < colours.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_GT((oklab(colours[i]) - oklab(colours[k])).norm(), kApart) << i << " and " << k;
    }
  }
}

}  // namespace
}  // namespace gnbv
