#include "tools/render/candidate_views.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/core/error.hpp"
#include "tools/render/candidate_legend.hpp"

namespace gnbv {
namespace {

// How much of a length shows from there: 1 from beside it, 0 along it.
double shown_share(const Vec3& length_m, const ViewAngles& angles) {
  const Vec3 towards(std::cos(angles.azimuth_rad) * std::cos(angles.elevation_rad),
                     std::sin(angles.azimuth_rad) * std::cos(angles.elevation_rad),
                     std::sin(angles.elevation_rad));
  return length_m.norm() > 0.0 ? length_m.normalized().cross(towards).norm() : 1.0;
}

// From behind the chosen view and beside it, on the side of the picture's camera, but not from
// where the way there is seen end on.
ViewAngles near_angles(const ViewPose& chosen, const Vec3& way_m, double picture_azimuth_rad) {
  constexpr double kShown = 0.6;
  ViewAngles best;
  double best_share = -1.0;
  for (const double beside_rad : {deg_to_rad(55.0), deg_to_rad(85.0), deg_to_rad(25.0)}) {
    std::array<double, 2> sides_rad = {chosen.yaw_rad + kPi + beside_rad,
                                       chosen.yaw_rad + kPi - beside_rad};
    const auto away_rad = [&](double azimuth_rad) {
      return std::abs(wrap_angle_rad(azimuth_rad - picture_azimuth_rad));
    };
    if (away_rad(sides_rad[1]) < away_rad(sides_rad[0])) std::swap(sides_rad[0], sides_rad[1]);
    for (const double azimuth_rad : sides_rad) {
      const ViewAngles angles{azimuth_rad, deg_to_rad(25.0)};
      const double share = std::min(kShown, shown_share(way_m, angles));
      if (share <= best_share) continue;
      best = angles;
      best_share = share;
    }
  }
  return best;
}

/// What the candidates are worth that a picture from there shows.
double worth_shown(const ReplayedDecision& decision, const RenderView& view) {
  constexpr double kChosen = 40.0;
  constexpr double kValid = 4.0;
  const Plan& plan = decision.plan;
  double worth = 0.0;
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    const Candidate& candidate = plan.candidates[i];
    if (candidate.rejected == Rejection::out_of_bounds) continue;
    if (!is_shown(candidate, decision.belief.grid, std::array{PanelView{view}})) continue;
    worth += plan.is_chosen(i) ? kChosen : candidate.rejected ? 1.0 : kValid;
  }
  return worth;
}

}  // namespace

std::size_t decision_asked(const RunRecord& record, const PictureOptions& options) {
  const std::size_t iteration = iteration_of(record, options, record.views.size() / 2);
  if (iteration > 0) return iteration;
  throw BadInput(
      fmt::format("{}: view 0 is where the mission starts: nothing chose it; --iteration "
                  "asks for one from 1 on",
                  record.folder.string()));
}

void frame_candidates(RunSource& run, const PictureOptions& options,
                      std::vector<Vec3>& points_world_m) {
  const RunRecord& record = run.record();
  const std::size_t iteration = decision_asked(record, options);
  frame_structure(run, points_world_m);
  // voxels stick out of the surface
  const double beside_m = record.scenario.planner.map.resolution_m;
  for (std::size_t i = points_world_m.size(); i-- > 0;) {
    for (const double side_m : {beside_m, -beside_m}) {
      points_world_m.push_back(points_world_m[i] + Vec3(side_m, side_m, 0.0));
      points_world_m.push_back(points_world_m[i] + Vec3(side_m, -side_m, 0.0));
    }
  }
  for (const Candidate& candidate : run.decision(iteration).plan.candidates) {
    // those beyond the bounds lie far around everything else
    if (candidate.rejected == Rejection::out_of_bounds) continue;
    points_world_m.push_back(candidate.view.p_world_m);
  }
  points_world_m.push_back(record.views[iteration - 1].decision.view.p_world_m);
  points_world_m.push_back(record.views[iteration].decision.view.p_world_m);
}

ViewAngles angles_to_candidates(std::span<RunSource* const> runs, const PictureOptions& options) {
  constexpr int kDirections = 8;
  const RenderView picture{.width_px = 640, .height_px = 480};
  ViewAngles best;
  double most = -1.0;
  std::vector<Vec3> points_m;
  for (RunSource* const run : runs) frame_candidates(*run, options, points_m);
  for (int i = 0; i < kDirections; ++i) {
    ViewAngles angles;
    angles.azimuth_rad = wrap_angle_rad(angles.azimuth_rad + 2.0 * kPi * i / kDirections);
    const RenderView view = frame_points(points_m, angles, picture.width_px, picture.height_px);
    double worth = 0.0;
    for (RunSource* const run : runs) {
      worth += worth_shown(run->decision(decision_asked(run->record(), options)), view);
    }
    if (worth <= most) continue;
    most = worth;
    best = angles;
  }
  return best;
}

RenderView near_view(const RunRecord& record, std::size_t iteration, const RenderScene& chosen,
                     const RenderView& whole) {
  const ViewPose& pose = record.views[iteration].decision.view;
  std::vector<Vec3> points_m = {record.views[iteration - 1].decision.view.p_world_m,
                                pose.p_world_m};
  for (const BallItem& ball : chosen.balls) points_m.push_back(ball.centre_m.cast<double>());
  for (const TubeItem& ray : chosen.tubes) points_m.push_back(ray.points_m.back().cast<double>());
  for (const FrustumItem& frustum : chosen.frusta) {  // the axis, and as much to its sides
    const double half_m = frustum.length_m * std::tan(0.5 * frustum.fov_x_rad);
    for (const double side_m : {-half_m, half_m}) {
      points_m.push_back(frustum.T_world_camera * Vec3(side_m, 0.0, frustum.length_m));
      points_m.push_back(frustum.T_world_camera * Vec3(0.0, side_m, frustum.length_m));
    }
  }
  const Vec3 to_camera = -whole.T_world_camera.linear().col(2);
  const ViewAngles angles =
      near_angles(pose, points_m[1] - points_m[0], std::atan2(to_camera.y(), to_camera.x()));
  const FrameMargins margins{.left = 0.08, .right = 0.08, .top = 0.06, .bottom = 0.1};
  return frame_points(points_m, angles, whole.width_px, whole.height_px, margins);
}

}  // namespace gnbv
