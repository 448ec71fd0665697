#include "tools/frames/frame_sight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "sensors/camera_model.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

constexpr double kSteepest_rad = deg_to_rad(80.0);

}  // namespace

FrameSight::FrameSight(const FrameRecord& record, std::size_t frame)
    : camera_(record.cameras[record.frames[frame].camera]),
      T_camera_world_(record.frames[frame].T_world_camera.inverse()),
      colour_(read_colour(record, frame)),
      depth_(read_depth(record, frame)) {}

std::optional<Sighting> FrameSight::sees(const Vec3& p_world_m, double blur_m) const {
  const Vec3 p_camera_m = T_camera_world_ * p_world_m;
  const double z_m = p_camera_m.z();
  if (!(z_m > 0.0)) return std::nullopt;
  const Eigen::Vector2d px = pixel_of(camera_, p_camera_m);
  const Sighting sighting{px.x(), px.y(), z_m};
  const bool is_inside = sighting.u_px >= 0.0 && sighting.u_px < camera_.width_px &&
                         sighting.v_px >= 0.0 && sighting.v_px < camera_.height_px;
  if (!is_inside) return std::nullopt;
  const auto pixel =
      static_cast<std::size_t>(sighting.v_px) * static_cast<std::size_t>(camera_.width_px) +
      static_cast<std::size_t>(sighting.u_px);
  const std::uint16_t depth = depth_.values[pixel];
  if (depth == 0) return std::nullopt;
  const double slope_m =
      0.5 * z_m / std::min(camera_.fx_px, camera_.fy_px) * std::tan(kSteepest_rad);
  const double off_m = std::abs(depth * camera_.depth_scale_m - z_m);
  if (off_m > slope_m + blur_m + camera_.depth_scale_m) return std::nullopt;
  return sighting;
}

Rgb8 FrameSight::colour_at(const Sighting& sighting) const {
  return colour_.at(static_cast<int>(sighting.u_px), static_cast<int>(sighting.v_px));
}

void for_each_frame(const FrameRecord& record, int threads, const ShareDone& progress,
                    const std::function<void(std::size_t frame, const FrameSight& sight)>& look) {
  const std::size_t count = record.frames.size();
  const std::size_t batch = 16 * static_cast<std::size_t>(std::max(threads, 1));
  for (std::size_t first = 0; first < count; first += batch) {
    progress(static_cast<double>(first) / static_cast<double>(count));
    parallel_for(threads, std::min(batch, count - first),
                 [&](std::size_t i) { look(first + i, FrameSight(record, first + i)); });
  }
  progress(1.0);
}

double cloud_blur_m(const RunRecord& record) { return 0.5 * record.scenario.planner.cloud.leaf_m; }

CloudColours::CloudColours(const RunRecord& record, const RunCloud& cloud,
                           const FrameRecord& frames, std::span<const std::size_t> points)
    : record_(record),
      cloud_(cloud),
      frames_(frames),
      points_(points),
      blur_m_(cloud_blur_m(record)),
      has_flight_frames_(std::any_of(record.scenario.cameras.begin(), record.scenario.cameras.end(),
                                     [](const CameraConfig& c) { return c.rate_hz > 0.0; })),
      best_(points.size(), {.z_m = std::numeric_limits<double>::infinity()}) {}

bool CloudColours::is_before(const Seen& a, const Seen& b) {
  return std::tie(a.is_foreign, a.z_m, a.frame) < std::tie(b.is_foreign, b.z_m, b.frame);
}

/// Its index among the record's views; their number for a frame of none of them.
std::size_t CloudColours::view_of(std::size_t frame) const {
  const auto view = std::find_if(
      record_.views.begin(), record_.views.end(),
      [&](const ViewRecord& v) { return v.iteration == frames_.frames[frame].iteration; });
  return static_cast<std::size_t>(view - record_.views.begin());
}

void CloudColours::look(std::size_t frame, const FrameSight& sight) {
  std::vector<Seen> seen;
  // points [begin, end) of the cloud, as far as they are asked for
  const auto look_at = [&](std::size_t begin, std::size_t end, bool is_foreign) {
    auto i = std::lower_bound(points_.begin(), points_.end(), begin);
    for (; i != points_.end() && *i < end; ++i) {
      const auto at = sight.sees(cloud_.points_world_m[*i].cast<double>(), blur_m_);
      if (!at) continue;
      const auto point = static_cast<std::size_t>(i - points_.begin());
      seen.push_back({point, is_foreign, at->z_m, frame, sight.colour_at(*at)});
    }
  };
  const std::vector<std::size_t>& ends = cloud_.view_points;
  const std::size_t own = view_of(frame);
  std::size_t begin = cloud_.profile_points;
  look_at(0, begin, true);
  for (std::size_t view = 0; view < ends.size(); ++view) {
    if (view == own || has_flight_frames_) look_at(begin, ends[view], view != own);
    begin = ends[view];
  }
  look_at(begin, cloud_.points_world_m.size(), true);
  const std::lock_guard lock(mutex_);
  for (const Seen& s : seen) {
    if (is_before(s, best_[s.point])) best_[s.point] = s;
  }
}

std::vector<Rgb8> CloudColours::colours(const Rgb8& unseen) const {
  std::vector<Rgb8> colours;
  colours.reserve(best_.size());
  for (const Seen& s : best_) colours.push_back(std::isfinite(s.z_m) ? s.rgb : unseen);
  return colours;
}

std::vector<Rgb8> colours_of_cloud(const RunRecord& record, const RunCloud& cloud,
                                   const FrameRecord& frames, int threads,
                                   const ShareDone& progress) {
  std::vector<std::size_t> all(cloud.points_world_m.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  CloudColours colours(record, cloud, frames, all);
  for_each_frame(frames, threads, progress,
                 [&](std::size_t frame, const FrameSight& sight) { colours.look(frame, sight); });
  return colours.colours(kNoColour);
}

}  // namespace gnbv
