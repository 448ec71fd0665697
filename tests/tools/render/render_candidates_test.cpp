// Laws of the picture of a decision, and of what it is made of.
#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

#include "sim/core/error.hpp"
#include "tests/tools/render/laid_out.hpp"
#include "tests/tools/render/watched.hpp"
#include "tools/run/decision_lines.hpp"
#include "tools/scene/decision.hpp"
#include "tools/scene/voxels.hpp"

namespace gnbv {
namespace {

PictureOptions asked() { return {.iteration = kAsked}; }

const Plan& planned() { return watched().plans.at(kAsked); }
const OccupancyGrid& grid_before() { return watched().beliefs[kAsked - 1].grid; }

/// A run's file with other candidates for the decision that is asked for.
void write_candidates(const Plan& of_asked, const std::filesystem::path& folder) {
  CandidatesFile file(folder, 1);
  for (const auto& [iteration, plan] : watched().plans) {
    file.write(iteration, iteration == kAsked ? of_asked : plan);
  }
  file.finish();
}

/// The picture of a decision between those candidates, as read from a run's file.
Picture drawn_with(const Plan& plan, const RenderView& view = {}) {
  const TempFolder temp;
  write_candidates(plan, temp.path());
  RunSource run = source(temp.path());
  return kCandidatesPicture.draw(run, asked(), view);
}

std::optional<LegendItem> item_of(const Picture& picture, std::string_view beginning) {
  for (const LegendItem& item : picture.legend) {
    if (item.label.starts_with(beginning)) return item;
  }
  return std::nullopt;
}

/// The first balls and tubes of a scene are the candidates, in their order: a pin from where each
/// stands to where it looks, the ball at its beginning where it is valid, else at its end.
bool holds(const RenderScene& scene, const Plan& plan) {
  if (std::min(scene.balls.size(), scene.tubes.size()) < plan.candidates.size()) return false;
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    const Candidate& candidate = plan.candidates[i];
    const std::vector<Vec3f>& pin_m = scene.tubes[i].points_m;
    const Vec3f& ball_m = scene.balls[i].centre_m;
    if (pin_m.front() != candidate.view.p_world_m.cast<float>()) return false;
    if (((candidate.rejected ? pin_m.back() : pin_m.front()) - ball_m).norm() > 1e-5F) return false;
    const Vec3f ahead = pin_m.back() - pin_m.front();
    const double yaw_rad = std::atan2(ahead.y(), ahead.x());
    if (std::abs(wrap_angle_rad(yaw_rad - candidate.view.yaw_rad)) > 1e-3) return false;
  }
  return true;
}

TEST(CandidatesPicture, HoldsEachCandidateWhetherReadOrPlannedAgain) {
  const TempFolder temp;
  RunSource again = source(temp.path());
  const RenderScene scene = kCandidatesPicture.draw(again, asked(), {}).panels.at(0).scene;
  EXPECT_TRUE(holds(scene, planned()));
  EXPECT_EQ(drawn_with(planned()).panels.at(0).scene.balls.size(), scene.balls.size());
  Plan fewer = planned();
  fewer.candidates.pop_back();
  const RenderScene less = drawn_with(fewer).panels.at(0).scene;
  EXPECT_TRUE(holds(less, fewer));
  EXPECT_EQ(less.balls.size() + 1, scene.balls.size());  // nothing but that one is gone
}

/// Within the chosen view's pyramid, and each says something.
TEST(CandidatesPicture, RaysLieInsideTheViewAndEndOnSurfaceOrCrossTheUnknown) {
  const Flown& flown = watched().flown;
  RenderScene scene;
  RunRecord record{.folder = {}, .scenario = flown.scenario, .views = flown.result.views};
  add_chosen_view(record, flown.world, watched().beliefs[kAsked - 1], kAsked, 0.01, scene);
  const CameraModel camera = make_camera_model(record.scenario.cameras.front());
  const ViewPose& view = record.views[kAsked].decision.view;
  const Isometry T_world_camera = T_world_body(view) * camera.T_body_camera;
  const Eigen::AlignedBox2d whole_px(
      Eigen::Vector2d::Zero(), Eigen::Vector2d(camera.config.width_px, camera.config.height_px));
  ASSERT_FALSE(scene.tubes.empty());
  ASSERT_FALSE(scene.balls.empty());
  std::size_t unknown = 0;
  for (const TubeItem& piece : scene.tubes) {
    const Vec3 end = T_world_camera.inverse() * piece.points_m.back().cast<double>();
    ASSERT_GT(end.z(), 0.0);
    EXPECT_LE(end.z(), camera.config.range_max_m + 1e-3);
    EXPECT_TRUE(whole_px.contains(pixel_of(camera, end)));
    const Vec3 middle_m = 0.5 * (piece.points_m.front() + piece.points_m.back()).cast<double>();
    const bool is_unknown = piece.colours.front() == looks::kRayUnknown.rgb();
    if ((piece.points_m.front() - piece.points_m.back()).norm() < 0.2F) continue;
    EXPECT_EQ(grid_before().state_at(middle_m) == VoxelState::unknown, is_unknown);
    unknown += is_unknown ? 1 : 0;
  }
  for (const BallItem& hit : scene.balls) {
    EXPECT_EQ(grid_before().state_at(hit.centre_m.cast<double>()), VoxelState::occupied);
    EXPECT_TRUE(std::any_of(scene.tubes.begin(), scene.tubes.end(), [&](const TubeItem& piece) {
      return piece.points_m.back() == hit.centre_m;
    }));
  }
  EXPECT_GT(unknown, 0U);
}

/// However short it is, and whatever stands before it.
TEST(CandidatesPicture, TheWayThereShowsOverEverything) {
  const TempFolder temp;
  RunSource run = source(temp.path());
  const PictureOptions options{
      .width_px = 400, .height_px = 300, .iteration = kAsked, .has_caption = false};
  const PanelLayout layout = layout_of(kCandidatesPicture, run, options);
  Picture picture = kCandidatesPicture.draw(run, options, layout.view);
  const std::vector<PlaceLine>& lines = picture.panels.at(0).lines;
  const std::vector<ViewRecord>& views = run.record().views;
  EXPECT_EQ(lines.front().from_world_m, views[kAsked].decision.view.p_world_m);
  EXPECT_EQ(lines[1].from_world_m, views[kAsked - 1].decision.view.p_world_m);
  EXPECT_LT(lines.back().width, lines.front().width);  // the upper dot hides no other
  const Vec3 middle_m = bounds_m(run.world().structure).center();
  picture.panels.at(0).lines = {{middle_m, middle_m, srgb(0xff00ff), 8.0}};
  Renderer renderer;
  const Image image = draw_picture(picture, run, options, layout, renderer);
  const Vec3 at_px = *project(layout.view, middle_m);
  EXPECT_EQ(image.at(static_cast<int>(at_px.x()), static_cast<int>(at_px.y())),
            (Rgb8{255, 0, 255}));
}

/// The legend counts what of each reason is in sight, and the detail what is not.
TEST(CandidatesPicture, CountsWhatItDoesNotShow) {
  const TempFolder temp;
  RunSource run = source(temp.path());
  const RenderView whole = view_of(kCandidatesPicture, run, asked());
  std::size_t most_unseen = 0;
  for (const double turn_rad : {0.0, 0.5 * whole.fov_y_rad, -0.7 * whole.fov_y_rad, kPi}) {
    RenderView view = whole;
    view.T_world_camera.rotate(Eigen::AngleAxisd(turn_rad, Vec3::UnitY()));
    const Picture picture = kCandidatesPicture.draw(run, asked(), view);
    std::size_t unseen = 0;
    std::size_t seen_rejected = 0;
    for (std::size_t i = 0; i < planned().candidates.size(); ++i) {
      const BallItem& ball = picture.panels[0].scene.balls[i];
      const bool is_seen = shows(view, grid_before(), ball.centre_m.cast<double>(),
                                 static_cast<double>(ball.radius_m));
      unseen += is_seen ? 0 : 1;
      seen_rejected += is_seen && planned().candidates[i].rejected ? 1 : 0;
    }
    const std::string words = std::to_string(unseen) + " hidden or outside the picture";
    EXPECT_EQ(picture.detail.ends_with(words), unseen > 0) << picture.detail;
    std::size_t said = 0;
    for (const RejectionLook& look : rejection_looks()) {
      const std::string before = std::string(look.words) + ": ";
      if (const auto item = item_of(picture, before)) {
        said += std::stoul(item->label.substr(before.size()));
        EXPECT_EQ(item->colours.front(), look.rgb());
      }
    }
    EXPECT_EQ(said, seen_rejected);
    most_unseen = std::max(most_unseen, unseen);
  }
  EXPECT_EQ(most_unseen, planned().candidates.size());  // nothing is behind the camera's back
}

TEST(CandidatesPicture, TheLegendNamesWhatIsThereAndNothingElse) {
  Plan plan = planned();
  const std::size_t chosen = plan.chosen.at(0);
  for (Candidate& candidate : plan.candidates) {
    candidate.sampler = Sampler::agvs;
    candidate.cluster = -1;
    candidate.rejected = Rejection::recently_visited;
  }
  plan.candidates[chosen].rejected.reset();
  plan.candidates[chosen].score.value = 1.23;
  RunSource run = source();
  const RenderView view = view_of(kCandidatesPicture, run, asked());
  const Picture grid = drawn_with(plan, view);
  const auto valid = item_of(grid, "valid: 1, utility 1.23");  // a bar would say nothing
  ASSERT_TRUE(valid.has_value());
  EXPECT_EQ(valid->colours, std::vector<Rgb>{score_colours().back()});
  EXPECT_TRUE(item_of(grid, "occupied"));
  EXPECT_FALSE(item_of(grid, "frontier"));
  // whoever was chosen in the end: what was sampled around clusters shows them
  Candidate& other = plan.candidates[chosen == 0 ? 1 : 0];
  other.sampler = Sampler::fvs;
  other.cluster = 0;
  const Picture frontiers = drawn_with(plan, view);
  EXPECT_GT(frontiers.panels[0].scene.surfaces.size(), grid.panels[0].scene.surfaces.size());
  EXPECT_TRUE(item_of(frontiers, "frontier"));
  EXPECT_FALSE(item_of(frontiers, "frontier looked at"));  // the chosen view is one of the grid
  RenderView away;
  away.T_world_camera.translate(Vec3(0, 0, 1000));  // and looks up
  for (const Look& look : {looks::kOccupied, looks::kUnknown, looks::kFrontier, looks::kRayHit}) {
    EXPECT_FALSE(item_of(drawn_with(plan, away), look.words)) << look.words;
  }
}

/// Each view of a burst has the picture of the decision, in which they are numbered in the order of
/// their flight, and the points are told apart that they see.
TEST(CandidatesPicture, ShowsABurst) {
  const Flown& flown = watched_bursts().flown;
  const std::vector<ViewRecord>& views = flown.result.views;
  const auto later = std::ranges::find_if(
      views, [](const ViewRecord& view) { return view.decision.plan_view == 2; });
  ASSERT_NE(later, views.end());
  const Plan& burst = watched_bursts().plan_of(static_cast<std::size_t>(later->iteration));
  RunSource run{RunRecord{.folder = {}, .scenario = flown.scenario, .views = views}, flown.world};
  for (const ViewRecord& view : {*(later - 1), *later}) {
    const PictureOptions options{.iteration = view.iteration};
    const Picture picture = kCandidatesPicture.draw(run, options, {});
    EXPECT_NE(picture.detail.find(fmt::format(
                  "(iteration {}) was chosen: view {} of {} of the burst planned at view {}, ",
                  view.iteration, view.decision.plan_view, burst.chosen.size(), later->iteration)),
              std::string::npos)
        << picture.detail;
    for (std::size_t i = 0; i < burst.views.size(); ++i) {
      const Vec3& p_m = burst.views[i].view.p_world_m;
      EXPECT_TRUE(std::ranges::any_of(picture.panels[0].labels, [&](const PlaceLabel& label) {
        return label.text == std::to_string(i + 1) && label.p_world_m == p_m;
      }));
    }
    RenderScene scene;
    const ReplayedDecision& decision = run.decision(static_cast<std::size_t>(view.iteration));
    const Covered covered = add_points_to_cover(flown.scenario, decision, 0.1, scene);
    // each point is covered by one view at the most: by the first that sees it
    int by_views = 0;
    for (const std::size_t kept : burst.chosen) by_views += *burst.candidates[kept].covers;
    EXPECT_EQ(covered.covered, static_cast<std::size_t>(by_views));
    EXPECT_GT(covered.covered, 0U);
    std::size_t dots = 0;
    for (const DotsItem& item : scene.dots) dots += item.points_m.size();
    EXPECT_EQ(dots, covered.points);
  }
}

/// Whatever side of what the map knows the candidates are on, no direction around shows more.
TEST(CandidatesPicture, IsSeenFromWhereTheMostCandidatesShow) {
  const Box3 structure_m = bounds_m(watched().flown.world.structure);
  std::size_t worse = 0;
  for (const Vec3& side : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)}) {
    Plan plan = planned();
    const Vec3 half_m = 0.5 * structure_m.sizes().array() + 0.4;
    for (Candidate& candidate : plan.candidates) {
      candidate.view.p_world_m = structure_m.center() + half_m.cwiseProduct(side);
      candidate.rejected.reset();
    }
    const TempFolder temp;
    write_candidates(plan, temp.path());
    RunSource run = source(temp.path());
    const auto shown = [&](const PictureOptions& options) {
      const RenderView view = view_of(kCandidatesPicture, run, options);
      return std::count_if(plan.candidates.begin(), plan.candidates.end(), [&](const auto& c) {
        return shows(view, run.decision(kAsked).belief.grid, c.view.p_world_m, 0.0);
      });
    };
    for (int turn_deg = 0; turn_deg < 360; turn_deg += 45) {
      PictureOptions turned = asked();
      turned.angles = ViewAngles{ViewAngles{}.azimuth_rad + deg_to_rad(turn_deg)};
      EXPECT_LE(shown(turned), shown(asked())) << turn_deg;
      worse += shown(turned) < shown(asked()) ? 1 : 0;
    }
  }
  EXPECT_GT(worse, 0U);
}

TEST(CandidatesPicture, TheFirstViewWasChosenByNothing) {
  RunSource run = source();
  EXPECT_THROW(kCandidatesPicture.draw(run, {.iteration = 0}, {}), BadInput);
}

/// From that side of the middle of the map, as far away as shows all of it.
RenderView view_along(const OccupancyGrid& grid, const Vec3& from) {
  const GridGeometry& geometry = grid.geometry();
  const Vec3 middle_m =
      geometry.center_m(geometry.key_at(static_cast<VoxelIndex>(geometry.voxel_count() / 2)));
  RenderView view;
  view.T_world_camera = look_at(middle_m + 100.0 * from, middle_m);
  return view;
}

/// Against a ray from each voxel's middle in much finer steps.
TEST(Voxels, HideWhatIsBehindThemAndNothingElse) {
  const OccupancyGrid& grid = watched().beliefs.back().grid;
  const double beside_m = 3.0 * grid.geometry().resolution_m();
  for (const Vec3& axis : {Vec3(0.01, 0, 1), Vec3(1, 0, 0.01), Vec3(0, -1, 0.01)}) {
    const RenderView view = view_along(grid, axis);
    std::size_t hidden = 0;
    std::size_t shown = 0;
    std::size_t all = 0;
    for (const VoxelIndex v : sort_voxels(grid).occupied) {
      const Vec3 p_m = grid.geometry().center_m(grid.geometry().key_at(v));
      const Vec3 away_m = view.T_world_camera.translation() - p_m;
      bool is_covered = false;
      for (double t = beside_m; t < away_m.norm(); t += 0.01) {
        is_covered |= grid.state_at(p_m + t * away_m.normalized()) == VoxelState::occupied;
      }
      const bool is_shown = shows(view, grid, p_m, beside_m);
      EXPECT_TRUE(is_shown || is_covered);
      ++all;
      if (is_covered != is_shown) ++(is_shown ? shown : hidden);
    }
    EXPECT_GT(hidden + shown, 9 * all / 10);  // not where a corner is in the way
    EXPECT_GT(shown, 0U);
  }
}

TEST(Frontiers, TheChosenClusterStandsOutAndNumbersAreWhereTheirClustersShow) {
  const FrontierConfig& config = watched().flown.scenario.planner.fvs.frontier;
  const Belief& belief = watched().beliefs.back();
  FrontierMarks marks(belief.grid.geometry().voxel_count());
  const auto found = find_frontiers(config, belief.grid, belief.cloud, marks);
  ASSERT_GE(found.size(), 2U);
  ReplayedDecision decision{.belief = belief, .plan = {}};
  decision.plan.chosen = {0};
  decision.plan.frontier = voxels_of(found);
  for (const std::size_t first : {std::size_t{0}, found.size() - 1}) {
    decision.plan.clusters = {found[first]};  // the others may not be tried
    decision.plan.candidates = {{.view = {}, .sampler = Sampler::fvs, .cluster = 0}};
    Panel panel;
    add_frontiers(decision, 0.1, {}, panel);
    std::size_t faces = 0;
    for (const SurfaceItem& cubes : panel.scene.surfaces) faces += cubes.mesh.faces.size();
    EXPECT_EQ(faces, 12U * decision.plan.frontier.size());
    const SurfaceItem& chosen = panel.scene.surfaces.front();
    EXPECT_EQ(chosen.mesh.faces.size(), 12U * found[first].voxels.size());
    EXPECT_EQ(chosen.vertex_colours.front(), looks::kLookedAt.rgb());
    Box3 cube_m;  // the map's own cubes may fill their voxels, and do not hide it
    for (std::size_t i = 0; i < 24; ++i) cube_m.extend(chosen.mesh.vertices_m[i].cast<double>());
    EXPECT_GT(cube_m.volume(), 1.001 * std::pow(belief.grid.geometry().resolution_m(), 3.0));
  }
  decision.plan.clusters = found;
  decision.plan.candidates.at(0).cluster = static_cast<int>(found.size()) - 1;
  std::size_t most = 0;
  for (const Vec3& from : {Vec3(0.01, 0, 1), Vec3(1, 0, 0.2), Vec3(-1, 0, 0.2), Vec3(0, 1, 0.2)}) {
    const RenderView view = view_along(belief.grid, from);
    Panel panel;
    add_frontiers(decision, 0.1, view, panel);
    const auto in_sight = static_cast<std::size_t>(
        std::count_if(found.begin(), found.end(), [&](const FrontierCluster& cluster) {
          return shows(view, belief.grid, cluster.centroid_world_m,
                       3.0 * belief.grid.geometry().resolution_m());
        }));
    EXPECT_EQ(panel.labels.size(), in_sight);
    most = std::max(most, in_sight);
  }
  EXPECT_GE(most, 2U);
}

}  // namespace
}  // namespace gnbv
