#include "bench/limits/view_survey.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/limits/cloud_of_views.hpp"
#include "bench/limits/free_yaw_camera.hpp"
#include "bench/score/content_cache.hpp"
#include "bench/score/packed_numbers.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

constexpr int kYaws = 8;
constexpr double kFewestPixels = 0.05;  // share of the images that has to show a surface
constexpr std::size_t kViewsAtOnce = 16;

/// Cameras that look the same way with few pixels.
std::vector<CameraModel> coarse(std::span<const CameraModel> cameras) {
  std::vector<CameraModel> out;
  for (const CameraModel& camera : cameras) {
    CameraConfig config = camera.config;
    const double across = 40.0 / config.width_px;
    const double down = 32.0 / config.height_px;
    for (double* const px : {&config.fx_px, &config.cx_px, &config.skew_px}) *px *= across;
    for (double* const px : {&config.fy_px, &config.cy_px}) *px *= down;
    config.width_px = 40;
    config.height_px = 32;
    out.push_back(make_camera_model(config));
  }
  return out;
}

/// The most lattice steps between surveyed positions: half of what the most short-sighted camera
/// reaches, since nobody would see what lies between them.
std::int32_t longest_stride(const LegalViewpoints& legal, std::span<const CameraModel> cameras) {
  double reach_m = std::numeric_limits<double>::infinity();
  for (const CameraModel& camera : cameras) {
    reach_m = std::min(reach_m, return_end_m(camera.config));
  }
  return std::max(1, static_cast<std::int32_t>(0.5 * reach_m / legal.step_m));
}

double share_of_hits(std::span<const FrameRays> view) {
  std::ptrdiff_t hits = 0;
  std::size_t pixels = 0;
  for (const FrameRays& frame : view) {
    hits += std::count(frame.kind.begin(), frame.kind.end(), PixelRay::hits);
    pixels += frame.kind.size();
  }
  return static_cast<double>(hits) / static_cast<double>(std::max<std::size_t>(pixels, 1));
}

/// Of positions so many lattice steps apart.
std::vector<SurveyedView> worthwhile_views(const RayScene& scene, const LegalViewpoints& legal,
                                           std::span<const CameraModel> cameras, double floor_z_m,
                                           std::int32_t stride, int threads, const HeedStop& stop) {
  const std::vector<CameraModel> quick = coarse(cameras);
  const std::optional<GimbalConfig> gimbal = gimbal_of(cameras);
  const std::vector<double> pitches = gimbal ? pitches_rad(*gimbal) : std::vector<double>{0.0};
  double far_m = 0.0;
  for (const CameraModel& camera : cameras)
    far_m = std::max(far_m, FreeYawCamera(camera).reach_m());
  std::vector<std::vector<SurveyedView>> at(legal.size());
  parallel_for(threads, legal.size(), [&](std::size_t i) {
    heed(stop);
    const auto& cell = legal.cell[i];
    if (cell[0] % stride != 0 || cell[1] % stride != 0 || cell[2] % stride != 0) return;
    if (std::isinf(scene.distance_to_structure_m(legal.p_world_m[i], far_m))) return;
    std::vector<FrameRays> rays;
    for (int k = 0; k < kYaws; ++k) {
      for (const double pitch_rad : pitches) {
        const SurveyedView view{.position = static_cast<std::uint32_t>(i),
                                .yaw_rad = wrap_angle_rad(2.0 * kPi * k / kYaws),
                                .gimbal_pitch_rad = pitch_rad};
        take_view(scene, quick, pose_of(legal, view), floor_z_m, 1, rays);
        if (share_of_hits(rays) >= kFewestPixels) at[i].push_back(view);
      }
    }
  });
  std::vector<SurveyedView> views;
  for (const auto& some : at) views.insert(views.end(), some.begin(), some.end());
  return views;
}

}  // namespace

ViewPose pose_of(const LegalViewpoints& legal, const SurveyedView& view) {
  return {legal.p_world_m[view.position], view.yaw_rad, view.gimbal_pitch_rad};
}

ViewSurvey survey_views(const Scenario& scenario, const RayScene& scene,
                        const LegalViewpoints& legal, const SurfaceReference& reference,
                        int threads, const HeedStop& stop) {
  const std::vector<CameraModel> cameras = exact_cameras(scenario);
  const double floor_z_m = scenario.planner.floor_z_m;
  ViewSurvey survey;
  const std::int32_t longest = longest_stride(legal, cameras);
  for (std::int32_t stride = std::min(2, longest);; ++stride) {
    survey.views = worthwhile_views(scene, legal, cameras, floor_z_m, stride, threads, stop);
    if (survey.views.size() <= kManySurveyedViews || stride >= longest) break;
  }
  CloudOfViews cloud(scenario, reference.counted[0]);
  std::vector<std::vector<FrameRays>> rays(kViewsAtOnce);
  for (std::size_t begin = 0; begin < survey.views.size(); begin += kViewsAtOnce) {
    const std::size_t count = std::min(kViewsAtOnce, survey.views.size() - begin);
    heed(stop);
    parallel_for(threads, count, [&](std::size_t i) {
      SurveyedView& view = survey.views[begin + i];
      take_view(scene, cameras, pose_of(legal, view), floor_z_m, 1, rays[i]);
      view.finds = finds_alone(reference.counted[0], rays[i], scenario.planner.cloud.leaf_m);
    });
    for (std::size_t i = 0; i < count; ++i) cloud.add(rays[i]);
  }
  survey.leaf_raw = coverage_at_all_sizes(reference.raw, cloud.cloud().points_world_m());
  survey.leaf_counted = coverage_at_all_sizes(reference.counted, cloud.cloud().points_world_m());
  return survey;
}

std::string bytes_of(const ViewSurvey& survey) {
  std::string bytes;
  append_bytes(bytes, survey.leaf_raw);
  append_bytes(bytes, survey.leaf_counted);
  put_count(bytes, survey.views.size());
  for (const SurveyedView& view : survey.views) {
    append_bytes(bytes, view.position);
    append_bytes(bytes, view.yaw_rad);
    append_bytes(bytes, view.gimbal_pitch_rad);
    put_ascending(bytes, view.finds);
  }
  return bytes;
}

std::optional<ViewSurvey> survey_in(std::string_view bytes) {
  PackedNumbers in(bytes);
  ViewSurvey survey;
  survey.leaf_raw = in.take<std::array<double, 3>>();
  survey.leaf_counted = in.take<std::array<double, 3>>();
  for (std::uint64_t views = in.take_count(); views > 0 && in.is_good(); --views) {
    SurveyedView& view = survey.views.emplace_back();
    view.position = in.take<std::uint32_t>();
    view.yaw_rad = in.take<double>();
    view.gimbal_pitch_rad = in.take<double>();
    view.finds = in.take_ascending<std::uint32_t>();
  }
  if (!in.is_read()) return std::nullopt;
  return survey;
}

ViewSurvey cached_survey(const std::string& key, const Scenario& scenario, const RayScene& scene,
                         const LegalViewpoints& legal, const SurfaceReference& reference,
                         int threads, const HeedStop& stop) {
  return cached("view_survey", key, survey_in, bytes_of,
                [&] { return survey_views(scenario, scene, legal, reference, threads, stop); });
}

}  // namespace gnbv
